// Saves the wet paint of a tile for undo, or swaps it with the saved paint.

struct UndoTileParams {
    tile: vec4<u32>,
    canvas: vec2<u32>,
    // Index of the slot's first cell in its block.
    first_cell: u32,
    // 0 to save, 1 to swap.
    swap: u32,
    // Number of cells from a saved body to its skin.
    saved_skin: u32,
    padding: u32,
    padding_b: u32,
    padding_c: u32,
}

@group(0) @binding(0) var<uniform> params: UndoTileParams;
@group(0) @binding(1) var<storage, read_write> pigments: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> vehicle: array<u32>;
@group(0) @binding(3) var<storage, read_write> saved_pigments: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> saved_vehicle: array<u32>;

// Saves or swaps the film at `i` of the canvas and `k` of the saved tiles.
fn undo_film(i: u32, k: u32) {
    let wet = Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
    if params.swap != 0u {
        pigments[2u * i] = saved_pigments[2u * k];
        pigments[2u * i + 1u] = saved_pigments[2u * k + 1u];
        vehicle[i] = saved_vehicle[k];
    }
    saved_pigments[2u * k] = wet.low;
    saved_pigments[2u * k + 1u] = wet.high;
    saved_vehicle[k] = wet.vehicle;
}

@compute @workgroup_size(8, 8)
fn undo_tile(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.tile.zw) {
        return;
    }
    let at = params.tile.xy + id.xy;
    let i = at.y * params.canvas.x + at.x;
    let k = params.first_cell + 64u * id.y + id.x;
    undo_film(i, k);
    undo_film(i + params.canvas.x * params.canvas.y, k + params.saved_skin);
}
