// The paint in one cell in quanta. This is the twin of layer.rs. Slots 0 to 3 are `low`, 4 to 7
// `high`.

struct Cell {
    low: vec4<u32>,
    high: vec4<u32>,
    vehicle: u32,
}

fn volume(cell: Cell) -> u32 {
    let both = cell.low + cell.high;
    return both.x + both.y + both.z + both.w + cell.vehicle;
}

fn cell_share_of_65536(cell: Cell, share: u32) -> Cell {
    return Cell(
        shares_of_65536(cell.low, share),
        shares_of_65536(cell.high, share),
        share_of_65536(cell.vehicle, share),
    );
}

fn plus(cell: Cell, other: Cell) -> Cell {
    return Cell(cell.low + other.low, cell.high + other.high, cell.vehicle + other.vehicle);
}

fn minus(cell: Cell, part: Cell) -> Cell {
    return Cell(cell.low - part.low, cell.high - part.high, cell.vehicle - part.vehicle);
}
