//! Parts of the file: their window on the canvas, and their rows as bytes.

use exr::block::{BlockIndex, UncompressedBlock};
use rayon::prelude::*;

use super::channels::{Channel, Content, inexact_slots, of_ground, of_layer};
use super::header::FileHeader;
use super::millimetres::{INEXACT_FROM, Millimetres};
use super::names::BASE;
use crate::document::Document;
use crate::layer::{Layer, SLOTS};
use crate::strokes::KeptBrush;
use graphics::field::Field;
use graphics::tile::Rect;

/// A part to be written.
#[derive(Debug)]
pub(super) struct Part<'a> {
    pub(super) name: String,
    /// Cells of the canvas that the part covers.
    pub(super) window: Rect,
    pub(super) channels: Vec<Channel>,
    source: Source<'a>,
}

#[derive(Debug, Clone, Copy)]
enum Source<'a> {
    Ground(&'a Field<i32>),
    Paint(&'a Layer),
}

/// All parts of `document` and of the `brushes` beside it, in the order of the file.
pub(super) fn parts<'a>(
    document: &'a Document,
    brushes: &'a [KeptBrush],
    header: &FileHeader,
) -> Vec<Part<'a>> {
    let ground = &document.ground.height;
    let inexact = ground.values().iter().any(|height| height.unsigned_abs() >= INEXACT_FROM);
    let base = Part {
        name: BASE.to_owned(),
        window: ground.bounds(),
        channels: of_ground(inexact),
        source: Source::Ground(ground),
    };
    let paints =
        std::iter::once(&document.wet).chain(document.dry.iter().map(|layer| &layer.paint));
    let paints = paints.chain(brushes.iter().filter_map(|brush| brush.paint.as_ref()));
    let layers = header.paints().into_iter().zip(paints).map(|(layer, paint)| Part {
        name: layer.part.to_owned(),
        window: covered(paint),
        channels: of_layer(layer.pigments, inexact_slots(paint)),
        source: Source::Paint(paint),
    });
    std::iter::once(base).chain(layers).collect()
}

/// Smallest rectangle that contains all paint; one cell if there is none, since a data
/// window cannot be empty.
fn covered(paint: &Layer) -> Rect {
    let width = paint.width();
    let height = paint.height();
    let painted = |index: usize| {
        paint.vehicle.values()[index] > 0 || paint.pigments.values()[index] != [0; SLOTS]
    };
    let rows = (0..height).into_par_iter().filter_map(|y| {
        let first = (0..width).find(|x| painted(y * width + x))?;
        let last = (0..width).rfind(|x| painted(y * width + x))?;
        Some((y, first, last))
    });
    let union = |a: Bounds, b: Bounds| (a.0.min(b.0), a.1.max(b.1), a.2.min(b.2), a.3.max(b.3));
    type Bounds = (usize, usize, usize, usize);
    match rows.map(|(y, first, last)| (y, y, first, last)).reduce_with(union) {
        Some((top, bottom, left, right)) => {
            Rect { x: left, y: top, width: right - left + 1, height: bottom - top + 1 }
        }
        None => Rect { x: 0, y: 0, width: 1, height: 1 },
    }
}

impl Part<'_> {
    /// Samples of the rows in block `index`, channel by channel within each row.
    pub(super) fn block(&self, index: BlockIndex, scale: Millimetres) -> UncompressedBlock {
        let rows = index.pixel_size.height();
        let width = index.pixel_size.width();
        let mut data = Vec::with_capacity(rows * width * self.channels.len() * size_of::<f32>());
        for row in 0..rows {
            let y = self.window.y + index.pixel_position.y() + row;
            for channel in &self.channels {
                let values = self.values(channel.content, y, scale);
                data.extend(values.flat_map(f32::to_ne_bytes));
            }
        }
        UncompressedBlock { index, data }
    }

    /// One row of a channel, in mm.
    fn values(
        &self,
        content: Content,
        y: usize,
        scale: Millimetres,
    ) -> impl Iterator<Item = f32> + '_ {
        let Rect { x, width, .. } = self.window;
        let residue = matches!(content, Content::HeightResidue | Content::AmountResidue(_));
        let quanta = move |i: usize| match (self.source, content) {
            (Source::Ground(height), _) => f64::from(height[(x + i, y)]),
            (Source::Paint(paint), Content::Amount(slot) | Content::AmountResidue(slot)) => {
                f64::from(match paint.pigments[(x + i, y)].get(slot) {
                    Some(&amount) => amount,
                    None => paint.vehicle[(x + i, y)],
                })
            }
            (Source::Paint(paint), _) => f64::from(paint.cell(y * paint.width() + x + i).volume()),
        };
        (0..width).map(move |i| match residue {
            true => scale.residue(quanta(i)),
            false => scale.mm(quanta(i)),
        })
    }
}
