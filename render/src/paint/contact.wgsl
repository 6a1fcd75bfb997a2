// What the head is over one cell of the canvas; twin of contact.rs.

struct Touch {
    height: i32,
    brush_cell: u32,
    velocity: u32,
    weights: u32,
}

// Two's complement of 16 bits in either half.
fn touch_velocity(touch: Touch) -> vec2<i32> {
    let both = bitcast<i32>(touch.velocity);
    return vec2((both << 16u) >> 16u, both >> 16u);
}

fn touch_speed(touch: Touch) -> u32 {
    return touch.weights & 0xffffu;
}

fn touch_sharers(touch: Touch) -> u32 {
    return touch.weights >> 16u;
}
