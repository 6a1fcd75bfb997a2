//! The pigments of a library that take part in a map, and remarks on those with an unknown S.
//!
//! K/S of a masstone is known, S is not. A film of several paints shows only the ratio of K and S, so a
//! wrong level of S acts like another share: the map sees that the pigment is there, and is wrong about
//! how much of it. A masstone that looks like a measured pigment would only compete with it.

use std::collections::BTreeMap;

use pigment::evaluate::Remark;
use pigment::library::{Pigment, PigmentLibrary};
use pigment::{PigmentId, RecipeError};

use super::book::Prepared;
use super::groups::Confusion;
use crate::films::settings::{MapSettings, ModelError};
use crate::pixel_maps::{BlockMaps, MapError};

/// A masstone alone leaves the level of S open by this factor, as the fit states it.
pub(crate) const UNKNOWN_LEVEL: f64 = 4.0;
/// A masstone takes no part if you take it for a measured pigment with this probability or a higher one.
/// Its S is assumed, so we ask for a clearer difference than between measured pigments.
pub(crate) const LIKE_MEASURED: f64 = 0.001;

/// The pigments that take part in a map.
#[derive(Debug, Clone)]
pub(crate) struct Palette {
    /// Names as the library has them.
    pub(crate) names: Vec<String>,
    pub(crate) left_out: Vec<String>,
    pub(crate) remarks: Vec<Remark>,
}

impl Palette {
    /// The pigments that the settings name, or all that were measured, and masstones that do not look
    /// like one of these.
    ///
    /// # Errors
    /// [`MapError`] if wavelengths, library and settings do not fit together, or a name is unknown.
    pub(crate) fn new(
        library: &PigmentLibrary,
        wavelengths: &[f64],
        settings: &MapSettings,
        model_error: &ModelError,
    ) -> Result<Self, MapError> {
        let mut places: Vec<PigmentId> = match settings.palette.is_empty() {
            true => usual(library, wavelengths, settings, model_error)?,
            false => {
                let places = settings.palette.iter().map(|name| library.find(name));
                places.collect::<Result<_, RecipeError>>()?
            }
        };
        places.sort_unstable();
        places.dedup();
        let is_left_out = |id: &PigmentId| settings.palette.is_empty() && !places.contains(id);
        let left_out = library.ids().filter(is_left_out).map(|id| library[id].name.clone());
        let left_out: Vec<String> = left_out.collect();
        let names: Vec<String> = places.iter().map(|id| library[*id].name.clone()).collect();
        let remarks = remarks(library, &left_out, &names);
        Ok(Self { names, left_out, remarks })
    }
}

/// The pigments of a map if the settings name none.
fn usual(
    library: &PigmentLibrary,
    wavelengths: &[f64],
    settings: &MapSettings,
    model_error: &ModelError,
) -> Result<Vec<PigmentId>, MapError> {
    let all: Vec<PigmentId> = library.ids().filter(|id| !library[*id].guessed).collect();
    let measured = |id: &PigmentId| library[*id].identified;
    let known: Vec<PigmentId> = all.iter().copied().filter(measured).collect();
    if known.len() < 2 {
        // A set of masstones, alone or beside their white.
        return Ok(all);
    }
    if known.len() == all.len() || all.len() > BlockMaps::MOST_PIGMENTS {
        return Ok(known);
    }
    let palette = all.iter().map(|id| library[*id].name.clone()).collect();
    let settings = MapSettings { palette, ..settings.clone() };
    let confusion = confusion(library, wavelengths, &settings, model_error)?;
    let takes_part = |place: usize| {
        let mut others = (0..all.len()).filter(|&other| measured(&all[other]));
        measured(&all[place]) || others.all(|other| confusion.of(place, other) < LIKE_MEASURED)
    };
    Ok((0..all.len()).filter(|&place| takes_part(place)).map(|place| all[place]).collect())
}

/// How likely you take each pigment of the settings' palette for another, within twice the stated error of
/// the library, or within the errors of left-out mixtures. If we used the stated error once, we would often
/// take a measured oil for another of its kind.
pub(crate) fn confusion(
    library: &PigmentLibrary,
    wavelengths: &[f64],
    settings: &MapSettings,
    model_error: &ModelError,
) -> Result<Confusion, MapError> {
    let wide = match model_error {
        ModelError::Residuals(_) => model_error.clone(),
        ModelError::Stated(relative) => ModelError::Stated((2.0 * relative).min(1.0)),
    };
    let prepared = Prepared::new(library, wavelengths, settings, &wide)?;
    Ok(Confusion::new(&prepared.engine, &prepared.paints))
}

/// Why K and S of a pigment are not known, and how you measure them.
fn why_unknown(pigment: &Pigment, takes_part: bool) -> Option<(&'static str, &'static str)> {
    match (pigment.guessed, pigment.identified) {
        (true, _) => Some(("guessed from a colour, not measured", "measure them and fit again")),
        (false, false) => Some((
            match takes_part {
                true => "measured as masstones only, so that S is assumed",
                false => "measured as masstones only, and too like measured pigments",
            },
            "measure mixtures of them, for example with white, and fit again",
        )),
        (false, true) => None,
    }
}

