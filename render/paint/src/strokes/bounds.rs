//! What an action may say, whether it stands in a script or is done by hand.

use spectra::hint::Explain;
use spectra::{Observer, light_from_text};

use super::action::{Action, Load, Recipe, Squeeze, Stroke, SurfaceId};
use super::at::{At, Checked, near};
use super::palette::PaletteSpec;
use super::rows::numbers;
use super::saved_path;
use crate::document::Lighting;
use crate::layer::SLOTS;
use crate::optics::Gloss;
use crate::pose::Sample;

/// How far off a surface a brush may be, in greatest sides of it.
const FAR: f64 = 1000.0;

/// The surfaces that actions may name, by their greatest sides in mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surfaces {
    /// The canvas's.
    pub(crate) canvas_mm: f64,
    /// The palette's, if there is one.
    pub(crate) palette_mm: Option<f64>,
}

impl Surfaces {
    /// Checks the numbers of an action, and that its surface is there. Brushes
    /// and pigments are looked up elsewhere.
    pub(crate) fn check(&self, at: &At, action: &Action) -> Checked {
        match action {
            Action::Load(load) => check_load(at, load),
            Action::Stroke(stroke) => self.check_stroke(at, stroke),
            Action::Wipe { keep, .. } => at.range("keep", *keep, 0.0, 1.0),
            Action::Dry { fraction } => {
                at.range("fraction", *fraction, 0.0, 1.0)?;
                at.above_zero("fraction", *fraction)
            }
            Action::Palette(palette) => check_palette(at, palette),
            Action::Light(lighting) => check_light(at, "", lighting),
            Action::Opacity { value, .. } => at.range("value", *value, 0.0, 1000.0),
            Action::Merge { layer: 0 } => {
                let wanted = "1 and up: a dry layer that has one below it";
                Err(at.fault("layer", wanted, &0, None))
            }
            Action::Squeeze(squeeze) => {
                self.far_mm(at, squeeze.on)?;
                check_squeeze(at, squeeze)
            }
            Action::Scrape { on } => self.far_mm(at, *on).map(|_| ()),
            Action::Gloss { wet, dry } => check_gloss(at, "", *wet, *dry),
            Action::Save { path } => match saved_path::fault(path) {
                None => Ok(()),
                Some(wanted) => {
                    let hint = Some("name a file such as `picture.png`".to_owned());
                    Err(at.fault("path", wanted, path, hint))
                }
            },
            Action::Wash { .. }
            | Action::Undo {}
            | Action::Redo {}
            | Action::Swap { .. }
            | Action::Merge { .. } => Ok(()),
        }
    }

    fn check_stroke(&self, at: &At, stroke: &Stroke) -> Checked {
        let far_mm = self.far_mm(at, stroke.on)?;
        if stroke.samples.is_empty() {
            return Err(at.fault("samples", "at least one", &0, None));
        }
        let mut before = 0.0;
        for (index, sample) in stroke.samples.iter().enumerate() {
            check_sample(&at.sample(index), sample, before, far_mm)?;
            before = sample.seconds;
        }
        Ok(())
    }

    /// How far from the corner of a surface a sample may be, in mm.
    pub(crate) fn far_mm(&self, at: &At, on: SurfaceId) -> Result<f64, Box<super::InvalidValue>> {
        let side_mm = match on {
            SurfaceId::Canvas => Some(self.canvas_mm),
            SurfaceId::Palette => self.palette_mm,
        };
        side_mm.map(|side_mm| FAR * side_mm).ok_or_else(|| {
            let hint = Some("describe it as `mixing`, a second canvas".to_owned());
            at.fault("on", "the canvas, as there is no palette to mix on", &"palette", hint)
        })
    }
}

/// Whether `sample` may follow one at `before` seconds.
pub(crate) fn check_sample(at: &At, sample: &Sample, before: f64, far_mm: f64) -> Checked {
    let usual = numbers(sample).iter().all(|number| number.is_finite())
        && (before..=1e6).contains(&sample.seconds)
        && sample.x_mm.abs().max(sample.y_mm.abs()) <= far_mm
        && (0.0..=1.0).contains(&sample.pressure)
        && sample.tilt_x_deg.abs().max(sample.tilt_y_deg.abs()) <= 90.0
        && sample.twist_deg.abs() <= 3600.0;
    if usual { Ok(()) } else { wrong_number(at, sample, before, far_mm) }
}

