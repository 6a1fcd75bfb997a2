// The picture: wet paint over what is baked, then surface, relief and gloss.

struct Showing {
    coat: Coat,
    rgb_from_nodes: array<vec4<f32>, 8>,
    skin: Skin,
    bumps: Bumps,
    canvas: vec2<u32>,
    // In the batch.
    first_tile: u32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> now: Showing;
// Column and row.
@group(0) @binding(1) var<storage, read> tiles: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> vehicle: array<u32>;
@group(0) @binding(4) var<storage, read> ground: array<i32>;
@group(0) @binding(5) var<storage, read> baked: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> bare: array<u32>;
@group(0) @binding(7) var<storage, read_write> picture: array<vec4<f32>>;

fn cell_at(i: u32) -> Cell {
    return Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
}

// The surface at a cell, or at the nearest of the canvas.
fn top(at: vec2<i32>) -> i32 {
    let inside = vec2<u32>(clamp(at, vec2(0), vec2<i32>(now.canvas) - vec2(1)));
    let i = inside.y * now.canvas.x + inside.x;
    return ground[i] + bitcast<i32>(volume(cell_at(i)));
}

@compute @workgroup_size(8, 8)
fn show_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = 64u * tiles[now.first_tile + id.z] + id.xy;
    if any(at >= now.canvas) {
        return;
    }
    let i = at.y * now.canvas.x + at.x;
    let wet = cell_at(i);
    let backing = Nodes(baked[2u * i], baked[2u * i + 1u]);
    let internal = lay_over(wet.low, wet.high, backing);
    var seen = color(internal);
    if now.skin.bumpy != 0u {
        let here = vec2<i32>(at);
        let heights = vec4(
            top(here - vec2(1, 0)),
            top(here + vec2(1, 0)),
            top(here - vec2(0, 1)),
            top(here + vec2(0, 1)),
        );
        let surface = select(bare[i], 0u, volume(wet) > 0u);
        seen = shaded(now.bumps, heights, surface, seen);
    }
    picture[i] = vec4(seen, 1.0);
}
