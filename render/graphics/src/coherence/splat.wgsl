// The sum of all features at each pixel. This is the twin of splat.rs. A workgroup is a square of
// pixels with its own list of features.

struct SplatParams {
    width: u32,
    height: u32,
    starts: u32,
    lists: u32,
}

struct Splat {
    x: f32,
    y: f32,
    narrowness: f32,
    amplitude: f32,
    depth: f32,
    slope_x: f32,
    slope_y: f32,
    tightness: f32,
}

@group(0) @binding(0) var<uniform> params: SplatParams;
@group(0) @binding(1) var<storage, read> depths: array<f32>;
@group(0) @binding(2) var<storage, read> splats: array<Splat>;
@group(0) @binding(3) var<storage, read> batch: array<u32>;
@group(0) @binding(4) var<storage, read_write> sums: array<f32>;

@compute @workgroup_size(8, 8)
fn gather_splats(
    @builtin(global_invocation_id) at: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    if at.x >= params.width || at.y >= params.height {
        return;
    }
    let pixel = at.y * params.width + at.x;
    let depth = depths[pixel];
    if depth >= 1.0 {
        sums[pixel] = 0.5;
        return;
    }
    let square = params.starts + group.y * groups.x + group.x;
    let end = batch[square + 1u];
    var sum = 0.0;
    for (var i = batch[square]; i < end; i++) {
        // We read members one by one, because most features of a list miss most of its rows.
        let index = batch[params.lists + i];
        let narrowness = splats[index].narrowness;
        let down = f32(at.y) + 0.5 - splats[index].y;
        if abs(down) * narrowness >= 1.0 {
            continue;
        }
        let right = f32(at.x) + 0.5 - splats[index].x;
        let t = max(1.0 - length(vec2(right, down) * narrowness), 0.0);
        if t <= 0.0 {
            continue;
        }
        let slopes = splats[index].slope_y * down + splats[index].slope_x * right;
        let off = abs(splats[index].depth + slopes - depth);
        let share = clamp(2.0 - off * splats[index].tightness, 0.0, 1.0);
        let bump = t * t * t * (t * (6.0 * t - 15.0) + 10.0);
        sum += splats[index].amplitude * share * bump;
    }
    sums[pixel] = clamp(0.5 + sum, 0.0, 1.0);
}
