//! Decodes a painting's file. We check its parts and channels against its header before we allocate
//! memory.

use std::io::Cursor;

use documents::file::{check_expansion, has_memory};
use documents::foreign_message;
use exr::block::UncompressedBlock;
use exr::block::chunk::Chunk;
use exr::meta::attribute::{AttributeValue, Compression, SampleType, Text};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use graphics::field::Field;
use graphics::tile::Rect;
use rayon::prelude::*;

use super::PaintingFileError;
use super::channels::{BASE, Channel, Content, Millimetres, of_ground, of_layer};
use super::header::{ATTRIBUTE, BrushHeader, FileHeader, LayerAttribute, PaintHeader, table_bytes};
use crate::amount::MAX_COLUMN;
use crate::document::{Document, DryLayer, LayerId};
use crate::ground::Ground;
use crate::layer::{Cell, Layer, SLOTS, distinct_ids};
use crate::strokes::{KeptBrush, SideTable};

/// Memory that [`read`] allows a painting, in bytes: 16 GiB. This is enough for 4096 x 4096 cells
/// with 28 layers, for example (a layer takes 36 bytes per cell, the ground 4).
pub const MEMORY_LIMIT: u64 = 16 << 30;

/// We read this number of blocks as a batch and then decompress them in parallel.
const BATCH: usize = 64;

/// Decodes a painting from `bytes`, the content of `file`. We use the name in errors only.
///
/// # Errors
/// [`PaintingFileError`] if the content is not OpenEXR, not a painting, of a newer
/// version, truncated, inconsistent, or needs more than [`MEMORY_LIMIT`].
pub fn read(file: &str, bytes: &[u8]) -> Result<Document, PaintingFileError> {
    read_within(file, bytes, MEMORY_LIMIT)
}

/// Decodes a painting like [`read`], within `limit` bytes of memory.
///
/// # Errors
/// [`PaintingFileError`] in the cases of [`read`].
pub fn read_within(file: &str, bytes: &[u8], limit: u64) -> Result<Document, PaintingFileError> {
    Ok(decode(file, bytes, limit)?.0)
}

/// Decodes the palette and the brushes beside a painting, if `bytes`, the content of `file`, hold
/// them. This does not decode the paint of the painting itself.
///
/// # Errors
/// [`PaintingFileError`] in the cases of [`read`], for the palette and the brushes.
pub fn read_table(file: &str, bytes: &[u8]) -> Result<Option<SideTable>, PaintingFileError> {
    let reader =
        exr::block::read(Cursor::new(bytes), false).map_err(|error: exr::error::Error| {
            PaintingFileError::Container { file: file.to_owned(), reason: foreign_message(&error) }
        })?;
    let Some(table) = table_bytes(reader.headers()) else { return Ok(None) };
    let (palette, brushes) = decode(&format!("{file}: palette"), table, MEMORY_LIMIT)?;
    Ok(Some(SideTable { palette, brushes }))
}

