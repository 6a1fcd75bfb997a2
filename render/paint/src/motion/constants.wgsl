// The constants of motion; twin of constants.rs.

struct MotionConstants {
    push_quanta: i32,
    adhesion_quanta: u32,
    max_transfer_quanta: u32,
    full_transfer_quanta: u32,
}
