// The depth of each pixel of a visibility buffer. This is the twin of depths.rs.

struct DepthsParams {
    size: vec2<u32>,
    spare: vec2<u32>,
}

struct Fragment {
    triangle: u32,
    second: f32,
    third: f32,
    depth: f32,
}

@group(0) @binding(0) var<uniform> params: DepthsParams;
@group(0) @binding(1) var<storage, read> fragments: array<Fragment>;
@group(0) @binding(2) var<storage, read_write> depths_out: array<f32>;

@compute @workgroup_size(8, 8)
fn depths(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= params.size.x || id.y >= params.size.y {
        return;
    }
    let cell = id.y * params.size.x + id.x;
    depths_out[cell] = fragments[cell].depth;
}
