// Where a column of paint goes in one sub-step; twin of advect.rs.

struct Outflow {
    beside: Cell,
    along: Cell,
    corner: Cell,
}

fn mobile_share(motion: Motion, column: u32) -> u32 {
    if column <= motion.adhesion {
        return 0u;
    }
    let stays = motion.adhesion << 16u;
    return 65536u - (stays / column + select(0u, 1u, stays % column != 0u));
}

// `speed` is the absolute velocity in 1/256 cell.
fn outflow(cell: Cell, mobile: u32, speed: vec2<u32>) -> Outflow {
    let moving = share(cell, mobile);
    let sideways = Cell(
        shares_of_256(moving.low, speed.x),
        shares_of_256(moving.high, speed.x),
        share_of_256(moving.vehicle, speed.x),
    );
    let corner = Cell(
        shares_of_256(sideways.low, speed.y),
        shares_of_256(sideways.high, speed.y),
        share_of_256(sideways.vehicle, speed.y),
    );
    let along = Cell(
        shares_of_256(moving.low - sideways.low, speed.y),
        shares_of_256(moving.high - sideways.high, speed.y),
        share_of_256(moving.vehicle - sideways.vehicle, speed.y),
    );
    return Outflow(minus(sideways, corner), along, corner);
}
