//! Encodes a painting's file. You can also open and save documents by path.

use std::io::Cursor;
use std::path::Path;

use exr::block::writer::ChunksWriter;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::math::Vec2;
use exr::meta::BlockDescription;
use exr::meta::attribute::{
    AttributeValue, ChannelDescription, Compression, IntegerBounds, LineOrder, SampleType, Text,
};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use graphics::field::Field;
use graphics::tile::Rect;
use rayon::prelude::*;

use super::PaintingFileError;
use super::channels::{
    BASE, Channel, Content, INEXACT_FROM, Millimetres, WET, dry_part, inexact_slots, of_ground,
    of_layer,
};
use super::header::{
    ATTRIBUTE, FileHeader, LAYER_ATTRIBUTE, LayerAttribute, TABLE_ATTRIBUTE, table_attribute,
};
use super::read::read;
use crate::amount::MAX_COLUMN;
use crate::document::{Document, Slots};
use crate::layer::{Layer, SLOTS};
use crate::strokes::KeptBrush;

/// Number of blocks that are compressed in parallel.
const BATCH: usize = 64;

/// Encodes a painting as a file. One document always gives the same bytes.
///
/// # Errors
/// [`PaintingFileError::Unwritable`] if the document is inconsistent: layers of another
/// size than the ground, paint in a slot without a pigment, pigments that the library
/// lacks, numbers that are not finite.
pub fn write(document: &Document) -> Result<Vec<u8>, PaintingFileError> {
    encode(document, &[], None)
}

/// Encodes a painting with the palette and the brushes beside it, which [`read`](super::read)
/// leaves out and [`read_table`](super::read_table) reads.
///
/// # Errors
/// [`PaintingFileError::Unwritable`] in the cases of [`write()`], for the palette and the brushes
/// as well.
pub fn write_with_table(
    document: &Document,
    palette: &Document,
    brushes: &[KeptBrush],
) -> Result<Vec<u8>, PaintingFileError> {
    encode(document, &[], Some(encode(palette, brushes, None)?))
}

/// Encodes a painting, the brushes beside it, and `table`, a file within the file.
pub(super) fn encode(
    document: &Document,
    brushes: &[KeptBrush],
    table: Option<Vec<u8>>,
) -> Result<Vec<u8>, PaintingFileError> {
    check(document, brushes)?;
    let header = FileHeader::of(document, brushes)?;
    let parts = parts(document, brushes, &header);
    let json = header.to_json()?;
    let mut table = table.map(table_attribute);
    let headers = parts.iter().map(|part| {
        let attribute = match part.name.as_str() {
            BASE => Some((ATTRIBUTE, AttributeValue::Text(json.as_str().into()))),
            WET => table.take().map(|table| (TABLE_ATTRIBUTE, table)),
            name => layer_attribute(document, name)?,
        };
        Ok::<_, PaintingFileError>(exr_header(part, &header, attribute))
    });
    let headers = headers.collect::<Result<_, _>>()?;
    let scale = Millimetres::new(document.cell_mm);
    let mut bytes = Vec::new();
    exr::block::write(Cursor::new(&mut bytes), headers, true, |meta, writer| {
        let indices: Vec<_> =
            exr::block::enumerate_ordered_header_block_indices(&meta.headers).collect();
        for batch in indices.chunks(BATCH) {
            let chunks: Vec<_> = batch
                .par_iter()
                .map(|&(_, index)| parts[index.layer].block(index, scale))
                .map(|block| block.compress_to_chunk(&meta.headers))
                .collect::<Result<_, _>>()?;
            for (&(index, _), chunk) in batch.iter().zip(chunks) {
                writer.write_chunk(index, chunk)?;
            }
        }
        Ok(())
    })
    .map_err(|error| PaintingFileError::Unwritable(error.to_string()))?;
    Ok(bytes)
}

/// Attribute of the part `name`, if it is the part of a dry layer.
fn layer_attribute<'a>(
    document: &Document,
    name: &str,
) -> Result<Option<(&'a str, AttributeValue)>, PaintingFileError> {
    let mut dry = document.dry.iter().enumerate();
    let Some((_, layer)) = dry.find(|(index, _)| dry_part(*index) == name) else { return Ok(None) };
    let text = LayerAttribute::of(layer, document.next_layer).to_json()?;
    Ok(Some((LAYER_ATTRIBUTE, AttributeValue::Text(text.as_str().into()))))
}

fn exr_header(
    part: &Part<'_>,
    header: &FileHeader,
    attribute: Option<(&str, AttributeValue)>,
) -> Header {
    let channels = part.channels.iter();
    let channels = channels
        .map(|channel| ChannelDescription::new(channel.name.as_str(), SampleType::F32, true));
    let window = part.window;
    let mut own = LayerAttributes::named(part.name.as_str());
    own.layer_position = Vec2(window.x as i32, window.y as i32);
    own.horizontal_density = Some((25.4 / header.cell_mm) as f32);
    // Add at most one custom attribute. The encoder does not keep the order of several, so the
    // bytes of the file would vary.
    own.other.extend(attribute.map(|(name, value)| (Text::from(name), value)));
    let canvas = IntegerBounds::new((0, 0), (header.width, header.height));
    Header::new(Text::from(part.name.as_str()), (window.width, window.height), channels.collect())
        .with_attributes(own)
        .with_shared_attributes(ImageAttributes::new(canvas))
        .with_encoding(Compression::PIZ, BlockDescription::ScanLines, LineOrder::Increasing)
}

