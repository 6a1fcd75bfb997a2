// Paint changing sides; then every cell of the region is back on the canvas.
// What the cells of the head gain or lose is added up in `gained`, modulo 2^32.

@group(0) @binding(0) var<uniform> now: Step;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
@group(0) @binding(2) var<storage, read> flow: array<vec4<i32>>;
@group(0) @binding(3) var<storage, read> moved: array<Cell>;
@group(0) @binding(4) var<storage, read> brush_pigments: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read> brush_vehicle: array<u32>;
// Nine numbers a cell of the head: eight pigments, vehicle.
@group(0) @binding(6) var<storage, read_write> gained: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read_write> pigments: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read_write> vehicle: array<u32>;

fn gain(at: u32, amount: u32) {
    if amount != 0u {
        atomicAdd(&gained[at], amount);
    }
}

fn gain_cell(brush_cell: u32, part: Cell) {
    let first = 9u * brush_cell;
    for (var i = 0u; i < 4u; i++) {
        gain(first + i, part.low[i]);
        gain(first + 4u + i, part.high[i]);
    }
    gain(first + 8u, part.vehicle);
}

@compute @workgroup_size(8, 8)
fn transfer_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.region.zw) {
        return;
    }
    let place = id.y * now.region.z + id.x;
    let at = now.region.xy + id.xy;
    var cell = moved[place];
    let depth = flow[place].w;
    if depth != APART {
        let over = at - now.contact.xy;
        let touch = touches[now.first_touch + over.y * now.contact.z + over.x];
        let b = touch.brush_cell;
        let brush = Cell(brush_pigments[2u * b], brush_pigments[2u * b + 1u], brush_vehicle[b]);
        let change = exchange(now.motion, touch, u32(depth), volume(cell), volume(brush));
        if change.parts != 0u && change.brush_gives {
            let given = share(brush, change.parts);
            cell = plus(cell, given);
            gain_cell(b, minus(Cell(), given));
        } else if change.parts != 0u {
            let given = share(cell, change.parts);
            cell = minus(cell, given);
            gain_cell(b, given);
        }
    }
    let i = at.y * now.canvas.x + at.x;
    pigments[2u * i] = cell.low;
    pigments[2u * i + 1u] = cell.high;
    vehicle[i] = cell.vehicle;
}
