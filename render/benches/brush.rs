//! How fast: brush.

fn main() {
    divan::main();
}
