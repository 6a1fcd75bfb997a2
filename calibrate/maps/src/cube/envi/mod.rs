//! Cubes of ENVI: a text header and a file of plain numbers, read and written.

mod header;

#[cfg(feature = "files")]
mod written;

#[cfg(feature = "files")]
use std::fs::File;
#[cfg(feature = "files")]
use std::io::Read;
use std::path::{Path, PathBuf};

use pigment::Remark;

use crate::cube::error::CubeError;
use crate::cube::raw_file::{PositionalFile, RawFile};
use crate::cube::window::{Opened, Values};

pub use header::EnviHeader;
pub(crate) use header::is_header;
#[cfg(feature = "files")]
pub use written::{EnviAbout, EnviWriter, WRITTEN_SCALE, written_data};

/// Data files beside `NAME.hdr` may have these endings.
const ENDINGS: [&str; 9] = ["img", "dat", "raw", "bil", "bip", "bsq", "cube", "bin", "sc"];

fn with_added(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

/// Paths where the data of the header `path` may lie, the likeliest first.
pub(crate) fn places(path: &Path) -> Vec<PathBuf> {
    // `scan.img.hdr` belongs to `scan.img`, `scan.hdr` to `scan` or `scan.img`.
    let stem = path.with_extension("");
    let mut places = vec![stem.clone()];
    for ending in ENDINGS {
        places.push(with_added(&stem, ending));
        places.push(with_added(&stem, &ending.to_uppercase()));
    }
    places
}

/// Finds the data file of the header at `path`. If several files could be the data, the size decides.
#[cfg(feature = "files")]
pub(crate) fn data_of(path: &Path, header: &EnviHeader) -> Result<PathBuf, CubeError> {
    let found: Vec<_> = places(path).into_iter().filter(|place| place.is_file()).collect();
    let expected = header.layout.file_bytes();
    match found
        .iter()
        .find(|place: &&PathBuf| expected.is_some() && bytes(place) == expected)
        .or(found.first())
    {
        None => Err(CubeError::format(
            path,
            "the data of this header are not beside it",
            format!(
                "put the data file beside it, as {} or with an ending such as .{}",
                path.with_extension("").display(),
                ENDINGS[..6].join(", .")
            ),
        )),
        Some(place) => {
            check_size(place, path, header, bytes(place).unwrap_or(0))?;
            Ok(place.clone())
        }
    }
}

#[cfg(feature = "files")]
fn bytes(place: &PathBuf) -> Option<u64> {
    std::fs::metadata(place).map(|about| about.len()).ok()
}

/// Checks that the file `data` has the size that the header `path` describes. It has `found` bytes.
pub(crate) fn check_size(
    data: &Path,
    path: &Path,
    header: &EnviHeader,
    found: u64,
) -> Result<(), CubeError> {
    match header.layout.file_bytes() == Some(found) {
        true => Ok(()),
        false => Err(size_error(data, path, header, found)),
    }
}

fn size_error(data: &Path, path: &Path, header: &EnviHeader, found: u64) -> CubeError {
    let Some(expected) = header.layout.file_bytes() else {
        return CubeError::format(
            path,
            format!(
                "describes more bytes than a file can have: {} samples, {} lines, {} bands",
                header.layout.samples, header.layout.lines, header.layout.bands
            ),
            "correct samples, lines and bands in the header",
        );
    };
    let layout = &header.layout;
    let sizes = format!(
        "{} samples x {} lines x {} bands x {} bytes + offset {}",
        layout.samples,
        layout.lines,
        layout.bands,
        layout.number_type.bytes(),
        layout.offset
    );
    CubeError::Size { data: data.to_owned(), header: path.to_owned(), expected, found, sizes }
}

/// Finds the header of the data at `path`: `scan.hdr` or `scan.img.hdr`.
#[cfg(feature = "files")]
pub(crate) fn header_of(path: &Path) -> Option<PathBuf> {
    let endings = ["hdr", "HDR"];
    let added = endings.map(|ending| with_added(path, ending));
    let replaced = endings.map(|ending| path.with_extension(ending));
    added.into_iter().chain(replaced).find(|place| place.is_file())
}

/// We read headers up to this size. A header of 65,536 bands has 2 MB.
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

/// Refuses a file that is too large to be a header of ENVI.
pub(crate) fn check_length(path: &Path, bytes: u64) -> Result<(), CubeError> {
    if bytes <= LARGEST_HEADER {
        return Ok(());
    }
    let problem = format!("has more than {LARGEST_HEADER} bytes, which no ENVI header has");
    Err(CubeError::format(path, problem, "name the header, which is a short text"))
}

/// Makes a scan of a header and its data, if their sizes match.
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
        told: header.told,
        integration_time: header.integration_time,
        remarks: header.remarks.into_iter().map(Remark::note).collect(),
        source: Box::new(RawFile::new(file, layout)),
    }
}
