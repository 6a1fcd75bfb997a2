// Computes the velocity of every cell's paint and the share of it that may move.

@group(0) @binding(0) var<uniform> params: SubStepParams;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
// x: penetration; y: volume.
@group(0) @binding(2) var<storage, read> depths: array<vec2<i32>>;
// x: velocity, packed as in `Touch`; y: mobile share in parts of 65536. Either both are 0
// or neither is.
@group(0) @binding(3) var<storage, read_write> flow: array<vec2<u32>>;

// Penetration for slopes: 0 where there is no contact and beyond the region.
fn pressed(place: vec2<u32>) -> i32 {
    if any(place >= params.region.zw) {
        return 0;
    }
    let depth = depths[place.y * params.region.z + place.x].x;
    return select(depth, 0, depth == NO_CONTACT);
}

fn crowded(place: vec2<u32>, offset: vec2<i32>) -> bool {
    let there = vec2<u32>(vec2<i32>(place) + offset);
    return bitcast<u32>(depths[there.y * params.region.z + there.x].y) > CROWDED_VOLUME;
}

// Twin of `avoid_crowded_columns` in press.rs. Only cells of the contact grown by 1
// move, so all neighbours asked for lie within the region.
fn avoid_crowded_columns(place: vec2<u32>, velocity: vec2<i32>) -> vec2<i32> {
    var allowed = velocity;
    if crowded(place, vec2(0)) {
        return vec2(0);
    }
    if allowed.x != 0 && crowded(place, vec2(sign(allowed.x), 0)) {
        allowed.x = 0;
    }
    if allowed.y != 0 && crowded(place, vec2(0, sign(allowed.y))) {
        allowed.y = 0;
    }
    if allowed.x != 0 && allowed.y != 0 && crowded(place, sign(allowed)) {
        allowed.y = 0;
    }
    return allowed;
}

@compute @workgroup_size(8, 8)
fn press_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.region.zw) {
        return;
    }
    let place = id.y * params.region.z + id.x;
    let here = depths[place];
    var touch: Touch;
    if here.x != NO_CONTACT {
        touch.velocity = touches[touch_index(id.xy)].velocity;
    }
    // Left of or above the region the differences wrap to large numbers, which lie outside
    // as well.
    let slopes = vec2(
        pressed(id.xy + vec2(1u, 0u)) - pressed(id.xy - vec2(1u, 0u)),
        pressed(id.xy + vec2(0u, 1u)) - pressed(id.xy - vec2(0u, 1u)),
    );
    var speed = velocity(params.motion, touch, here.x, slopes);
    // No paint leaves the canvas.
    let beyond = vec2<i32>(params.region.xy + id.xy) + sign(speed);
    let leaves = (beyond < vec2(0)) | (beyond >= vec2<i32>(params.canvas));
    speed = select(speed, vec2(0), leaves);
    flow[place] = vec2(0u);
    if any(speed != vec2(0)) {
        speed = avoid_crowded_columns(id.xy, speed);
    }
    if any(speed != vec2(0)) {
        let mobile = mobile_share(params.motion, bitcast<u32>(here.y));
        if mobile != 0u {
            let halves = vec2<u32>(speed) & vec2(0xffffu);
            flow[place] = vec2(halves.x | (halves.y << 16u), mobile);
        }
    }
}
