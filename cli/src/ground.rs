//! What lies under a film: a grey, or a measured spectrum.

use calibrate::library::PigmentLibrary;
use spectra::{Extrapolation, Interpolation, Reflectance, Spectrum};

use crate::console::Console;
use crate::failure::Refusal;
use crate::named_spectra::{Chosen, chosen, first_few};
use crate::readings::ReadingOptions;

/// The ground's measured reflectance on the library's grid.
pub(crate) fn ground(
    text: &str,
    library: &PigmentLibrary,
    console: &mut Console<'_>,
) -> anyhow::Result<Vec<f64>> {
    let even = match text {
        "white" => Some(1.0),
        "black" => Some(0.0),
        _ => text.parse().ok().filter(|v| (0.0..=1.0).contains(v)),
    };
    if let Some(value) = even {
        return Ok(vec![value; library.grid.count()]);
    }
    let Some(Chosen { file, grid, spectra }) = chosen(text, &ReadingOptions::default(), console)?
    else {
        return Err(Refusal::usage(
            format!("--over takes 0 to 1, white, black or a file that exists, found `{text}`"),
            "try --over 0.85 or --over paper.csv#SAMPLE",
        ));
    };
    let [one] = spectra.as_slice() else {
        let names: Vec<&str> = spectra.iter().map(|one| one.name.as_str()).collect();
        return Err(Refusal::data(
            format!("{file}: one ground is wanted, found `{}` spectra", names.len()),
            format!("name one: --over \"{file}#NAME\", with NAME {}", first_few(&names, " or ")),
        ));
    };
    let spectrum = Spectrum::<Reflectance>::new(grid, one.reflectance.clone())?;
    let (start, end) = (grid.start_nm(), grid.end_nm());
    if start > library.grid.end_nm() || end < library.grid.start_nm() {
        return Err(Refusal::data(
            format!("{file}: the ground is measured from {start} to {end} nm only"),
            format!("the library stands on {}", library.grid),
        ));
    }
    if start > library.grid.start_nm() || end < library.grid.end_nm() {
        console.warnings(&[format!(
            "the ground is measured from {start} to {end} nm; beyond, its end values are held"
        )])?;
    }
    let method = Interpolation::best_for(grid);
    Ok(spectrum.resampled(library.grid, method, Extrapolation::Hold)?.into_values())
}
