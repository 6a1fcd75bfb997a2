//! Pixels mapped: `cargo bench -p impasto-maps --bench map`.

fn main() {
    divan::main();
}
