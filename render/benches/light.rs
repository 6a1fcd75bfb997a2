//! How fast: light.

fn main() {
    divan::main();
}
