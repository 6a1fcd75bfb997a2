//! Picture of a painting at rest, computed on all CPU cores.

use rayon::prelude::*;

use crate::composite::composite_row;
use crate::document::Document;
use crate::layer::Layer;
use crate::optics::{NODES, Scene};
use crate::shade::{TopMaterial, Tops, shade_row};
use graphics::field::Field;

/// Picture of a document in linear sRGB, white at 1; the fourth value is 1. It equals the
/// picture of a paint engine. Takes 20 bytes per cell beside the document.
///
/// `scene` must have been made for `document`.
#[must_use]
pub fn picture(document: &Document, scene: &Scene) -> Field<[f32; 4]> {
    picture_of_lowest(document, scene, ALL)
}

/// Picture of a document like [`picture`] with its lowest `layers` only, dry ones first: as it
/// would look without the others. 0 is the ground.
#[must_use]
pub fn picture_of_lowest(document: &Document, scene: &Scene, layers: usize) -> Field<[f32; 4]> {
    let width = document.wet.width();
    let tops = tops(document, layers);
    let mut picture = Field::filled(width, document.wet.height(), [0.0; 4]);
    if width == 0 {
        return picture;
    }
    picture.values_mut().par_chunks_mut(width).enumerate().for_each_init(
        || (vec![scene.ground; width], vec![TopMaterial::Ground; width]),
        |(internal, materials), (y, out)| {
            lay_row((document, layers), scene, y, internal, materials);
            shade_row(scene, (&tops, (0, y)), internal, materials, out);
        },
    );
    picture
}

/// Number of layers that stands for all of them.
pub(super) const ALL: usize = usize::MAX;

/// Computes the internal reflectance and the topmost material of every cell of row `y` of the
/// lowest `layers`.
pub(super) fn lay_row(
    (document, layers): (&Document, usize),
    scene: &Scene,
    y: usize,
    internal: &mut [[f32; NODES]],
    materials: &mut [TopMaterial],
) {
    internal.fill(scene.ground);
    materials.fill(TopMaterial::Ground);
    let dry = document.dry.iter().map(|layer| &layer.paint).zip(&scene.dry);
    let wet = std::iter::once((&document.wet, &scene.wet));
    let dry = dry.map(|layer| (TopMaterial::Dry, layer));
    let wet = wet.map(|layer| (TopMaterial::Wet, layer));
    for (material, (layer, optics)) in dry.chain(wet).take(layers) {
        composite_row(optics, layer.pigments.row(y, 0, layer.width()), internal);
        mark(layer, y, material, materials);
    }
}

/// Sets `materials` to `material` in each cell of row `y` where `layer` has paint.
fn mark(layer: &Layer, y: usize, material: TopMaterial, materials: &mut [TopMaterial]) {
    let first = y * layer.width();
    for (i, top) in materials.iter_mut().enumerate() {
        if layer.cell(first + i).volume() > 0 {
            *top = material;
        }
    }
}

/// Height of the surface of the lowest `layers` at every cell.
pub(super) fn tops(document: &Document, layers: usize) -> Tops {
    let ground = &document.ground.height;
    let all = document.dry.iter().map(|layer| &layer.paint).chain([&document.wet]);
    let layers: Vec<_> = all.take(layers).collect();
    let mut tops = Tops::level(ground.width(), ground.height());
    tops.set_all(|x, y| {
        let index = y * ground.width() + x;
        let volumes = layers.iter().map(|layer| layer.cell(index).volume());
        volumes.fold(ground.values()[index], i32::saturating_add_unsigned)
    });
    tops
}
