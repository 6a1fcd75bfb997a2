//! The program `impasto-studio`.

fn main() {}
