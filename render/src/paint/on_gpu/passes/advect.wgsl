// What every cell holds after the paint has moved: its own less what leaves,
// and what comes from the eight around it.

@group(0) @binding(0) var<uniform> now: Step;
@group(0) @binding(1) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> vehicle: array<u32>;
@group(0) @binding(3) var<storage, read> flow: array<vec4<i32>>;
@group(0) @binding(4) var<storage, read_write> moved: array<Cell>;

fn cell_at(place: vec2<u32>) -> Cell {
    let at = now.region.xy + place;
    let i = at.y * now.canvas.x + at.x;
    return Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
}

fn outflow_of(cell: Cell, leaving: vec4<i32>) -> Outflow {
    return outflow(cell, u32(leaving.z), vec2<u32>(abs(leaving.xy)));
}

@compute @workgroup_size(8, 8)
fn advect_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.region.zw) {
        return;
    }
    let width = now.region.z;
    var cell = cell_at(id.xy);
    let own = flow[id.y * width + id.x];
    if own.z != 0 {
        let out = outflow_of(cell, own);
        cell = minus(cell, plus(out.beside, plus(out.along, out.corner)));
    }
    for (var i = 0; i < 9; i++) {
        let way = vec2(i % 3, i / 3) - vec2(1);
        let source = vec2<i32>(id.xy) - way;
        if all(way == vec2(0)) || any(source < vec2(0)) || any(source >= vec2<i32>(now.region.zw)) {
            continue;
        }
        let leaving = flow[u32(source.y) * width + u32(source.x)];
        // It comes here only if it moves this way in every direction that counts.
        if leaving.z == 0 || any((way != vec2(0)) & (sign(leaving.xy) != way)) {
            continue;
        }
        let out = outflow_of(cell_at(vec2<u32>(source)), leaving);
        if way.y == 0 {
            cell = plus(cell, out.beside);
        } else if way.x == 0 {
            cell = plus(cell, out.along);
        } else {
            cell = plus(cell, out.corner);
        }
    }
    moved[id.y * width + id.x] = cell;
}
