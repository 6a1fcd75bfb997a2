// The picture on its sheet; twin of sheet.rs.

struct SheetNow {
    paper: vec4<f32>,
    size: vec2<u32>,
    spare: vec2<u32>,
}

@group(0) @binding(0) var<uniform> now: SheetNow;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> heights: array<f32>;
@group(0) @binding(3) var<storage, read_write> seen: array<vec4<f32>>;

fn height(x: u32, y: u32) -> f32 {
    return heights[y * now.size.x + x];
}

@compute @workgroup_size(8, 8)
fn watercolor_sheet(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = id.xy;
    if any(at >= now.size) {
        return;
    }
    let before = at - min(at, vec2(1u));
    let after = min(at + vec2(1u), now.size - vec2(1u));
    let slope = height(after.x, at.y) - height(before.x, at.y)
        + (height(at.x, after.y) - height(at.x, before.y));
    let light = 1.0 + now.paper.w * slope;
    let i = at.y * now.size.x + at.x;
    let color = colors[i];
    let flat_color = (color.xyz * color.w + (1.0 - color.w)) * now.paper.xyz;
    seen[i] = vec4(clamp(flat_color * light, vec3(0.0), vec3(1.0)), 1.0);
}
