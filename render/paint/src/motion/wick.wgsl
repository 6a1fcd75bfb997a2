// Flow of paint along the hair of a head. This is the twin of wick.rs.

const UNIT_BITS: u32 = 10u;
const POT_UNITS: u32 = 2097152u;

fn flowing(wicking: u32, lacks: u32) -> u32 {
    return min(wicking, ratio_of_65536(POT_UNITS, max(lacks, POT_UNITS)));
}

fn given_share(volume_quanta: u32, mean: u32, flowing: u32) -> u32 {
    let level = mean << UNIT_BITS;
    let surplus = select(0u, volume_quanta - level, volume_quanta > level);
    return ratio_of_65536(share_of_65536(surplus, flowing), volume_quanta);
}

fn lack(volume_quanta: u32, mean: u32) -> u32 {
    let units = volume_quanta >> UNIT_BITS;
    return select(0u, mean - units, mean > units);
}

fn dealt(pot: Cell, lack: u32, lacks: u32) -> Cell {
    return cell_share_of_65536(pot, ratio_of_65536(lack, lacks));
}