/// Tells which of a sample's numbers is wrong.
fn wrong_number(at: &At, sample: &Sample, before: f64, far_mm: f64) -> Checked {
    at.range("seconds", sample.seconds, 0.0, 1e6)?;
    if sample.seconds < before {
        let wanted = format!("not before the last sample's {before}");
        return Err(at.fault("seconds", &wanted, &sample.seconds, None));
    }
    at.range("x", sample.x_mm, -far_mm, far_mm)?;
    at.range("y", sample.y_mm, -far_mm, far_mm)?;
    at.range("pressure", sample.pressure, 0.0, 1.0)?;
    at.range("tilt x", sample.tilt_x_deg, -90.0, 90.0)?;
    at.range("tilt y", sample.tilt_y_deg, -90.0, 90.0)?;
    at.range("twist", sample.twist_deg, -3600.0, 3600.0)
}

/// Whether a brush is one of `known`.
pub(crate) fn check_brush<'a>(
    at: &At,
    brush: &str,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Checked {
    if known.clone().any(|name| name == brush) {
        return Ok(());
    }
    let hint = near(brush, known).or_else(|| Some("declare it under `brushes`".to_owned()));
    Err(at.fault("brush", "one of `brushes`", &brush, hint))
}

/// Whether there is a brush so wide.
pub(crate) fn check_size(at: &At, field: &str, size_mm: f64) -> Checked {
    at.range(field, size_mm, 0.2, 100.0)
}

pub(super) fn check_gloss(at: &At, prefix: &str, wet: Gloss, dry: Gloss) -> Checked {
    for (field, Gloss { strength, exponent }) in [("wet", wet), ("dry", dry)] {
        at.range(&format!("{prefix}{field}.strength"), f64::from(strength), 0.0, 100.0)?;
        at.range(&format!("{prefix}{field}.exponent"), f64::from(exponent), 0.0, 1e6)?;
    }
    Ok(())
}

pub(super) fn check_light(at: &At, prefix: &str, lighting: &Lighting) -> Checked {
    let field = |name: &str| format!("{prefix}{name}");
    at.range(&field("azimuth_deg"), lighting.azimuth_deg, -360.0, 360.0)?;
    at.range(&field("elevation_deg"), lighting.elevation_deg, 0.0, 90.0)?;
    at.above_zero(&field("elevation_deg"), lighting.elevation_deg)?;
    at.range(&field("ambient"), lighting.ambient, 0.0, 1.0)?;
    at.range(&field("relief"), lighting.relief, 0.0, 100.0)?;
    if let Err(error) = light_from_text(&lighting.illuminant) {
        let wanted = "a CIE illuminant, a temperature or a lamp's file";
        let hint = error.hint().map(|hint| hint.to_string());
        return Err(at.fault(&field("illuminant"), wanted, &lighting.illuminant, hint));
    }
    if let Err(error) = Observer::named(&lighting.observer) {
        let hint = Some(error.to_string());
        return Err(at.fault(&field("observer"), "an observer", &lighting.observer, hint));
    }
    Ok(())
}

pub(super) fn check_palette(at: &At, palette: &PaletteSpec) -> Checked {
    let count = palette.pigments.len();
    if (1..=SLOTS).contains(&count) {
        return Ok(());
    }
    let hint = "dry the paint and change the palette for more".to_owned();
    Err(at.fault("palette", &format!("1 to {SLOTS} pigments"), &count, Some(hint)))
}

fn check_load(at: &At, load: &Load) -> Checked {
    at.range("amount_mm", load.amount_mm, 0.0, 100.0)?;
    check_recipe(at, &load.recipe, load.vehicle)
}

fn check_squeeze(at: &At, squeeze: &Squeeze) -> Checked {
    at.range("x_mm", squeeze.x_mm, -1e6, 1e6)?;
    at.range("y_mm", squeeze.y_mm, -1e6, 1e6)?;
    at.range("volume_mm3", squeeze.volume_mm3, 0.0, 1e6)?;
    at.above_zero("volume_mm3", squeeze.volume_mm3)?;
    check_recipe(at, &squeeze.recipe, squeeze.vehicle)
}

fn check_recipe(at: &At, recipe: &Recipe, vehicle: f64) -> Checked {
    at.range("vehicle", vehicle, 0.0, 1.0)?;
    if recipe.len() > SLOTS {
        let wanted = format!("at most {SLOTS} pigments");
        return Err(at.fault("recipe", &wanted, &recipe.len(), None));
    }
    for (pigment, parts) in recipe {
        at.range(&format!("recipe, {pigment}"), *parts, 0.0, 1e6)?;
    }
    let paint = recipe.values().fold(0.0, |sum, parts| sum + parts);
    if paint <= 0.0 && vehicle < 1.0 {
        let hint = "clear vehicle alone is \"vehicle\": 1".to_owned();
        return Err(at.fault("recipe", "parts that sum to more than 0", &paint, Some(hint)));
    }
    Ok(())
}
