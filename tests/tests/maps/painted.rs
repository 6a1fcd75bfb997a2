//! Small paintings whose paint is laid by hand.

use std::path::{Path, PathBuf};

use calibrate::PigmentLibrary;
use graphics::field::Field;
use paint::amount::quanta_from_mm;
use paint::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use paint::file;
use paint::ground::Ground;
use paint::layer::Layer;
use paint::optics::Gloss;
use suite::oils::library;

const CELL_MM: f64 = 0.1;

/// Pigments of all paintings here, by slot.
pub(crate) const NAMES: [&str; 8] = [
    "Lead White",
    "Vermilion",
    "Viridian",
    "Chrome Yellow",
    "Ultramarine",
    "Prussian Blue",
    "Bone Black",
    "Emerald Green",
];

/// A painting without paint on a grey ground.
pub(crate) fn bare(width: usize, height: usize, library: PigmentLibrary) -> Document {
    let slots: Slots = NAMES.map(|name| Some(library.find(name).unwrap()));
    Document {
        title: "laid by hand".to_owned(),
        cell_mm: CELL_MM,
        ground: Ground {
            name: "even".to_owned(),
            height: Field::filled(width, height, 0),
            reflectance: vec![0.6; library.grid.count()],
            gloss: Gloss { strength: 0.0, exponent: 1.0 },
        },
        library,
        // One mm of white has S d = 50.
        medium: Medium { scattering_per_mm: 50.0, ..Medium::default() },
        dry: Vec::new(),
        next_layer: LayerId::FIRST,
        slots,
        wet: Layer::empty(width, height),
        lighting: Lighting { relief: 0.0, ..Lighting::default() },
    }
}

/// Lays paint on all cells of `columns` and `rows`: heights of pigments in mm.
pub(crate) fn lay(
    layer: &mut Layer,
    (columns, rows): (std::ops::Range<usize>, std::ops::Range<usize>),
    recipe: &[(&str, f64)],
) {
    for y in rows {
        for x in columns.clone() {
            for (name, mm) in recipe {
                let slot = NAMES.iter().position(|known| known == name).unwrap();
                layer.pigments[(x, y)][slot] = quanta_from_mm(*mm, CELL_MM);
            }
        }
    }
}

/// The wet paint as a dry layer below an empty wet one.
pub(crate) fn dried(mut document: Document) -> Document {
    let width = document.wet.width();
    let height = document.wet.height();
    let paint = std::mem::replace(&mut document.wet, Layer::empty(width, height));
    document.dry.push(DryLayer {
        id: LayerId::FIRST,
        name: String::new(),
        visible: true,
        slots: document.slots,
        opacity: 1.0,
        paint,
    });
    document.next_layer = LayerId(2);
    document
}

pub(crate) fn written(document: &Document, folder: &Path) -> PathBuf {
    let path = folder.join("painting.exr");
    std::fs::write(&path, file::write(document).unwrap()).unwrap();
    path
}

/// The oils with a viridian that only absorbs: K = 1 and hardly any S at all wavelengths.
pub(crate) fn with_clear_viridian() -> PigmentLibrary {
    let mut library = library();
    let viridian = library.find("Viridian").unwrap().index();
    let pigment = &mut library.pigments[viridian];
    pigment.absorption.fill(1.0);
    pigment.scattering.fill(1e-6);
    library
}

/// Recipes of the patches of [`patches`]: pigments and shares, of all tones.
pub(crate) const RECIPES: [&[(&str, f64)]; 12] = [
    &[("Lead White", 1.0)],
    &[("Lead White", 0.8), ("Ultramarine", 0.2)],
    &[("Lead White", 0.7), ("Viridian", 0.3)],
    &[("Lead White", 0.5), ("Vermilion", 0.5)],
    &[("Chrome Yellow", 1.0)],
    &[("Chrome Yellow", 0.6), ("Vermilion", 0.4)],
    &[("Chrome Yellow", 0.8), ("Prussian Blue", 0.2)],
    &[("Lead White", 0.5), ("Prussian Blue", 0.5)],
    &[("Vermilion", 1.0)],
    &[("Viridian", 1.0)],
    &[("Ultramarine", 0.7), ("Vermilion", 0.3)],
    &[("Ultramarine", 1.0)],
];

/// A painting of thick patches of 16 x 16 cells, one a recipe, in three rows of four.
pub(crate) fn patches() -> Document {
    let mut document = bare(64, 48, library());
    for (index, recipe) in RECIPES.iter().enumerate() {
        let column = 16 * (index % 4);
        let row = 16 * (index / 4);
        let mm: Vec<(&str, f64)> =
            recipe.iter().map(|(name, share)| (*name, 4.0 * share)).collect();
        lay(&mut document.wet, (column..column + 16, row..row + 16), &mm);
    }
    document
}
