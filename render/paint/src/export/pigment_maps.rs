//! Maps of the amount of each pigment, and spectral OpenEXR files. Use the maps to reproduce a
//! painting by printer, plotter or hand.
//!
//! Spectral files follow the layout of A. Fichet, R. Pacanowski and A. Wilkie, "An OpenEXR Layout
//! for Spectral Images" (Journal of Computer Graphics Techniques 10(3), 2021). For a reflective
//! image they have a channel per wavelength, for example `T.550,000000nm` (with a decimal comma,
//! since a dot separates layers). Programs that do not know spectra read R, G and B. Attribute
//! `spectralLayoutVersion` is "1.0". Reflectance does not have a unit, so we need no other
//! attributes.

use exr::image::FlatSamples;
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::LayerAttributes;
use graphics::export::{ExportError, check_cell, check_size, exr_file, grey16, rgb_channels};
use graphics::field::Field;
use serde_json::json;

/// Amounts of one pigment.
#[derive(Debug, Clone, PartialEq)]
pub struct PigmentMap {
    /// Name of the pigment, or `vehicle`.
    pub name: String,
    /// Height of the paint in mm, for every cell.
    pub height_mm: Field<f32>,
}

/// A file in memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedFile {
    /// File name, without a folder.
    pub name: String,
    /// Content of the file.
    pub bytes: Vec<u8>,
}

/// Encodes maps as files: for each a 16-bit grey PNG `STEM.PIGMENT.png`, for their sum
/// `STEM.thickness.png`, the scale in `STEM.maps.json`, and a table of each pigment's
/// total in `STEM.recipe.csv`.
///
/// All PNGs have one scale, so that you can compare them: the value 65535 is the greatest height in
/// mm of all paint together in one cell (`mm_at_65535`). Cells are `cell_mm` wide. The PNGs store
/// that in `pHYs`.
///
/// # Errors
/// [`ExportError`] for maps of different sizes or without cells, a cell size out of
/// range, and amounts that are negative or not finite.
pub fn pigment_maps(
    stem: &str,
    maps: &[PigmentMap],
    cell_mm: f64,
) -> Result<Vec<NamedFile>, ExportError> {
    check_cell(cell_mm)?;
    let bounds = maps.first().map(|map| map.height_mm.bounds()).unwrap_or_default();
    check_size(bounds.width, bounds.height)?;
    for map in maps {
        check_map(map, bounds.width, bounds.height)?;
    }
    let mut thickness = Field::filled(bounds.width, bounds.height, 0.0_f64);
    for map in maps {
        for (sum, &mm) in thickness.values_mut().iter_mut().zip(map.height_mm.values()) {
            *sum += f64::from(mm);
        }
    }
    let thickest = thickness.values().iter().copied().fold(0.0, f64::max);

    let mut names = FileNames::default();
    let mut files = Vec::new();
    let mut listed = Vec::new();
    let mut picture = |title: &str, name: String, values: Field<u16>| {
        let scale = format!("{thickest} mm at 65535");
        let bytes = grey16(&values, cell_mm, &[("Title", title), ("Description", &scale)])?;
        files.push(NamedFile { name, bytes });
        Ok::<_, ExportError>(())
    };
    for map in maps {
        let name = format!("{stem}.{}.png", names.name(&map.name));
        let values =
            map.height_mm.values().iter().map(|&mm| scaled(f64::from(mm), thickest)).collect();
        let values = Field::from_values(bounds.width, bounds.height, values);
        listed.push(json!({"pigment": map.name, "file": name}));
        picture(&map.name, name, values)?;
    }
    let name = format!("{stem}.{}.png", names.name("thickness"));
    let total = json!({"file": name});
    let values = thickness.values().iter().map(|&mm| scaled(mm, thickest)).collect();
    picture("thickness", name, Field::from_values(bounds.width, bounds.height, values))?;

    let sidecar = json!({
        "format": "impasto-pigment-maps",
        "version": 1,
        "cell_mm": cell_mm,
        "width_mm": rounded(bounds.width as f64 * cell_mm),
        "height_mm": rounded(bounds.height as f64 * cell_mm),
        "mm_at_65535": thickest,
        "maps": listed,
        "thickness": total,
    });
    let sidecar = pigment::library::to_text(&sidecar);
    files.push(NamedFile { name: format!("{stem}.maps.json"), bytes: sidecar.into_bytes() });
    let recipe = recipe(maps, cell_mm);
    files.push(NamedFile { name: format!("{stem}.recipe.csv"), bytes: recipe.into_bytes() });
    Ok(files)
}

fn scaled(mm: f64, thickest: f64) -> u16 {
    if thickest > 0.0 { (mm / thickest * 65535.0).round() as u16 } else { 0 }
}

