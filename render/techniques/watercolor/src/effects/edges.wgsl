// The symmetric gradient of a picture; twin of `edge` in edges.rs.

struct EdgesParams {
    size: vec2<u32>,
    spare: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: EdgesParams;
@group(0) @binding(1) var<storage, read> pixels: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> edges: array<f32>;

fn pixel(x: u32, y: u32) -> vec4<f32> {
    return pixels[y * params.size.x + x];
}

@compute @workgroup_size(8, 8)
fn watercolor_edges(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = id.xy;
    if any(at >= params.size) {
        return;
    }
    let least = at - min(at, vec2(1u));
    let most = min(at + vec2(1u), params.size - vec2(1u));
    let step = abs(pixel(least.x, at.y) - pixel(most.x, at.y))
        + abs(pixel(at.x, least.y) - pixel(at.x, most.y));
    edges[at.y * params.size.x + at.x] = max((step.x + step.y + step.z) / 3.0, step.w);
}
