// What the head is over one cell of the canvas; twin of contact.rs.

struct Touch {
    height: i32,
    brush_cell: u32,
    velocity: u32,
    weights: u32,
}

// Two numbers in one, each a two's complement of 16 bits.
fn halves(both: u32) -> vec2<i32> {
    let signed = bitcast<i32>(both);
    return vec2((signed << 16u) >> 16u, signed >> 16u);
}

fn touch_velocity(touch: Touch) -> vec2<i32> {
    return halves(touch.velocity);
}

fn touch_speed(touch: Touch) -> u32 {
    return touch.weights & 0xffffu;
}

fn touch_sharers(touch: Touch) -> u32 {
    return touch.weights >> 16u;
}
