//! One sub-step of a brush head, bending included:
//! `cargo bench -p impasto-paint --bench brush`.
//!
//! Target: 80 microseconds for a contact of 88 x 88 cells, 25 for 26 x 26. The bench counts cells
//! of the contact as items.

use divan::{Bencher, counter::ItemsCount};
use graphics::field::Field;
use graphics::tile::Rect;
use paint::brush::{Head, HeadShape, Relief};
use paint::contact::Contact;
use paint::pose::Pose;

fn main() {
    divan::main();
}

const CELL_MM: f64 = 0.1;
const BOUNDS: Rect = Rect { x: 0, y: 0, width: 2048, height: 512 };

/// Shape, size in mm and pressure of each head.
const HEADS: [(HeadShape, f64, f64); 8] = [
    (HeadShape::Round, 1.7, 1.0),
    (HeadShape::Round, 6.0, 1.0),
    (HeadShape::Flat, 2.6, 0.7),
    (HeadShape::Flat, 8.8, 0.7),
    (HeadShape::Filbert, 8.8, 0.7),
    (HeadShape::Fan, 8.8, 0.7),
    (HeadShape::Rigger, 1.5, 0.7),
    (HeadShape::Knife, 8.8, 0.7),
];

fn pose(step: usize, pressure: f64) -> Pose {
    Pose {
        x: 300.0 + (step % 1400) as f64,
        y: 256.3,
        pressure,
        tilt_x_deg: 20.0,
        tilt_y_deg: 10.0,
        twist_deg: 90.0,
        speed_mm_s: 0.0,
    }
}

fn drag(bencher: Bencher, head: usize, relief: &Relief) {
    let (shape, size_mm, pressure) = HEADS[head];
    let mut head = Head::new(shape, size_mm, CELL_MM).expect("a head");
    let mut contact = Contact::default();
    let mut step = 0;
    head.set_down(&pose(0, pressure), (1.0, 0.0), relief);
    for _ in 0..200 {
        step += 1;
        head.advance(&pose(step, pressure), relief, BOUNDS, &mut contact);
    }
    let cells = contact.touches.len();
    bencher.counter(ItemsCount::new(cells)).bench_local(|| {
        step += 1;
        head.advance(&pose(step, pressure), relief, BOUNDS, &mut contact);
        contact.touches.len()
    });
}

#[divan::bench(args = 0..HEADS.len())]
fn on_a_plane(bencher: Bencher, head: usize) {
    drag(bencher, head, &Relief::flat(BOUNDS.width, BOUNDS.height, CELL_MM));
}

#[divan::bench(args = 0..HEADS.len())]
fn on_a_relief(bencher: Bencher, head: usize) {
    let cells = BOUNDS.width * BOUNDS.height;
    let floor = Field::from_values(
        BOUNDS.width,
        BOUNDS.height,
        (0..cells).map(|i: usize| ((i % 40) * 40_000) as i32).collect(),
    );
    drag(bencher, head, &Relief::from_floor(&floor, CELL_MM));
}
