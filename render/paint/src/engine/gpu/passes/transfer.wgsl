// Transfers paint between canvas and head, and writes every cell of the region back to the canvas.
// We change a cell of the head by atomic additions modulo 2^32, so the order of its exchanges does
// not matter.

@group(0) @binding(0) var<uniform> params: SubStepParams;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
// x: penetration, y: volume, z: top, w: coat and a bit, all from before advection. See begin.wgsl.
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
    var body = moved[place];
    var skin = Cell();
    if params.mask.z != 0u {
        skin = moved[place + region_skin()];
    }
    let here = depths[place];
    if here.x != NO_CONTACT {
        let touch = touches[touch_index(id.xy)];
        let brush = above[place];
        let change = exchange(
            params.rates,
            touch,
            here.x,
            bitcast<u32>(here.w) & 0x7fffffffu,
            volume(body),
            volume(skin),
            volume(brush),
            leaving(touch, params.region.xy + id.xy, params.canvas),
        );
        if (change.down | change.up_body | change.up_skin) != 0u {
            let laid = cell_share_of_65536(brush, change.down);
            let of_body = cell_share_of_65536(body, change.up_body);
            let of_skin = cell_share_of_65536(skin, change.up_skin);
            body = minus(body, of_body);
            skin = minus(skin, of_skin);
            if here.w < 0 {
                skin = plus(skin, laid);
            } else {
                body = plus(body, laid);
            }
            gain_cell(touch.brush_cell, minus(plus(of_body, of_skin), laid));
        }
        let moves = stirred(params.rates, touch, here.x, volume(body), volume(skin));
        if (moves.x | moves.y) != 0u {
            let risen = cell_share_of_65536(body, moves.x);
            let sunk = cell_share_of_65536(skin, moves.y);
            body = plus(minus(body, risen), sunk);
            skin = plus(minus(skin, sunk), risen);
        }
    }
    let i = canvas_index(id.xy);
    pigments[2u * i] = body.low;
    pigments[2u * i + 1u] = body.high;
    vehicle[i] = body.vehicle;
    if params.mask.z != 0u {
        let k = i + canvas_skin();
        pigments[2u * k] = skin.low;
        pigments[2u * k + 1u] = skin.high;
        vehicle[k] = skin.vehicle;
    }
}
