// One sub-step: twin of `Step` in ../motion.rs. Rectangles are x, y, width, height.

struct Step {
    motion: Motion,
    // The contact grown by 2: all cells that may change.
    region: vec4<u32>,
    contact: vec4<u32>,
    canvas: vec2<u32>,
    first_touch: u32,
    brush_cells: u32,
}
