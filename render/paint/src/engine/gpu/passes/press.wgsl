// Computes the velocity of every cell's paint and the share of it that may move.

@group(0) @binding(0) var<uniform> params: SubStepParams;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
// x: penetration, y: volume, z: top, w: coat.
@group(0) @binding(2) var<storage, read> depths: array<vec4<i32>>;
// x: velocity, packed as in `Touch`. y: mobile share in parts of 65536. Either both are 0 or
// neither is.
@group(0) @binding(3) var<storage, read_write> flow_out: array<vec2<u32>>;

// Top and penetration of the cell at `place`, or of the nearest cell of the region.
fn column(place: vec2<i32>) -> vec2<i32> {
    let last = vec2<i32>(params.region.zw) - vec2(1);
    let inside = vec2<u32>(clamp(place, vec2(0), last));
    let here = depths[inside.y * params.region.z + inside.x];
    return vec2(here.z, select(NO_CONTACT, here.x, all(inside == vec2<u32>(place))));
}

// Flow from the cell at `place` to the next one along `step`.
fn flow_from(place: vec2<i32>, step: vec2<i32>) -> i32 {
    let here = column(place);
    let next = column(place + step);
    let before = column(place - step).x;
    let beyond = column(place + 2 * step).x;
    return flow(params.motion, before, here.x, next.x, beyond, here.y, next.y);
}

fn crowded(place: vec2<u32>, offset: vec2<i32>) -> bool {
    let there = vec2<u32>(vec2<i32>(place) + offset);
    return bitcast<u32>(depths[there.y * params.region.z + there.x].y) > CROWDED_VOLUME;
}

// This is the twin of `avoid_crowded_columns` in press.rs. Only cells of the contact grown by 1
// move, so all neighbours that we read lie within the region.
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

// Whether the cell at `place` or a neighbour of it is in contact.
fn near_contact(place: vec2<i32>) -> bool {
    for (var i = 0; i < 9; i++) {
        if column(place + vec2(i % 3, i / 3) - vec2(1)).y != NO_CONTACT {
            return true;
        }
    }
    return false;
}

@compute @workgroup_size(8, 8)
fn press_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.region.zw) {
        return;
    }
    let place = id.y * params.region.z + id.x;
    flow_out[place] = vec2(0u);
    // Only cells of the contact grown by 1 move.
    let moving = params.region.xy + id.xy + vec2(1u) - params.contact.xy;
    if any(moving >= params.contact.zw + vec2(2u)) {
        return;
    }
    let cell = vec2<i32>(id.xy);
    if params.motion.everywhere == 0u && !near_contact(cell) {
        return;
    }
    let here = depths[place];
    var head = vec2(0);
    if here.x != NO_CONTACT {
        head = dragged(params.rates, touches[touch_index(id.xy)], here.x, bitcast<u32>(here.y));
    }
    let volume_quanta = bitcast<u32>(here.y);
    var speed = vec2(
        velocity(
            head.x,
            volume_quanta,
            flow_from(cell - vec2(1, 0), vec2(1, 0)),
            flow_from(cell, vec2(1, 0)),
        ),
        velocity(
            head.y,
            volume_quanta,
            flow_from(cell - vec2(0, 1), vec2(0, 1)),
            flow_from(cell, vec2(0, 1)),
        ),
    );
    // No paint leaves the canvas.
    let beyond = vec2<i32>(params.region.xy + id.xy) + sign(speed);
    let leaves = (beyond < vec2(0)) | (beyond >= vec2<i32>(params.canvas));
    speed = select(speed, vec2(0), leaves);
    if any(speed != vec2(0)) {
        speed = avoid_crowded_columns(id.xy, speed);
    }
    if any(speed != vec2(0)) {
        let mobile = mobile_share(params.motion, bitcast<u32>(here.y));
        if mobile != 0u {
            let halves = vec2<u32>(speed) & vec2(0xffffu);
            flow_out[place] = vec2(halves.x | (halves.y << 16u), mobile);
        }
    }
}
