// The ink that hatching puts on a point; twin of ink.rs. It reads the array `quads`.

const COARSEST_SIDE: i32 = 32;
const FINEST_LEVEL: i32 = 3;
const DIRECTIONS_MEET: f32 = 1.0 / 3.0;

struct Patch {
    u: f32,
    v: f32,
    u_per_px: f32,
    v_per_px: f32,
    weight: f32,
}

// The threshold at a place of the tile, for strokes of a density in octaves.
fn threshold(at: vec2<f32>, density: i32) -> f32 {
    let octave = clamp(density, -8, 14);
    let level = clamp(octave, 0, FINEST_LEVEL);
    let side = COARSEST_SIDE << u32(level);
    let texels = bitcast<f32>(u32(octave - level + 127) << 23u) * f32(side);
    let place = at * texels - 0.5;
    let corner = floor(place);
    let part = place - corner;
    let column = i32(corner.x) & (side - 1);
    let row = i32(corner.y) & (side - 1);
    let first = (side * side - COARSEST_SIDE * COARSEST_SIDE) / 3;
    let quad = unpack4x8unorm(quads[first + row * side + column]);
    let rows = mix(quad.xz, quad.yw, part.x);
    return mix(rows.x, rows.y, part.y);
}

fn inked(edge: f32, tone: f32, softness: f32) -> f32 {
    let at = clamp((tone - edge) / softness * 0.5 + 0.5, 0.0, 1.0);
    return 1.0 - at * at * (3.0 - 2.0 * at);
}

// Ink of strokes along the first coordinate, where the second changes by `per_px`.
fn strokes(at: vec2<f32>, per_px: f32, tone: f32, softness: f32, scale: f32) -> f32 {
    let density = bitcast<u32>(scale / max(per_px, 1e-12));
    let octave = i32(density >> 23u) - 127;
    let part = bitcast<f32>((density & 0x7fffffu) | 0x3f800000u);
    let passed = clamp((part - 1.1892071) * 2.0310876, 0.0, 1.0);
    var ink = 0.0;
    if passed < 1.0 {
        ink = inked(threshold(at, octave), tone, softness);
    }
    if passed > 0.0 {
        let finer = inked(threshold(at, octave + 1), tone, softness);
        ink += (finer - ink) * passed;
    }
    return ink * min((1.0 - tone) / softness * 2.0, 1.0);
}

// Ink of a tone on a patch of a surface.
fn ink_on(place: Patch, tone: f32, softness: f32, scale: f32) -> f32 {
    if tone >= 1.0 {
        return 0.0;
    }
    if tone >= DIRECTIONS_MEET {
        return strokes(vec2(place.u, place.v), place.v_per_px, tone, softness, scale);
    }
    let dark = max(tone, 0.0);
    let along = sqrt(dark * DIRECTIONS_MEET);
    let across = sqrt(dark / DIRECTIONS_MEET);
    let ink = strokes(vec2(place.u, place.v), place.v_per_px, along, softness, scale);
    let turned = vec2(place.v + 0.37, place.u);
    let crossed = strokes(turned, place.u_per_px, across, softness, scale);
    return 1.0 - (1.0 - ink) * (1.0 - crossed);
}