fn check(document: &Document, brushes: &[KeptBrush]) -> Result<(), PaintingFileError> {
    let bounds = document.ground.height.bounds();
    if bounds.width.max(bounds.height) > i32::MAX as usize / 4 {
        return Err(PaintingFileError::unwritable(format!(
            "a side has `{}` cells",
            bounds.width.max(bounds.height)
        )));
    }
    let dry = document.dry.iter().enumerate();
    let dry = dry.map(|(i, layer)| (dry_part(i), &layer.slots, &layer.paint));
    let wet = (WET.to_owned(), &document.slots, &document.wet);
    for (name, slots, paint) in std::iter::once(wet).chain(dry) {
        let mut sizes =
            paint.single_films().flat_map(|film| [film.pigments.bounds(), film.vehicle.bounds()]);
        if let Some(size) = sizes.find(|size| *size != bounds) {
            let width = size.width;
            let height = size.height;
            let canvas = format!("{} x {}", bounds.width, bounds.height);
            return Err(PaintingFileError::unwritable(format!(
                "layer `{name}` has `{width} x {height}` cells, the canvas {canvas}"
            )));
        }
        check_paint(slots, paint)
            .map_err(|what| PaintingFileError::unwritable(format!("layer `{name}` {what}")))?;
    }
    for brush in brushes {
        let Some(paint) = &brush.paint else { continue };
        if paint.pigments.bounds() != paint.vehicle.bounds() || paint.vehicle.values().is_empty() {
            return Err(PaintingFileError::unwritable(format!(
                "brush `{}` has no cells",
                brush.name
            )));
        }
        check_paint(&document.slots, paint).map_err(|what| {
            PaintingFileError::unwritable(format!("brush `{}` {what}", brush.name))
        })?;
    }
    Ok(())
}

fn check_paint(slots: &Slots, paint: &Layer) -> Result<(), String> {
    for index in 0..paint.vehicle.values().len() {
        let cell = paint.cell(index);
        let x = index % paint.width();
        let y = index / paint.width();
        let amounts = cell.pigments.iter().chain([&cell.vehicle]).map(|&q| u64::from(q));
        let volume: u64 = amounts.sum();
        if volume > u64::from(MAX_COLUMN) {
            return Err(format!("holds more than a cell can at x {x}, y {y}: `{volume}` quanta"));
        }
        let stray = (0..SLOTS).find(|&s| slots[s].is_none() && cell.pigments[s] > 0);
        if let Some(slot) = stray {
            return Err(format!("has paint of no pigment at x {x}, y {y}, slot `{slot}`"));
        }
    }
    Ok(())
}

/// A part to be written.
#[derive(Debug)]
pub(super) struct Part<'a> {
    pub(super) name: String,
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
    let layers = std::iter::once(&document.wet).chain(document.dry.iter().map(|dry| &dry.paint));
    let skins = layers.clone().filter_map(Layer::painted_skin);
    let paints = layers.chain(brushes.iter().filter_map(|brush| brush.paint.as_ref()));
    let paints = paints.chain(skins);
    let layers = header.paints().into_iter().zip(paints).map(|(layer, paint)| Part {
        name: layer.part.to_owned(),
        window: covered(paint),
        channels: of_layer(layer.pigments, inexact_slots(paint)),
        source: Source::Paint(paint),
    });
    std::iter::once(base).chain(layers).collect()
}

/// Smallest rectangle that contains all paint of the body. If there is none, this is one cell, since a data
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
    type Bounds = (usize, usize, usize, usize);
    match rows.map(|(y, first, last)| (y, y, first, last)).reduce_with(|a: Bounds, b: Bounds| {
        (a.0.min(b.0), a.1.max(b.1), a.2.min(b.2), a.3.max(b.3))
    }) {
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
        (x..x + width).map(move |x| {
            let quanta = match (self.source, content) {
                (Source::Ground(height), _) => f64::from(height[(x, y)]),
                (Source::Paint(paint), Content::Amount(slot) | Content::AmountResidue(slot)) => {
                    f64::from(match paint.pigments[(x, y)].get(slot) {
                        Some(&amount) => amount,
                        None => paint.vehicle[(x, y)],
                    })
                }
                (Source::Paint(paint), _) => {
                    let [body, _] = paint.films(y * paint.width() + x);
                    f64::from(body.volume())
                }
            };
            if residue { scale.residue(quanta) } else { scale.mm(quanta) }
        })
    }
}

impl Document {
    /// Reads a painting from its file (OpenEXR, see [`crate::file`]).
    ///
    /// # Errors
    /// [`PaintingFileError`] if the file cannot be read or is not a valid painting.
    pub fn open(path: &Path) -> Result<Self, PaintingFileError> {
        read(&path.display().to_string(), &documents::file::read(path)?)
    }

    /// Writes the painting to a file (OpenEXR, see [`crate::file`]). This replaces the file as a
    /// whole or not at all.
    ///
    /// # Errors
    /// [`PaintingFileError`] if the document is inconsistent or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), PaintingFileError> {
        Ok(documents::file::write_whole(path, &write(self)?)?)
    }
}