/// Decodes a painting, and the brushes in the same file.
fn decode(
    file: &str,
    bytes: &[u8],
    limit: u64,
) -> Result<(Document, Vec<KeptBrush>), PaintingFileError> {
    let damaged = |error: exr::error::Error| PaintingFileError::Container {
        file: file.to_owned(),
        reason: foreign_message(&error),
    };
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(damaged)?;
    let (header, library) = FileHeader::from_json(file, &json(file, reader.headers())?)?;
    let parts = layout(file, reader.headers(), &header, bytes.len(), limit)?;

    let width = header.width;
    let height = header.height;
    let mut ground = Field::filled(width, height, 0);
    let sizes = header.paints().into_iter().map(|paint| paint.size);
    let mut paints: Vec<_> = sizes.map(|(width, height)| Layer::empty(width, height)).collect();
    let mut filled: Vec<_> = parts.iter().map(|part| vec![false; part.window.height]).collect();

    let scale = Millimetres::new(header.cell_mm);
    let meta = reader.meta_data().clone();
    let reader_parts = &meta.headers;
    let mut chunks = reader.all_chunks(false).map_err(damaged)?;
    loop {
        let batch: Vec<Chunk> =
            chunks.by_ref().take(BATCH).collect::<Result<_, _>>().map_err(damaged)?;
        if batch.is_empty() {
            break;
        }
        let rows: Vec<_> =
            batch.into_par_iter().map(|chunk| rows(file, chunk, &meta, &parts, scale)).collect();
        for rows in rows {
            let Rows { part, y, values } = rows?;
            let PartLayout { window, layer, name, .. } = &parts[part];
            for (row, cells) in values.chunks(window.width).enumerate() {
                let row = y + row;
                if std::mem::replace(&mut filled[part][row], true) {
                    let reason = format!("has row `{}` twice", window.y + row);
                    let file = file.to_owned();
                    let part = name.clone();
                    return Err(PaintingFileError::Part { file, part, reason });
                }
                let width = layer.map_or(width, |layer| paints[layer].width());
                let first = (window.y + row) * width + window.x;
                match layer {
                    None => {
                        let row = &mut ground.values_mut()[first..][..window.width];
                        for (height, cell) in row.iter_mut().zip(cells) {
                            *height = cell.vehicle as i32;
                        }
                    }
                    Some(layer) => {
                        for (index, &cell) in (first..).zip(cells) {
                            paints[*layer].set_cell(index, cell);
                        }
                    }
                }
            }
        }
    }
    for (part, rows) in parts.iter().zip(&filled) {
        if let Some(row) = rows.iter().position(|filled| !filled) {
            let reason = format!("lacks row `{}`", part.window.y + row);
            let file = file.to_owned();
            let part = part.name.clone();
            return Err(PaintingFileError::Part { file, part, reason });
        }
    }
    let found = reader_parts.iter().map(part_name).collect::<Vec<_>>();
    let names = header.layers.iter().skip(1).enumerate().map(|(index, layer)| {
        // The check of the layout found each part once.
        let place = found.iter().position(|name| *name == layer.part).unwrap_or(0);
        LayerAttribute::from_part(file, &reader_parts[place], &layer.part, index)
    });
    let names = names.collect::<Result<Vec<_>, _>>()?;
    let mut loads = paints.split_off(header.layers.len());
    let skins =
        loads.split_off(header.brushes.iter().filter(|brush| brush.paint.is_some()).count());
    let skinned = header.layers.iter().zip(&mut paints).filter(|(layer, _)| layer.skin.is_some());
    for ((_, paint), skin) in skinned.zip(skins) {
        add_skin(file, paint, skin)?;
    }
    let brushes = brushes(&header.brushes, loads);
    Ok((document(file, header, library, ground, (names, paints))?, brushes))
}

/// Puts a skin on a layer.
fn add_skin(file: &str, paint: &mut Layer, skin: Layer) -> Result<(), PaintingFileError> {
    for index in 0..skin.vehicle.values().len() {
        let both = u64::from(paint.cell(index).volume()) + u64::from(skin.cell(index).volume());
        if both > u64::from(MAX_COLUMN) {
            let [x, y] = [index % skin.width(), index / skin.width()];
            let reason = format!("and its skin hold `{both}` quanta at x {x}, y {y}, too many");
            return Err(PaintingFileError::container(file, format!("a layer {reason}")));
        }
    }
    paint.skin = Some(Box::new(skin));
    Ok(())
}

fn brushes(headers: &[BrushHeader], loads: Vec<Layer>) -> Vec<KeptBrush> {
    let mut loads = loads.into_iter();
    headers
        .iter()
        .map(|header: &BrushHeader| KeptBrush {
            name: header.name.clone(),
            spec: header.spec.clone(),
            at: header.at,
            paint: header.paint.as_ref().and_then(|_| loads.next()),
        })
        .collect()
}

fn part_name(part: &Header) -> String {
    let name = part.own_attributes.layer_name.as_ref();
    name.map_or_else(String::new, |name| name.chars().collect())
}

/// Text of attribute `impasto` of part `base`.
fn json(file: &str, parts: &[Header]) -> Result<String, PaintingFileError> {
    let format = |reason: &str| PaintingFileError::Format {
        file: file.to_owned(),
        reason: reason.to_owned(),
    };
    let key = Text::from(ATTRIBUTE);
    let base = parts.iter().find(|part: &&Header| {
        part.own_attributes.layer_name.as_ref().is_some_and(|name| name.eq(BASE))
    });
    let base = base.ok_or_else(|| format("part `base` is missing"))?;
    match base.own_attributes.other.get(&key) {
        Some(AttributeValue::Text(text)) => Ok(text.chars().collect()),
        Some(_) => Err(format("attribute `impasto` of part `base` is not text")),
        None => Err(format("attribute `impasto` of part `base` is missing")),
    }
}

/// Consecutive rows of a part. In rows of the ground, we store the bits of the height, an i32, as
/// the vehicle of a cell.
struct Rows {
    part: usize,
    /// First row, counted from the top of the part's window.
    y: usize,
    values: Vec<Cell>,
}

