//! Stacks of pictures. A folder holds a TIFF or PNG picture for each wavelength, or one TIFF file
//! holds the bands as pages or as values of pixels.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use documents::foreign_message;
use pigment::Remark;
use png::{BitDepth, ColorType, Decoder, DecodingError, Reader};
use tiff::decoder::{Decoder as TiffDecoder, DecodingResult};
use tiff::tags::{PlanarConfiguration, Tag};
use tiff::{ColorType as TiffColor, TiffError};

use crate::cube::error::CubeError;
use crate::cube::gdal::GdalMetadata;
use crate::cube::options::CubeOptions;
use crate::cube::raw_file::Interleave;
use crate::cube::side_files::{Spool, wavelengths_of};
use crate::cube::window::{Opened, Values};
use crate::numbers::NumberType;

/// Size and numbers of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Plane {
    pub(crate) samples: usize,
    pub(crate) lines: usize,
    pub(crate) bands: usize,
    pub(crate) number_type: NumberType,
}

impl Plane {
    /// Checks that this picture has the size and numbers of the first one in its stack. Messages
    /// call it `place`.
    pub(crate) fn check_like(self, first: Self, path: &Path, place: &str) -> Result<(), CubeError> {
        if self == first {
            return Ok(());
        }
        let [found, first] = [self, first].map(|Self { samples, lines, bands, number_type }| {
            let bands = if bands == 1 { String::new() } else { format!("{bands} ") };
            format!("{samples} x {lines} pixels of {bands}{number_type:?}")
        });
        let problem = format!("{place} has {found}, the first picture of the stack {first}");
        Err(CubeError::format(path, problem, "export all pictures at one size and one depth"))
    }
}

/// The error for a picture of several colours.
pub(crate) fn not_gray(path: &Path, place: &str, found: impl std::fmt::Debug) -> CubeError {
    CubeError::format(
        path,
        format!("{place} is of kind {found:?}, expected one gray value a pixel"),
        "export one gray picture a wavelength",
    )
}

/// Files of a folder with one of these endings, in the order in which people number them.
pub(crate) fn files_ending_in(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.filter_map(Result::ok).map(|entry| entry.path());
    let mut found: Vec<_> = paths
        .filter(|path: &PathBuf| {
            let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
            endings.iter().any(|wanted| ending.eq_ignore_ascii_case(wanted)) && path.is_file()
        })
        .collect();
    found.sort_by_cached_key(|path| natural(&path.to_string_lossy()));
    found
}

/// Splits a name into texts and numbers in turn, so that e.g. `band 10` comes after `band 9`.
fn natural(name: &str) -> Vec<(String, u128)> {
    let mut parts = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let start = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
        let (text, from) = rest.split_at(start);
        let end = from.find(|c: char| !c.is_ascii_digit()).unwrap_or(from.len());
        let number = from[..end].parse().unwrap_or(if end == 0 { 0 } else { u128::MAX });
        parts.push((text.to_owned(), number));
        rest = &from[end..];
    }
    parts
}

fn list_inside(folder: &Path) -> Option<PathBuf> {
    let places = ["wavelengths.txt", "wavelengths.csv"].map(|name| folder.join(name));
    places.into_iter().find(|place| place.is_file())
}

fn pictures(folder: &Path) -> Vec<PathBuf> {
    files_ending_in(folder, &["png", "tif", "tiff"])
}

