// The depth of every pixel.

struct DepthsNow {
    size: vec2<u32>,
    spare: vec2<u32>,
}

struct Seen {
    triangle: u32,
    second: f32,
    third: f32,
    depth: f32,
}

@group(0) @binding(0) var<uniform> now: DepthsNow;
@group(0) @binding(1) var<storage, read> seen: array<Seen>;
@group(0) @binding(2) var<storage, read_write> depths: array<f32>;

@compute @workgroup_size(8, 8)
fn watercolor_depths(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= now.size.x || id.y >= now.size.y {
        return;
    }
    let cell = id.y * now.size.x + id.x;
    depths[cell] = seen[cell].depth;
}
