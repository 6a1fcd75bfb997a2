//! Check of a file's parts and channels against its header, before memory is allocated.

use exr::meta::BlockDescription;
use exr::meta::attribute::{Compression, SampleType};
use exr::meta::header::Header;

use super::channels::{Channel, Content, of_ground, of_layer};
use super::error::PaintingFileError;
use super::header::{FileHeader, PaintHeader};
use super::names::BASE;
use crate::layer::SLOTS;
use graphics::tile::Rect;

/// Most bytes that one stored byte of an OpenEXR file can expand to: 1032 by ZIP, less by
/// PIZ, plus headers. A file that announces more is truncated or malicious.
pub const EXPANSION: u64 = 1100;

/// A part of the file that passed the checks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PartLayout {
    pub(super) name: String,
    /// Index of the header's paint that the part holds; `None` for the ground.
    pub(super) layer: Option<usize>,
    pub(super) window: Rect,
    /// Number of channels of the part.
    pub(super) channels: usize,
    pub(super) planes: Vec<Plane>,
}

/// Channels that hold one amount, or the ground's height.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Plane {
    pub(super) name: String,
    /// Slot of the amount; [`SLOTS`] stands for the vehicle, and for the ground's height.
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

/// Checks the parts against `header` and returns them in the file's order. Nothing has
/// been allocated yet.
pub(super) fn layout(
    file: &str,
    parts: &[Header],
    header: &FileHeader,
    file_bytes: usize,
    limit: u64,
) -> Result<Vec<PartLayout>, PaintingFileError> {
    let paints = header.paints();
    let cells = |(width, height): (usize, usize)| (width as u64).saturating_mul(height as u64);
    let sizes = paints.iter().map(|paint| cells(paint.size).saturating_mul(36));
    let ground = cells((header.width, header.height)).saturating_mul(4);
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
    if stored > EXPANSION.saturating_mul(file_bytes as u64) {
        return Err(PaintingFileError::Container {
            file: file.to_owned(),
            reason: format!("{file_bytes} bytes cannot hold the {stored} that its header tells of"),
        });
    }
    Ok(found)
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

/// Cells that a part covers within its `room`; the ground, which has none, must cover the whole
/// canvas.
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
        let wrong = |reason: &str| Err(fault.channel(name.clone(), reason));
        if wanted.iter().all(|wanted| wanted.name != *name) {
            return wrong("names no pigment of this layer");
        }
        if names[..index].contains(name) {
            return wrong("occurs twice");
        }
        if channel.sample_type != SampleType::F32 {
            return wrong("must hold 32-bit floats; fewer bits lose paint");
        }
        if (channel.sampling.x(), channel.sampling.y()) != (1, 1) {
            return wrong("must have a value for every cell");
        }
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
