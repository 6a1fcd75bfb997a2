//! `impasto mix`: predicts the reflectance and the colour of a recipe.

use calibrate::library::{AmountKind, PigmentLibrary};
use calibrate::{FilmOver, MixtureColor};
use clap::Args;
use serde_json::json;

use crate::console::Console;
use crate::csv_rows;
use crate::failure::{Failure, Result};
use crate::library_choice::{ChosenLibrary, chosen, split};
use crate::readings::ViewingOptions;
use crate::surface::ground;

/// Predict a mixture: reflectance, XYZ, Lab and sRGB
///
/// A recipe is pigments with their parts: `impasto mix oils.json "Zinc White=9" "Cobalt Blue=1"`.
/// The film hides its ground unless --thickness is given.
#[derive(Debug, Args)]
#[command(override_usage = "impasto mix [OPTIONS] [LIBRARY] <NAME=PARTS>...")]
pub(crate) struct Mix {
    /// The pigment library (JSON) [default: the one in IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then pigments and parts, NAME=PARTS; a name may be
    /// abbreviated
    #[arg(required = true, value_name = "[LIBRARY] NAME=PARTS")]
    words: Vec<String>,
    /// Thickness of the film. At 1 the reference white has S d = 1; for absolute amounts, 1 means the
    /// amounts as given [default: a film that hides; for absolute amounts 1]
    #[arg(long, value_name = "T", allow_hyphen_values = true, value_parser = thickness)]
    thickness: Option<f64>,
    /// Measured reflectance of the ground: 0 to 1, white (1), black (0), or a file of
    /// spectra, FILE or FILE#SAMPLE with a name as `color` prints it [default: white]
    #[arg(long, value_name = "GROUND", allow_hyphen_values = true)]
    over: Option<String>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: wavelengths_nm, reflectance, xyz, lab, srgb, hex, in_gamut
    #[arg(long)]
    json: bool,
    /// Print the reflectance as CSV
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Mix {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let viewing = self.viewing.viewing(console)?;
        let (path, recipe) = split(&self.words, false);
        let ChosenLibrary { library, .. } = chosen(path.as_deref(), console)?;
        let parts = parsed_recipe(recipe, &library)?;
        let absolute = library.amounts == AmountKind::Absolute;
        let hides = self.thickness.is_none() && !absolute;
        if hides && self.over.is_some() {
            return Err(Failure::usage(
                "a film that hides shows no ground",
                "add a thickness, such as --thickness 1",
            ));
        }
        let ground = self.over.as_deref().map(|text| ground(text, console)).transpose()?;
        let color = if hides {
            library.color(parts, &viewing)?
        } else {
            let thickness = self.thickness.unwrap_or(1.0);
            let film = FilmOver { thickness, ground: ground.unwrap_or_default() };
            library.film_color(parts, &film, &viewing)?
        };
        console.remarks(&color.remarks)?;
        let MixtureColor { recipe, reflectance, xyz, lab, srgb: rgb, .. } = color;
        if self.csv {
            let rows = library
                .grid
                .wavelengths_nm()
                .zip(reflectance.values())
                .map(|(nm, value): (f64, &f64)| json!({"nm": nm, "reflectance": value}));
            return console.csv_rows(&rows.collect::<Vec<_>>());
        }
        if self.json {
            let wavelengths: Vec<f64> = library.grid.wavelengths_nm().collect();
            return console.json(&json!({
                "wavelengths_nm": wavelengths,
                "reflectance": reflectance.values(),
                "xyz": xyz.to_array(),
                "lab": lab.to_array(),
                "srgb": rgb.0,
                "hex": rgb.to_hex(),
                "in_gamut": rgb.in_gamut(),
            }));
        }
        let total = recipe.total();
        for &(id, part) in &recipe {
            let name = &library[id].name;
            if absolute {
                console.line(format!("{part:8} {name}"))?;
            } else {
                console.line(format!("{:7.2} % {name}", 100.0 * part / total))?;
            }
        }
        console.line(console.srgb(rgb))?;
        let [x, y, z] = xyz.to_array();
        console.line(format!("XYZ {x:.3} {y:.3} {z:.3}"))?;
        console.line(format!(
            "Lab {}  ({}, observer {})",
            csv_rows::lab(lab),
            viewing.illuminant.name(),
            viewing.observer
        ))?;
        for (nm, value) in library.grid.wavelengths_nm().zip(reflectance.values()) {
            console.line(format!("{nm:6} nm {value:.4}"))?;
        }
        Ok(())
    }
}

