// Adds the weight of a closed surface where its faces lie at or behind the seen point. This is the
// twin of WeighedCount and follows corner.wgsl.

struct Fragment {
    triangle: u32,
    second: f32,
    third: f32,
    depth: f32,
}

const NO_TRIANGLE: u32 = 0xffffffffu;

@group(0) @binding(3) var<storage, read> fragments: array<Fragment>;
@group(0) @binding(4) var<storage, read> weights: array<i32>;
@group(0) @binding(5) var<storage, read_write> sums: array<atomic<i32>>;

@fragment
fn pixel(at: Corner, @builtin(front_facing) front: bool) {
    let cell = u32(at.position.y) * params.width + u32(at.position.x);
    let seen = fragments[cell];
    if seen.triangle != NO_TRIANGLE && at.position.z * params.depth_scale >= seen.depth {
        let weight = weights[at.surface];
        atomicAdd(&sums[cell], select(weight, -weight, front));
    }
}
