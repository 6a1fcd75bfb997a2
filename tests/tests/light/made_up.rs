//! Helpers: small documents in the shipped oils.

use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use graphics::field::Field;
use paint::amount::quanta_from_mm;
use paint::document::{Document, LayerId, Lighting, Medium, Slots};
use paint::ground::Ground;
use paint::layer::Layer;
use paint::light::Light;
use paint::optics::Gloss;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::{Observer, light_from_text};
pub(crate) use suite::oils::library as oils;

pub(crate) const CELL_MM: f64 = 0.1;

pub(crate) fn slots(library: &PigmentLibrary, names: &[&str]) -> Slots {
    std::array::from_fn(|slot| names.get(slot).map(|name| library.find(name).unwrap()))
}

pub(crate) fn viewing(light: &str) -> Viewing {
    Viewing { illuminant: light_from_text(light).unwrap(), observer: Observer::default() }
}

pub(crate) fn light(library: &PigmentLibrary, light: &str) -> Light {
    Light::new(library, &viewing(light)).unwrap()
}

/// A document without paint, with the pigments `names` in its slots, on a level ground of
/// reflectance 0.9. It is shown without relief.
pub(crate) fn document(width: usize, height: usize, names: &[&str]) -> Document {
    let library = oils();
    let slots = slots(&library, names);
    Document {
        title: "made up".to_owned(),
        cell_mm: CELL_MM,
        ground: Ground {
            name: "even".to_owned(),
            height: Field::filled(width, height, 0),
            reflectance: vec![0.9; library.grid.count()],
            gloss: Gloss { strength: 0.0, exponent: 1.0 },
        },
        library,
        medium: Medium::default(),
        dry: Vec::new(),
        next_layer: LayerId::FIRST,
        slots,
        wet: Layer::empty(width, height),
        lighting: Lighting { relief: 0.0, ..Lighting::default() },
    }
}

/// Sets the heights of the slots of a cell, in mm.
pub(crate) fn lay(layer: &mut Layer, cell: (usize, usize), mm: &[f64]) {
    for (slot, mm) in mm.iter().enumerate() {
        layer.pigments[cell][slot] = quanta_from_mm(*mm, CELL_MM);
    }
}

/// 48 x 48 cells with a dry layer of mixtures up to 0.3 mm per pigment, wet glazes up to 0.02 mm
/// per pigment over it, and bare ground in places. Each layer has eight pigments.
pub(crate) fn glazes_over_mixtures() -> Document {
    let names = [
        "Lead White",
        "Chrome Yellow",
        "Vermilion",
        "Cobalt Blue",
        "Viridian",
        "Emerald Green",
        "Bone Black",
        "Zinc White",
    ];
    let glazing = [
        "Eosin Lake",
        "Ultramarine",
        "Prussian Blue",
        "Cochineal Lake",
        "Viridian",
        "Minium",
        "Chrome Yellow",
        "Barium Sulphate",
    ];
    let mut document = document(48, 48, &glazing);
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let mut laid = |layer: &mut Layer, share: f64, most_mm: f64| {
        for y in 0..48 {
            for x in 0..48 {
                if random.random_range(0.0..1.0) > share {
                    continue;
                }
                let mut mm = [0.0; 8];
                for _ in 0..random.random_range(1..4) {
                    mm[random.random_range(0..8)] = random.random_range(0.0..most_mm);
                }
                lay(layer, (x, y), &mm);
            }
        }
    };
    let mut below = Layer::empty(48, 48);
    laid(&mut below, 0.85, 0.3);
    laid(&mut document.wet, 0.7, 0.02);
    let slots = slots(&document.library, &names);
    document.push_dry(slots, below);
    document
}
