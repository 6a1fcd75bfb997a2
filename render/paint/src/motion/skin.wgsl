// The two wet films of a cell. This is the twin of skin.rs.

// Largest difference of two mixtures that count as one, in parts of 65536.
const ALIKE = 2048u;

fn apart(a: u32, whole_a: u32, b: u32, whole_b: u32) -> u32 {
    let x = ratio_of_65536(a, whole_a);
    let y = ratio_of_65536(b, whole_b);
    return max(x, y) - min(x, y);
}

fn four_apart(a: vec4<u32>, whole_a: u32, b: vec4<u32>, whole_b: u32) -> u32 {
    return apart(a.x, whole_a, b.x, whole_b) + apart(a.y, whole_a, b.y, whole_b)
        + apart(a.z, whole_a, b.z, whole_b) + apart(a.w, whole_a, b.w, whole_b);
}

fn settling(body: Cell, skin: Cell, most: u32) -> u32 {
    let below = volume(body);
    let above = volume(skin);
    let difference = four_apart(body.low, below, skin.low, above)
        + four_apart(body.high, below, skin.high, above)
        + apart(body.vehicle, below, skin.vehicle, above);
    if below == 0u || difference <= ALIKE {
        return 65536u;
    }
    return ratio_of_65536(above - min(above, most), above);
}

// x: share of the body, y: share of the skin, in parts of 65536.
fn drying(share: u32, body: u32, skin: u32) -> vec2<u32> {
    if skin == 0u || share == 65536u {
        return vec2(share);
    }
    let dries = share_of_65536(body + skin, share);
    if dries < body {
        return vec2(ratio_of_65536(dries, body), 0u);
    }
    return vec2(65536u, ratio_of_65536(dries - body, skin));
}

// x: share of the body, y: share of the skin, in parts of 65536.
fn stirred(rates: ExchangeRates, touch: Touch, penetration: i32, body: u32, skin: u32) -> vec2<u32> {
    let depth = u32(max(penetration, 0));
    let reached = min(depth - min(depth, skin), body);
    let stirred_in = share_of_65536(min(reached, skin), rates.shear);
    let moved = share_of_256(stirred_in, touch_transfer_weight(touch));
    return vec2(ratio_of_65536(moved, body), ratio_of_65536(moved, skin));
}
