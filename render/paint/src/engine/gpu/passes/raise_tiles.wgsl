// Adds up the heights of floor and wet paint, which shading reads around every cell.

struct RaiseParams {
    canvas: vec2<u32>,
    first_tile: u32,
    // 1 if a cell may have a skin.
    skin: u32,
}

@group(0) @binding(0) var<uniform> params: RaiseParams;
// Column and row of each tile.
@group(0) @binding(1) var<storage, read> tiles: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> vehicle: array<u32>;
// Height of ground and dry paint in quanta.
@group(0) @binding(4) var<storage, read> floor_height: array<i32>;
// Height of the surface in quanta.
@group(0) @binding(5) var<storage, read_write> tops: array<i32>;

@compute @workgroup_size(64)
fn raise_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[params.first_tile + id.z] + id.xy;
    if any(at >= params.canvas) {
        return;
    }
    let i = at.y * params.canvas.x + at.x;
    var wet = volume(Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]));
    if params.skin != 0u {
        let k = i + params.canvas.x * params.canvas.y;
        wet += volume(Cell(pigments[2u * k], pigments[2u * k + 1u], vehicle[k]));
    }
    tops[i] = floor_height[i] + bitcast<i32>(wet);
}
