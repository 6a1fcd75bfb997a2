//! Decoding of a file of samples.

use std::io::Cursor;

use exr::block::UncompressedBlock;
use exr::block::chunk::Chunk;
use exr::meta::attribute::{AttributeValue, SampleType, Text};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use rayon::prelude::*;

use super::error::SampleFileError;
use super::header::{ATTRIBUTE, FileHeader, PigmentHeader, SampleHeader};
use super::planes::sample;
use crate::sample::passage::SampleSet;

/// Most bytes that one stored byte expands to: 1032 by ZIP, less by PIZ, plus headers. A file
/// that announces more is truncated or malicious.
const EXPANSION: u64 = 1100;

/// Number of blocks that are read as a batch and then decompressed in parallel.
const BATCH: usize = 64;

/// Decodes samples from `bytes`, the content of `file`. The name is used in errors only.
///
/// # Errors
/// [`SampleFileError`] if the content is not OpenEXR, holds no samples, is of a newer version,
/// truncated or inconsistent.
pub fn read(file: &str, bytes: &[u8]) -> Result<SampleSet, SampleFileError> {
    let damaged = |error: exr::error::Error| SampleFileError::Container {
        file: file.to_owned(),
        reason: error.to_string(),
    };
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(damaged)?;
    let (header, paint) = FileHeader::from_json(file, &json(file, reader.headers())?)?;
    let pigments = header.pigments.as_deref();
    let parts = layout(file, reader.headers(), &header, bytes.len())?;

    let planes = |part: &PartLayout<'_>| {
        vec![vec![0.0; part.sample.width * part.sample.height]; part.channels.len()]
    };
    let mut filled: Vec<_> = parts.iter().map(|part| vec![false; part.sample.height]).collect();
    let mut content: Vec<Vec<Vec<f32>>> = parts.iter().map(planes).collect();
    let meta = reader.meta_data().clone();
    let mut chunks = reader.all_chunks(false).map_err(damaged)?;
    loop {
        let batch: Vec<Chunk> =
            chunks.by_ref().take(BATCH).collect::<Result<_, _>>().map_err(damaged)?;
        if batch.is_empty() {
            break;
        }
        let blocks: Vec<_> =
            batch.into_par_iter().map(|chunk| block(file, chunk, &meta, &parts)).collect();
        for block in blocks {
            let UncompressedBlock { index, data } = block?;
            let part = &parts[index.layer];
            let (width, count) = (part.sample.width, part.channels.len());
            for (line, numbers) in data.chunks(width * size_of::<f32>()).enumerate() {
                let (row, channel) = (index.pixel_position.y() + line / count, line % count);
                if channel == 0 && std::mem::replace(&mut filled[index.layer][row], true) {
                    return Err(part.fault(file, format!("has row `{row}` twice")));
                }
                let numbers = numbers.as_chunks().0.iter().map(|bytes| f32::from_ne_bytes(*bytes));
                let row = &mut content[index.layer][channel][row * width..][..width];
                row.iter_mut().zip(numbers).for_each(|(value, number)| *value = number);
            }
        }
    }
    let mut samples = Vec::with_capacity(parts.len());
    for ((part, rows), planes) in parts.iter().zip(&filled).zip(&content) {
        if let Some(row) = rows.iter().position(|filled| !filled) {
            return Err(part.fault(file, format!("lacks row `{row}`")));
        }
        let made = sample(part.sample, pigments, &part.channels, planes);
        samples.push(made.map_err(|(channel, reason)| SampleFileError::Channel {
            file: file.to_owned(),
            part: part.sample.part.clone(),
            channel,
            reason,
        })?);
    }
    Ok(SampleSet { samples, paint, provenance: header.provenance })
}

/// Text of attribute `impasto` of the first part that has it.
fn json(file: &str, parts: &[Header]) -> Result<String, SampleFileError> {
    let format =
        |reason: &str| SampleFileError::Format { file: file.to_owned(), reason: reason.to_owned() };
    let key = Text::from(ATTRIBUTE);
    match parts.iter().find_map(|part| part.own_attributes.other.get(&key)) {
        Some(AttributeValue::Text(text)) => Ok(text.chars().collect()),
        Some(_) => Err(format("attribute `impasto` is no text")),
        None => Err(format("attribute `impasto` is missing")),
    }
}

/// A part of the file that passed the checks.
struct PartLayout<'a> {
    sample: &'a SampleHeader,
    /// Names of the channels in the order of the file.
    channels: Vec<String>,
}

