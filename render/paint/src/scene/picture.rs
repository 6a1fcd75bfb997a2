//! Picture of a painting at rest, computed on all CPU cores.

use rayon::prelude::*;

use crate::composite::composite_row;
use crate::document::Document;
use crate::layer::Layer;
use crate::optics::Scene;
use crate::shade::{RowHeights, TopMaterial, shade_row};
use graphics::field::Field;

/// Picture of a document in linear sRGB, white at 1; the fourth value is 1. It equals the
/// picture of a paint engine. Takes 20 bytes per cell beside the document.
///
/// `scene` must have been made for `document`.
#[must_use]
pub fn picture(document: &Document, scene: &Scene) -> Field<[f32; 4]> {
    let width = document.wet.width();
    let tops = tops(document);
    let mut picture = Field::filled(width, document.wet.height(), [0.0; 4]);
    if width == 0 {
        return picture;
    }
    let last = picture.height().saturating_sub(1);
    picture.values_mut().par_chunks_mut(width).enumerate().for_each_init(
        || {
            let heights = [(); 3].map(|()| vec![0; width + 2]);
            (vec![scene.ground; width], vec![TopMaterial::Ground; width], heights)
        },
        |(internal, materials, heights), (y, out)| {
            internal.fill(scene.ground);
            materials.fill(TopMaterial::Ground);
            let dry = document.dry.iter().map(|layer| &layer.paint).zip(&scene.dry);
            let wet = std::iter::once((&document.wet, &scene.wet));
            let dry = dry.map(|layer| (TopMaterial::Dry, layer));
            let wet = wet.map(|layer| (TopMaterial::Wet, layer));
            for (material, (layer, optics)) in dry.chain(wet) {
                composite_row(optics, layer.pigments.row(y, 0, width), internal);
                mark(layer, y, material, materials);
            }
            for (row, y) in heights.iter_mut().zip([y.saturating_sub(1), y, (y + 1).min(last)]) {
                let tops = tops.row(y, 0, width);
                row[1..=width].copy_from_slice(tops);
                (row[0], row[width + 1]) = (tops[0], tops[width - 1]);
            }
            let [above, here, below] = &*heights;
            shade_row(scene, &RowHeights { above, here, below }, internal, materials, out);
        },
    );
    picture
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

/// Height of the surface at every cell, in quanta.
fn tops(document: &Document) -> Field<i32> {
    let mut tops = document.ground.height.clone();
    let layers = document.dry.iter().map(|layer| &layer.paint).chain([&document.wet]);
    for layer in layers {
        tops.values_mut().par_iter_mut().enumerate().for_each(|(index, top)| {
            *top = top.saturating_add_unsigned(layer.cell(index).volume());
        });
    }
    tops
}
