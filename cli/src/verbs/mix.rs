//! `impasto mix`: a recipe to a reflectance and a colour.

use std::path::PathBuf;

use calibrate::library::{AmountKind, PigmentLibrary};
use clap::Args;
use serde_json::json;
use spectra::color::{Lab, RgbSpace};

use crate::console::Console;
use crate::failure::Refusal;
use crate::ground::ground;
use crate::input::{ViewingOptions, color_weights, library, srgb};

/// Predict a mixture: reflectance, XYZ, Lab and sRGB
///
/// A recipe is pigments with their parts: `impasto mix oils.json "Zinc White=9" "Cobalt Blue=1"`.
/// The film hides its ground unless --thickness is given.
#[derive(Debug, Args)]
pub(crate) struct Mix {
    /// The pigment library (JSON)
    library: PathBuf,
    /// Pigments and parts, NAME=PARTS; a name may be cut short
    #[arg(required = true, value_name = "NAME=PARTS")]
    recipe: Vec<String>,
    /// Thickness of the film; 1 is where the reference white has S d = 1 (for absolute amounts,
    /// the amounts as given) [default: hiding]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    thickness: Option<f64>,
    /// Measured reflectance of the ground: 0 to 1, white (1), black (0), or a file of
    /// spectra as `color` reads it, FILE or FILE#SAMPLE, named as there [default: white]
    #[arg(long, value_name = "GROUND", allow_hyphen_values = true)]
    over: Option<String>,
    #[command(flatten)]
    viewing: ViewingOptions,
    /// Print JSON: wavelengths_nm, reflectance, xyz, lab, srgb, hex
    #[arg(long)]
    json: bool,
}

impl Mix {
    pub(super) fn run(self, console: &mut Console<'_>) -> anyhow::Result<()> {
        let viewing = self.viewing.viewing()?;
        let library = library(&self.library)?;
        let recipe = parsed_recipe(&library, &self.recipe)?;
        let mixture = library.mix(&recipe)?;
        let absolute = library.amounts == AmountKind::Absolute;
        let thickness = match self.thickness {
            Some(t) if !(t > 0.0 && t <= 1e9) => {
                return Err(Refusal::usage(
                    format!("--thickness must be above 0 and up to 1e9, found `{t}`"),
                    "leave it out for a film that hides",
                ));
            }
            None if absolute => Some(1.0),
            None if self.over.is_some() => {
                return Err(Refusal::usage(
                    "a film that hides shows no ground",
                    "give --over a --thickness, such as 1",
                ));
            }
            given => given,
        };
        let reflectance = match thickness {
            None => mixture.hiding(library.saunderson),
            Some(thickness) => {
                let ground = ground(self.over.as_deref().unwrap_or("white"), &library, console)?;
                mixture.film(thickness, &ground, library.film())
            }
        };
        for (index, _) in &recipe {
            let pigment = &library.pigments[*index];
            if pigment.guessed {
                let notes = pigment.notes.join("; ");
                console.warnings(&[format!("{}: {notes}", pigment.name)])?;
            }
        }
        for (index, _) in recipe.iter().filter(|_| recipe.len() > 1) {
            let pigment = &library.pigments[*index];
            if !pigment.identified {
                let notes = pigment.notes.join("; ");
                console.warnings(&[format!("{}: {notes}", pigment.name)])?;
            }
        }
        let weights = color_weights(&viewing, library.grid, console)?;
        let xyz = weights.xyz(&reflectance);
        let lab = Lab::from_xyz(xyz, weights.white());
        let rgb = srgb(xyz, weights.white());
        if self.json {
            let wavelengths: Vec<f64> = library.grid.wavelengths_nm().collect();
            return console.json(&json!({
                "wavelengths_nm": wavelengths,
                "reflectance": reflectance,
                "xyz": xyz.to_array(),
                "lab": lab.to_array(),
                "srgb": rgb.0,
                "hex": rgb.to_hex(),
            }));
        }
        let total: f64 = recipe.iter().map(|(_, part)| part).sum();
        for (index, part) in &recipe {
            let name = &library.pigments[*index].name;
            if absolute {
                console.line(format!("{part:8} {name}"))?;
            } else {
                console.line(format!("{:7.2} % {name}", 100.0 * part / total))?;
            }
        }
        let patch = console.patch(rgb);
        console.line(format!("{patch}{}{}", rgb.to_hex(), gamut_note(rgb.in_gamut())))?;
        let [x, y, z] = xyz.to_array();
        console.line(format!("XYZ {x:.3} {y:.3} {z:.3}"))?;
        let [l, a, b] = lab.to_array();
        console.line(format!(
            "Lab {l:.2} {a:.2} {b:.2}  ({}, observer {})",
            viewing.illuminant.name(),
            viewing.observer
        ))?;
        for (nm, value) in library.grid.wavelengths_nm().zip(&reflectance) {
            console.line(format!("{nm:6} nm {value:.4}"))?;
        }
        Ok(())
    }
}

/// A word for colours that sRGB cannot show.
pub(super) fn gamut_note(inside: bool) -> String {
    if inside { String::new() } else { format!(" (nearest; outside {:?})", RgbSpace::Srgb) }
}

/// `NAME=PARTS` of each pigment.
fn parsed_recipe(library: &PigmentLibrary, texts: &[String]) -> anyhow::Result<Vec<(usize, f64)>> {
    texts
        .iter()
        .map(|text| {
            let wrong = || {
                Refusal::usage(
                    format!("a part of a recipe is NAME=PARTS, found `{text}`"),
                    "try \"Zinc White=9\" \"Cobalt Blue=1\"",
                )
            };
            let (name, parts) = text.rsplit_once('=').ok_or_else(wrong)?;
            let parts: f64 = parts.trim().parse().map_err(|_| wrong())?;
            Ok((library.find(name)?, parts))
        })
        .collect()
}
