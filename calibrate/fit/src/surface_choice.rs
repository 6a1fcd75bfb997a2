//! The surface of a fit that states none, and readings that no surface explains.

use spectra::optics::{Specular, Surface};

use crate::measurement::{MeasurementError, k1_below};
use crate::observation::least_reading;
use crate::swatch::SwatchSet;
use pigment::remark::Remark;

/// The surface of most paints, its k1 lowered below every reading of `set`; the remark tells of that.
pub(crate) fn usual_below_readings(
    set: &SwatchSet,
    specular: Specular,
) -> (Surface, Option<Remark>) {
    let usual = Surface::of_most_paints(specular);
    let least = least_reading(set);
    if least >= usual.floor() {
        return (usual, None);
    }
    let surface = Surface { k1: k1_below(least), ..usual };
    let remark = Remark::note(format!(
        "k1 = {}, not {}: {} reads {least:.4}, and a surface reflects no more than is read",
        surface.k1,
        usual.k1,
        darkest(set, least)
    ));
    (surface, Some(remark.with_hint("state the surface with [saunderson=K1,K2]")))
}

/// Name and wavelength of the reading `least` of `set`.
fn darkest(set: &SwatchSet, least: f64) -> String {
    for swatch in &set.swatches {
        for film in &swatch.films {
            for (readings, kind) in
                [(Some(&film.reflectance), ""), (film.bare.as_ref(), "the bare card under ")]
            {
                let at = readings.and_then(|all| all.iter().position(|&reading| reading == least));
                if let Some(at) = at {
                    return format!("{kind}{} at {} nm", swatch.sample, set.grid.nm(at));
                }
            }
        }
    }
    "a film".to_owned()
}

/// Refuses a set of films most of whose readings lie below `k1`: such a set is read in a wrong unit.
pub(crate) fn check_above_surface(
    set: &SwatchSet,
    k1: f64,
    k2: f64,
) -> Result<(), MeasurementError> {
    let mut below = 0;
    let mut count = 0;
    let mut first = None;
    for swatch in &set.swatches {
        let readings = || swatch.films.iter().flat_map(|film| &film.reflectance);
        let dark = readings().filter(|&&reading| reading < k1).count();
        first = first.or_else(|| (dark > 0).then_some(swatch));
        below += dark;
        count += readings().count();
    }
    match first {
        Some(swatch) if 2 * below > count => Err(MeasurementError::MostBelowSurface {
            file: swatch.file.to_string(),
            row: swatch.row,
            sample: swatch.sample.clone(),
            below,
            count,
            k1,
            below_all: format!("{:.3},{k2}", k1_below(least_reading(set))),
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use documents::hint::Explain;
    use pigment::evaluate::delta_e;

    use super::*;
    use crate::fitting::{FilmModel, FitOptions, PreparedFit, fit};
    use crate::leave_out::{ValidationOptions, validate};
    use crate::observation::BelowSurface;
    use crate::readings::Readings;

    /// Films that hide, of a white and a black paint, read without any surface, times `scale`.
    fn matte(scale: f64) -> Readings {
        let wavelengths: Vec<String> = (0..16).map(|i| (400 + 20 * i).to_string()).collect();
        let mut text = format!("sample,White,Black,{}\n", wavelengths.join(","));
        for (sample, black) in [("w", 0.0), ("a", 0.1), ("b", 0.5), ("c", 0.9), ("d", 1.0)] {
            let k = 0.013 * (1.0 - black) + 20.0 * black;
            let s = 1.0 - 0.5 * black;
            let value = scale * spectra::optics::infinite_film_from_ratio(k / s);
            let values = vec![value.to_string(); wavelengths.len()].join(",");
            text += &format!("{sample},{},{black},{values}\n", 1.0 - black);
        }
        Readings::from_csv("matte.csv", text.as_bytes()).unwrap()
    }

    fn floored() -> FitOptions {
        let below_surface = Some(BelowSurface::Floor);
        FitOptions {
            surface: Some(Surface::of_most_paints(Specular::Included)),
            below_surface,
            ..FitOptions::default()
        }
    }

    #[test]
    fn errors_are_told_against_readings_as_they_were_read() {
        let readings = matte(1.0);
        let options = floored();
        let fitted = fit(&readings, &options).unwrap();
        let library = &fitted.library;
        let weights = options.viewing.weights(library.grid).unwrap();
        for (sample, black) in [("c", 0.9), ("d", 1.0)] {
            let recipe = [("White", 1.0 - black), ("Black", black)];
            let recipe = recipe.map(|(name, share)| (library.find(name).unwrap(), share));
            let predicted = library.mix(recipe).unwrap();
            let read = &readings.table.readings.iter().find(|r| r.sample == sample).unwrap();
            let truth = delta_e(&weights, &read.reflectance, &predicted.hiding(library.saunderson));
            let told = fitted.evidence().per_sample.iter().find(|s| s.sample == sample).unwrap();
            assert!(truth > 2.0, "the surface reflects more than was read: {truth}");
            assert!((told.delta_e - truth).abs() < 1e-3, "{sample}: {} for {truth}", told.delta_e);
        }
        let left_out = ValidationOptions { fit: options, ..ValidationOptions::default() };
        let worst = validate(&readings, &left_out).unwrap().errors.delta_e.max;
        assert!(worst > 2.0, "{worst}");
    }

    #[test]
    fn a_k1_that_nobody_stated_stays_below_every_reading() {
        let readings = matte(1.0);
        let fitted = fit(&readings, &FitOptions::default()).unwrap();
        let least = least_reading(&readings.swatches().unwrap());
        assert!(fitted.library.saunderson.k1 < least, "{:?}", fitted.library.saunderson);
        let told = fitted.remarks.iter().find(|remark| remark.text.starts_with("k1 = "));
        let told = &told.unwrap().text;
        assert!(told.contains("not 0.03") && told.contains("d at 400 nm"), "{told}");
        assert!(fitted.evidence().delta_e.max < 1.0, "{:?}", fitted.evidence().delta_e);

        // Readings above the usual k1 keep it, and so does who says how those below are treated.
        let mut lighter = matte(1.0);
        let reflectances = lighter.table.readings.iter_mut().flat_map(|r| &mut r.reflectance);
        reflectances.for_each(|value| *value = value.max(0.04));
        for (readings, below_surface) in [(&lighter, None), (&readings, Some(BelowSurface::Floor))]
        {
            let options = FitOptions { below_surface, ..FitOptions::default() };
            let prepared =
                PreparedFit::new(readings, &options, crate::fit::Watch::default()).unwrap();
            let FilmModel::Relative { surface, .. } = prepared.model else { panic!("relative") };
            assert_eq!(surface.k1, 0.03);
        }
    }

    #[test]
    fn readings_mostly_below_k1_are_refused_with_a_way_out() {
        let readings = matte(0.01);
        for options in [FitOptions::default(), floored()] {
            let error = fit(&readings, &options).unwrap_err();
            let said = error.to_string();
            assert!(said.contains("matte.csv, row 2") && said.contains("80 of 80"), "{said}");
            let hint = error.hint().unwrap().to_string();
            assert!(hint.contains("fraction") && hint.contains("saunderson"), "{hint}");
        }
    }
}
