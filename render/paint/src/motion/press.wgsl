// How deep the head is pressed into the paint, and the velocity that it gives to the
// paint; twin of press.rs.

const NO_CONTACT: i32 = -1;
// A tenth of amount::MAX_COLUMN.
const CROWDED_VOLUME: u32 = 107374182u;

fn penetration(touch: Touch, floor_quanta: i32, volume_quanta: u32) -> i32 {
    let top = floor_quanta + bitcast<i32>(volume_quanta);
    return select(NO_CONTACT, top - touch.height, touch.height <= top);
}

fn velocity(
    motion: MotionConstants,
    touch: Touch,
    depth: i32,
    slopes: vec2<i32>,
) -> vec2<i32> {
    let brush = select(touch_velocity(touch), vec2(0), depth == NO_CONTACT);
    return clamp(brush / 2 - slopes / motion.push_quanta, vec2(-256), vec2(256));
}