fn thickness(text: &str) -> std::result::Result<f64, String> {
    text.parse().map_err(|_| "takes a plain number, such as 0.1".to_owned())
}

/// Parses a recipe of texts `NAME=PARTS`. Hints name pigments of `library`.
fn parsed_recipe<'a>(texts: &'a [String], library: &PigmentLibrary) -> Result<Vec<(&'a str, f64)>> {
    if texts.is_empty() {
        let names = library.pigments.iter().zip([9, 1]);
        let example: Vec<String> =
            names.map(|(pigment, parts)| format!("\"{}={parts}\"", pigment.name)).collect();
        return Err(Failure::usage(
            "no pigment is named",
            format!("name pigments with their parts: impasto mix LIBRARY {}", example.join(" ")),
        ));
    }
    texts.iter().map(|text| parsed_part(text)).collect()
}

/// Parses `NAME=PARTS`.
fn parsed_part(text: &str) -> Result<(&str, f64)> {
    let Some((name, parts)) = text.rsplit_once('=') else {
        return Err(Failure::usage(
            format!("a recipe takes NAME=PARTS, found `{text}`"),
            "try \"Zinc White=9\" \"Cobalt Blue=1\"",
        ));
    };
    match parts.trim().parse::<f64>() {
        Ok(number) if number > 0.0 => Ok((name, number)),
        Ok(_) => Err(Failure::usage(
            format!("a part is above 0, found `{text}`"),
            "leave out pigments that do not take part",
        )),
        Err(_) => {
            let plain: String = parts.trim().replace(',', ".");
            let plain = plain.trim_end_matches(|c: char| !c.is_ascii_digit());
            let plain = plain.parse::<f64>().map_or_else(|_| "9".to_owned(), |n| n.to_string());
            Err(Failure::usage(
                format!("parts are plain numbers with a decimal point, found `{text}`"),
                format!("try \"{name}={plain}\""),
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_that_cannot_be_used_say_why_and_what_to_write() {
        assert_eq!(parsed_part("A=B=1.5").unwrap(), ("A=B", 1.5));
        for (text, message, hint) in [
            ("White", "a recipe takes NAME=PARTS", "\"Zinc White=9\""),
            ("White=0", "a part is above 0, found `White=0`", "leave out"),
            ("White=-1", "a part is above 0, found `White=-1`", "leave out"),
            ("White=NaN", "a part is above 0", "leave out"),
            ("White=1,5", "plain numbers with a decimal point, found `White=1,5`", "\"White=1.5\""),
            ("White=90%", "plain numbers with a decimal point", "\"White=90\""),
            ("White=90 g", "plain numbers with a decimal point", "\"White=90\""),
            ("White=much", "plain numbers with a decimal point", "\"White=9\""),
        ] {
            let failure = parsed_part(text).unwrap_err();
            let mut told = Vec::new();
            let status = failure.report(&mut told);
            let told = String::from_utf8(told).unwrap();
            assert!(told.contains(message) && told.contains(hint), "{text}: {told}");
            assert_eq!(status, 2, "{text}");
        }
        let nothing = parsed_recipe(&[], &PigmentLibrary::van_gogh_oils()).unwrap_err();
        assert_eq!(nothing.to_string(), "no pigment is named");
    }
}
