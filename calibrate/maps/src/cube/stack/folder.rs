//! A folder with a picture a wavelength and the list of their wavelengths.

use std::path::{Path, PathBuf};

use super::plane::Plane;
use super::{png_plane, tiff_pages};
use crate::cube::error::CubeError;
use crate::cube::opened::{Opened, Values};
use crate::cube::options::CubeOptions;
use crate::cube::raw_file::Interleave;
use crate::cube::spool::Spool;
use crate::cube::wavelength_file::wavelengths_of;

/// Files of a folder that have one of these endings, in the order in which people number them.
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

/// A name as texts and numbers in turn, so that `band 10` comes after `band 9`.
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

/// Whether `folder` holds pictures whose wavelengths are known.
pub(crate) fn is_stack(folder: &Path, options: &CubeOptions) -> bool {
    let known = options.wavelengths.is_some() || list_inside(folder).is_some();
    known && !pictures(folder).is_empty()
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

fn plane_of(path: &Path) -> Result<Plane, CubeError> {
    if is_png(path) {
        return png_plane::plane(path);
    }
    let mut pages = tiff_pages::pages(path)?;
    if pages.more_images() {
        let problem = "has several pages, expected one picture a file";
        return Err(CubeError::format(path, problem, "open the file itself, not its folder"));
    }
    let plane = tiff_pages::plane(&mut pages, path, "the picture")?;
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
            png_plane::unpack(picture, plane, band, &mut spool)?;
        } else {
            let mut pages = tiff_pages::pages(picture)?;
            tiff_pages::unpack(&mut pages, picture, plane, band, &mut spool)?;
        }
    }
    let name = |path: &Path| {
        path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
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
        integration_time: None,
        remarks: vec![remark],
        source: Box::new(spool.finish(folder)?),
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
