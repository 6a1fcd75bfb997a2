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

// `speed` is the absolute velocity in 1/16384 cell.
fn outflow(cell: Cell, mobile: u32, speed: vec2<u32>) -> Outflow {
    let moving = cell_share_of_65536(cell, mobile);
    let sideways = cell_share_of_65536(moving, 4u * speed.x);
    let diagonal = cell_share_of_65536(sideways, 4u * speed.y);
    let in_y = cell_share_of_65536(minus(moving, sideways), 4u * speed.y);
    return Outflow(minus(sideways, diagonal), in_y, diagonal);
}
