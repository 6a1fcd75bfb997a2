// The surface of the paint before the stroke. This is the twin of bed.rs. Blocks are 8 x 8 cells.

// x: the first of the blocks between which a cell lies, y: the second, z: the share of the second
// in parts of 16.
fn between_blocks(place: u32, blocks: u32) -> vec3<u32> {
    let shifted = place + 4u;
    let second = shifted / 8u;
    return vec3(max(second, 1u) - 1u, min(second, blocks - 1u), 2u * (shifted % 8u) + 1u);
}

fn bed_height(upper: vec2<i32>, lower: vec2<i32>, right: u32, down: u32) -> i32 {
    let across = vec2(16 - i32(right), i32(right));
    let up = upper.x * across.x + upper.y * across.y;
    let low = lower.x * across.x + lower.y * across.y;
    return up * (16 - i32(down)) + low * i32(down);
}
