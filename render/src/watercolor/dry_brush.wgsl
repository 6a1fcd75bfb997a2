// What a dry brush leaves; twin of dry_brush.rs.

struct DryBrushNow {
    size: vec2<u32>,
    threshold: f32,
    softness: f32,
    masked: u32,
    patches: f32,
    thin: f32,
    thinner: f32,
}

@group(0) @binding(0) var<uniform> now: DryBrushNow;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> heights: array<f32>;
@group(0) @binding(3) var<storage, read> flow: array<f32>;
@group(0) @binding(4) var<storage, read> mask: array<f32>;
@group(0) @binding(5) var<storage, read_write> brushed: array<vec4<f32>>;

@compute @workgroup_size(8, 8)
fn watercolor_dry_brush(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.size) {
        return;
    }
    let i = id.y * now.size.x + id.x;
    var share = 1.0;
    if now.masked != 0u { share = mask[i]; }
    let thin = clamp((now.thin - flow[i]) / now.thinner, 0.0, 1.0);
    let dry = share * (1.0 - now.patches * (1.0 - thin));
    let above = (heights[i] - now.threshold * dry) / now.softness;
    let color = colors[i];
    brushed[i] = vec4(color.xyz, color.w * clamp(1.0 + above, 0.0, 1.0));
}
