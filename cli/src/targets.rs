//! Colours to be met: `#rrggbb`, Lab, or measured spectra.

use std::path::{Path, PathBuf};

use calibrate::matching::{Sight, Target};
use spectra::color::{Adaptation, Lab, Rgb, RgbSpace};
use spectra::{Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::Refusal;
use crate::input::remark_coverage;
use crate::named_spectra::{matching, named_spectra};
use crate::readings::{ReadingOptions, spectra};

/// The targets that `text` names: one colour, or the spectra of FILE or
/// FILE#SAMPLE.
///
/// A colour without a spectrum is wanted to look the same under every sight. An
/// sRGB colour is adapted (Bradford) from the display's white to the light's.
pub(crate) fn targets(
    text: &str,
    sights: &[Sight],
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> anyhow::Result<Vec<Target>> {
    let (file, sample) = match text.rsplit_once('#') {
        Some((file, sample)) if !Path::new(text).is_file() => (file, Some(sample)),
        _ => (text, None),
    };
    if Path::new(file).is_file() {
        return measured(file, sample, sights, reading, console);
    }
    if let Some(rgb) = Rgb::from_hex(text) {
        // Any white: Lab is relative to it.
        let white = RgbSpace::Srgb.white();
        let xyz = RgbSpace::Srgb.xyz_from_encoded(rgb, white, Adaptation::Bradford);
        return Ok(vec![Target::from_lab(&rgb.to_hex(), Lab::from_xyz(xyz, white), sights)]);
    }
    if let Some(lab) = lab(text) {
        return Ok(vec![Target::from_lab(&format!("Lab {text}"), lab, sights)]);
    }
    Err(Refusal::usage(
        format!("a target is #rrggbb, L,a,b or a file of spectra, found `{text}`"),
        "try \"#4a7d8c\", 52,-10.5,8 or swatches.csv#NAME",
    ))
}

/// Three numbers parted by commas or spaces, L* from 0 to 100.
fn lab(text: &str) -> Option<Lab> {
    let parts = text.split([',', ' ']).filter(|part| !part.is_empty());
    let numbers: Vec<f64> = parts.map(str::parse).collect::<Result<_, _>>().ok()?;
    match numbers[..] {
        [lightness, a, b]
            if (0.0..=100.0).contains(&lightness) && a.abs() <= 300.0 && b.abs() <= 300.0 =>
        {
            Some(Lab { lightness, a, b })
        }
        _ => None,
    }
}

fn measured(
    file: &str,
    sample: Option<&str>,
    sights: &[Sight],
    reading: &ReadingOptions,
    console: &mut Console<'_>,
) -> anyhow::Result<Vec<Target>> {
    let table = spectra(&[PathBuf::from(file)], reading, console)?;
    remark_coverage(table.grid, console)?;
    let found = named_spectra(&table);
    let names: Vec<(&str, &str)> =
        found.iter().map(|s| (s.name.as_str(), s.sample.as_str())).collect();
    let chosen = match sample {
        Some(sample) => matching(&names, sample)?,
        None => (0..found.len()).collect(),
    };
    let target = |index: usize| {
        let reflectance =
            Spectrum::<Reflectance>::new(table.grid, found[index].reflectance.clone())?;
        Ok(Target::from_reflectance(&found[index].name, &reflectance, sights)?)
    };
    chosen.into_iter().map(target).collect()
}
