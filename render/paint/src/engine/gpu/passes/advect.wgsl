// Computes the films of every cell after advection: its own minus the part that flows out, plus the
// parts that flow in from its eight neighbours.

@group(0) @binding(0) var<uniform> params: SubStepParams;
@group(0) @binding(1) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> vehicle: array<u32>;
// x: velocity, packed as in `Touch`. y: mobile share in parts of 65536.
@group(0) @binding(3) var<storage, read> flow_in: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read_write> moved: array<Cell>;

// A film of the cell at `place` of the region. `film` is 0 for the body, and else the distance to the
// skin.
fn cell_at(place: vec2<u32>, film: u32) -> Cell {
    let i = canvas_index(place) + film;
    return Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
}

// A film of the cell at `id` after advection.
fn advected(id: vec2<u32>, film: u32) -> Cell {
    let width = params.region.z;
    var cell = cell_at(id, film);
    let own = flow_in[id.y * width + id.x];
    if own.x != 0u {
        let start = cell;
        let out = outflow(own.y, vec2<u32>(abs(halves(own.x))));
        cell = minus(cell, cell_share_of_65536(start, out.in_x));
        cell = minus(cell, cell_share_of_65536(start, out.in_y));
        cell = minus(cell, cell_share_of_65536(start, out.diagonal));
    }
    for (var i = 0; i < 9; i++) {
        let direction = vec2(i % 3, i / 3) - vec2(1);
        // Left of or above the region this difference wraps to a large number, which lies outside
        // as well.
        let source = id - vec2<u32>(direction);
        if i == 4 || any(source >= params.region.zw) {
            continue;
        }
        let at = source.y * width + source.x;
        let speed = halves(flow_in[at].x);
        // Paint flows here only if its velocity has the sign of each component of
        // `direction` that is not 0.
        if any((direction != vec2(0)) & (sign(speed) != direction)) {
            continue;
        }
        let out = outflow(flow_in[at].y, vec2<u32>(abs(speed)));
        var share = out.diagonal;
        if direction.y == 0 {
            share = out.in_x;
        } else if direction.x == 0 {
            share = out.in_y;
        }
        cell = plus(cell, cell_share_of_65536(cell_at(source, film), share));
    }
    return cell;
}

@compute @workgroup_size(8, 8)
fn advect_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.region.zw) {
        return;
    }
    let place = id.y * params.region.z + id.x;
    moved[place] = advected(id.xy, 0u);
    if params.mask.z != 0u {
        moved[place + region_skin()] = advected(id.xy, canvas_skin());
    }
}
