//! Films over two cards whose names may be exchanged.

use crate::measurement::{DarkerFilm, MeasurementError};
use crate::observation::{LEAST_CONTRAST, alike};
use crate::swatch::{Swatch, SwatchFilm, SwatchSet};

/// Reflectance by which a film may be darker over the brighter card, for the error of two readings: that
/// of the Van Gogh oils is 0.013 at most.
const READING_ERROR: f64 = 0.02;
/// Standard deviations of repeated readings that are taken for chance.
const CHANCE: f64 = 3.0;

/// Refuses films that are darker over the brighter of two cards, which no film of paint can be.
///
/// # Errors
/// [`MeasurementError::DarkerOverBrighter`] for the first such sample.
pub(crate) fn check_backings(set: &SwatchSet) -> Result<(), MeasurementError> {
    let mut faults = set.swatches.iter().filter_map(|swatch| fault(set, swatch));
    faults.next().map_or(Ok(()), |first| {
        let film = DarkerFilm { others: faults.count(), ..first };
        Err(MeasurementError::DarkerOverBrighter(Box::new(film)))
    })
}

fn fault(set: &SwatchSet, swatch: &Swatch) -> Option<DarkerFilm> {
    let pairs =
        swatch.films.iter().flat_map(|bright| swatch.films.iter().map(move |d| (bright, d)));
    let (bright, dark, places) = pairs
        .filter(|(bright, dark)| alike(bright.thickness_mm, dark.thickness_mm))
        .map(|(bright, dark)| (bright, dark, darker(bright, dark)))
        .find(|(_, _, places)| !places.is_empty())?;
    let by = |&at: &usize| dark.reflectance[at] - bright.reflectance[at];
    let worst = places.iter().copied().max_by(|a, b| by(a).total_cmp(&by(b)))?;
    Some(DarkerFilm {
        file: swatch.file.to_string(),
        row: swatch.row,
        sample: swatch.sample.clone(),
        bright: bright.backing.clone(),
        dark: dark.backing.clone(),
        by: by(&worst),
        nm: set.grid.nm(worst),
        band_nm: [places[0], places[places.len() - 1]].map(|at| set.grid.nm(at)),
        others: 0,
    })
}

/// Wavelengths at which the film over the card that is brighter there is the darker one.
fn darker(bright: &SwatchFilm, dark: &SwatchFilm) -> Vec<usize> {
    let (Some(bright_bare), Some(dark_bare)) = (&bright.bare, &dark.bare) else {
        return Vec::new();
    };
    let spread = bright.spread.unwrap_or(0.0).max(dark.spread.unwrap_or(0.0));
    let allowed = READING_ERROR.max(CHANCE * spread);
    (0..bright.reflectance.len())
        .filter(|&at: &usize| {
            bright_bare[at] - dark_bare[at] > LEAST_CONTRAST
                && dark.reflectance[at] - bright.reflectance[at] > allowed
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use documents::hint::Explain;

    use crate::fitting::{FitOptions, fit};
    use crate::library::AmountKind;
    use crate::readings::Readings;

    /// Thin films of a white and a red over two cards; those of sample b are named as `b` says.
    fn thin(b: [&str; 2]) -> Readings {
        let text = format!(
            "sample,film,backing,White,Red,400,500,600,700\n\
             card,none,white,,,0.85,0.86,0.87,0.87\ncard,none,black,,,0.05,0.05,0.05,0.05\n\
             w,paint,white,1,,0.83,0.84,0.85,0.85\nw,paint,black,1,,0.6,0.55,0.5,0.48\n\
             r,paint,white,,1,0.1,0.12,0.6,0.7\nr,paint,black,,1,0.09,0.1,0.3,0.4\n\
             b,paint,{},1,1,0.3,0.32,0.75,0.78\nb,paint,{},1,1,0.25,0.27,0.45,0.46\n",
            b[0], b[1]
        );
        Readings::from_csv("thin.csv", text.as_bytes()).unwrap()
    }

    #[test]
    fn a_film_darker_over_the_brighter_card_is_refused() {
        for amounts in [AmountKind::Relative, AmountKind::Absolute] {
            let options = FitOptions { amounts, ..FitOptions::default() };
            assert!(fit(&thin(["white", "black"]), &options).is_ok(), "{amounts:?}");
            let exchanged = thin(["black", "white"]);
            let error = fit(&exchanged, &options).unwrap_err();
            let said = error.to_string();
            for word in ["thin.csv, row 8", "sample b", "0.320 at 700 nm", "400 to 700 nm"] {
                assert!(said.contains(word), "`{word}` is missing: {said}");
            }
            let hint = error.hint().unwrap().to_string();
            assert!(hint.contains("exchanged") && hint.contains("exclude"), "{hint}");
            let without = FitOptions { exclude: vec!["b".to_owned()], ..options };
            assert!(fit(&exchanged, &without).is_ok(), "{amounts:?}");
        }
    }
}
