// Renders the picture: composites the wet paint over the baked reflectance, then applies
// surface reflection, relief and gloss.

struct ShowParams {
    layer: LayerOptics,
    rgb_from_nodes: array<vec4<f32>, 8>,
    surface: SurfaceParams,
    lamp: LampParams,
    canvas: vec2<u32>,
    first_tile: u32,
    // 1 if a cell of the wet layer may have a skin.
    skin: u32,
}

@group(0) @binding(0) var<uniform> params: ShowParams;
// Column and row of each tile.
@group(0) @binding(1) var<storage, read> tiles: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> vehicle: array<u32>;
// Height of the surface in quanta.
@group(0) @binding(4) var<storage, read> tops: array<i32>;
@group(0) @binding(5) var<storage, read> baked: array<vec4<f32>>;
// Topmost material below the wet paint: 1 dry paint, 2 bare ground.
@group(0) @binding(6) var<storage, read> material: array<u32>;
@group(0) @binding(7) var<storage, read_write> picture: array<vec4<f32>>;

// Height of the surface in quanta at a cell, or at the nearest cell of the canvas.
fn top(at: vec2<i32>) -> f32 {
    let inside = vec2<u32>(clamp(at, vec2(0), vec2<i32>(params.canvas) - vec2(1)));
    return f32(tops[inside.y * params.canvas.x + inside.x]);
}

// A cell before relief and gloss.
struct LevelCell {
    at: vec2<u32>,
    index: u32,
    // 0 wet paint, 1 dry paint, 2 ground.
    material: u32,
    color: vec3<f32>,
}

// The cell at `at`, or the nearest cell of the canvas.
fn level_cell(at: vec2<u32>) -> LevelCell {
    let inside = min(at, params.canvas - vec2(1u));
    let i = inside.y * params.canvas.x + inside.x;
    let wet = Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
    let covered = covered_part(wet);
    var internal = composite(wet, covered, Nodes(baked[2u * i], baked[2u * i + 1u]));
    var is_wet = volume(wet) > 0u;
    if params.skin != 0u {
        let k = i + params.canvas.x * params.canvas.y;
        let above = Cell(pigments[2u * k], pigments[2u * k + 1u], vehicle[k]);
        internal = composite(above, covered + covered_part(above), internal);
        is_wet = is_wet || volume(above) > 0u;
    }
    return LevelCell(at, i, select(material[i], 0u, is_wet), color(internal));
}

// `column` holds the heights of the cell above, of the cell, and of the cell below.
fn shaded(cell: LevelCell, column: vec3<f32>) -> vec3<f32> {
    return shade(vec2<i32>(cell.at), column, cell.material, cell.color);
}

fn write(cell: LevelCell) {
    if all(cell.at < params.canvas) {
        picture[cell.index] = vec4(cell.color, 1.0);
    }
}

// Shows four cells of a column of a tile. A software device loads the uniforms once for all four,
// and this takes longer than their arithmetic, so we do not let a branch divide the four.
@compute @workgroup_size(64)
fn show_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[params.first_tile + id.z] + vec2(id.x, 4u * id.y);
    var a = level_cell(at);
    var b = level_cell(at + vec2(0u, 1u));
    var c = level_cell(at + vec2(0u, 2u));
    var d = level_cell(at + vec2(0u, 3u));
    if params.surface.relief_on != 0u {
        let place = vec2<i32>(at);
        let above = top(place - vec2(0, 1));
        let of_a = top(place);
        let of_b = top(place + vec2(0, 1));
        let of_c = top(place + vec2(0, 2));
        let of_d = top(place + vec2(0, 3));
        let below = top(place + vec2(0, 4));
        a.color = shaded(a, vec3(above, of_a, of_b));
        b.color = shaded(b, vec3(of_a, of_b, of_c));
        c.color = shaded(c, vec3(of_b, of_c, of_d));
        d.color = shaded(d, vec3(of_c, of_d, below));
    }
    write(a);
    write(b);
    write(c);
    write(d);
}
