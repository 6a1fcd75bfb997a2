// The least or greatest of pixels on two segments that cross; twin of morphology.rs.

struct Crossing {
    // Of the picture; both planes have more around it.
    size: vec2<i32>,
    // Cells around the picture in the plane that is read, and in the one written.
    margin_in: i32,
    margin_out: i32,
    // From a pixel to the next of a segment, and how many of them on either side.
    along: vec2<i32>,
    across: vec2<i32>,
    reach_along: i32,
    reach_across: i32,
    // 1 for the greatest, 0 for the least.
    greatest: u32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> now: Crossing;
@group(0) @binding(1) var<storage, read> before: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> after: array<vec4<f32>>;

const FARTHEST: f32 = 3.4028234e38;

fn further(found: vec4<f32>, at: vec2<i32>) -> vec4<f32> {
    let cell = at + now.margin_in;
    let cells = now.size + 2 * now.margin_in;
    if any(cell < vec2(0)) || any(cell >= cells) {
        return found;
    }
    let value = before[cell.y * cells.x + cell.x];
    return select(min(found, value), max(found, value), now.greatest == 1u);
}

@compute @workgroup_size(8, 8)
fn crossing(@builtin(global_invocation_id) id: vec3<u32>) {
    let cells = now.size + 2 * now.margin_out;
    let cell = vec2<i32>(id.xy);
    if any(cell >= cells) {
        return;
    }
    let at = cell - now.margin_out;
    var found = vec4(select(FARTHEST, -FARTHEST, now.greatest == 1u));
    for (var i = -now.reach_along; i <= now.reach_along; i++) {
        found = further(found, at + i * now.along);
    }
    for (var i = 1; i <= now.reach_across; i++) {
        found = further(further(found, at - i * now.across), at + i * now.across);
    }
    after[cell.y * cells.x + cell.x] = found;
}
