//! The picture of a painting at rest, computed here and now on all cores.

use rayon::prelude::*;

use crate::composite::lay_over;
use crate::document::Document;
use crate::layer::Layer;
use crate::optics::Scene;
use crate::shade::{Relief, shade_row};
use graphics::field::Field;

/// Linear sRGB of every cell, white at 1, and 1; what a backend shows of the
/// same painting. 20 bytes a cell besides the painting.
///
/// `scene` must be that of `document`.
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
        || (vec![scene.ground; width], vec![0; width], [(); 3].map(|()| vec![0; width + 2])),
        |(internal, bare, heights), (y, out)| {
            internal.fill(scene.ground);
            bare.fill(2);
            let dry = document.dry.iter().map(|layer| &layer.paint).zip(&scene.dry);
            let wet = std::iter::once((&document.wet, &scene.wet));
            for (kind, (layer, coat)) in dry.map(|d| (1, d)).chain(wet.map(|w| (0, w))) {
                lay_over(coat, layer.pigments.row(y, 0, width), internal);
                mark(layer, y, kind, bare);
            }
            for (row, y) in heights.iter_mut().zip([y.saturating_sub(1), y, (y + 1).min(last)]) {
                let tops = tops.row(y, 0, width);
                row[1..=width].copy_from_slice(tops);
                (row[0], row[width + 1]) = (tops[0], tops[width - 1]);
            }
            let [above, here, below] = &*heights;
            shade_row(scene, &Relief { above, here, below }, internal, bare, out);
        },
    );
    picture
}

/// Puts `kind` where `layer` has anything in row `y`.
fn mark(layer: &Layer, y: usize, kind: u8, bare: &mut [u8]) {
    let first = y * layer.width();
    for (i, bare) in bare.iter_mut().enumerate() {
        if layer.cell(first + i).volume() > 0 {
            *bare = kind;
        }
    }
}

/// The height of the surface over every cell, in quanta.
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
