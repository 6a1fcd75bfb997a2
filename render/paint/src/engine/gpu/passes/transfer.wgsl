// Transfers paint between canvas and head, and writes every cell of the region back to the canvas.
// We change a cell of the head by atomic additions modulo 2^32, so the order of its exchanges does
// not matter.

@group(0) @binding(0) var<uniform> params: SubStepParams;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
// x: penetration, y: volume, z: top, w: coat, all from before advection.
@group(0) @binding(2) var<storage, read> depths: array<vec4<i32>>;
@group(0) @binding(3) var<storage, read> moved: array<Cell>;
// The head's cell above, at the start of the sub-step.
@group(0) @binding(4) var<storage, read> above: array<Cell>;
@group(0) @binding(5) var<storage, read_write> brush_pigments: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> brush_vehicle: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read_write> pigments: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read_write> vehicle: array<u32>;

fn gain(at: u32, amount: u32) {
    if amount != 0u {
        atomicAdd(&brush_pigments[at], amount);
    }
}

fn gain_cell(b: u32, part: Cell) {
    gain(8u * b, part.low.x);
    gain(8u * b + 1u, part.low.y);
    gain(8u * b + 2u, part.low.z);
    gain(8u * b + 3u, part.low.w);
    gain(8u * b + 4u, part.high.x);
    gain(8u * b + 5u, part.high.y);
    gain(8u * b + 6u, part.high.z);
    gain(8u * b + 7u, part.high.w);
    if part.vehicle != 0u {
        atomicAdd(&brush_vehicle[b], part.vehicle);
    }
}

@compute @workgroup_size(8, 8)
fn transfer_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.region.zw) {
        return;
    }
    let place = id.y * params.region.z + id.x;
    var cell = moved[place];
    let here = depths[place];
    if here.x != NO_CONTACT {
        let touch = touches[touch_index(id.xy)];
        let brush = above[place];
        let change = exchange(
            params.rates,
            touch,
            here.x,
            bitcast<u32>(here.w),
            volume(cell),
            volume(brush),
            leaving(touch, params.region.xy + id.xy, params.canvas),
        );
        if (change.down | change.up) != 0u {
            let laid = cell_share_of_65536(brush, change.down);
            let taken = cell_share_of_65536(cell, change.up);
            cell = plus(minus(cell, taken), laid);
            gain_cell(touch.brush_cell, minus(taken, laid));
        }
    }
    let i = canvas_index(id.xy);
    pigments[2u * i] = cell.low;
    pigments[2u * i + 1u] = cell.high;
    vehicle[i] = cell.vehicle;
}
