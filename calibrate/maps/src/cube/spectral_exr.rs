//! Spectral OpenEXR files, as this engine exports paintings.
//!
//! Layout by A. Fichet, R. Pacanowski and A. Wilkie, "An OpenEXR Layout for Spectral Images" (Journal
//! of Computer Graphics Techniques 10(3), 2021): a channel `T.550,000000nm` a wavelength.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use exr::block::chunk::TileCoordinates;
use exr::block::lines::LineRef;
use exr::block::reader::ChunksReader;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::meta::MetaData;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use half::f16;

use super::error::CubeError;
use super::opened::{Opened, Values};
use super::options::CubeOptions;
use super::raw_file::Interleave;
use super::spool::Spool;
use crate::numbers::NumberType;

/// Whether a file begins as OpenEXR.
pub(crate) fn is_exr(start: &[u8]) -> bool {
    start.starts_with(&[0x76, 0x2f, 0x31, 0x01])
}

/// Wavelength of a channel of reflectance in nm: `T.550,5nm`.
fn channel_nm(name: &str) -> Option<f64> {
    let number = name.strip_prefix("T.")?;
    let (number, factor) = match number.strip_suffix("nm") {
        Some(number) => (number, 1.0),
        None => (number.strip_suffix("um")?, 1000.0),
    };
    let nm = number.replace(',', ".").parse::<f64>().ok()? * factor;
    (nm.is_finite() && nm > 0.0).then_some(nm)
}

/// Layer and channels of reflectance: index of the channel in the layer, and nm, rising.
fn channels(meta: &MetaData) -> Option<(usize, Vec<(usize, f64)>)> {
    let layers = meta
        .headers
        .iter()
        .map(|header: &Header| -> Vec<(usize, f64)> {
            let names = header.channels.list.iter().map(|channel| channel.name.to_string());
            let mut found: Vec<_> =
                names.enumerate().filter_map(|(at, name)| Some((at, channel_nm(&name)?))).collect();
            found.sort_by(|a, b| a.1.total_cmp(&b.1));
            found
        })
        .enumerate();
    layers.into_iter().find(|(_, channels)| !channels.is_empty())
}

/// Opens the file: unpacks its channels of reflectance.
pub(crate) fn open(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let fault = |error: exr::error::Error| match error {
        exr::error::Error::Io(reason) => CubeError::unpacking(path, reason),
        other => CubeError::data(path, format!("cannot be unpacked: {other}"), "export it again"),
    };
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    let reader = exr::block::read(BufReader::new(file), false).map_err(fault)?;
    let Some((layer, found)) = channels(reader.meta_data()) else {
        return Err(CubeError::format(
            path,
            "is an OpenEXR file without channels of reflectance such as T.550,000000nm",
            "export the painting with its spectra",
        ));
    };
    if let Some(pair) = found.windows(2).find(|pair| pair[0].1 == pair[1].1) {
        let problem = format!("has two channels at {} nm", pair[0].1);
        return Err(CubeError::format(path, problem, "export each wavelength once"));
    }
    let header = reader.headers()[layer].clone();
    let samples = header.layer_size.0;
    let lines = header.layer_size.1;
    let list = &header.channels.list;
    if found.iter().any(|(channel, _)| list[*channel].sampling.0 * list[*channel].sampling.1 != 1) {
        let problem = "has channels of a lower resolution";
        return Err(CubeError::format(path, problem, "export all channels at one resolution"));
    }
    let places: BTreeMap<usize, usize> =
        found.iter().enumerate().map(|(band, (channel, _))| (*channel, band)).collect();
    let size = (lines, samples, found.len());
    let scratch = options.scratch.as_deref();
    let mut spool = Spool::new(scratch, size, NumberType::F32, Interleave::Bil)?;
    let chunks = reader
        .filter_chunks(false, |_: &MetaData, _: TileCoordinates, block: BlockIndex| {
            block.layer == layer && block.level.0 == 0 && block.level.1 == 0
        })
        .map_err(fault)?;
    let meta = chunks.meta_data().clone();
    for chunk in chunks {
        let block =
            chunk.and_then(|chunk| UncompressedBlock::decompress_chunk(chunk, &meta, false));
        let block = block.map_err(fault)?;
        for line in block.lines(&header.channels) {
            let Some(&band) = places.get(&line.location.channel) else { continue };
            let position = line.location.position;
            let values = bytes_of(line, list[line.location.channel].sample_type);
            spool.write((position.1, position.0, band), &values.map_err(fault)?)?;
        }
    }
    Ok(Opened {
        path: path.to_owned(),
        lines,
        samples,
        bands: found.len(),
        wavelengths_nm: Some(found.iter().map(|(_, nm)| *nm).collect()),
        fwhm_nm: None,
        good: vec![true; found.len()],
        ignore: None,
        // The layout says that these channels are reflectances.
        values: Values::Divided(1.0),
        integration_time: None,
        remarks: Vec::new(),
        source: Box::new(spool.finish(path)?),
    })
}

/// Values of a line as bytes of f32.
fn bytes_of(line: LineRef<'_>, kind: SampleType) -> exr::error::Result<Vec<u8>> {
    match kind {
        SampleType::F32 => collect::<f32>(line, |value| value),
        SampleType::F16 => collect::<f16>(line, f16::to_f32),
        SampleType::U32 => collect::<u32>(line, |value| value as f32),
    }
}

fn collect<T: exr::io::Data>(
    line: LineRef<'_>,
    number: impl Fn(T) -> f32,
) -> exr::error::Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(line.location.sample_count * size_of::<f32>());
    for value in line.read_samples::<T>() {
        bytes.extend(number(value?).to_ne_bytes());
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_read_by_their_published_names() {
        assert_eq!(channel_nm("T.550,000000nm"), Some(550.0));
        assert_eq!(channel_nm("T.412,345679nm"), Some(412.345_679));
        assert_eq!(channel_nm("T.0,55um"), Some(550.0));
        for other in ["R", "S0.550,000000nm", "T.nm", "T.-5nm", "T.550"] {
            assert_eq!(channel_nm(other), None, "{other}");
        }
    }
}