fn rows(
    file: &str,
    chunk: Chunk,
    meta: &MetaData,
    parts: &[PartLayout],
    scale: Millimetres,
) -> Result<Rows, PaintingFileError> {
    let block = UncompressedBlock::decompress_chunk(chunk, meta, false);
    let UncompressedBlock { index, data } =
        block.map_err(|error| PaintingFileError::container(file, error.to_string()))?;
    let part = index.layer;
    let y = index.pixel_position.y();
    let layout = &parts[part];
    let width = layout.window.width;
    let height = index.pixel_size.height();
    let line = width * size_of::<f32>();
    let wanted = line * layout.channels * height;
    if index.pixel_size.width() != width || data.len() != wanted {
        let part = &layout.name;
        let found = data.len();
        return Err(PaintingFileError::container(
            file,
            format!("block of part `{part}` with `{found}` bytes for {wanted}"),
        ));
    }
    let mut values = vec![Cell::default(); width * height];
    let lines: Vec<&[u8]> = data.chunks(line).collect();
    for ((row, cells), lines) in
        (0..).zip(values.chunks_mut(width)).zip(lines.chunks(layout.channels))
    {
        let row = PartRow { file, part: layout, y: layout.window.y + y + row };
        for plane in &layout.planes {
            row.read(plane, lines, cells, scale)?;
        }
        if layout.layer.is_some() {
            row.check_volumes(cells)?;
        }
    }
    Ok(Rows { part, y, values })
}

/// One row of a part, for decoding and error messages.
struct PartRow<'a> {
    file: &'a str,
    part: &'a PartLayout,
    y: usize,
}

impl PartRow<'_> {
    fn read(
        &self,
        plane: &Plane,
        lines: &[&[u8]],
        cells: &mut [Cell],
        scale: Millimetres,
    ) -> Result<(), PaintingFileError> {
        let residue = plane.residue.map(|residue| lines[residue]);
        let (values, _) = lines[plane.channel].as_chunks::<4>();
        for (x, (cell, &bytes)) in cells.iter_mut().zip(values).enumerate() {
            let mm = f32::from_ne_bytes(bytes);
            let residue =
                residue.map_or(0.0, |residue| f32::from_ne_bytes(residue.as_chunks().0[x]));
            let quanta = scale.quanta(mm, residue);
            let found = || match residue {
                0.0 => mm.to_string(),
                _ => format!("{mm} and {residue}"),
            };
            if self.part.layer.is_none() {
                if quanta.is_nan() || quanta.abs() > f64::from(i32::MAX) {
                    return Err(self.value(
                        x,
                        &plane.name,
                        "a height is up to 1023 cells",
                        found(),
                    ));
                }
                cell.vehicle = (quanta as i32) as u32;
                continue;
            }
            if quanta.is_nan() || mm < 0.0 || quanta < 0.0 || quanta > f64::from(MAX_COLUMN) {
                let wanted = "an amount is 0 to 512 cell widths";
                return Err(self.value(x, &plane.name, wanted, found()));
            }
            match cell.pigments.get_mut(plane.slot) {
                Some(amount) => *amount = quanta as u32,
                None => cell.vehicle = quanta as u32,
            }
        }
        Ok(())
    }

    /// Checks that no cell holds more than 512 cell widths of paint in total.
    fn check_volumes(&self, cells: &[Cell]) -> Result<(), PaintingFileError> {
        for (x, cell) in cells.iter().enumerate() {
            let volume: u64 =
                cell.pigments.iter().chain([&cell.vehicle]).map(|&q| u64::from(q)).sum();
            if volume > u64::from(MAX_COLUMN) {
                let found = format!("{volume} quanta");
                return Err(self.value(x, "thickness", "a cell holds 512 cell widths", found));
            }
        }
        Ok(())
    }

    fn value(
        &self,
        x: usize,
        channel: &str,
        wanted: &'static str,
        found: String,
    ) -> PaintingFileError {
        PaintingFileError::Value {
            file: self.file.to_owned(),
            part: self.part.name.clone(),
            channel: channel.to_owned(),
            x: (self.part.window.x + x) as u32,
            y: self.y as u32,
            wanted,
            found,
        }
    }
}

