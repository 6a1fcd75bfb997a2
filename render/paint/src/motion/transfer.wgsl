// Paint changing sides between canvas and head; twin of transfer.rs.

// Whether the brush gives, and of the giver's whole cell how many of 65536 parts.
struct Exchange {
    brush_gives: bool,
    parts: u32,
}

fn exchange(
    motion: Motion,
    touch: Touch,
    penetration: u32,
    canvas_volume: u32,
    brush_volume: u32,
) -> Exchange {
    let canvas = min(canvas_volume, penetration);
    let brush = brush_volume / max(touch_sharers(touch), 1u);
    let brush_gives = brush > canvas;
    let amount = select(canvas, brush, brush_gives);
    let whole = select(canvas_volume, brush_volume, brush_gives);
    let difference = max(brush, canvas) - min(brush, canvas);
    let unlike = min(difference / (motion.cutoff / 256u), 256u);
    let wanted = share_of_256(share_of_256(amount / 10u, unlike), touch_speed(touch));
    let given = min(wanted, motion.most);
    if whole == 0u {
        return Exchange(brush_gives, 0u);
    }
    return Exchange(brush_gives, (given << 16u) / whole);
}
