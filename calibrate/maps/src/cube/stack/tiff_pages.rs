//! TIFF files: the pages of one file with one or several bands each, or one page as a picture of a stack.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use tiff::ColorType;
use tiff::TiffError;
use tiff::decoder::{Decoder, DecodingResult};
use tiff::tags::{PlanarConfiguration, Tag};

use super::plane::{Plane, not_gray};
use crate::cube::error::CubeError;
use crate::cube::opened::{Opened, Values};
use crate::cube::options::CubeOptions;
use crate::cube::raw_file::Interleave;
use crate::cube::spool::Spool;
use crate::cube::wavelength_file::wavelengths_of;
use crate::numbers::NumberType;

/// Most bands of a file, so that a file whose pages form a circle ends.
const MOST_BANDS: usize = 65_536;

/// Whether a file begins as TIFF or BigTIFF.
pub(crate) fn is_tiff(start: &[u8]) -> bool {
    [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|magic| start.starts_with(*magic))
}

type Pages = Decoder<BufReader<File>>;

fn fault(path: &Path, error: TiffError) -> CubeError {
    match error {
        TiffError::IoError(reason) => CubeError::unpacking(path, reason),
        TiffError::LimitsExceeded => CubeError::data(
            path,
            "has strips or tiles of more than 256 MB, or more than 100,000 of them",
            "save it in strips of a few rows: tifffile.imwrite(.., rowsperstrip=16)",
        ),
        other => CubeError::data(
            path,
            format!("cannot be unpacked: {other}"),
            "save it without packing, or packed by deflate or LZW",
        ),
    }
}

/// Opens the pages of the file at `path`.
pub(crate) fn pages(path: &Path) -> Result<Pages, CubeError> {
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    Decoder::new(BufReader::new(file)).map_err(|error| fault(path, error))
}

/// Size and numbers of the page that the decoder stands on.
pub(crate) fn plane(pages: &mut Pages, path: &Path, place: &str) -> Result<Plane, CubeError> {
    let colors = pages.colortype().map_err(|error| fault(path, error))?;
    let bands = match colors {
        ColorType::Gray(_) => 1,
        ColorType::Multiband { num_samples, .. } => usize::from(num_samples),
        _ => return Err(not_gray(path, place, colors)),
    };
    let (width, height) = pages.dimensions().map_err(|error| fault(path, error))?;
    if width == 0 || height == 0 {
        return Err(CubeError::format(path, format!("{place} has no pixels"), "export it again"));
    }
    // The first part tells the type of the numbers.
    let first = pages.read_chunk(0).map_err(|error| fault(path, error))?;
    let (number_type, _) = bytes_of(first);
    Ok(Plane { samples: width as usize, lines: height as usize, bands, number_type })
}

/// Whether each band of the page has parts of its own, those of the first band first.
fn has_parts_of_bands(pages: &mut Pages, path: &Path) -> Result<bool, CubeError> {
    let order = pages.find_tag_unsigned::<u16>(Tag::PlanarConfiguration);
    let order = order.map_err(|error| fault(path, error))?;
    Ok(order == Some(PlanarConfiguration::Planar.to_u16()))
}

/// Unpacks the page that the decoder stands on, part after part, as `band` and those that follow.
pub(crate) fn unpack(
    pages: &mut Pages,
    path: &Path,
    plane: Plane,
    band: usize,
    spool: &mut Spool,
) -> Result<(), CubeError> {
    let (across, down) = pages.chunk_dimensions();
    let across = across as usize;
    let down = down as usize;
    let columns = plane.samples.div_ceil(across.max(1));
    let parts = columns * plane.lines.div_ceil(down.max(1));
    let number = plane.number_type.bytes();
    // Bands that lie side by side in a part, and rounds of parts.
    let (beside, rounds) = match has_parts_of_bands(pages, path)? {
        true => (1, plane.bands),
        false => (plane.bands, 1),
    };
    for (round, part) in (0..rounds).flat_map(|round| (0..parts).map(move |part| (round, part))) {
        let index = u32::try_from(round * parts + part).unwrap_or(u32::MAX);
        let (width, height) = pages.chunk_data_dimensions(index);
        let width = width as usize;
        let height = height as usize;
        let (found, bytes) = bytes_of(pages.read_chunk(index).map_err(|error| fault(path, error))?);
        let row_bytes = width * beside * number;
        if found != plane.number_type || bytes.len() != row_bytes * height {
            let problem =
                format!("part {} of the page of band {} has another size", index, band + 1);
            return Err(CubeError::data(path, problem, "export it again"));
        }
        let line = part / columns * down;
        let sample = part % columns * across;
        // Parts at the lower edge may hold rows beyond it.
        let rows = bytes.chunks_exact(row_bytes).take(plane.lines.saturating_sub(line));
        for (row, bytes) in rows.enumerate() {
            if beside == 1 {
                spool.write((line + row, sample, band + round), bytes)?;
                continue;
            }
            let pixel = beside * number;
            for of_pixel in 0..beside {
                let numbers = bytes.chunks_exact(pixel).map(|pixel| &pixel[of_pixel * number..]);
                let numbers: Vec<u8> = numbers.flat_map(|rest| &rest[..number]).copied().collect();
                spool.write((line + row, sample, band + of_pixel), &numbers)?;
            }
        }
    }
    Ok(())
}

