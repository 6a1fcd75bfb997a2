//! Ranges of the numbers in an action, for scripts and for actions of a user.

use documents::hint::{Explain, Hint};
use spectra::{Observer, light_from_text};

use super::action::{Action, Load, Recipe, Squeeze};
use super::check_context::{CheckContext, Checked, did_you_mean};
use super::error::InvalidValue;
use super::limits::MAX_MASK_POINTS;
use super::palette::PaletteSpec;
use super::sample_rows::numbers;
use super::save_path;
use super::stroke_action::Stroke;
use super::surface_id::SurfaceId;
use crate::brush::StrokeTool;
use crate::document::Lighting;
use crate::dry_layer::layer_name_violation;
use crate::layer::SLOTS;
use crate::optics::Gloss;
use crate::painting::{LayerRef, MaskChange};
use crate::pose::Sample;

/// Farthest distance of a sample from the corner of its surface, as a multiple of the
/// surface's longer side.
const REACH: f64 = 1000.0;

/// Limits of actions, which depend on the sizes of the surfaces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ActionLimits {
    /// Longer side of the canvas in mm.
    pub(crate) canvas_mm: f64,
    /// Longer side of the palette in mm, if there is a palette.
    pub(crate) palette_mm: Option<f64>,
}

impl ActionLimits {
    /// Checks the numbers of an action, and that its surface exists. The names of brushes
    /// and pigments are looked up elsewhere.
    pub(crate) fn check(&self, at: &CheckContext, action: &Action) -> Checked {
        match action {
            Action::Load(load) => check_load(at, load),
            Action::Stroke(stroke) | Action::Cut(stroke) => self.check_stroke(at, stroke),
            Action::Wipe { keep, .. } => at.range("keep", *keep, 0.0, 1.0),
            Action::Dry { fraction } => {
                at.range("fraction", *fraction, 0.0, 1.0)?;
                at.above_zero("fraction", *fraction)
            }
            Action::Palette(palette) => check_palette(at, palette),
            Action::Light(lighting) => check_light(at, "", lighting),
            Action::Opacity { value, .. } => at.range("value", *value, 0.0, 1000.0),
            Action::Name { name, .. } => match layer_name_violation(name) {
                None => Ok(()),
                Some(wanted) => Err(at.invalid("name", wanted, &shortened(name), None)),
            },
            Action::Merge { layer: LayerRef::Dry(0), with: None } => {
                let wanted = "1 and up: a dry layer that has one below it";
                Err(at.invalid("layer", wanted, &0, None))
            }
            Action::Squeeze(squeeze) => {
                self.reach_mm(at, squeeze.on)?;
                check_squeeze(at, squeeze)
            }
            Action::Scrape { on } => self.reach_mm(at, *on).map(|_| ()),
            Action::Mask(change) => self.check_mask(at, change),
            Action::Gloss { wet, dry } => check_gloss(at, "", *wet, *dry),
            Action::Stiffness { value } => at.range("value", *value, 0.0, 1.0),
            Action::Save { path } => match save_path::violation(path) {
                None => Ok(()),
                Some(wanted) => {
                    let hint = Some(Hint::new("name a file such as `picture.png`"));
                    Err(at.invalid("path", wanted, path, hint))
                }
            },
            Action::Wash { .. }
            | Action::Undo {}
            | Action::Redo {}
            | Action::Visible { .. }
            | Action::Order { .. }
            | Action::Swap { .. }
            | Action::Merge { .. } => Ok(()),
        }
    }

    fn check_stroke(&self, at: &CheckContext, stroke: &Stroke) -> Checked {
        let reach_mm = self.reach_mm(at, stroke.on)?;
        check_tool(at, stroke.tool)?;
        if stroke.samples.is_empty() {
            return Err(at.invalid("samples", "at least one", &0, None));
        }
        let mut before = 0.0;
        for (index, sample) in stroke.samples.iter().enumerate() {
            check_sample(&at.sample(index), sample, before, reach_mm)?;
            before = sample.seconds;
        }
        Ok(())
    }

