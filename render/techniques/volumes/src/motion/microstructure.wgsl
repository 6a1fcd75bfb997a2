// Resting radii of particles over the hills of the surfaces. This is the twin of star.rs, and of
// `SolidHills` in graphics.

const STEEPEST: f32 = 1.746;
const FACTORS: vec3<u32> = vec3(0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du);

fn mixed(word: u32) -> u32 {
    let once = (word ^ (word >> 16u)) * 0x85ebca6bu;
    let twice = (once ^ (once >> 13u)) * 0xc2b2ae35u;
    return twice ^ (twice >> 16u);
}

// The height by the slope at one of the eight corners.
fn corner_height(corner: vec3<u32>, hashes: vec3<u32>, inside: vec3<f32>) -> f32 {
    let hash = hashes + corner * FACTORS;
    let word = mixed(hash.x ^ hash.y ^ hash.z ^ params.seed);
    let parts = vec3(word >> 22u, (word >> 12u) & 1023u, (word >> 2u) & 1023u);
    let way = inside - vec3<f32>(corner);
    let slopes = vec3<f32>(vec3<i32>(parts)) * way;
    return (slopes.x + slopes.y + slopes.z) * (2.0 / 1023.0) - (way.x + way.y + way.z);
}

fn mixed_heights(near: f32, far: f32, share: f32) -> f32 {
    return near + (far - near) * share;
}

// The height between the four corners at the near or far side along z.
fn side_height(back: u32, hashes: vec3<u32>, inside: vec3<f32>, shares: vec3<f32>) -> f32 {
    let upper = mixed_heights(
        corner_height(vec3(0u, 0u, back), hashes, inside),
        corner_height(vec3(1u, 0u, back), hashes, inside),
        shares.x,
    );
    let lower = mixed_heights(
        corner_height(vec3(0u, 1u, back), hashes, inside),
        corner_height(vec3(1u, 1u, back), hashes, inside),
        shares.x,
    );
    return mixed_heights(upper, lower, shares.y);
}

fn hill(place: vec3<f32>) -> f32 {
    let low = floor(place);
    let inside = place - low;
    let hashes = bitcast<vec3<u32>>(vec3<i32>(low)) * FACTORS;
    let shares = inside * inside * inside * (inside * (inside * 6.0 - 15.0) + 10.0);
    let near = side_height(0u, hashes, inside, shares);
    let far = side_height(1u, hashes, inside, shares);
    return clamp(mixed_heights(near, far, shares.z) * STEEPEST, -1.0, 1.0);
}

// R (1 + a N(c + R u)) over the inradius, whose inverse is `scale`.
fn resting_radius(center: vec3<f32>, towards: vec3<f32>, radius: f32, scale: f32) -> f32 {
    if params.height == 0.0 {
        return radius * scale;
    }
    return radius * scale * (1.0 + params.height * hill((center + radius * towards) * params.units));
}
