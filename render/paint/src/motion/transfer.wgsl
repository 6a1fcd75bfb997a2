// Transfer of paint between canvas and head; twin of transfer.rs.

struct Exchange {
    // Whether paint is taken from the brush, not from the canvas.
    from_brush: bool,
    // Share of the source's whole cell that is transferred, in parts of 65536.
    share: u32,
}

fn exchange(
    motion: MotionConstants,
    touch: Touch,
    penetration: u32,
    canvas_volume: u32,
    brush_volume: u32,
) -> Exchange {
    let canvas = min(canvas_volume, penetration);
    let brush = brush_volume / max(touch_sharers(touch), 1u);
    let from_brush = brush > canvas;
    let amount = select(canvas, brush, from_brush);
    let whole = select(canvas_volume, brush_volume, from_brush);
    let quanta_apart = max(brush, canvas) - min(brush, canvas);
    let difference = min(quanta_apart / (motion.full_transfer_quanta / 256u), 256u);
    let wanted =
        share_of_256(share_of_256(amount / 10u, difference), touch_transfer_weight(touch));
    let transferred = min(wanted, motion.max_transfer_quanta);
    if whole == 0u {
        return Exchange(from_brush, 0u);
    }
    return Exchange(from_brush, (transferred << 16u) / whole);
}
