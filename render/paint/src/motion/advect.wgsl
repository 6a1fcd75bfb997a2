// Conservative advection of a column of paint in one sub-step; twin of advect.rs.

struct Outflow {
    in_x: Cell,
    in_y: Cell,
    diagonal: Cell,
}

fn mobile_share(motion: MotionConstants, column: u32) -> u32 {
    if column <= motion.adhesion_quanta {
        return 0u;
    }
    let stays = motion.adhesion_quanta << 16u;
    return 65536u - (stays / column + select(0u, 1u, stays % column != 0u));
}

// `speed` is the absolute velocity in 1/256 cell.
fn outflow(cell: Cell, mobile: u32, speed: vec2<u32>) -> Outflow {
    let moving = cell_share_of_65536(cell, mobile);
    let sideways = Cell(
        shares_of_256(moving.low, speed.x),
        shares_of_256(moving.high, speed.x),
        share_of_256(moving.vehicle, speed.x),
    );
    let diagonal = Cell(
        shares_of_256(sideways.low, speed.y),
        shares_of_256(sideways.high, speed.y),
        share_of_256(sideways.vehicle, speed.y),
    );
    let in_y = Cell(
        shares_of_256(moving.low - sideways.low, speed.y),
        shares_of_256(moving.high - sideways.high, speed.y),
        share_of_256(moving.vehicle - sideways.vehicle, speed.y),
    );
    return Outflow(minus(sideways, diagonal), in_y, diagonal);
}
