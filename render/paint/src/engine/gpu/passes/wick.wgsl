// Lets paint flow along the hair of a head, one invocation a hair: a column of cells and the
// column opposite to it.

struct WickParams {
    // Width and height of the head in cells.
    size: vec2<u32>,
    // Share of each surplus that moves, in parts of 65536.
    wicking: u32,
    padding: u32,
}

@group(0) @binding(0) var<uniform> params: WickParams;
@group(0) @binding(1) var<storage, read_write> pigments: array<vec4<u32>>;
// The vehicle of all cells, then the mean of each cell's hair.
@group(0) @binding(2) var<storage, read_write> vehicle: array<u32>;

fn cell_at(i: u32) -> Cell {
    return Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
}

fn put(i: u32, cell: Cell) {
    pigments[2u * i] = cell.low;
    pigments[2u * i + 1u] = cell.high;
    vehicle[i] = cell.vehicle;
}

@compute @workgroup_size(8, 8)
fn wick_hairs(@builtin(global_invocation_id) id: vec3<u32>) {
    let width = params.size.x;
    // A group is a row of 64 hairs.
    let hair = id.x / 8u * 64u + id.y * 8u + id.x % 8u;
    let opposite = width - 1u - hair;
    if hair >= (width + 1u) / 2u {
        return;
    }
    let columns = select(2u, 1u, opposite == hair);
    let count = columns * params.size.y;
    var sum = 0u;
    for (var k = 0u; k < count; k++) {
        sum += volume(cell_at(place(k, columns, hair, opposite))) >> UNIT_BITS;
    }
    let mean = sum / max(count, 1u);
    var lacks = 0u;
    var last = 0u;
    for (var k = 0u; k < count; k++) {
        let i = place(k, columns, hair, opposite);
        vehicle[width * params.size.y + i] = mean << UNIT_BITS;
        let missing = lack(volume(cell_at(i)), mean);
        if missing > 0u {
            lacks += missing;
            last = k;
        }
    }
    if lacks == 0u {
        return;
    }
    let share_flowing = flowing(params.wicking, lacks);
    var pot = Cell();
    for (var k = 0u; k < count; k++) {
        let i = place(k, columns, hair, opposite);
        let cell = cell_at(i);
        let share = given_share(volume(cell), mean, share_flowing);
        if share > 0u {
            let given = cell_share_of_65536(cell, share);
            pot = plus(pot, given);
            put(i, minus(cell, given));
        }
    }
    var rest = pot;
    for (var k = 0u; k < count; k++) {
        let i = place(k, columns, hair, opposite);
        let cell = cell_at(i);
        let missing = lack(volume(cell), mean);
        if missing > 0u {
            var part = dealt(pot, missing, lacks);
            if k == last {
                part = rest;
            }
            rest = minus(rest, part);
            put(i, plus(cell, part));
        }
    }
}

// Index of cell `k` of a hair, row by row.
fn place(k: u32, columns: u32, hair: u32, opposite: u32) -> u32 {
    let column = select(opposite, hair, k % columns == 0u);
    return k / columns * params.size.x + column;
}
