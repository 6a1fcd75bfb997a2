// Conservative advection of a column of paint in one sub-step. This is the twin of advect.rs.

// Shares of a column that leave it, in parts of 65536.
struct Outflow {
    in_x: u32,
    in_y: u32,
    diagonal: u32,
}

fn mobile_share(motion: MotionConstants, column: u32) -> u32 {
    let moving = column - min(column, motion.adhesion_quanta);
    return ratio_of_65536(moving, column);
}

// `speed` is the absolute velocity in 1/16384 cell.
fn outflow(mobile: u32, speed: vec2<u32>) -> Outflow {
    let sideways = share_of_65536(mobile, 4u * speed.x);
    let diagonal = share_of_65536(sideways, 4u * speed.y);
    let in_y = share_of_65536(mobile - sideways, 4u * speed.y);
    return Outflow(sideways - diagonal, in_y, diagonal);
}
