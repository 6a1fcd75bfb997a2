// The coverage that a dry brush leaves; twin of dry_brush.rs.

struct DryBrushParams {
    size: vec2<u32>,
    threshold: f32,
    softness: f32,
    masked: u32,
    patches: f32,
    thin: f32,
    thin_fade: f32,
    outline: f32,
    darkest: f32,
    spare: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: DryBrushParams;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> heights: array<f32>;
@group(0) @binding(3) var<storage, read> flow: array<f32>;
@group(0) @binding(4) var<storage, read> edges: array<f32>;
@group(0) @binding(5) var<storage, read> mask: array<f32>;
@group(0) @binding(6) var<storage, read_write> brushed: array<vec4<f32>>;

@compute @workgroup_size(8, 8)
fn watercolor_dry_brush(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.size) {
        return;
    }
    let i = id.y * params.size.x + id.x;
    var share = 1.0;
    if params.masked != 0u { share = mask[i]; }
    let thin = clamp((params.thin - flow[i]) / params.thin_fade, 0.0, 1.0);
    let color = colors[i];
    var inside = 1.0;
    if params.outline > 0.0 { inside = clamp(1.0 - params.outline * edges[i], 0.0, 1.0); }
    var light = 1.0;
    if params.darkest > 0.0 {
        light = clamp((color.x + color.y + color.z) / 3.0 / params.darkest - 1.0, 0.0, 1.0);
    }
    let dry = share * inside * light * (1.0 - params.patches * (1.0 - thin));
    let above = (heights[i] - params.threshold * dry) / params.softness;
    brushed[i] = vec4(color.xyz, color.w * clamp(1.0 + above, 0.0, 1.0));
}