/// Whether `folder` holds pictures with known wavelengths.
pub(crate) fn is_stack(folder: &Path, options: &CubeOptions) -> bool {
    let known = options.wavelengths.is_some() || list_inside(folder).is_some();
    known && !pictures(folder).is_empty()
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

fn plane_of(path: &Path) -> Result<Plane, CubeError> {
    if is_png(path) {
        return png_plane(path);
    }
    let mut pages = tiff_pages(path)?;
    if pages.more_images() {
        let problem = "has several pages, expected one picture a file";
        return Err(CubeError::format(path, problem, "open the file itself, not its folder"));
    }
    let plane = tiff_plane(&mut pages, path, "the picture")?;
    if plane.bands > 1 {
        let problem = format!("has {} values a pixel, expected one picture a file", plane.bands);
        return Err(CubeError::format(path, problem, "open the file itself, not its folder"));
    }
    Ok(plane)
}

/// Opens the pictures of a folder, in the order of their names.
pub(crate) fn open_folder(folder: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let pictures = pictures(folder);
    let list = options.wavelengths.clone().or_else(|| list_inside(folder));
    let (Some(list), Some(first)) = (list, pictures.first()) else {
        let way_out = "add wavelengths.txt with one wavelength in nm a picture";
        return Err(CubeError::format(folder, "holds no pictures with wavelengths", way_out));
    };
    let nm = wavelengths_of(&list)?;
    if nm.len() != pictures.len() {
        let problem =
            format!("has {} wavelengths, the folder {} pictures", nm.len(), pictures.len());
        return Err(CubeError::format(&list, problem, "give one wavelength a picture"));
    }
    let plane = plane_of(first)?;
    let size = (plane.lines, plane.samples, pictures.len());
    let scratch = options.scratch.as_deref();
    let mut spool = Spool::new(scratch, size, plane.number_type, Interleave::Bsq)?;
    for (band, picture) in pictures.iter().enumerate() {
        plane_of(picture)?.check_like(plane, picture, "the picture")?;
        if is_png(picture) {
            unpack_png(picture, plane, band, &mut spool)?;
        } else {
            let mut pages = tiff_pages(picture)?;
            unpack_tiff(&mut pages, picture, plane, band, &mut spool)?;
        }
    }
    let ends = [first, &pictures[pictures.len() - 1]].map(|path| name(path));
    let remark = format!(
        "{} pictures from {} ({} nm) to {} ({} nm), in the order of their names",
        pictures.len(),
        ends[0],
        nm[0],
        ends[1],
        nm[nm.len() - 1]
    );
    Ok(Opened {
        path: folder.to_owned(),
        lines: plane.lines,
        samples: plane.samples,
        bands: nm.len(),
        good: vec![true; nm.len()],
        wavelengths_nm: Some(nm),
        fwhm_nm: None,
        ignore: None,
        values: Values::Unknown { are_whole: plane.number_type.is_whole() },
        told: Vec::new(),
        integration_time: None,
        remarks: vec![Remark::note(remark)],
        source: Box::new(spool.finish(folder)?),
    })
}

fn name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

fn png_fault(path: &Path, error: DecodingError) -> CubeError {
    match error {
        DecodingError::IoError(reason) => CubeError::unpacking(path, reason),
        other => CubeError::data(path, format!("cannot be unpacked: {other}"), "export it again"),
    }
}

fn png_reader(path: &Path) -> Result<Reader<BufReader<File>>, CubeError> {
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    Decoder::new(BufReader::new(file)).read_info().map_err(|error| png_fault(path, error))
}

pub(crate) fn png_plane(path: &Path) -> Result<Plane, CubeError> {
    let reader = png_reader(path)?;
    let info = reader.info();
    let number_type = match (info.color_type, info.bit_depth) {
        (ColorType::Grayscale, BitDepth::Eight) => NumberType::U8,
        (ColorType::Grayscale, BitDepth::Sixteen) => NumberType::U16,
        other => return Err(not_gray(path, "the picture", other)),
    };
    let samples = info.width as usize;
    let lines = info.height as usize;
    Ok(Plane { samples, lines, bands: 1, number_type })
}

/// Unpacks the picture row by row as the band `band`.
pub(crate) fn unpack_png(
    path: &Path,
    plane: Plane,
    band: usize,
    spool: &mut Spool,
) -> Result<(), CubeError> {
    let mut reader = png_reader(path)?;
    if reader.info().interlaced {
        let problem = "is interlaced, so that its rows do not follow each other";
        return Err(CubeError::format(path, problem, "save it without interlacing"));
    }
    let mut line = 0;
    while let Some(row) = reader.next_row().map_err(|error| png_fault(path, error))? {
        match plane.number_type {
            NumberType::U16 => {
                let (numbers, _) = row.data().as_chunks::<2>();
                let bytes: Vec<u8> = numbers
                    .iter()
                    .flat_map(|&bytes| u16::from_be_bytes(bytes).to_ne_bytes())
                    .collect();
                spool.write((line, 0, band), &bytes)?;
            }
            _ => spool.write((line, 0, band), row.data())?,
        }
        line += 1;
    }
    Ok(())
}

/// Tag in which GDAL stores its metadata as XML.
const GDAL_METADATA: u16 = 42112;

/// We read at most this many bands, so that a file with pages in a circle ends.
const MOST_BANDS: usize = 65_536;

/// Whether a file begins as TIFF or BigTIFF.
pub(crate) fn is_tiff(start: &[u8]) -> bool {
    [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|magic| start.starts_with(*magic))
}

type Pages = TiffDecoder<BufReader<File>>;

fn tiff_fault(path: &Path, error: TiffError) -> CubeError {
    match error {
        TiffError::IoError(reason) => CubeError::unpacking(path, reason),
        TiffError::LimitsExceeded => CubeError::data(
            path,
            "has strips or tiles of more than 256 MB, or more than 100,000 of them",
            "save it in strips of a few rows: tifffile.imwrite(.., rowsperstrip=16)",
        ),
        other => CubeError::data(
            path,
            format!("cannot be unpacked: {}", foreign_message(&other)),
            "save it without packing, or packed by deflate or LZW",
        ),
    }
}

/// Opens the pages of the file at `path`.
pub(crate) fn tiff_pages(path: &Path) -> Result<Pages, CubeError> {
    let file = File::open(path).map_err(|reason| CubeError::reading(path, reason))?;
    TiffDecoder::new(BufReader::new(file)).map_err(|error| tiff_fault(path, error))
}

/// Size and numbers of the current page of the decoder.
pub(crate) fn tiff_plane(pages: &mut Pages, path: &Path, place: &str) -> Result<Plane, CubeError> {
    let colors = pages.colortype().map_err(|error| tiff_fault(path, error))?;
    let bands = match colors {
        TiffColor::Gray(_) => 1,
        TiffColor::Multiband { num_samples, .. } => usize::from(num_samples),
        _ => return Err(not_gray(path, place, colors)),
    };
    let (width, height) = pages.dimensions().map_err(|error| tiff_fault(path, error))?;
    if width == 0 || height == 0 {
        return Err(CubeError::format(path, format!("{place} has no pixels"), "export it again"));
    }
    // The first part tells the type of the numbers.
    let first = pages.read_chunk(0).map_err(|error| tiff_fault(path, error))?;
    let (number_type, _) = bytes_of(first);
    Ok(Plane { samples: width as usize, lines: height as usize, bands, number_type })
}

/// Whether the page is stored plane by plane (PlanarConfiguration 2).
fn has_parts_of_bands(pages: &mut Pages, path: &Path) -> Result<bool, CubeError> {
    let order = pages.find_tag_unsigned::<u16>(Tag::PlanarConfiguration);
    let order = order.map_err(|error| tiff_fault(path, error))?;
    Ok(order == Some(PlanarConfiguration::Planar.to_u16()))
}

/// Unpacks the current page of the decoder part by part, as `band` and the bands after it.
pub(crate) fn unpack_tiff(
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
        let (found, bytes) =
            bytes_of(pages.read_chunk(index).map_err(|error| tiff_fault(path, error))?);
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

/// Type and bytes of numbers, in the byte order of this machine.
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

/// Finds the list of wavelengths beside a TIFF file.
fn list_beside(path: &Path) -> Option<PathBuf> {
    let named = ["txt", "csv"].map(|ending| path.with_extension(ending));
    let common = ["wavelengths.txt", "wavelengths.csv"].map(|name| path.with_file_name(name));
    named.into_iter().chain(common).find(|place| place.is_file())
}

/// GDAL's metadata of the current page of the decoder.
fn gdal_metadata(pages: &mut Pages, path: &Path) -> Result<GdalMetadata, CubeError> {
    let tag =
        pages.find_tag(Tag::Unknown(GDAL_METADATA)).map_err(|error| tiff_fault(path, error))?;
    let text = tag.and_then(|value| value.into_string().ok()).unwrap_or_default();
    Ok(GdalMetadata::parse(&text))
}

/// Value that marks pixels without data, from the tag of GDAL.
fn ignored(pages: &mut Pages, path: &Path) -> Result<Option<f64>, CubeError> {
    let tag = pages.find_tag(Tag::GdalNodata).map_err(|error| tiff_fault(path, error))?;
    let text = tag.and_then(|value| value.into_string().ok()).unwrap_or_default();
    Ok(text.trim_matches(['\0', ' ']).parse().ok())
}

/// Opens a TIFF file with a page for each wavelength, or with several values a pixel in its pages,
/// first page first. We take the wavelengths from the settings, from a list beside the file, or from
/// GDAL's metadata.
pub(crate) fn open_pages(path: &Path, options: &CubeOptions) -> Result<Opened, CubeError> {
    let mut decoder = tiff_pages(path)?;
    let first = tiff_plane(&mut decoder, path, "page 1")?;
    let mut metadata = gdal_metadata(&mut decoder, path)?;
    let ignore = ignored(&mut decoder, path)?;
    let mut pages = Vec::new();
    let mut count = 1;
    while decoder.more_images() {
        if count * first.bands >= MOST_BANDS {
            let problem = format!("has more than {MOST_BANDS} bands in its pages");
            return Err(CubeError::format(path, problem, "export a page a wavelength"));
        }
        decoder.next_image().map_err(|error| tiff_fault(path, error))?;
        count += 1;
        let place = format!("page {count}");
        tiff_plane(&mut decoder, path, &place)?.check_like(first, path, &place)?;
        pages.push(gdal_metadata(&mut decoder, path)?);
    }
    if !pages.is_empty() {
        let of_first = std::mem::take(&mut metadata);
        for (page, found) in std::iter::once(of_first).chain(pages).enumerate() {
            metadata.add_page(found, page * first.bands);
        }
    }
    let mut place = path.to_owned();
    if let Some((beside, found)) = GdalMetadata::beside(path)? {
        metadata.merge(found);
        place = beside;
    }
    let bands = count * first.bands;
    let (each, has) = match first.bands {
        1 => ("a page", format!("{count} pages")),
        _ => ("a band", format!("{bands} bands")),
    };
    let mut remarks = Vec::new();
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
            let found = metadata.wavelengths(bands).map_err(|problem| {
                let way_out = format!("give one wavelength in nm {each} with [wavelengths=FILE]");
                CubeError::format(&place, format!("the metadata of GDAL {problem}"), way_out)
            })?;
            found.map(|found| {
                remarks.extend(found.remark.map(Remark::note));
                found.nm
            })
        }
    };
    let nm = match (nm, &options.wavelengths) {
        (Some(nm), _) => Some(nm),
        (None, Some(_)) => None,
        (None, None) => {
            return Err(CubeError::format(
                path,
                format!(
                    "has {has}, but no list of their wavelengths is beside it, nor do metadata of GDAL name them"
                ),
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
        decoder.seek_to_image(page).map_err(|error| tiff_fault(path, error))?;
        unpack_tiff(&mut decoder, path, first, page * first.bands, &mut spool)?;
    }
    Ok(Opened {
        path: path.to_owned(),
        lines: first.lines,
        samples: first.samples,
        bands,
        wavelengths_nm: nm,
        fwhm_nm: None,
        good: vec![true; bands],
        ignore,
        values: metadata
            .values(bands)
            .unwrap_or(Values::Unknown { are_whole: first.number_type.is_whole() }),
        told: metadata.told(),
        integration_time: None,
        remarks,
        source: Box::new(spool.finish(path)?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_are_ordered_by_value() {
        let mut names = ["b10.png", "b9.png", "a.png", "b9-2.png", "b100.png"];
        names.sort_by_cached_key(|name| natural(name));
        assert_eq!(names, ["a.png", "b9-2.png", "b9.png", "b10.png", "b100.png"]);
    }
}
