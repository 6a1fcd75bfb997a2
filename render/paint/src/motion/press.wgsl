// How deep the head is in the paint, and which way it pushes it; twin of press.rs.

const APART: i32 = -1;
// A tenth of amount::FULL.
const CROWDED: u32 = 107374182u;

fn penetration(touch: Touch, ground: i32, wet: u32) -> i32 {
    let top = ground + bitcast<i32>(wet);
    return select(APART, top - touch.height, touch.height <= top);
}

fn velocity(motion: Motion, touch: Touch, here: i32, slopes: vec2<i32>) -> vec2<i32> {
    let brush = select(touch_velocity(touch), vec2(0), here == APART);
    return clamp(brush / 2 - slopes / motion.push, vec2(-256), vec2(256));
}
