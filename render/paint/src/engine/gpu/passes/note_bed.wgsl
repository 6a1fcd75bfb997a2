// Records the surface of the paint in a tile as the bed of a stroke. Each invocation records a
// block.

struct BedParams {
    // x, y, width, height in cells.
    tile: vec4<u32>,
    canvas: vec2<u32>,
    padding: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: BedParams;
@group(0) @binding(1) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> vehicle: array<u32>;
// The floor of all cells, then the bed of all blocks.
@group(0) @binding(3) var<storage, read_write> floor_height: array<i32>;

@compute @workgroup_size(8, 8)
fn note_bed(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(8u * id.xy >= params.tile.zw) {
        return;
    }
    let first = params.tile.xy + 8u * id.xy;
    let end = min(first + vec2(8u), params.tile.xy + params.tile.zw);
    var sum = 0;
    for (var y = first.y; y < end.y; y++) {
        for (var x = first.x; x < end.x; x++) {
            let i = y * params.canvas.x + x;
            let wet = volume(Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]));
            sum += (floor_height[i] + bitcast<i32>(wet)) >> 8u;
        }
    }
    let cells = (end - first).x * (end - first).y;
    let blocks_across = (params.canvas.x + 7u) / 8u;
    let block = first.y / 8u * blocks_across + first.x / 8u;
    floor_height[params.canvas.x * params.canvas.y + block] = sum / i32(cells);
}