fn check_map(map: &PigmentMap, width: usize, height: usize) -> Result<(), ExportError> {
    let PigmentMap { name, height_mm } = map;
    if (height_mm.width(), height_mm.height()) != (width, height) {
        return Err(ExportError::Differs { plane: name.clone(), width, height });
    }
    let Some(at) = height_mm.values().iter().position(|mm| !(mm.is_finite() && *mm >= 0.0)) else {
        return Ok(());
    };
    let x = at % width;
    let y = at / width;
    let found = height_mm.values()[at];
    let what = name.clone();
    Err(if found < 0.0 && found.is_finite() {
        ExportError::Negative { what, x, y, found }
    } else {
        ExportError::NotFinite { what, x, y, found }
    })
}

/// CSV table with a row per pigment: total, mean and greatest height, and coverage.
fn recipe(maps: &[PigmentMap], cell_mm: f64) -> String {
    let sums: Vec<f64> = maps
        .iter()
        .map(|map: &PigmentMap| map.height_mm.values().iter().map(|&mm| f64::from(mm)).sum())
        .collect();
    let all: f64 = sums.iter().sum();
    let mut table =
        "pigment,volume_mm3,share,mean_height_mm,greatest_height_mm,covered_share\n".to_owned();
    for (map, &sum) in maps.iter().zip(&sums) {
        let values = map.height_mm.values();
        let covered = values.iter().filter(|mm| **mm > 0.0).count();
        let greatest = f64::from(values.iter().copied().fold(0.0, f32::max));
        let figures = [
            sum * cell_mm * cell_mm,
            if all > 0.0 { sum / all } else { 0.0 },
            sum / values.len() as f64,
            greatest,
            covered as f64 / values.len() as f64,
        ];
        table.push_str(&quoted(&map.name));
        for figure in figures {
            table.push_str(&format!(",{}", rounded(figure)));
        }
        table.push('\n');
    }
    table
}

fn rounded(value: f64) -> f64 {
    pigment::digits::rounded(value)
}

/// Quotes a CSV field where needed (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Assigns file names that every file system accepts.
#[derive(Default)]
struct FileNames {
    taken: Vec<String>,
}

impl FileNames {
    fn name(&mut self, pigment: &str) -> String {
        let plain: String = pigment
            .chars()
            .map(|l| if l.is_ascii_alphanumeric() { l.to_ascii_lowercase() } else { '-' })
            .take(100)
            .collect();
        let numbered = (2..).map(|number| format!("{plain}-{number}"));
        let mut names = std::iter::once(plain.clone()).chain(numbered);
        let name = names.find(|name| !self.taken.contains(name)).unwrap_or(plain);
        self.taken.push(name.clone());
        name
    }
}

/// Encodes `planes` of reflectance (0..1) at `wavelengths_nm` with 32 bits each. It also stores
/// `picture` (linear sRGB) as R, G and B. A cell is `cell_mm` wide.
///
/// # Errors
/// [`ExportError`] unless wavelengths rise, there is one per plane, all planes have the
/// picture's size, and every value is finite.
pub fn spectral_exr(
    picture: &Field<[f32; 4]>,
    wavelengths_nm: &[f64],
    planes: &[Field<f32>],
    cell_mm: f64,
) -> Result<Vec<u8>, ExportError> {
    let width = picture.width();
    let height = picture.height();
    if wavelengths_nm.len() != planes.len() {
        let found = format!("{} wavelengths", wavelengths_nm.len());
        return Err(ExportError::Wavelength { plane: planes.len(), found });
    }
    let mut channels = rgb_channels(picture)?;
    let mut before = 0.0;
    for (index, (&nm, plane)) in wavelengths_nm.iter().zip(planes).enumerate() {
        let name = channel_name(nm);
        if !(nm.is_finite() && nm > before) || channels.iter().any(|(other, _)| *other == name) {
            return Err(ExportError::Wavelength { plane: index, found: nm.to_string() });
        }
        before = nm;
        if plane.bounds() != picture.bounds() {
            return Err(ExportError::Differs { plane: name, width, height });
        }
        if let Some(at) = plane.values().iter().position(|value| !value.is_finite()) {
            let x = at % width;
            let y = at / width;
            let found = plane.values()[at];
            let what = format!("the reflectance at {nm} nm");
            return Err(ExportError::NotFinite { what, x, y, found });
        }
        channels.push((name, FlatSamples::F32(plane.values().to_vec())));
    }
    let mut attributes = LayerAttributes::default();
    // Add at most one custom attribute. The encoder does not keep the order of several, so the
    // bytes of the file would vary.
    let version = AttributeValue::Text("1.0".into());
    attributes.other.insert(Text::from("spectralLayoutVersion"), version);
    exr_file((width, height), cell_mm, channels, attributes)
}

fn channel_name(nm: f64) -> String {
    format!("T.{}nm", format!("{nm:.6}").replace('.', ","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_named_as_published() {
        assert_eq!(channel_name(550.0), "T.550,000000nm");
        assert_eq!(channel_name(412.345_678_9), "T.412,345679nm");
    }
}
