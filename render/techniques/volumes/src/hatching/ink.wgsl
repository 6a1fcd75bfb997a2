// The ink that hatching puts on a point. This is the twin of ink.rs and reads the array `quads`.

const SIDE: i32 = 512;
const DIRECTIONS_MEET: f32 = 0.4;

// Magnification of the second slice.
const SECOND: f32 = 1.4142135;

struct Patch {
    u: f32,
    v: f32,
    across_per_px: f32,
    v_per_px: f32,
    weight: f32,
}

// The threshold at a place of the tile, in a slice and an octave of density.
fn threshold(at: vec2<f32>, density: i32, slice: i32) -> f32 {
    let octave = clamp(density, -8, 14);
    let texels = bitcast<f32>(u32(octave + 127) << 23u) * f32(SIDE);
    let place = at * texels - 0.5;
    let corner = floor(place);
    let part = place - corner;
    let column = i32(corner.x) & (SIDE - 1);
    let row = i32(corner.y) & (SIDE - 1);
    let quad = unpack4x8unorm(quads[(slice * SIDE + row) * SIDE + column]);
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
    var slice = 0;
    var passed = (part - 1.0) / (SECOND - 1.0);
    if part >= SECOND {
        slice = 1;
        passed = (part - SECOND) / (2.0 - SECOND);
    }
    let own = inked(threshold(at, octave, slice), tone, softness);
    let next = inked(threshold(at, octave + slice, 1 - slice), tone, softness);
    let ink = own + (next - own) * passed;
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
    let root = sqrt(max(tone, 0.0) / DIRECTIONS_MEET);
    let fourth = sqrt(root);
    let along = DIRECTIONS_MEET * fourth;
    let ink = strokes(vec2(place.u, place.v), place.v_per_px, along, softness, scale);
    let turned = vec2(place.u - 2.0 * place.v + 0.37, 2.0 * place.u + place.v);
    let crossed = strokes(turned, place.across_per_px, root * fourth, softness, scale);
    return 1.0 - (1.0 - ink) * (1.0 - crossed);
}
