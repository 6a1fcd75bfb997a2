// The wet paint of a tile, kept in a slot or exchanged with what a slot keeps.

struct Keeping {
    // x, y, width, height in cells.
    tile: vec4<u32>,
    canvas: vec2<u32>,
    // The slot's first cell in the store.
    first_cell: u32,
    // 0 to keep, 1 to exchange.
    exchange: u32,
}

@group(0) @binding(0) var<uniform> now: Keeping;
@group(0) @binding(1) var<storage, read_write> pigments: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read_write> vehicle: array<u32>;
@group(0) @binding(3) var<storage, read_write> kept_pigments: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> kept_vehicle: array<u32>;

@compute @workgroup_size(8, 8)
fn keep_tile(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.tile.zw) {
        return;
    }
    let at = now.tile.xy + id.xy;
    let i = at.y * now.canvas.x + at.x;
    let k = now.first_cell + 64u * id.y + id.x;
    let wet = Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
    if now.exchange != 0u {
        pigments[2u * i] = kept_pigments[2u * k];
        pigments[2u * i + 1u] = kept_pigments[2u * k + 1u];
        vehicle[i] = kept_vehicle[k];
    }
    kept_pigments[2u * k] = wet.low;
    kept_pigments[2u * k + 1u] = wet.high;
    kept_vehicle[k] = wet.vehicle;
}
