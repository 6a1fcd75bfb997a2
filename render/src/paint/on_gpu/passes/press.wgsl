// The penetration of every cell, the velocity of its paint, and how much may move.

@group(0) @binding(0) var<uniform> now: Step;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
@group(0) @binding(2) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> vehicle: array<u32>;
@group(0) @binding(4) var<storage, read> ground: array<i32>;
// Velocity x and y, mobile share, penetration; over the region.
@group(0) @binding(5) var<storage, read_write> flow: array<vec4<i32>>;

fn index(at: vec2<i32>) -> u32 {
    return u32(at.y) * now.canvas.x + u32(at.x);
}

fn column(at: vec2<i32>) -> u32 {
    let i = index(at);
    return volume(Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]));
}

fn within_contact(at: vec2<i32>) -> bool {
    let place = at - vec2<i32>(now.contact.xy);
    return all(place >= vec2(0)) && all(place < vec2<i32>(now.contact.zw));
}

fn touch_at(at: vec2<i32>) -> Touch {
    let place = vec2<u32>(at) - now.contact.xy;
    return touches[now.first_touch + place.y * now.contact.z + place.x];
}

// Apart counts as 0 in a slope.
fn pressed(at: vec2<i32>) -> i32 {
    if !within_contact(at) {
        return 0;
    }
    let depth = penetration(touch_at(at), ground[index(at)], column(at));
    return select(depth, 0, depth == APART);
}

@compute @workgroup_size(8, 8)
fn press_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.region.zw) {
        return;
    }
    let at = vec2<i32>(now.region.xy + id.xy);
    let wet = column(at);
    var touch: Touch;
    var here = APART;
    if within_contact(at) {
        touch = touch_at(at);
        here = penetration(touch, ground[index(at)], wet);
    }
    let slopes = vec2(
        pressed(at + vec2(1, 0)) - pressed(at - vec2(1, 0)),
        pressed(at + vec2(0, 1)) - pressed(at - vec2(0, 1)),
    );
    var speed = velocity(now.motion, touch, here, slopes);
    // Nothing leaves the canvas.
    let beyond = at + sign(speed);
    let leaves = (beyond < vec2(0)) | (beyond >= vec2<i32>(now.canvas));
    speed = select(speed, vec2(0), leaves);
    var mobile = 0u;
    if any(speed != vec2(0)) {
        mobile = mobile_share(now.motion, wet);
    }
    flow[id.y * now.region.z + id.x] = vec4(speed, i32(mobile), here);
}
