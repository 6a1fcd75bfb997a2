// Paint composited on shaded paper; twin of paper_shading.rs.

struct PaperShadingParams {
    paper: vec4<f32>,
    size: vec2<u32>,
    spare: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: PaperShadingParams;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> heights: array<f32>;
@group(0) @binding(3) var<storage, read_write> shaded: array<vec4<f32>>;

fn height(x: u32, y: u32) -> f32 {
    return heights[y * params.size.x + x];
}

@compute @workgroup_size(8, 8)
fn watercolor_paper_shading(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = id.xy;
    if any(at >= params.size) {
        return;
    }
    let before = at - min(at, vec2(1u));
    let after = min(at + vec2(1u), params.size - vec2(1u));
    let slope = height(after.x, at.y) - height(before.x, at.y)
        + (height(at.x, after.y) - height(at.x, before.y));
    let light = 1.0 + params.paper.w * slope;
    let i = at.y * params.size.x + at.x;
    let color = colors[i];
    let flat_color = (color.xyz * color.w + (1.0 - color.w)) * params.paper.xyz;
    shaded[i] = vec4(clamp(flat_color * light, vec3(0.0), vec3(1.0)), 1.0);
}
