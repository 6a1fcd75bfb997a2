// The picture displaced by the paper's slopes; twin of wobble.rs.

struct WobbleParams {
    size: vec2<u32>,
    px_per_slope: f32,
    factor: u32,
}

@group(0) @binding(0) var<uniform> params: WobbleParams;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> heights: array<f32>;
@group(0) @binding(3) var<storage, read_write> displaced: array<vec4<f32>>;

fn index(x: u32, y: u32) -> u32 {
    return y * params.size.x + x;
}

fn height(x: u32, y: u32) -> f32 {
    return heights[y * params.size.x * params.factor + x];
}

// A colour weighted by its share and its coverage; the weight itself is the fourth value.
fn part(x: u32, y: u32, share: f32) -> vec4<f32> {
    let color = colors[index(x, y)];
    return share * color.w * vec4(color.xyz, 1.0);
}

@compute @workgroup_size(8, 8)
fn watercolor_wobble(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = id.xy;
    if any(at >= params.size) {
        return;
    }
    let last = params.size - vec2(1u);
    let factor = params.factor;
    let last_cell = params.size * factor - vec2(1u);
    var sum = vec4(0.0);
    for (var cell = 0u; cell < factor * factor; cell++) {
        let place = at * factor + vec2(cell % factor, cell / factor);
        let before = place - min(place, vec2(1u));
        let after = min(place + vec2(1u), last_cell);
        let slope = vec2(
            height(after.x, place.y) - height(before.x, place.y),
            height(place.x, after.y) - height(place.x, before.y),
        );
        let inside = (vec2<f32>(vec2(cell % factor, cell / factor)) + 0.5) / f32(factor) - 0.5;
        let displaced_to = vec2<f32>(at) + inside + params.px_per_slope * slope;
        let source = clamp(displaced_to, vec2(0.0), vec2<f32>(last));
        let corner = vec2<u32>(source);
        let share = source - vec2<f32>(corner);
        let far = min(corner + vec2(1u), last);
        let rest = vec2(1.0) - share;
        sum += part(corner.x, corner.y, rest.x * rest.y) + part(far.x, corner.y, share.x * rest.y)
            + part(corner.x, far.y, rest.x * share.y) + part(far.x, far.y, share.x * share.y);
    }
    if sum.w > 0.0 {
        sum = vec4(sum.xyz / sum.w, sum.w / f32(factor * factor));
    }
    displaced[index(at.x, at.y)] = min(sum, vec4(1.0));
}
