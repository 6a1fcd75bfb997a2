// How deep the head is pressed into the paint, and the velocity that it gives to the paint. This is
// the twin of press.rs.

const NO_CONTACT: i32 = i32(-2147483647 - 1);
const NO_HEAD: i32 = 2147483647;
const CROWDED_VOLUME: u32 = MAX_COLUMN / 10u;
const BORNE: u32 = 2u;
const CELL_A_SUB_STEP: i32 = 16384;
const FASTEST_FLOW: u32 = 8192u;

fn coat(rates: ExchangeRates, touch: Touch, mean: u32) -> u32 {
    let kept = (rates.held >> 5u) * max(64u - min(touch_release(touch), 64u), 12u);
    let above = min(mean - min(mean, kept), MAX_COLUMN / 3u);
    let free = min(mean, 3u * above);
    let usual = rates.film + min(share_of_65536(free, rates.release), CROWDED_VOLUME);
    return (usual >> 5u) * touch_release(touch);
}

fn penetration(
    rates: ExchangeRates,
    touch: Touch,
    floor_quanta: i32,
    volume_quanta: u32,
    bed: i32,
    coat_quanta: u32,
) -> i32 {
    if touch.height == NO_HEAD {
        return NO_CONTACT;
    }
    let sinks = bitcast<i32>(select(0u, rates.sink - coat_quanta, rates.sink > coat_quanta));
    // Heads far below the canvas do not wrap.
    let ground = max(max(touch.height, -NO_HEAD + sinks) - sinks, floor_quanta);
    let top = floor_quanta + bitcast<i32>(volume_quanta);
    let there = min(bed, top + bitcast<i32>(coat_quanta));
    let above = select(0u, bitcast<u32>(there - ground), there > ground);
    let most = max(BORNE * coat_quanta, rates.carried);
    let borne = share_of_65536(min(above, most), rates.bearing);
    let hair = ground + bitcast<i32>(borne);
    return select(NO_CONTACT, top - hair, hair - bitcast<i32>(coat_quanta) <= top);
}

// `before`, `here`, `next` and `beyond` are tops, the others penetrations.
fn flow(
    motion: MotionConstants,
    before: i32,
    here: i32,
    next: i32,
    beyond: i32,
    depth_here: i32,
    depth_next: i32,
) -> i32 {
    let drop = here - next;
    let head = bitcast<i32>(share_of_65536(u32(max(depth_here, 0)), motion.squeeze_share))
        - bitcast<i32>(share_of_65536(u32(max(depth_next, 0)), motion.squeeze_share));
    let pressed = max(depth_here, depth_next) != NO_CONTACT;
    let driven = select(0, (drop >> 1u) + (head >> 1u), pressed);
    let steep = u32(abs(drop));
    let beyond_yield = select(0u, steep - motion.yield_quanta, steep > motion.yield_quanta);
    let slides = bitcast<i32>(beyond_yield) / 8;
    let crest = ((here - before) >> 1u) + (drop >> 1u);
    let pit = (drop >> 1u) + ((beyond - next) >> 1u);
    let kink = select(min(u32(abs(crest)), u32(abs(pit))), 0u, (crest ^ pit) < 0);
    let level = bitcast<i32>(share_of_65536(kink, motion.levelling_share));
    let driven_flow = bitcast<i32>(share_of_65536(u32(abs(driven)), motion.push_share));
    return driven_flow * sign(driven) + slides * sign(drop) + level * sign(crest);
}

fn velocity(head: i32, volume_quanta: u32, before: i32, after: i32) -> i32 {
    let forward = max(after, 0);
    let back = max(-before, 0);
    let flow = min(u32(max(forward, back)), volume_quanta);
    let cells = bitcast<i32>(min(ratio_of_65536(flow, volume_quanta) / 4u, FASTEST_FLOW));
    let flowing = select(-cells, cells, forward >= back);
    return clamp(head + flowing, -CELL_A_SUB_STEP, CELL_A_SUB_STEP);
}

fn dragged(rates: ExchangeRates, touch: Touch, penetration: i32, volume_quanta: u32) -> vec2<i32> {
    let below = u32(max(penetration, 0));
    let depth = select(0u, below - rates.film, below > rates.film);
    var immersed = 256u;
    if depth < volume_quanta {
        immersed = ratio_of_65536(depth, volume_quanta) >> 8u;
    }
    return touch_velocity(touch) * bitcast<i32>(immersed * rates.drag) / 1024;
}