    fn check_mask(&self, at: &CheckContext, change: &MaskChange) -> Checked {
        let points = match change {
            MaskChange::PolygonMm(points) => points,
            MaskChange::Inverse(false) => {
                return Err(at.invalid("inverse", "true, or another key", &false, None));
            }
            _ => return Ok(()),
        };
        if !(3..=MAX_MASK_POINTS).contains(&points.len()) {
            let wanted = format!("3 to {MAX_MASK_POINTS} points");
            return Err(at.invalid("polygon_mm", &wanted, &points.len(), None));
        }
        let reach_mm = self.reach_mm(at, SurfaceId::Canvas)?;
        for [x, y] in points {
            at.range("polygon_mm, x", *x, -reach_mm, reach_mm)?;
            at.range("polygon_mm, y", *y, -reach_mm, reach_mm)?;
        }
        Ok(())
    }

    /// Farthest distance of a sample from the corner of a surface, in mm.
    pub(crate) fn reach_mm(
        &self,
        at: &CheckContext,
        on: SurfaceId,
    ) -> Result<f64, Box<InvalidValue>> {
        let side_mm = match on {
            SurfaceId::Canvas => Some(self.canvas_mm),
            SurfaceId::Palette => self.palette_mm,
        };
        side_mm.map(|side_mm| REACH * side_mm).ok_or_else(|| {
            let hint = Some(Hint::new("describe it as `mixing`, a second canvas"));
            at.invalid("on", "the canvas, as there is no palette to mix on", &"palette", hint)
        })
    }
}

/// Checks a sample that follows one at `before` seconds. It may lie up to `reach_mm` from
/// the corner of the surface.
pub(crate) fn check_sample(
    at: &CheckContext,
    sample: &Sample,
    before: f64,
    reach_mm: f64,
) -> Checked {
    let valid = numbers(sample).iter().all(|number| number.is_finite())
        && (before..=1e6).contains(&sample.seconds)
        && sample.x_mm.abs().max(sample.y_mm.abs()) <= reach_mm
        && (0.0..=1.0).contains(&sample.pressure)
        && sample.tilt_x_deg.abs().max(sample.tilt_y_deg.abs()) <= 90.0
        && sample.twist_deg.abs() <= 3600.0;
    if valid { Ok(()) } else { invalid_number(at, sample, before, reach_mm) }
}

/// The error about the first number of a sample that is out of range.
fn invalid_number(at: &CheckContext, sample: &Sample, before: f64, reach_mm: f64) -> Checked {
    at.range("seconds", sample.seconds, 0.0, 1e6)?;
    if sample.seconds < before {
        let wanted = format!("not before the last sample's {before}");
        return Err(at.invalid("seconds", &wanted, &sample.seconds, None));
    }
    at.range("x", sample.x_mm, -reach_mm, reach_mm)?;
    at.range("y", sample.y_mm, -reach_mm, reach_mm)?;
    at.range("pressure", sample.pressure, 0.0, 1.0)?;
    at.range("tilt x", sample.tilt_x_deg, -90.0, 90.0)?;
    at.range("tilt y", sample.tilt_y_deg, -90.0, 90.0)?;
    at.range("twist", sample.twist_deg, -3600.0, 3600.0)
}

/// Checks the number of a tool.
pub(crate) fn check_tool(at: &CheckContext, tool: StrokeTool) -> Checked {
    tool.check().map_err(|error| at.invalid(error.field, error.wanted, &error.found, error.hint()))
}

/// Checks that a brush is one of `known`.
pub(crate) fn check_brush<'a>(
    at: &CheckContext,
    brush: &str,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Checked {
    if known.clone().any(|name| name == brush) {
        return Ok(());
    }
    let hint = did_you_mean(brush, known).or_else(|| Some(Hint::new("declare it under `brushes`")));
    Err(at.invalid("brush", "one of `brushes`", &brush, hint))
}

