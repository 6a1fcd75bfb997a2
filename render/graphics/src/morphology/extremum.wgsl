// The minimum or maximum of the pixels on two segments that cross. This is the twin of
// extremum.rs.

struct ExtremumParams {
    // Size of the picture in pixels. Both planes have a margin around it.
    size: vec2<i32>,
    // Width of the margin in the plane that is read, and in the one that is written.
    margin_in: i32,
    margin_out: i32,
    // For each segment: the step from a pixel to the next, then the number of pixels on either
    // side of its middle.
    along: vec2<i32>,
    across: vec2<i32>,
    reach_along: i32,
    reach_across: i32,
    // 1 for the maximum, 0 for the minimum.
    maximum: u32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> params: ExtremumParams;
@group(0) @binding(1) var<storage, read> before: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> after: array<vec4<f32>>;

const FARTHEST: f32 = 3.4028234e38;

fn further(found: vec4<f32>, at: vec2<i32>) -> vec4<f32> {
    let cell = at + params.margin_in;
    let cells = params.size + 2 * params.margin_in;
    if any(cell < vec2(0)) || any(cell >= cells) {
        return found;
    }
    let value = before[cell.y * cells.x + cell.x];
    return select(min(found, value), max(found, value), params.maximum == 1u);
}

@compute @workgroup_size(8, 8)
fn extremum(@builtin(global_invocation_id) id: vec3<u32>) {
    let cells = params.size + 2 * params.margin_out;
    let cell = vec2<i32>(id.xy);
    if any(cell >= cells) {
        return;
    }
    let at = cell - params.margin_out;
    var found = vec4(select(FARTHEST, -FARTHEST, params.maximum == 1u));
    for (var i = -params.reach_along; i <= params.reach_along; i++) {
        found = further(found, at + i * params.along);
    }
    for (var i = 1; i <= params.reach_across; i++) {
        found = further(further(found, at - i * params.across), at + i * params.across);
    }
    after[cell.y * cells.x + cell.x] = found;
}
