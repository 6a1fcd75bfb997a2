// Computes the state at the start of a sub-step: penetration and volume of every cell, and a copy
// of the head's cell above it.

@group(0) @binding(0) var<uniform> params: SubStepParams;
@group(0) @binding(1) var<storage, read> touches: array<Touch>;
@group(0) @binding(2) var<storage, read> pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> vehicle: array<u32>;
// The floor of all cells, then the bed of all blocks, then the bits of the mask.
@group(0) @binding(4) var<storage, read> floor_height: array<i32>;
@group(0) @binding(5) var<storage, read> brush_pigments: array<vec4<u32>>;
// The vehicle of all cells, then the mean of each cell's hair.
@group(0) @binding(6) var<storage, read> brush_vehicle: array<u32>;
// x: penetration, y: volume, z: top, w: coat, and in its highest bit whether the cell had wet paint
// before the stroke.
@group(0) @binding(7) var<storage, read_write> depths: array<vec4<i32>>;
@group(0) @binding(8) var<storage, read_write> above: array<Cell>;

// Height in quanta of the bed of the stroke at a cell.
fn bed_at(at: vec2<u32>) -> i32 {
    let blocks = (params.canvas + vec2(7u)) / 8u;
    let across = between_blocks(at.x, blocks.x);
    let down = between_blocks(at.y, blocks.y);
    let upper = params.canvas.x * params.canvas.y + down.x * blocks.x;
    let lower = params.canvas.x * params.canvas.y + down.y * blocks.x;
    return bed_height(
        vec2(floor_height[upper + across.x], floor_height[upper + across.y]),
        vec2(floor_height[lower + across.x], floor_height[lower + across.y]),
        across.z,
        down.z,
    );
}

// Whether the mask covers a cell of the canvas.
fn covered(i: u32) -> bool {
    if params.mask.x == 0u {
        return false;
    }
    let word = bitcast<u32>(floor_height[params.mask.x + i / 32u]);
    return ((word >> (i % 32u)) & 1u) == 1u;
}

// Whether a cell of the canvas had wet paint before the stroke.
fn painted_before(at: vec2<u32>) -> bool {
    let blocks = (params.canvas.x + 7u) / 8u;
    let block = at.y / 8u * blocks + at.x / 8u;
    let bit = at.y % 8u * 8u + at.x % 8u;
    let word = bitcast<u32>(floor_height[params.mask.y + 2u * block + bit / 32u]);
    return ((word >> (bit % 32u)) & 1u) == 1u;
}

@compute @workgroup_size(8, 8)
fn begin_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.region.zw) {
        return;
    }
    let place = id.y * params.region.z + id.x;
    let i = canvas_index(id.xy);
    var wet = volume(Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]));
    var layered = 0u;
    if params.mask.z != 0u {
        let k = i + canvas_skin();
        wet += volume(Cell(pigments[2u * k], pigments[2u * k + 1u], vehicle[k]));
        layered = select(0u, 0x80000000u, painted_before(params.region.xy + id.xy));
    }
    var depth = NO_CONTACT;
    var coat_quanta = 0u;
    let is_covered = covered(i);
    if within_contact(id.xy) && !is_covered {
        let touch = touches[touch_index(id.xy)];
        let b = touch.brush_cell;
        if touch.height != NO_HEAD {
            coat_quanta = coat(params.rates, touch, brush_vehicle[params.brush_cells + b]);
            let bed = bed_at(params.region.xy + id.xy);
            depth = penetration(params.rates, touch, floor_height[i], wet, bed, coat_quanta);
        }
        if depth != NO_CONTACT {
            above[place] =
                Cell(brush_pigments[2u * b], brush_pigments[2u * b + 1u], brush_vehicle[b]);
        }
    }
    let volume_quanta = bitcast<i32>(wet);
    let top = floor_height[i] + volume_quanta;
    // Nothing flows to or from a crowded column, so we treat a covered one in this way.
    let seen = select(volume_quanta, bitcast<i32>(MAX_COLUMN), is_covered);
    depths[place] = vec4(depth, seen, top, bitcast<i32>(coat_quanta | layered));
}