fn document(
    file: &str,
    header: FileHeader,
    library: pigment::library::PigmentLibrary,
    height: Field<i32>,
    (names, mut paints): (Vec<LayerAttribute>, Vec<Layer>),
) -> Result<Document, PaintingFileError> {
    // The check of the header guarantees that the wet layer comes first.
    let slots = header.layers[0]
        .slots(&library)
        .map_err(|reason| PaintingFileError::header(file, reason))?;
    let wet = paints.remove(0);
    let next = names.iter().map(|name| name.next).max().unwrap_or(LayerId::FIRST);
    let layers = header.layers.iter().skip(1).zip(names.into_iter().zip(paints));
    let layers = layers.map(|(layer, (about, paint))| {
        let slots =
            layer.slots(&library).map_err(|reason| PaintingFileError::header(file, reason))?;
        let LayerAttribute { id, name, visible, .. } = about;
        Ok(DryLayer { id, name, visible, slots, opacity: layer.opacity, paint })
    });
    let mut layers = layers.collect::<Result<Vec<_>, PaintingFileError>>()?;
    let next_layer = distinct_ids(layers.iter_mut().map(|layer| &mut layer.id), next);
    Ok(Document {
        title: header.title,
        cell_mm: header.cell_mm,
        ground: Ground {
            name: header.ground.name,
            height,
            reflectance: header.ground.reflectance,
            gloss: header.ground.gloss,
        },
        library,
        medium: header.medium,
        dry: layers,
        next_layer,
        slots,
        wet,
        lighting: header.lighting,
    })
}

/// A part of the file that passed the checks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PartLayout {
    pub(super) name: String,
    /// Index among `FileHeader::paints` of the paint that the part holds. `None` for the ground.
    pub(super) layer: Option<usize>,
    pub(super) window: Rect,
    pub(super) channels: usize,
    pub(super) planes: Vec<Plane>,
}

/// Channels that hold one amount, or the ground's height.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Plane {
    pub(super) name: String,
    /// Slot of the amount. [`SLOTS`] stands for the vehicle, and for the ground's height.
    pub(super) slot: usize,
    pub(super) channel: usize,
    pub(super) residue: Option<usize>,
}

/// Builder of errors about one part.
struct Fault<'a> {
    file: &'a str,
    part: &'a str,
}

impl Fault<'_> {
    fn part(&self, reason: String) -> PaintingFileError {
        let file = self.file.to_owned();
        let part = self.part.to_owned();
        PaintingFileError::Part { file, part, reason }
    }

    fn channel(&self, channel: String, reason: &str) -> PaintingFileError {
        let file = self.file.to_owned();
        let part = self.part.to_owned();
        let reason = reason.to_owned();
        PaintingFileError::Channel { file, part, channel, reason }
    }
}

/// Checks the parts against `header` and returns them in the file's order. We have not allocated
/// anything before this.
pub(super) fn layout(
    file: &str,
    parts: &[Header],
    header: &FileHeader,
    file_bytes: usize,
    limit: u64,
) -> Result<Vec<PartLayout>, PaintingFileError> {
    let paints = header.paints();
    let sizes = paints.iter().map(|paint| cell_count(paint.size).saturating_mul(36));
    let ground = cell_count((header.width, header.height)).saturating_mul(4);
    let bytes = sizes.fold(ground, u64::saturating_add);
    if bytes > limit {
        return Err(PaintingFileError::TooLarge { file: file.to_owned(), bytes, limit });
    }
    let found = parts
        .iter()
        .map(|part| check_part(file, part, header, &paints))
        .collect::<Result<Vec<_>, _>>()?;
    let wanted = paints.iter().map(|paint| paint.part);
    for part in wanted.chain([BASE]) {
        let fault = Fault { file, part };
        match found.iter().filter(|found| found.name == part).count() {
            1 => {}
            0 => return Err(fault.part("is missing".to_owned())),
            _ => return Err(fault.part("occurs twice".to_owned())),
        }
    }
    let stored = found.iter().map(|part| {
        let cells = part.window.width as u64 * part.window.height as u64;
        cells.saturating_mul(4 * part.channels as u64)
    });
    let stored = stored.fold(0, u64::saturating_add);
    check_expansion(stored, file_bytes as u64).map_err(|error| PaintingFileError::Container {
        file: file.to_owned(),
        reason: error.to_string(),
    })?;
    if !has_memory(bytes) {
        return Err(PaintingFileError::Memory { file: file.to_owned(), mb: bytes >> 20 });
    }
    Ok(found)
}

fn cell_count((width, height): (usize, usize)) -> u64 {
    (width as u64).saturating_mul(height as u64)
}

