
// Sums divided by their weights, shown as a pixel; twin of divided.rs and of coloring.rs.

const STEPS: f32 = 4096.0;
const OVERHANG: vec2<f32> = vec2(0.7, 0.9);
const BRISTLES: f32 = 1.0;
const THIN: f32 = 1e-3;

const YUV: u32 = 1u;
const CIELAB: u32 = 2u;

struct Pixel {
    color: vec4<f32>,
    height: f32,
}

// Rises from 0 at `low` to 1 at `high`.
fn smooth_step(low: f32, high: f32, at: f32) -> f32 {
    let share = clamp((at - low) / (high - low), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

fn encoded(linear: f32) -> f32 {
    let at = clamp(linear, 0.0, 1.0) * STEPS;
    let step = u32(at);
    let low = encoded_values[step];
    return low + (encoded_values[step + 1u] - low) * (at - f32(step));
}

fn of_lab(lab: vec3<f32>) -> vec3<f32> {
    const KNEE: f32 = 6.0 / 29.0;
    let middle = (lab.x + 16.0) / 116.0;
    let root = vec3(middle + lab.y / 500.0, middle, middle - lab.z / 200.0);
    let below = 3.0 * KNEE * KNEE * (root - 4.0 / 29.0);
    let xyz = params.white * select(below, root * root * root, root > vec3(KNEE));
    return vec3(
        encoded(dot(params.rgb_from_xyz[0].xyz, xyz)),
        encoded(dot(params.rgb_from_xyz[1].xyz, xyz)),
        encoded(dot(params.rgb_from_xyz[2].xyz, xyz)),
    );
}

// Encoded sRGB of a colour in the coordinates of mixing.
fn shown_color(color: vec3<f32>) -> vec3<f32> {
    var rgb = color;
    if params.coordinates == YUV {
        let green = color.x - 0.39465 * color.y - 0.58060 * color.z;
        rgb = vec3(color.x + 1.13983 * color.z, green, color.x + 2.03211 * color.y);
    } else if params.coordinates == CIELAB {
        rgb = of_lab(color);
    }
    return clamp(rgb, vec3(0.0), vec3(1.0));
}

// Encoded sRGB and height of one surface; zeros where it has no stroke.
fn surface(sums: Sums) -> vec4<f32> {
    if sums.weight <= LOST {
        return vec4(0.0);
    }
    let value = params.low + params.step * (sums.bytes * (1.0 / (256.0 * sums.weight)));
    return vec4(shown_color(value.xyz + sums.color / sums.weight), value.w);
}

// How high the brushwork stands, 0 to 1; its lightness in maps without relief.
fn ridge(sums: Sums) -> f32 {
    let byte = select(sums.bytes.x, sums.bytes.w, params.step.w > 0.0);
    return select(0.0, byte / (65280.0 * sums.weight), sums.weight > LOST);
}

// Shares of a pixel that show strokes before the mesh, and strokes on it.
fn shown_shares(gathered: Gathered, covered: bool) -> vec2<f32> {
    let on = select(0.0, gathered.on.cover, gathered.on.weight > LOST);
    // Nothing lies below the lowest layer.
    let lowest = params.thin <= THIN;
    var under = min(on * (1.0 / THIN), 1.0);
    if !lowest {
        let high = on * (1.0 + BRISTLES * (ridge(gathered.on) - 0.5));
        under = smooth_step(0.5 * params.thin, 1.5 * params.thin, high);
    }
    let out = select(0.0, gathered.before.cover, gathered.before.weight > LOST);
    var over = 0.0;
    if params.overhang > 0.0 && out > 0.0 {
        let high = out * (1.0 + BRISTLES * (ridge(gathered.before) - 0.5));
        let start = OVERHANG.x * (1.0 - params.overhang);
        over = smooth_step(start, start + OVERHANG.y - OVERHANG.x, high);
    }
    // A mesh that is seen is never bare where any stroke reaches.
    if covered && lowest && out > 0.0 {
        over += (1.0 - over) * (1.0 - under);
    }
    return vec2(max(over, 0.0), (1.0 - max(over, 0.0)) * under);
}

// Pass 3: encoded sRGB with cover, and height.
fn divided(gathered: Gathered, covered: bool) -> Pixel {
    let shares = shown_shares(gathered, covered);
    let on = surface(gathered.on);
    let before = surface(gathered.before);
    let cover = shares.x + shares.y;
    let mixed = select(on.xyz, (before.xyz * shares.x + on.xyz * shares.y) / cover, shares.x > 0.0);
    return Pixel(vec4(mixed, cover), before.w * shares.x + on.w * shares.y);
}
