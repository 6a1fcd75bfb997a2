// Counts the closed surfaces that hold the seen point, if their gate lets the triangle there pass.
// This is the twin of GatedCount and follows corner.wgsl.

struct Fragment {
    triangle: u32,
    second: f32,
    third: f32,
    depth: f32,
}

const NO_TRIANGLE: u32 = 0xffffffffu;

@group(0) @binding(3) var<storage, read> fragments: array<Fragment>;
// For each surface: the direction that it faces, and the least cosine. Then its body, or 0 for
// any.
@group(0) @binding(4) var<storage, read> gates: array<vec4<f32>>;
// For each triangle of the scene: its normal and its body, or 0 for any.
@group(0) @binding(5) var<storage, read> normals: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> sums: array<atomic<i32>>;

@fragment
fn pixel(at: Corner, @builtin(front_facing) front: bool) {
    let cell = u32(at.position.y) * params.width + u32(at.position.x);
    let seen = fragments[cell];
    if seen.triangle == NO_TRIANGLE || at.position.z * params.depth_scale < seen.depth {
        return;
    }
    let gate = gates[2u * at.surface];
    let body = gates[2u * at.surface + 1u].x;
    let own = normals[seen.triangle];
    let is_own = body == 0.0 || own.w == 0.0 || body == own.w;
    if is_own && dot(own.xyz, gate.xyz) >= gate.w {
        atomicAdd(&sums[cell], select(1, -1, front));
    }
}
