// Drying, and the floor's rise and fall with dry layers.

struct DryParams {
    canvas: vec2<u32>,
    // Share of the wet paint that dries, in parts of 65536.
    share: u32,
    // 1 when the layer is added, -1 when it is removed.
    rise: i32,
    // 2 if the dry layer has a skin, else 1.
    films: u32,
    padding: u32,
    padding_b: u32,
    padding_c: u32,
}

@group(0) @binding(0) var<uniform> params: DryParams;
@group(0) @binding(1) var<storage, read_write> floor_height: array<i32>;
@group(0) @binding(2) var<storage, read_write> dry_pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> dry_vehicle: array<u32>;
@group(0) @binding(4) var<storage, read_write> pigments: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> vehicle: array<u32>;

// Number of cells of the canvas: the distance from a body to its skin.
fn cells() -> u32 {
    return params.canvas.x * params.canvas.y;
}

fn wet_cell(i: u32) -> Cell {
    return Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
}

// Moves a share of a film.
fn dry_film(i: u32, share: u32) {
    let wet = wet_cell(i);
    let dried = cell_share_of_65536(wet, share);
    let left = minus(wet, dried);
    pigments[2u * i] = left.low;
    pigments[2u * i + 1u] = left.high;
    vehicle[i] = left.vehicle;
    dry_pigments[2u * i] = dried.low;
    dry_pigments[2u * i + 1u] = dried.high;
    dry_vehicle[i] = dried.vehicle;
}

fn dry_volume(i: u32) -> i32 {
    return bitcast<i32>(volume(Cell(dry_pigments[2u * i], dry_pigments[2u * i + 1u], dry_vehicle[i])));
}

// Moves a share of the wet paint to the new layer and raises the floor.
@compute @workgroup_size(8, 8)
fn dry_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.canvas) {
        return;
    }
    let i = id.y * params.canvas.x + id.x;
    if params.films == 1u {
        dry_film(i, params.share);
        floor_height[i] += params.rise * dry_volume(i);
        return;
    }
    let k = i + cells();
    let shares = drying(params.share, volume(wet_cell(i)), volume(wet_cell(k)));
    dry_film(i, shares.x);
    dry_film(k, shares.y);
    floor_height[i] += params.rise * (dry_volume(i) + dry_volume(k));
}

// Raises or lowers the floor by an existing layer.
@compute @workgroup_size(8, 8)
fn move_floor(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.canvas) {
        return;
    }
    let i = id.y * params.canvas.x + id.x;
    for (var film = 0u; film < params.films; film++) {
        floor_height[i] += params.rise * dry_volume(i + film * cells());
    }
}
