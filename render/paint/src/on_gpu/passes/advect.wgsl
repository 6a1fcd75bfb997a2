// What every cell holds after the paint has moved: its own less what leaves,
// and what comes from the eight around it.

@group(0) @binding(0) var<uniform> now: Step;
@group(0) @binding(1) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> vehicle: array<u32>;
// Velocity in two halves, and the mobile share.
@group(0) @binding(3) var<storage, read> flow: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read_write> moved: array<Cell>;

fn cell_at(place: vec2<u32>) -> Cell {
    let i = canvas_index(place);
    return Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
}

@compute @workgroup_size(8, 8)
fn advect_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.region.zw) {
        return;
    }
    let width = now.region.z;
    var cell = cell_at(id.xy);
    let own = flow[id.y * width + id.x];
    if own.x != 0u {
        let out = outflow(cell, own.y, vec2<u32>(abs(halves(own.x))));
        cell = minus(cell, plus(out.beside, plus(out.along, out.corner)));
    }
    for (var i = 0; i < 9; i++) {
        let way = vec2(i % 3, i / 3) - vec2(1);
        // To the left of and above the region it wraps, and so lies beyond it.
        let source = id.xy - vec2<u32>(way);
        if i == 4 || any(source >= now.region.zw) {
            continue;
        }
        let at = source.y * width + source.x;
        let speed = halves(flow[at].x);
        // It comes here only if it moves this way in every direction that counts.
        if any((way != vec2(0)) & (sign(speed) != way)) {
            continue;
        }
        let out = outflow(cell_at(source), flow[at].y, vec2<u32>(abs(speed)));
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
