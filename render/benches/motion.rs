//! How fast: motion.

fn main() {
    divan::main();
}