/// Remarks on pigments with an unknown S: those in `left_out`, and those among the `names` that take part.
fn remarks(library: &PigmentLibrary, left_out: &[String], names: &[String]) -> Vec<Remark> {
    let all = library.ids().count();
    let mut remarks = Vec::new();
    for (listed, takes_part) in [(left_out, false), (names, true)] {
        let mut by_reason: BTreeMap<(&str, &str), Vec<&str>> = BTreeMap::new();
        for pigment in library.ids().map(|id| &library[id]).filter(|p| listed.contains(&p.name)) {
            if let Some(reason) = why_unknown(pigment, takes_part) {
                by_reason.entry(reason).or_default().push(&pigment.name);
            }
        }
        for ((why, way_out), found) in by_reason {
            let count = found.len();
            let found = found.join(", ");
            remarks.push(match takes_part {
                true => Remark::warning(format!(
                    "shares of {found} may be off by a factor of {UNKNOWN_LEVEL} ({why})"
                ))
                .with_hint(way_out),
                false => Remark::note(format!(
                    "{count} of {} no part, so that others stand in for them: {found} ({why})",
                    documents::counted_as(all, "pigment takes", "pigments take")
                ))
                .with_hint(format!(
                    "{way_out}; if you name one with [palette], it takes part with an assumed S"
                )),
            });
        }
    }
    remarks
}

#[cfg(test)]
mod tests {
    use documents::Task;

    use super::*;
    use crate::mapping::Mapper;

    fn palette(library: &PigmentLibrary) -> Palette {
        let nm: Vec<f64> = library.grid.wavelengths_nm().collect();
        Palette::new(library, &nm, &MapSettings::default(), &ModelError::Stated(0.1)).unwrap()
    }

    /// The oils, with S of `names` assumed as for masstones: one number at all wavelengths, which is
    /// wrong by a factor of 2.
    fn masstones(names: &[&str]) -> PigmentLibrary {
        let mut oils = PigmentLibrary::van_gogh_oils();
        for name in names {
            let id = oils.find(name).unwrap();
            let pigment = &mut oils.pigments[id.0];
            let level =
                2.0 * pigment.scattering.iter().sum::<f64>() / pigment.scattering.len() as f64;
            for (k, s) in pigment.absorption.iter_mut().zip(&mut pigment.scattering) {
                (*k, *s) = (level * *k / *s, level);
            }
            pigment.identified = false;
        }
        oils
    }

    #[test]
    fn masstones_take_part_if_no_measured_pigment_looks_like_them() {
        let shipped = palette(&PigmentLibrary::van_gogh_oils());
        assert_eq!(shipped.left_out, ["Zinc White (linseed)", "Chrome Yellow (poppyseed)"]);
        assert_eq!(shipped.names.len(), 18);
        let palette = palette(&masstones(&["Vermilion", "Zinc White"]));
        assert!(palette.names.contains(&"Vermilion".to_owned()), "{palette:?}");
        assert!(
            palette.left_out.contains(&"Zinc White".to_owned()),
            "like lead white: {palette:?}"
        );
        let words: Vec<String> = palette.remarks.iter().map(ToString::to_string).collect();
        assert!(words[0].starts_with("3 of 20 pigments take no part"), "{words:?}");
        assert!(words[1].starts_with("warning: shares of Vermilion may be off by a factor of 4"));
    }

    #[test]
    fn a_masstone_is_found_and_its_share_is_doubtful() {
        let oils = PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let recipe = oils.recipe([("Lead White", 0.6), ("Vermilion", 0.4)]).unwrap();
        let pink = oils.mix(recipe).unwrap().hiding(oils.saunderson);
        let pink: Vec<f32> = pink.iter().map(|r| *r as f32).collect();
        let map = |library: &PigmentLibrary| {
            let mapper = Mapper::new(library, &nm, &MapSettings::default()).unwrap();
            let maps = mapper.map_block(&mapper.survey(&pink, &Task::default()).unwrap(), &pink);
            let maps = maps.unwrap();
            let place = mapper.columns().iter().position(|column| column.name == "Vermilion");
            let place = place.unwrap();
            (maps.presence[place], maps.share[place], maps.share_sd[place])
        };
        let (presence, share, sd) = map(&oils);
        assert!(
            presence > 0.9 && (share - 0.4).abs() < 0.02 && sd < 0.1,
            "{presence} {share} {sd}"
        );
        let (presence, share, sd) = map(&masstones(&["Vermilion"]));
        assert!(presence > 0.9, "{presence}");
        // Twice the strength looks like half of the part.
        assert!((share - 0.25).abs() < 0.05, "{share}");
        assert!((share - 0.4).abs() < sd && sd < 0.35, "{share} {sd}");
    }
}
