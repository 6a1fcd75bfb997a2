// One sub-step: twin of `Step` in ../motion.rs. Rectangles are x, y, width,
// height; a place is counted from the region's corner.

struct Step {
    motion: Motion,
    // The contact grown by 2: all cells that may change.
    region: vec4<u32>,
    contact: vec4<u32>,
    canvas: vec2<u32>,
    first_touch: u32,
    spare: u32,
}

fn canvas_index(place: vec2<u32>) -> u32 {
    let at = now.region.xy + place;
    return at.y * now.canvas.x + at.x;
}

// Left of or above the contact a difference wraps, and is no less beyond it.
fn within_contact(place: vec2<u32>) -> bool {
    return all(now.region.xy + place - now.contact.xy < now.contact.zw);
}

fn touch_index(place: vec2<u32>) -> u32 {
    let over = now.region.xy + place - now.contact.xy;
    return now.first_touch + over.y * now.contact.z + over.x;
}