fn check_part(
    file: &str,
    part: &Header,
    header: &FileHeader,
    paints: &[PaintHeader<'_>],
) -> Result<PartLayout, PaintingFileError> {
    let name = part.own_attributes.layer_name.as_ref();
    let name = name.map_or_else(String::new, |name| name.chars().collect());
    let fault = Fault { file, part: &name };
    let layer = paints.iter().position(|paint| paint.part == name);
    if layer.is_none() && name != BASE {
        return Err(fault.part("is none that attribute `impasto` names".to_owned()));
    }
    if part.blocks != BlockDescription::ScanLines || part.deep {
        return Err(fault.part("has tiles or is deep; expected scan lines".to_owned()));
    }
    use Compression::{PIZ, Uncompressed, ZIP1, ZIP16};
    if ![Uncompressed, ZIP1, ZIP16, PIZ].contains(&part.compression) {
        let found = part.compression;
        return Err(fault.part(format!("must be stored plain, by ZIP or by PIZ, found `{found}`")));
    }
    let room = layer.map(|layer| paints[layer].size);
    let window = window(&fault, part, header, room)?;
    let wanted = match layer {
        None => of_ground(true),
        Some(layer) => of_layer(paints[layer].pigments, [true; SLOTS + 1]),
    };
    let planes = planes(&fault, part, &wanted)?;
    let channels = part.channels.list.len();
    Ok(PartLayout { name, layer, window, channels, planes })
}

/// Cells that a part covers. They must lie within `room` (columns and rows). The ground does not
/// have a `room` and must cover the whole canvas.
fn window(
    fault: &Fault<'_>,
    part: &Header,
    header: &FileHeader,
    room: Option<(usize, usize)>,
) -> Result<Rect, PaintingFileError> {
    let canvas = part.shared_attributes.display_window;
    let width = header.width;
    let height = header.height;
    let sizes = (canvas.size.width(), canvas.size.height());
    if (canvas.position.x(), canvas.position.y()) != (0, 0) || sizes != (width, height) {
        let found = format!("{} x {}", sizes.0, sizes.1);
        return Err(fault.part(format!(
            "has a display window of another size than the canvas of {width} x {height}, found \
             `{found}`"
        )));
    }
    let whole = room.is_none();
    let (width, height) = room.unwrap_or((width, height));
    let size = part.layer_size;
    let place = part.own_attributes.layer_position;
    let outside = || {
        let w = size.width();
        let h = size.height();
        let x = place.x();
        let y = place.y();
        let wanted = if whole { "is not" } else { "leaves" };
        fault.part(format!(
            "{wanted} the canvas of {width} x {height}: data window `{w} x {h} at {x}, {y}`"
        ))
    };
    let x = usize::try_from(place.x()).map_err(|_| outside())?;
    let y = usize::try_from(place.y()).map_err(|_| outside())?;
    let rect = Rect { x, y, width: size.width(), height: size.height() };
    let all = Rect { x: 0, y: 0, width, height };
    if rect.is_empty() || rect.intersection(all) != rect || (whole && rect != all) {
        return Err(outside());
    }
    Ok(rect)
}

/// Matches every channel of the part with the content that it may hold.
fn planes(
    fault: &Fault<'_>,
    part: &Header,
    wanted: &[Channel],
) -> Result<Vec<Plane>, PaintingFileError> {
    let names: Vec<String> =
        part.channels.list.iter().map(|channel| channel.name.chars().collect()).collect();
    for (index, (name, channel)) in names.iter().zip(&part.channels.list).enumerate() {
        let reason = if wanted.iter().all(|wanted| wanted.name != *name) {
            "names no pigment of this layer"
        } else if names[..index].contains(name) {
            "occurs twice"
        } else if channel.sample_type != SampleType::F32 {
            "must hold 32-bit floats; fewer bits lose paint"
        } else if (channel.sampling.x(), channel.sampling.y()) != (1, 1) {
            "must have a value for every cell"
        } else {
            continue;
        };
        return Err(fault.channel(name.clone(), reason));
    }
    let place = |name: &str| names.iter().position(|found| found == name);
    let mut planes = Vec::new();
    for Channel { name, content } in wanted {
        let slot = match *content {
            Content::Height => SLOTS,
            Content::Amount(slot) => slot,
            Content::Thickness => match place(name) {
                Some(_) => continue,
                None => return Err(fault.channel(name.clone(), "is missing")),
            },
            Content::HeightResidue | Content::AmountResidue(_) => continue,
        };
        let channel = place(name).ok_or_else(|| fault.channel(name.clone(), "is missing"))?;
        let residue = wanted.iter().find(|other| match other.content {
            Content::AmountResidue(of) => of == slot,
            content => content == Content::HeightResidue,
        });
        let residue = residue.and_then(|residue| place(&residue.name));
        planes.push(Plane { name: name.clone(), slot, channel, residue });
    }
    Ok(planes)
}
