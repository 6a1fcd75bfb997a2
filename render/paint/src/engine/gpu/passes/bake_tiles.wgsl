// Bakes the internal reflectance of ground and dry layers, tile by tile.

struct BakeParams {
    layer: LayerOptics,
    // Internal reflectance of the ground.
    ground: array<vec4<f32>, 2>,
    // Width and height in cells.
    canvas: vec2<u32>,
    // Index of the first tile in the batch.
    first_tile: u32,
    padding: u32,
}

@group(0) @binding(0) var<uniform> params: BakeParams;
// Column and row of each tile.
@group(0) @binding(1) var<storage, read> tiles: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> vehicle: array<u32>;
@group(0) @binding(4) var<storage, read_write> baked: array<vec4<f32>>;
// Topmost material below the wet paint: 1 dry paint, 2 bare ground.
@group(0) @binding(5) var<storage, read_write> material: array<u32>;

// Sets tiles to the bare ground.
@compute @workgroup_size(8, 8)
fn prime_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[params.first_tile + id.z] + id.xy;
    if any(at >= params.canvas) {
        return;
    }
    let i = at.y * params.canvas.x + at.x;
    baked[2u * i] = params.ground[0];
    baked[2u * i + 1u] = params.ground[1];
    material[i] = 2u;
}

// Composites one dry layer over what is baked.
@compute @workgroup_size(8, 8)
fn bake_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[params.first_tile + id.z] + id.xy;
    if any(at >= params.canvas) {
        return;
    }
    let i = at.y * params.canvas.x + at.x;
    let paint = Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
    if volume(paint) == 0u {
        return;
    }
    let backing = Nodes(baked[2u * i], baked[2u * i + 1u]);
    let above = composite(paint.low, paint.high, backing);
    baked[2u * i] = above.low;
    baked[2u * i + 1u] = above.high;
    material[i] = 1u;
}
