//! Opens the scan of an ENVI header.

#[cfg(feature = "files")]
use std::fs::File;
#[cfg(feature = "files")]
use std::io::Read;
use std::path::Path;

#[cfg(feature = "files")]
use super::data_file::data_of;
use super::header::EnviHeader;
use crate::cube::error::CubeError;
use crate::cube::opened::{Opened, Values};
use crate::cube::positional::PositionalFile;
use crate::cube::raw_file::RawFile;

/// Largest header that is read. A header of 65,536 bands has 2 MB.
const LARGEST_HEADER: u64 = 16 << 20;

/// Opens the header at `path` and its data.
#[cfg(feature = "files")]
pub(crate) fn open(path: &Path) -> Result<Opened, CubeError> {
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    let mut bytes = Vec::new();
    let read = file.take(LARGEST_HEADER + 1).read_to_end(&mut bytes);
    read.map_err(|reason| CubeError::reading(path, reason))?;
    check_length(path, bytes.len() as u64)?;
    let header = EnviHeader::parse(&bytes, path)?;
    let data = data_of(path, &header)?;
    let file = PositionalFile::open(&data)?;
    Ok(opened(path, header, file))
}

/// Refuses a header that is too large to be one of ENVI.
pub(crate) fn check_length(path: &Path, bytes: u64) -> Result<(), CubeError> {
    if bytes <= LARGEST_HEADER {
        return Ok(());
    }
    let problem = format!("has more than {LARGEST_HEADER} bytes, which no ENVI header has");
    Err(CubeError::format(path, problem, "name the header, which is a short text"))
}

/// The scan of a header and its data, whose size fits.
pub(crate) fn opened(path: &Path, header: EnviHeader, file: PositionalFile) -> Opened {
    let layout = header.layout;
    let values = match (header.gains, header.scale_factor) {
        (Some(gains), _) => Values::Gains(gains),
        (None, Some(factor)) => Values::Divided(factor),
        (None, None) if header.is_radiance => Values::Counts,
        (None, None) => Values::Unknown { are_whole: layout.number_type.is_whole() },
    };
    Opened {
        path: path.to_owned(),
        lines: layout.lines,
        samples: layout.samples,
        bands: layout.bands,
        wavelengths_nm: header.wavelengths_nm,
        fwhm_nm: header.fwhm_nm,
        good: header.good,
        ignore: header.ignore,
        values,
        integration_time: header.integration_time,
        remarks: header.remarks,
        source: Box::new(RawFile::new(file, layout)),
    }
}
