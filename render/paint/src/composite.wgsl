// Composites a Kubelka-Munk film over a backing at eight wavelengths. This is the twin of
// composite.rs. Wavelengths 0 to 3 are `low`, 4 to 7 `high`.

struct Nodes {
    low: vec4<f32>,
    high: vec4<f32>,
}

// K and S per quantum, two vectors per slot.
struct LayerOptics {
    absorption: array<vec4<f32>, 16>,
    scattering: array<vec4<f32>, 16>,
    // Shares of a cell that a quantum covers: of slots 0 to 3, of slots 4 to 7, and of vehicle.
    covers: array<vec4<f32>, 3>,
}

// Computes 1 - exp(-y), given e = exp(-y). Where this difference would lose digits, a series
// replaces it. There are no quotients, because software devices compute them slowly.
fn one_minus_exp(y: vec4<f32>, e: vec4<f32>) -> vec4<f32> {
    let tail = 1.0 / 24.0 - y * (1.0 / 120.0 - y * (1.0 / 720.0 - y * (1.0 / 5040.0)));
    let series = y * (1.0 - y * (0.5 - y * (1.0 / 6.0 - y * tail)));
    return select(1.0 - e, series, y < vec4(0.5));
}

// Internal reflectance of a film of unit thickness over the backing g; see composite.rs:
//   x = sqrt(K (K + 2 S))   e = exp(-2 x)   n = S (1 - e)
//   den = (K + S) (1 - e) + (1 + e) x       above = den - n g
//   R = (n above + 4 e x^2 g) / (den above)
fn film(k: vec4<f32>, s: vec4<f32>, g: vec4<f32>) -> vec4<f32> {
    let x = max(sqrt(k * (k + 2.0 * s)), vec4(1e-5));
    let e = exp(-2.0 * x);
    let rest = one_minus_exp(2.0 * x, e);
    let through = e * x + x;
    let n = s * rest;
    let den = (k + s) * rest + through;
    let above = (k + s * (1.0 - g)) * rest + through;
    // Separate quotients, since the product of the denominators may overflow f32.
    let share = 1.0 / den;
    let r = n * share + (2.0 * x * share) * (2.0 * x / above) * e * g;
    return select(min(r, vec4(1.0)), g, k + s <= vec4(0.0));
}

struct Sums {
    k: Nodes,
    s: Nodes,
}

// Adds one slot's K and S. The uniform `params` of the including shader has a field `layer`, since
// uniforms cannot be passed to functions.
fn with_slot(sums: Sums, slot: u32, amount: f32) -> Sums {
    return Sums(
        Nodes(
            sums.k.low + amount * params.layer.absorption[2u * slot],
            sums.k.high + amount * params.layer.absorption[2u * slot + 1u],
        ),
        Nodes(
            sums.s.low + amount * params.layer.scattering[2u * slot],
            sums.s.high + amount * params.layer.scattering[2u * slot + 1u],
        ),
    );
}

// Part of a cell that a film covers, above 1 for a thick one; see composite.rs.
fn covered_part(cell: Cell) -> f32 {
    let low = dot(vec4<f32>(cell.low), params.layer.covers[0]);
    let high = dot(vec4<f32>(cell.high), params.layer.covers[1]);
    return low + high + f32(cell.vehicle) * params.layer.covers[2].x;
}

// Composites the film of `cell` over `backing`. `covered` is what it covers, for a skin together with its body. We
// unroll this, since a variable index would send the vectors through memory.
fn composite(cell: Cell, covered: f32, backing: Nodes) -> Nodes {
    let low = vec4<f32>(cell.low);
    let high = vec4<f32>(cell.high);
    let share = select(1.0, covered, covered > 0.0 && covered < 1.0);
    let thickening = 1.0 / share;
    let thick_low = thickening * low;
    let thick_high = thickening * high;
    var sums = with_slot(Sums(), 0u, thick_low.x);
    sums = with_slot(sums, 1u, thick_low.y);
    sums = with_slot(sums, 2u, thick_low.z);
    sums = with_slot(sums, 3u, thick_low.w);
    sums = with_slot(sums, 4u, thick_high.x);
    sums = with_slot(sums, 5u, thick_high.y);
    sums = with_slot(sums, 6u, thick_high.z);
    sums = with_slot(sums, 7u, thick_high.w);
    // With `mix`, an empty skin would change the last bit of what is below.
    let over_low = film(sums.k.low, sums.s.low, backing.low) - backing.low;
    let over_high = film(sums.k.high, sums.s.high, backing.high) - backing.high;
    return Nodes(backing.low + share * over_low, backing.high + share * over_high);
}
