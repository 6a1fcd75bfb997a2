//! Documents of paintings with random amounts of paint.

use calibrate::PigmentId;
use graphics::field::Field;
use paint::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use paint::ground::Ground;
use paint::layer::{Cell, Layer, SLOTS};
use paint::optics::Gloss;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
pub(crate) use suite::oils::library;

/// A layer with paint on about a third of the cells in a random rectangle: 0 to `highest` quanta of
/// each pigment and of vehicle.
fn paint(rng: &mut ChaCha8Rng, size: (usize, usize), slots: &Slots, highest: u32) -> Layer {
    let mut layer = Layer::empty(size.0, size.1);
    let left = rng.random_range(0..size.0);
    let top = rng.random_range(0..size.1);
    for y in top..size.1 {
        for x in left..size.0 {
            if rng.random_range(0..3) > 0 {
                continue;
            }
            let mut cell = Cell::default();
            for (amount, slot) in cell.pigments.iter_mut().zip(slots) {
                let some = slot.is_some() && rng.random_bool(0.5);
                *amount = if some { rng.random_range(0..=highest) } else { 0 };
            }
            cell.vehicle = rng.random_range(0..=highest);
            layer.set_cell(y * size.0 + x, cell);
        }
    }
    layer
}

/// A painting of `width` x `height` cells with `dry` dry layers. `highest` is the largest amount of
/// a pigment in a cell, in quanta.
pub(crate) fn painting(
    seed: u64,
    (width, height): (usize, usize),
    dry: usize,
    highest: u32,
) -> Document {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let library = library();
    let count = library.pigments.len();
    let mut slots = || -> Slots {
        std::array::from_fn(|_| rng.random_bool(0.7).then(|| PigmentId(rng.random_range(0..count))))
    };
    let palettes: Vec<Slots> = (0..=dry).map(|_| slots()).collect();
    let rise = i32::try_from(highest.min(i32::MAX as u32)).unwrap();
    let heights = (0..width * height).map(|_| rng.random_range(-rise..=rise)).collect();
    let mut layers: Vec<DryLayer> = palettes
        .iter()
        .enumerate()
        .map(|(index, slots)| DryLayer {
            id: LayerId(if index % 2 == 0 { 40 - index as u32 } else { index as u32 }),
            name: ["", "r\u{f6}tel, first coat", "sky"][index % 3].to_owned(),
            visible: index % 4 != 2,
            slots: *slots,
            opacity: rng.random_range(0.0..2.0),
            paint: paint(&mut rng, (width, height), slots, highest),
        })
        .collect();
    let wet = layers.remove(0);
    Document {
        title: "caf\u{e9} \u{1f3a8} \"quoted\"\n".to_owned(),
        cell_mm: rng.random_range(0.01..1.0),
        ground: Ground {
            name: "linen, seed 1".to_owned(),
            height: Field::from_values(width, height, heights),
            reflectance: (0..library.grid.count()).map(|_| rng.random_range(0.0..1.0)).collect(),
            gloss: Gloss { strength: 0.1, exponent: 17.3 },
        },
        library,
        medium: Medium { scattering_per_mm: rng.random_range(1.0..100.0), ..Medium::default() },
        dry: layers,
        next_layer: if dry == 0 { LayerId::FIRST } else { LayerId(41 + dry as u32) },
        slots: wet.slots,
        wet: wet.paint,
        lighting: Lighting { azimuth_deg: rng.random_range(0.0..360.0), ..Lighting::default() },
    }
}

/// A painting of 40 x 33 cells with two dry layers and at most 2^20 quanta of a pigment in a cell.
pub(crate) fn small() -> Document {
    let document = painting(5, (40, 33), 2, 1 << 20);
    assert!(document.slots.iter().filter(|slot| slot.is_some()).count() <= SLOTS, "a palette");
    document
}
