// Lets paint flow over a head, one invocation a group of hairs. A hair is a column of cells and the
// column opposite to it.

struct WickParams {
    // Width and height of the head in cells.
    size: vec2<u32>,
    // Share of each surplus that moves, in parts of 65536.
    wicking: u32,
    // First row that takes part.
    first_row: u32,
    // Number of hairs in a group.
    hairs: u32,
    // Number of hairs that the first group lacks.
    shift: u32,
    // Number of flows in which all groups have their turn, and which of them this is.
    turns: u32,
    turn: u32,
}

// The cells of a group of hairs: its hairs from `first` to before `end`, then their opposites.
struct Group {
    first: u32,
    end: u32,
    columns: u32,
    count: u32,
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
    let half = (width + 1u) / 2u;
    // A workgroup is a row of 64 groups.
    let number = (id.x / 8u * 64u + id.y * 8u + id.x % 8u) * params.turns + params.turn;
    let before = number * params.hairs;
    let first = before - min(before, params.shift);
    if first >= half || params.first_row >= params.size.y {
        return;
    }
    let end = min(before + params.hairs - params.shift, half);
    // The middle column of an odd width is its own opposite.
    let middle = select(0u, 1u, end == half && width % 2u == 1u);
    let columns = 2u * (end - first) - middle;
    let group = Group(first, end, columns, columns * (params.size.y - params.first_row));
    var sum = 0u;
    for (var k = 0u; k < group.count; k++) {
        sum += volume(cell_at(place(k, group))) >> UNIT_BITS;
    }
    let mean = sum / max(group.count, 1u);
    var lacks = 0u;
    var last = 0u;
    for (var k = 0u; k < group.count; k++) {
        let i = place(k, group);
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
    for (var k = 0u; k < group.count; k++) {
        let i = place(k, group);
        let cell = cell_at(i);
        let share = given_share(volume(cell), mean, share_flowing);
        if share > 0u {
            let given = cell_share_of_65536(cell, share);
            pot = plus(pot, given);
            put(i, minus(cell, given));
        }
    }
    var rest = pot;
    for (var k = 0u; k < group.count; k++) {
        let i = place(k, group);
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

// Index of cell `k` of a group, row by row.
fn place(k: u32, group: Group) -> u32 {
    let hairs = group.end - group.first;
    let column = k % group.columns;
    let opposite = params.size.x - group.columns + column - group.first;
    let row = params.first_row + k / group.columns;
    return row * params.size.x + select(opposite, group.first + column, column < hairs);
}
