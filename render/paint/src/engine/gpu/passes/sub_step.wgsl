// Uniforms and indices of one sub-step. This is the twin of `SubStepParams` in ../sub_step.rs.
// Rectangles are x, y, width, height in cells. `place` is a cell relative to the region's upper
// left corner.

struct SubStepParams {
    motion: MotionConstants,
    rates: ExchangeRates,
    // The contact's rectangle grown by 2: all cells that may change.
    region: vec4<u32>,
    contact: vec4<u32>,
    canvas: vec2<u32>,
    // Index of the contact's first touch in the batch.
    first_touch: u32,
    brush_cells: u32,
    // x: index of the mask's first word in the buffer of the floor, 0 without a mask. y: index of the
    // first block's painted cells there. z: 1 if a cell of the region may have a skin.
    mask: vec4<u32>,
}

// Distance from the body of a cell of the canvas to its skin, in cells.
fn canvas_skin() -> u32 {
    return params.canvas.x * params.canvas.y;
}

// Distance from the body of a cell of the region to its skin, in cells.
fn region_skin() -> u32 {
    return params.region.z * params.region.w;
}

fn canvas_index(place: vec2<u32>) -> u32 {
    let at = params.region.xy + place;
    return at.y * params.canvas.x + at.x;
}

// To the left of or above the contact this difference wraps to a large number, which lies outside
// as well.
fn within_contact(place: vec2<u32>) -> bool {
    return all(params.region.xy + place - params.contact.xy < params.contact.zw);
}

fn touch_index(place: vec2<u32>) -> u32 {
    let at = params.region.xy + place - params.contact.xy;
    return params.first_touch + at.y * params.contact.z + at.x;
}