impl PartLayout<'_> {
    fn fault(&self, file: &str, reason: String) -> SampleFileError {
        let part = self.sample.part.clone();
        SampleFileError::Part { file: file.to_owned(), part, reason }
    }
}

/// Checks the parts against `header`, in their order. Nothing has been allocated yet.
fn layout<'a>(
    file: &str,
    parts: &[Header],
    header: &'a FileHeader,
    file_bytes: usize,
) -> Result<Vec<PartLayout<'a>>, SampleFileError> {
    let (found, wanted) = (parts.len(), header.samples.len());
    if found != wanted {
        let reason = format!("it names {wanted} samples, the file has `{found}` parts");
        return Err(SampleFileError::Header { file: file.to_owned(), reason });
    }
    let pairs = parts.iter().zip(&header.samples);
    let layouts =
        pairs.map(|(part, sample)| check_part(file, part, sample, header.pigments.as_deref()));
    let layouts = layouts.collect::<Result<Vec<_>, _>>()?;
    let stored = layouts.iter().map(|part| {
        let texels = (part.sample.width as u64).saturating_mul(part.sample.height as u64);
        texels.saturating_mul(4 * part.channels.len() as u64)
    });
    let stored = stored.fold(0, u64::saturating_add);
    if stored > EXPANSION.saturating_mul(file_bytes as u64) {
        return Err(SampleFileError::Container {
            file: file.to_owned(),
            reason: format!("{file_bytes} bytes cannot hold the {stored} that its header tells of"),
        });
    }
    Ok(layouts)
}

fn check_part<'a>(
    file: &str,
    part: &Header,
    sample: &'a SampleHeader,
    pigments: Option<&[PigmentHeader]>,
) -> Result<PartLayout<'a>, SampleFileError> {
    let list = &part.channels.list;
    let channels: Vec<String> = list.iter().map(|channel| channel.name.chars().collect()).collect();
    let layout = PartLayout { sample, channels };
    let name = part.own_attributes.layer_name.as_ref();
    if !name.is_some_and(|name| name.eq(&sample.part)) {
        return Err(layout.fault(file, "is missing at its place".to_owned()));
    }
    if part.blocks != BlockDescription::ScanLines || part.deep {
        return Err(layout.fault(file, "has tiles or is deep; expected scan lines".to_owned()));
    }
    let size = (part.layer_size.width(), part.layer_size.height());
    if size != (sample.width, sample.height) {
        let (width, height) = (sample.width, sample.height);
        let found = format!("{} x {}", size.0, size.1);
        let reason = format!("has `{found}` texels, attribute `impasto` says {width} x {height}");
        return Err(layout.fault(file, reason));
    }
    let wrong = |channel: &str, reason: &str| {
        Err(SampleFileError::Channel {
            file: file.to_owned(),
            part: sample.part.clone(),
            channel: channel.to_owned(),
            reason: reason.to_owned(),
        })
    };
    let wanted = sample.channels(pigments);
    for (name, channel) in layout.channels.iter().zip(list) {
        if !wanted.contains(name) {
            return wrong(name, "is none that attribute `impasto` names");
        }
        if layout.channels.iter().filter(|other| *other == name).count() > 1 {
            return wrong(name, "occurs twice");
        }
        if channel.sample_type != SampleType::F32 {
            return wrong(name, "must hold 32-bit floats");
        }
        if (channel.sampling.x(), channel.sampling.y()) != (1, 1) {
            return wrong(name, "must have a value for every texel");
        }
    }
    match wanted.iter().find(|name| !layout.channels.contains(name)) {
        Some(name) => wrong(name, "is missing"),
        None => Ok(layout),
    }
}

/// Decompresses a block and checks its size.
fn block(
    file: &str,
    chunk: Chunk,
    meta: &MetaData,
    parts: &[PartLayout<'_>],
) -> Result<UncompressedBlock, SampleFileError> {
    let damaged = |reason: String| SampleFileError::Container { file: file.to_owned(), reason };
    let block = UncompressedBlock::decompress_chunk(chunk, meta, false)
        .map_err(|error| damaged(error.to_string()))?;
    let part = &parts[block.index.layer];
    let (width, height) = (part.sample.width, block.index.pixel_size.height());
    let wanted = width * part.channels.len() * height * size_of::<f32>();
    let bottom = block.index.pixel_position.y() + height;
    let fits = block.index.pixel_size.width() == width && bottom <= part.sample.height;
    if !fits || block.data.len() != wanted {
        let (part, found) = (&part.sample.part, block.data.len());
        return Err(damaged(format!("block of part `{part}` with `{found}` bytes for {wanted}")));
    }
    Ok(block)
}
