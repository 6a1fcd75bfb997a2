//! Whether what a script says can be done at all.

use spectra::{Observer, light_from_text};

use super::action::{Action, Load, Recipe, Squeeze, Stroke};
use super::error::{Fault, Place, StrokesError};
use super::names::nearest;
use super::palette::Palette;
use super::rows::numbers;
use super::saved_path;
use super::script::{Canvas, Strokes};
use crate::layer::SLOTS;
use crate::optics::Gloss;
use crate::paint::document::{Lighting, Medium};
use crate::paint::pose::Sample;

/// The most cells a script's canvas may have: 8192 x 8192. Painting takes about
/// 90 bytes a cell, and 36 more for each dry layer: 6 GB and up.
pub const MOST_CELLS: u64 = 1 << 26;

/// The most samples of all strokes together: an hour and a half of a pen that
/// tells 200 a second is a tenth of it. They take 560 MB.
pub const MOST_SAMPLES: usize = 10_000_000;

/// The most actions.
pub const MOST_ACTIONS: usize = 1_000_000;

/// How far off the canvas a brush may be, in greatest sides of the canvas.
const FAR: f64 = 1000.0;

type Checked = Result<(), Box<Fault>>;

impl Strokes {
    /// Whether every number is in range and every brush declared. Pigments are
    /// looked up by [`Strokes::resolve`].
    ///
    /// # Errors
    /// [`StrokesError::Fault`] with action, sample and field.
    pub fn check(&self) -> Result<(), StrokesError> {
        Ok(self.check_values()?)
    }

    pub(super) fn check_values(&self) -> Checked {
        let top = At { action: None, sample: None };
        check_canvas(&self.canvas)?;
        if let Some(medium) = &self.medium {
            check_medium(medium)?;
        }
        if let Some(lighting) = &self.lighting {
            check_light(&top, "lighting.", lighting)?;
        }
        check_palette(&top, &self.palette)?;
        for (name, brush) in &self.brushes {
            let field = format!("brushes.{name}.size_mm");
            top.range(&field, brush.size_mm, 0.2, 100.0)?;
        }
        let mut samples = 0;
        if self.actions.len() > MOST_ACTIONS {
            let wanted = format!("at most {MOST_ACTIONS}");
            return Err(top.fault("actions", &wanted, &self.actions.len(), None));
        }
        for (index, action) in self.actions.iter().enumerate() {
            let at = At { action: Some((index, action.kind())), sample: None };
            self.check_action(&at, action)?;
            if let Action::Stroke(stroke) = action {
                samples += stroke.samples.len();
            }
            if samples > MOST_SAMPLES {
                let wanted = format!("at most {MOST_SAMPLES} of all strokes so far");
                let hint = Some("record fewer samples a second, or several scripts".to_owned());
                return Err(at.fault("samples", &wanted, &samples, hint));
            }
        }
        Ok(())
    }

    fn check_action(&self, at: &At, action: &Action) -> Checked {
        match action {
            Action::Load(load) => {
                self.check_brush(at, &load.brush)?;
                check_load(at, load)
            }
            Action::Stroke(stroke) => {
                self.check_brush(at, &stroke.brush)?;
                self.check_stroke(at, stroke)
            }
            Action::Wipe { brush, keep } => {
                self.check_brush(at, brush)?;
                at.range("keep", *keep, 0.0, 1.0)
            }
            Action::Wash { brush } => self.check_brush(at, brush),
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
            Action::Save { path } => match saved_path::fault(path) {
                None => Ok(()),
                Some(wanted) => {
                    let hint = Some("name a file such as `picture.png`".to_owned());
                    Err(at.fault("path", wanted, path, hint))
                }
            },
            Action::Squeeze(squeeze) => check_squeeze(at, squeeze),
            Action::Gloss { wet, dry } => check_gloss(at, "", *wet, *dry),
            Action::Scrape { .. } => Ok(()),
            Action::Undo {} | Action::Redo {} | Action::Swap { .. } | Action::Merge { .. } => {
                Ok(())
            }
        }
    }

    fn check_brush(&self, at: &At, brush: &str) -> Checked {
        if self.brushes.contains_key(brush) {
            return Ok(());
        }
        let known = self.brushes.keys().map(String::as_str);
        let hint = near(brush, known).or_else(|| Some("declare it under `brushes`".to_owned()));
        Err(at.fault("brush", "one of `brushes`", &brush, hint))
    }

    fn check_stroke(&self, at: &At, stroke: &Stroke) -> Checked {
        if stroke.samples.is_empty() {
            return Err(at.fault("samples", "at least one", &0, None));
        }
        let far = FAR * self.canvas.width_mm.max(self.canvas.height_mm);
        let mut before = 0.0;
        for (index, sample) in stroke.samples.iter().enumerate() {
            let usual = numbers(sample).iter().all(|number| number.is_finite())
                && (before..=1e6).contains(&sample.seconds)
                && sample.x_mm.abs().max(sample.y_mm.abs()) <= far
                && (0.0..=1.0).contains(&sample.pressure)
                && sample.tilt_x_deg.abs().max(sample.tilt_y_deg.abs()) <= 90.0
                && sample.twist_deg.abs() <= 3600.0;
            if !usual {
                let at = At { sample: Some(index), ..*at };
                check_sample(&at, sample, before, far)?;
            }
            before = sample.seconds;
        }
        Ok(())
    }
}