/// The start of a long text, on one line, for messages.
fn shortened(text: &str) -> String {
    let start: String = text.chars().take(100).collect();
    let more = if start.len() < text.len() { ".." } else { "" };
    format!("{}{more}", start.escape_debug())
}

/// Checks the width of a brush head in mm.
pub(crate) fn check_size(at: &CheckContext, field: &str, size_mm: f64) -> Checked {
    at.range(field, size_mm, 0.2, 100.0)
}

pub(super) fn check_gloss(at: &CheckContext, prefix: &str, wet: Gloss, dry: Gloss) -> Checked {
    for (field, Gloss { strength, exponent }) in [("wet", wet), ("dry", dry)] {
        at.range(&format!("{prefix}{field}.strength"), f64::from(strength), 0.0, 100.0)?;
        at.range(&format!("{prefix}{field}.exponent"), f64::from(exponent), 0.0, 1e6)?;
    }
    Ok(())
}

pub(super) fn check_light(at: &CheckContext, prefix: &str, lighting: &Lighting) -> Checked {
    let field = |name: &str| format!("{prefix}{name}");
    at.range(&field("azimuth_deg"), lighting.azimuth_deg, -360.0, 360.0)?;
    at.range(&field("elevation_deg"), lighting.elevation_deg, 0.0, 90.0)?;
    at.above_zero(&field("elevation_deg"), lighting.elevation_deg)?;
    at.range(&field("ambient"), lighting.ambient, 0.0, 1.0)?;
    at.range(&field("relief"), lighting.relief, 0.0, 100.0)?;
    at.range(&field("adaptation"), lighting.adaptation, 0.0, 1.0)?;
    if let Err(error) = light_from_text(&lighting.illuminant) {
        let wanted = "a CIE illuminant, a temperature or a lamp's file";
        let hint = error.hint();
        return Err(at.invalid(&field("illuminant"), wanted, &lighting.illuminant, hint));
    }
    if let Err(error) = Observer::named(&lighting.observer) {
        let hint = Some(Hint::new(error.to_string()));
        return Err(at.invalid(&field("observer"), "an observer", &lighting.observer, hint));
    }
    Ok(())
}

pub(super) fn check_palette(at: &CheckContext, palette: &PaletteSpec) -> Checked {
    let count = palette.pigments.len();
    if (1..=SLOTS).contains(&count) {
        return Ok(());
    }
    let hint = Hint::new("dry the paint and change the palette for more");
    Err(at.invalid("palette", &format!("1 to {SLOTS} pigments"), &count, Some(hint)))
}

fn check_load(at: &CheckContext, load: &Load) -> Checked {
    at.range("amount_mm", load.amount_mm, 0.0, 100.0)?;
    check_recipe(at, &load.recipe, load.vehicle)
}

fn check_squeeze(at: &CheckContext, squeeze: &Squeeze) -> Checked {
    at.range("x_mm", squeeze.x_mm, -1e6, 1e6)?;
    at.range("y_mm", squeeze.y_mm, -1e6, 1e6)?;
    at.range("volume_mm3", squeeze.volume_mm3, 0.0, 1e6)?;
    at.above_zero("volume_mm3", squeeze.volume_mm3)?;
    check_recipe(at, &squeeze.recipe, squeeze.vehicle)
}

fn check_recipe(at: &CheckContext, recipe: &Recipe, vehicle: f64) -> Checked {
    at.range("vehicle", vehicle, 0.0, 1.0)?;
    if recipe.len() > SLOTS {
        let wanted = format!("at most {SLOTS} pigments");
        return Err(at.invalid("recipe", &wanted, &recipe.len(), None));
    }
    for (pigment, parts) in recipe {
        at.range(&format!("recipe, {pigment}"), *parts, 0.0, 1e6)?;
    }
    let paint = recipe.values().fold(0.0, |sum, parts| sum + parts);
    if paint <= 0.0 && vehicle < 1.0 {
        let hint = Hint::new("clear vehicle alone is \"vehicle\": 1");
        return Err(at.invalid("recipe", "parts that sum to more than 0", &paint, Some(hint)));
    }
    Ok(())
}
