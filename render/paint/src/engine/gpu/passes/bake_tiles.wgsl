// Bakes the internal reflectance of ground and dry layers, tile by tile.

struct BakeParams {
    layer: LayerOptics,
    // Internal reflectance of the ground.
    ground: array<vec4<f32>, 2>,
    canvas: vec2<u32>,
    first_tile: u32,
    // Index of the film's first cell in its buffer.
    first_cell: u32,
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
@compute @workgroup_size(64)
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

// A cell of a dry layer over what is baked.
struct BakedCell {
    index: u32,
    painted: bool,
    internal: Nodes,
}

fn baked_cell(at: vec2<u32>) -> BakedCell {
    let inside = min(at, params.canvas - vec2(1u));
    let i = inside.y * params.canvas.x + inside.x;
    let k = params.first_cell + i;
    let paint = Cell(pigments[2u * k], pigments[2u * k + 1u], vehicle[k]);
    let backing = Nodes(baked[2u * i], baked[2u * i + 1u]);
    let painted = all(at < params.canvas) && volume(paint) > 0u;
    var covered = covered_part(paint);
    if params.first_cell > 0u {
        // The body lies below this skin.
        covered += covered_part(Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]));
    }
    return BakedCell(i, painted, composite(paint, covered, backing));
}

fn write(cell: BakedCell) {
    if cell.painted {
        baked[2u * cell.index] = cell.internal.low;
        baked[2u * cell.index + 1u] = cell.internal.high;
        material[cell.index] = 1u;
    }
}

// Composites one dry layer over the baked reflectance. Each invocation computes four cells of a
// column of a tile. You find the reason at `show_tiles`.
@compute @workgroup_size(64)
fn bake_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[params.first_tile + id.z] + id.xy;
    let a = baked_cell(at);
    let b = baked_cell(at + vec2(0u, 16u));
    let c = baked_cell(at + vec2(0u, 32u));
    let d = baked_cell(at + vec2(0u, 48u));
    write(a);
    write(b);
    write(c);
    write(d);
}
