// A blur along rows or columns; twin of `mean` in edges.rs.

struct EdgeBlurParams {
    size: vec2<u32>,
    along: vec2<u32>,
    first: u32,
    count: u32,
    bare: u32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> params: EdgeBlurParams;
@group(0) @binding(1) var<storage, read> half: array<f32>;
@group(0) @binding(2) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> blurred: array<vec4<f32>>;

fn pixel(at: vec2<u32>) -> vec4<f32> {
    let inside = min(at, params.size - vec2(1u));
    let color = colors[inside.y * params.size.x + inside.x];
    if params.bare == 0u {
        return color;
    }
    return vec4(color.xyz * color.w + (1.0 - color.w), color.w);
}

@compute @workgroup_size(8, 8)
fn watercolor_edge_blur(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = id.xy;
    if any(at >= params.size) {
        return;
    }
    var sum = half[params.first] * pixel(at);
    for (var tap = 1u; tap < params.count; tap++) {
        let step = tap * params.along;
        let pair = pixel(at - min(step, at)) + pixel(at + step);
        sum += half[params.first + tap] * pair;
    }
    blurred[at.y * params.size.x + at.x] = sum;
}
