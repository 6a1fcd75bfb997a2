// The constants of motion; twin of mod.rs.

struct Motion {
    push: i32,
    adhesion: u32,
    most: u32,
    cutoff: u32,
}