/// Type and bytes of numbers, in the order of this machine.
fn bytes_of(numbers: DecodingResult) -> (NumberType, Vec<u8>) {
    macro_rules! bytes {
        ($kind:expr, $numbers:expr) => {
            ($kind, $numbers.into_iter().flat_map(|number| number.to_ne_bytes()).collect())
        };
    }
    match numbers {
        DecodingResult::U8(numbers) => (NumberType::U8, numbers),
        DecodingResult::U16(numbers) => bytes!(NumberType::U16, numbers),
        DecodingResult::U32(numbers) => bytes!(NumberType::U32, numbers),
        DecodingResult::U64(numbers) => bytes!(NumberType::U64, numbers),
        DecodingResult::F16(numbers) => bytes!(NumberType::F16, numbers),
        DecodingResult::F32(numbers) => bytes!(NumberType::F32, numbers),
        DecodingResult::F64(numbers) => bytes!(NumberType::F64, numbers),
        DecodingResult::I8(numbers) => bytes!(NumberType::I8, numbers),
        DecodingResult::I16(numbers) => bytes!(NumberType::I16, numbers),
        DecodingResult::I32(numbers) => bytes!(NumberType::I32, numbers),
        DecodingResult::I64(numbers) => bytes!(NumberType::I64, numbers),
    }
}

/// File of the wavelengths beside a TIFF file.
fn list_beside(path: &Path) -> Option<PathBuf> {
    let named = ["txt", "csv"].map(|ending| path.with_extension(ending));
    let common = ["wavelengths.txt", "wavelengths.csv"].map(|name| path.with_file_name(name));
    named.into_iter().chain(common).find(|place| place.is_file())
}

/// Opens a TIFF file with a page a wavelength, or with several values a pixel in its pages: those of the first page
/// come first. The wavelengths are those of the settings or of a list beside the file.
pub(crate) fn open_pages(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let mut decoder = pages(path)?;
    let first = plane(&mut decoder, path, "page 1")?;
    let mut count = 1;
    while decoder.more_images() {
        if count * first.bands >= MOST_BANDS {
            let problem = format!("has more than {MOST_BANDS} bands in its pages");
            return Err(CubeError::format(path, problem, "export a page a wavelength"));
        }
        decoder.next_image().map_err(|error| fault(path, error))?;
        count += 1;
        let place = format!("page {count}");
        plane(&mut decoder, path, &place)?.check_like(first, path, &place)?;
    }
    let bands = count * first.bands;
    let (each, has) = match first.bands {
        1 => ("a page", format!("{count} pages")),
        _ => ("a band", format!("{bands} bands")),
    };
    let nm = match (&options.wavelengths, list_beside(path)) {
        (Some(_), _) => None,
        (None, Some(list)) => {
            let nm = wavelengths_of(&list)?;
            if nm.len() != bands {
                let problem = format!("has {} wavelengths, the stack {has}", nm.len());
                return Err(CubeError::format(
                    &list,
                    problem,
                    format!("give one wavelength {each}"),
                ));
            }
            Some(nm)
        }
        (None, None) => {
            return Err(CubeError::format(
                path,
                format!("has {has}, but no list of their wavelengths is beside it"),
                format!(
                    "add {} with one wavelength in nm {each}, or give [wavelengths=FILE]",
                    path.with_extension("txt").display()
                ),
            ));
        }
    };
    let size = (first.lines, first.samples, bands);
    let scratch = options.scratch.as_deref();
    // Bands of one part are written beside each other.
    let interleave = if first.bands > 1 { Interleave::Bil } else { Interleave::Bsq };
    let mut spool = Spool::new(scratch, size, first.number_type, interleave)?;
    for page in 0..count {
        decoder.seek_to_image(page).map_err(|error| fault(path, error))?;
        unpack(&mut decoder, path, first, page * first.bands, &mut spool)?;
    }
    Ok(Opened {
        path: path.to_owned(),
        lines: first.lines,
        samples: first.samples,
        bands,
        wavelengths_nm: nm,
        fwhm_nm: None,
        good: vec![true; bands],
        ignore: None,
        values: Values::Unknown { are_whole: first.number_type.is_whole() },
        integration_time: None,
        remarks: Vec::new(),
        source: Box::new(spool.finish(path)?),
    })
}
