// The velocity of every cell's paint, and how much of it may move.

@group(0) @binding(0) var<uniform> now: Step;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
// Penetration and volume.
@group(0) @binding(2) var<storage, read> depths: array<vec2<i32>>;
// Velocity in two halves, as in a touch, and the mobile share; both 0 or neither.
@group(0) @binding(3) var<storage, read_write> flow: array<vec2<u32>>;

// Apart, or beyond the region, counts as 0 in a slope.
fn pressed(place: vec2<u32>) -> i32 {
    if any(place >= now.region.zw) {
        return 0;
    }
    let depth = depths[place.y * now.region.z + place.x].x;
    return select(depth, 0, depth == APART);
}

fn crowded(place: vec2<u32>, way: vec2<i32>) -> bool {
    let there = vec2<u32>(vec2<i32>(place) + way);
    return bitcast<u32>(depths[there.y * now.region.z + there.x].y) > CROWDED;
}

// The velocity near crowded columns; what moves stays within the region.
fn yielding(place: vec2<u32>, velocity: vec2<i32>) -> vec2<i32> {
    var left = velocity;
    if crowded(place, vec2(0)) {
        return vec2(0);
    }
    if left.x != 0 && crowded(place, vec2(sign(left.x), 0)) {
        left.x = 0;
    }
    if left.y != 0 && crowded(place, vec2(0, sign(left.y))) {
        left.y = 0;
    }
    if left.x != 0 && left.y != 0 && crowded(place, sign(left)) {
        left.y = 0;
    }
    return left;
}

@compute @workgroup_size(8, 8)
fn press_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.region.zw) {
        return;
    }
    let place = id.y * now.region.z + id.x;
    let here = depths[place];
    var touch: Touch;
    if here.x != APART {
        touch.velocity = touches[touch_index(id.xy)].velocity;
    }
    // Places left of and above the region wrap, and so lie beyond it.
    let slopes = vec2(
        pressed(id.xy + vec2(1u, 0u)) - pressed(id.xy - vec2(1u, 0u)),
        pressed(id.xy + vec2(0u, 1u)) - pressed(id.xy - vec2(0u, 1u)),
    );
    var speed = velocity(now.motion, touch, here.x, slopes);
    // Nothing leaves the canvas.
    let beyond = vec2<i32>(now.region.xy + id.xy) + sign(speed);
    let leaves = (beyond < vec2(0)) | (beyond >= vec2<i32>(now.canvas));
    speed = select(speed, vec2(0), leaves);
    flow[place] = vec2(0u);
    if any(speed != vec2(0)) {
        speed = yielding(id.xy, speed);
    }
    if any(speed != vec2(0)) {
        let mobile = mobile_share(now.motion, bitcast<u32>(here.y));
        if mobile != 0u {
            let halves = vec2<u32>(speed) & vec2(0xffffu);
            flow[place] = vec2(halves.x | (halves.y << 16u), mobile);
        }
    }
}
