// Shares of amounts, rounded down to whole quanta. This is the twin of amount.rs.

const MAX_COLUMN: u32 = 1073741824u;

fn share_of_256(amount: u32, share: u32) -> u32 {
    return (amount >> 8u) * share + (((amount & 0xffu) * share) >> 8u);
}

fn shares_of_256(amounts: vec4<u32>, share: u32) -> vec4<u32> {
    return (amounts >> vec4(8u)) * share + (((amounts & vec4(0xffu)) * share) >> vec4(8u));
}

fn share_of_65536(amount: u32, share: u32) -> u32 {
    return (amount >> 16u) * share + (((amount & 0xffffu) * share) >> 16u);
}

fn shares_of_65536(amounts: vec4<u32>, share: u32) -> vec4<u32> {
    return (amounts >> vec4(16u)) * share + (((amounts & vec4(0xffffu)) * share) >> vec4(16u));
}

fn ratio_of_65536(part: u32, whole: u32) -> u32 {
    var excess = 0u;
    if part >= 0x10000u {
        excess = firstLeadingBit(part) - 15u;
    }
    let divisor = (whole >> excess) + select(0u, 1u, excess > 0u);
    if divisor == 0u {
        return 0u;
    }
    return ((part >> excess) << 16u) / divisor;
}
