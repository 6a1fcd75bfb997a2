// Transfer of paint between canvas and head. This is the twin of transfer.rs.

struct Exchange {
    // Shares of the head's cell and of the canvas's body and skin, in parts of 65536.
    down: u32,
    up_body: u32,
    up_skin: u32,
}

fn exchange(
    rates: ExchangeRates,
    touch: Touch,
    penetration: i32,
    coat_quanta: u32,
    body: u32,
    skin: u32,
    brush_volume: u32,
    leaving: u32,
) -> Exchange {
    let canvas = min(body + skin, u32(max(penetration, 0)));
    let sharers = max(touch_sharers(touch), 1u);
    let brush = brush_volume / sharers;
    let room = (MAX_COLUMN - min(brush_volume, MAX_COLUMN)) / sharers;
    let missing = bitcast<i32>(coat_quanta) - penetration;
    let laid = share_of_65536(u32(max(missing, 0)), rates.deposit);
    let taken = share_of_65536(u32(max(-missing, 0)), rates.pick_up);
    let mixed = share_of_65536(min(canvas, brush), rates.mixing);
    let near =
        u32(bitcast<i32>(coat_quanta) + min(penetration, 0)) / max(coat_quanta >> 8u, 1u);
    let touching = select(256u, min(near, 256u), penetration < 0);
    let weight = share_of_256(touch_transfer_weight(touch), touching);
    let down = min(share_of_256(laid + mixed, weight), brush / 2u);
    let up = share_of_256(taken + mixed, weight) + share_of_256(canvas, leaving / 2u);
    let most = select(canvas / 2u, canvas, rates.mixing == 0u);
    let taken_all = min(min(up, most), room);
    let from_skin = min(taken_all, skin);
    return Exchange(
        ratio_of_65536(down, brush_volume),
        ratio_of_65536(taken_all - from_skin, body),
        ratio_of_65536(from_skin, skin),
    );
}

fn leaving(touch: Touch, place: vec2<u32>, canvas: vec2<u32>) -> u32 {
    let velocity = touch_velocity(touch);
    var leaving = 0;
    if place.x == 0u {
        leaving = max(leaving, -velocity.x);
    }
    if place.x + 1u == canvas.x {
        leaving = max(leaving, velocity.x);
    }
    if place.y == 0u {
        leaving = max(leaving, -velocity.y);
    }
    if place.y + 1u == canvas.y {
        leaving = max(leaving, velocity.y);
    }
    return u32(min(leaving, 256));
}