/// Tells which of a sample's numbers is wrong.
fn check_sample(at: &At, sample: &Sample, before: f64, far: f64) -> Checked {
    at.range("seconds", sample.seconds, 0.0, 1e6)?;
    if sample.seconds < before {
        let wanted = format!("not before the last sample's {before}");
        return Err(at.fault("seconds", &wanted, &sample.seconds, None));
    }
    at.range("x", sample.x_mm, -far, far)?;
    at.range("y", sample.y_mm, -far, far)?;
    at.range("pressure", sample.pressure, 0.0, 1.0)?;
    at.range("tilt x", sample.tilt_x_deg, -90.0, 90.0)?;
    at.range("tilt y", sample.tilt_y_deg, -90.0, 90.0)?;
    at.range("twist", sample.twist_deg, -3600.0, 3600.0)
}

fn check_canvas(canvas: &Canvas) -> Checked {
    let at = At { action: None, sample: None };
    at.range("canvas.cell_mm", canvas.cell_mm, 0.001, 10.0)?;
    for (field, side) in
        [("canvas.width_mm", canvas.width_mm), ("canvas.height_mm", canvas.height_mm)]
    {
        at.range(field, side, 0.001, 1e6)?;
    }
    let (width, height) = canvas.cells();
    if (width as u64).saturating_mul(height as u64) > MOST_CELLS {
        let wanted = format!("at most {MOST_CELLS} cells, which take 6 GB");
        let least = (canvas.width_mm * canvas.height_mm / MOST_CELLS as f64).sqrt();
        let hint = format!("\"cell_mm\": {:.3}", (least * 1000.0).ceil() / 1000.0 + 0.001);
        return Err(at.fault("canvas", &wanted, &format!("{width} x {height}"), Some(hint)));
    }
    Ok(())
}

fn check_medium(medium: &Medium) -> Checked {
    let at = At { action: None, sample: None };
    at.range("medium.scattering_per_mm", medium.scattering_per_mm, 1e-3, 1e6)?;
    check_gloss(&at, "medium.", medium.wet, medium.dry)
}

fn check_gloss(at: &At, prefix: &str, wet: Gloss, dry: Gloss) -> Checked {
    for (field, Gloss { strength, exponent }) in [("wet", wet), ("dry", dry)] {
        at.range(&format!("{prefix}{field}.strength"), f64::from(strength), 0.0, 100.0)?;
        at.range(&format!("{prefix}{field}.exponent"), f64::from(exponent), 0.0, 1e6)?;
    }
    Ok(())
}

fn check_light(at: &At, prefix: &str, lighting: &Lighting) -> Checked {
    let field = |name: &str| format!("{prefix}{name}");
    at.range(&field("azimuth_deg"), lighting.azimuth_deg, -360.0, 360.0)?;
    at.range(&field("elevation_deg"), lighting.elevation_deg, 0.0, 90.0)?;
    at.above_zero(&field("elevation_deg"), lighting.elevation_deg)?;
    at.range(&field("ambient"), lighting.ambient, 0.0, 1.0)?;
    at.range(&field("relief"), lighting.relief, 0.0, 100.0)?;
    if let Err(error) = light_from_text(&lighting.illuminant) {
        let wanted = "a CIE illuminant, a temperature or a lamp's file";
        return Err(at.fault(&field("illuminant"), wanted, &lighting.illuminant, error.hint()));
    }
    if let Err(error) = Observer::named(&lighting.observer) {
        let hint = Some(error.to_string());
        return Err(at.fault(&field("observer"), "an observer", &lighting.observer, hint));
    }
    Ok(())
}

fn check_palette(at: &At, palette: &Palette) -> Checked {
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

/// Where a check is.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    pub(super) action: Option<(usize, &'static str)>,
    pub(super) sample: Option<usize>,
}

impl At {
    pub(super) fn fault(
        &self,
        field: &str,
        wanted: &str,
        found: &dyn std::fmt::Display,
        hint: Option<String>,
    ) -> Box<Fault> {
        let place = Place { action: self.action, sample: self.sample, field: field.to_owned() };
        Box::new(Fault { place, wanted: wanted.to_owned(), found: found.to_string(), hint })
    }

    fn range(&self, field: &str, value: f64, least: f64, most: f64) -> Checked {
        if (least..=most).contains(&value) {
            return Ok(());
        }
        // Written out, 1e300 would be 301 digits.
        let found = if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") };
        Err(self.fault(field, &format!("{least} to {most}"), &found, None))
    }

    fn above_zero(&self, field: &str, value: f64) -> Checked {
        if value > 0.0 { Ok(()) } else { Err(self.fault(field, "above 0", &value, None)) }
    }
}

/// "did you mean", if anything is near.
pub(super) fn near<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let found = nearest(name, known);
    (!found.is_empty()).then(|| format!("did you mean {}?", found.join(" or ")))
}
