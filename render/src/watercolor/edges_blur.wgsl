// A blur along rows or columns; twin of `mean` in edges.rs.

struct EdgeBlurNow {
    size: vec2<u32>,
    along: vec2<u32>,
    first: u32,
    count: u32,
    bare: u32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> now: EdgeBlurNow;
@group(0) @binding(1) var<storage, read> half: array<f32>;
@group(0) @binding(2) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> blurred: array<vec4<f32>>;

fn pixel(at: vec2<u32>) -> vec4<f32> {
    let inside = min(at, now.size - vec2(1u));
    let color = colors[inside.y * now.size.x + inside.x];
    if now.bare == 0u {
        return color;
    }
    return vec4(color.xyz * color.w + (1.0 - color.w), color.w);
}

@compute @workgroup_size(8, 8)
fn watercolor_edge_blur(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = id.xy;
    if any(at >= now.size) {
        return;
    }
    var sum = half[now.first] * pixel(at);
    for (var tap = 1u; tap < now.count; tap++) {
        let step = tap * now.along;
        let pair = pixel(at - min(step, at)) + pixel(at + step);
        sum += half[now.first + tap] * pair;
    }
    blurred[at.y * now.size.x + at.x] = sum;
}
