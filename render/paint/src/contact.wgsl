// The head's surface above one cell of the canvas. This is the twin of contact.rs.

struct Touch {
    height: i32,
    brush_cell: u32,
    velocity: u32,
    weights: u32,
}

struct ExchangeRates {
    release: u32,
    film: u32,
    deposit: u32,
    pick_up: u32,
    mixing: u32,
    sink: u32,
    drag: u32,
    bearing: u32,
    shear: u32,
    held: u32,
    carried: u32,
    padding: u32,
}

// Unpacks two 16-bit numbers in two's complement: low half, high half.
fn halves(packed: u32) -> vec2<i32> {
    let signed = bitcast<i32>(packed);
    return vec2((signed << 16u) >> 16u, signed >> 16u);
}

fn touch_velocity(touch: Touch) -> vec2<i32> {
    return halves(touch.velocity);
}

fn touch_transfer_weight(touch: Touch) -> u32 {
    return touch.weights & 0x1ffu;
}

fn touch_release(touch: Touch) -> u32 {
    return (touch.weights >> 9u) & 0x7fu;
}

fn touch_sharers(touch: Touch) -> u32 {
    return touch.weights >> 16u;
}
