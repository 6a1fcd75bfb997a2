// The internal reflectance of ground and dry layers, tile by tile.

struct Baking {
    coat: Coat,
    // Of the ground.
    ground: array<vec4<f32>, 2>,
    canvas: vec2<u32>,
    // In the batch.
    first_tile: u32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> now: Baking;
// Column and row.
@group(0) @binding(1) var<storage, read> tiles: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> vehicle: array<u32>;
@group(0) @binding(4) var<storage, read_write> baked: array<vec4<f32>>;
// 1 where dry paint lies on top, 2 where the ground is bare.
@group(0) @binding(5) var<storage, read_write> bare: array<u32>;

// Nothing but ground.
@compute @workgroup_size(8, 8)
fn prime_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[now.first_tile + id.z] + id.xy;
    if any(at >= now.canvas) {
        return;
    }
    let i = at.y * now.canvas.x + at.x;
    baked[2u * i] = now.ground[0];
    baked[2u * i + 1u] = now.ground[1];
    bare[i] = 2u;
}

// One dry layer over what is baked.
@compute @workgroup_size(8, 8)
fn bake_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[now.first_tile + id.z] + id.xy;
    if any(at >= now.canvas) {
        return;
    }
    let i = at.y * now.canvas.x + at.x;
    let paint = Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
    if volume(paint) == 0u {
        return;
    }
    let backing = Nodes(baked[2u * i], baked[2u * i + 1u]);
    let above = lay_over(paint.low, paint.high, backing);
    baked[2u * i] = above.low;
    baked[2u * i + 1u] = above.high;
    bare[i] = 1u;
}
