//! Tests of counting on the processor, against winding numbers.

mod shapes;
mod winding;
mod scene;
mod random_scenes;
mod cases;
mod sums;
mod device;
