// Records the surface of the paint in a tile as the bed of a stroke, and settles its skins. Each
// invocation records a block.

struct BedParams {
    // x, y, width, height in cells.
    tile: vec4<u32>,
    canvas: vec2<u32>,
    // Height of a skin that stays.
    skin_quanta: u32,
    // Index of the first block's painted cells in the buffer of the floor.
    painted: u32,
}

@group(0) @binding(0) var<uniform> params: BedParams;
@group(0) @binding(1) var<storage, read_write> pigments: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> vehicle: array<u32>;
// The floor of all cells, then the bed of all blocks, the mask, and the painted cells of all blocks.
@group(0) @binding(3) var<storage, read_write> floor_height: array<i32>;

fn cell_at(i: u32) -> Cell {
    return Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
}

fn put(i: u32, cell: Cell) {
    pigments[2u * i] = cell.low;
    pigments[2u * i + 1u] = cell.high;
    vehicle[i] = cell.vehicle;
}

// Settles the films of a cell and returns its volume.
fn settled(i: u32) -> u32 {
    let k = i + params.canvas.x * params.canvas.y;
    let body = cell_at(i);
    let skin = cell_at(k);
    let above = volume(skin);
    if above > 0u {
        let joined = cell_share_of_65536(skin, settling(body, skin, params.skin_quanta));
        put(i, plus(body, joined));
        put(k, minus(skin, joined));
    }
    return volume(body) + above;
}

@compute @workgroup_size(8, 8)
fn note_bed(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(8u * id.xy >= params.tile.zw) {
        return;
    }
    let first = params.tile.xy + 8u * id.xy;
    let end = min(first + vec2(8u), params.tile.xy + params.tile.zw);
    var sum = 0;
    var upper = 0u;
    var lower = 0u;
    for (var y = first.y; y < end.y; y++) {
        for (var x = first.x; x < end.x; x++) {
            let i = y * params.canvas.x + x;
            let wet = settled(i);
            sum += (floor_height[i] + bitcast<i32>(wet)) >> 8u;
            let bit = select(0u, 1u, wet > 0u) << (((y - first.y) % 4u) * 8u + x - first.x);
            if y - first.y < 4u {
                upper |= bit;
            } else {
                lower |= bit;
            }
        }
    }
    let cells = (end - first).x * (end - first).y;
    let blocks_across = (params.canvas.x + 7u) / 8u;
    let block = first.y / 8u * blocks_across + first.x / 8u;
    floor_height[params.canvas.x * params.canvas.y + block] = sum / i32(cells);
    floor_height[params.painted + 2u * block] = bitcast<i32>(upper);
    floor_height[params.painted + 2u * block + 1u] = bitcast<i32>(lower);
}
