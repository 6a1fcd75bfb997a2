// A mask of the pixels of about one colour; twin of color_mask.rs.

struct ColorMaskParams {
    xyz: array<vec4<f32>, 3>,
    range: vec4<f32>,
    size: vec2<u32>,
    masked: u32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> params: ColorMaskParams;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> mask: array<f32>;
@group(0) @binding(3) var<storage, read_write> result: array<f32>;

@compute @workgroup_size(8, 8)
fn watercolor_color_mask(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.size) {
        return;
    }
    let i = id.y * params.size.x + id.x;
    let v = colors[i].xyz;
    let bright = pow((v + 0.055) / 1.055, vec3(2.4));
    let linear = select(bright, v / 12.92, v <= vec3(0.04045));
    let t = (linear.x * params.xyz[0] + linear.y * params.xyz[1] + linear.z * params.xyz[2]).xyz;
    let high = pow(max(t, vec3(1e-9)), vec3(1.0 / 3.0));
    let f = select(high, (24389.0 / 27.0 * t + 16.0) / 116.0, t <= vec3(216.0 / 24389.0));
    let lab = vec3(116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z));
    var value = clamp(3.0 - 2.0 * distance(lab, params.range.xyz) / params.range.w, 0.0, 1.0);
    if params.masked != 0u { value *= mask[i]; }
    result[i] = value;
}
