// The constants of motion. This is the twin of constants.rs.

struct MotionConstants {
    push_share: u32,
    squeeze_share: u32,
    yield_quanta: u32,
    levelling_share: u32,
    adhesion_quanta: u32,
    everywhere: u32,
    skin_quanta: u32,
    padding: u32,
}
