//! The table of actions: the numbers of each with their limits and digits, its rules, and its
//! label.
//!
//! We round every number to the digits of a file before it takes effect. A recording holds these
//! rounded numbers, so it paints the same bits when you play it.
//!
//! A script saves only below the folder that you choose when you play it.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use documents::hint::{Explain, Hint};
use pigment::library::PigmentLibrary;
use pigment::{PigmentId, digits};
use spectra::{Observer, light_from_text};

use super::action::{
    Action, ActionPigments, Load, MaskChange, PaletteSpec, PerSurface, Recipe, Squeeze, Stroke,
    SurfaceId, numbers,
};
use super::{InvalidValue, MAX_MASK_POINTS, ValueLocation};
use crate::brush::StrokeTool;
use crate::document::{Lighting, Medium};
use crate::layer::{DryLayerState, LayerId, LayerRef, SLOTS, layer_label, layer_name_violation};
use crate::optics::Gloss;
use crate::pose::Sample;
use crate::stroke::SampleDecimals;

impl Action {
    /// The numbers of the action with their limits, without the samples of a stroke. A corner of a
    /// mask lies at most `reach_mm` from the corner of the canvas.
    fn numbers(&mut self, reach_mm: f64) -> Vec<Number<'_>> {
        match self {
            Self::Load(Load { recipe, vehicle, amount_mm, .. }) => {
                let paint =
                    [number("amount_mm", amount_mm, 0.0..=100.0), share("vehicle", vehicle)];
                paint.into_iter().chain(parts(recipe)).collect()
            }
            Self::Wipe { keep, .. } => vec![share("keep", keep)],
            Self::Dry { fraction } => vec![share("fraction", fraction).above_zero()],
            Self::Light(lighting) => light_numbers(lighting).into(),
            Self::Opacity { value, .. } => vec![number("value", value, 0.0..=1000.0)],
            Self::Squeeze(Squeeze { recipe, vehicle, x_mm, y_mm, volume_mm3, .. }) => {
                let heap = [
                    number("x_mm", x_mm, -1e6..=1e6),
                    number("y_mm", y_mm, -1e6..=1e6),
                    number("volume_mm3", volume_mm3, 0.0..=1e6).above_zero(),
                    share("vehicle", vehicle),
                ];
                heap.into_iter().chain(parts(recipe)).collect()
            }
            Self::Mask(MaskChange::PolygonMm(points)) => {
                let corners = points.iter_mut().flat_map(|[x, y]| {
                    [
                        number("polygon_mm, x", x, -reach_mm..=reach_mm),
                        number("polygon_mm, y", y, -reach_mm..=reach_mm),
                    ]
                });
                corners.collect()
            }
            Self::Gloss { wet, dry } => gloss_numbers(wet, dry).into(),
            Self::Stiffness { value } => vec![share("value", value)],
            Self::Stroke(_)
            | Self::Cut(_)
            | Self::Wash { .. }
            | Self::Palette(_)
            | Self::Undo {}
            | Self::Redo {}
            | Self::Name { .. }
            | Self::Visible { .. }
            | Self::Order { .. }
            | Self::Swap { .. }
            | Self::Merge { .. }
            | Self::Scrape { .. }
            | Self::Mask(_)
            | Self::Save { .. } => Vec::new(),
        }
    }

    /// Checks everything in the action except the numbers that `numbers` lists.
    fn check_rules(&self, at: &CheckContext) -> Checked {
        match self {
            Self::Load(Load { recipe, vehicle, .. })
            | Self::Squeeze(Squeeze { recipe, vehicle, .. }) => check_recipe(at, recipe, *vehicle),
            Self::Palette(palette) => check_palette(at, palette),
            Self::Light(lighting) => check_light_names(at, "", lighting),
            Self::Name { name, .. } => match layer_name_violation(name) {
                None => Ok(()),
                Some(wanted) => Err(at.invalid("name", wanted, &shortened(name), None)),
            },
            Self::Merge { layer: LayerRef::Dry(0), with: None } => {
                let wanted = "1 and up: a dry layer that has one below it";
                Err(at.invalid("layer", wanted, &0, None))
            }
            Self::Save { path } => match violation(path) {
                None => Ok(()),
                Some(wanted) => {
                    let hint = Some(Hint::new("name a file such as `picture.png`"));
                    Err(at.invalid("path", wanted, path, hint))
                }
            },
            _ => Ok(()),
        }
    }

    /// The surfaces that the action changes, if they exist. Both are `false` for an action that
    /// changes only a brush.
    pub(crate) fn surfaces(&self) -> PerSurface<bool> {
        let canvas = PerSurface { canvas: true, palette: false };
        match self {
            Self::Load(_)
            | Self::Wipe { .. }
            | Self::Wash { .. }
            | Self::Undo {}
            | Self::Redo {}
            | Self::Save { .. } => PerSurface::default(),
            Self::Stroke(Stroke { on, .. })
            | Self::Cut(Stroke { on, .. })
            | Self::Squeeze(Squeeze { on, .. })
            | Self::Scrape { on } => PerSurface::from_fn(|surface| surface == *on),
            Self::Palette(_)
            | Self::Light(_)
            | Self::Gloss { .. }
            | Self::Stiffness { .. }
            | Self::Swap { layer: LayerRef::Wet, .. } => PerSurface { palette: true, ..canvas },
            Self::Dry { .. }
            | Self::Opacity { .. }
            | Self::Name { .. }
            | Self::Visible { .. }
            | Self::Order { .. }
            | Self::Swap { .. }
            | Self::Merge { .. }
            | Self::Mask(_) => canvas,
        }
    }

    /// Label for the history, with the pigments that the action names. `dry` are the dry layers of
    /// the canvas before the action, so that layers have the names and places that the action
    /// means.
    pub(crate) fn label(
        &self,
        pigments: &ActionPigments,
        library: &PigmentLibrary,
        dry: &[DryLayerState],
    ) -> String {
        let name = |pigment: PigmentId| library[pigment].name.as_str();
        match self {
            Self::Stroke(stroke) | Self::Cut(stroke) if stroke.tool.is_paint() => {
                format!("stroke{}, {}", place(stroke.on), stroke.brush)
            }
            Self::Stroke(stroke) | Self::Cut(stroke) => {
                format!("{}{}, {}", stroke.tool.name(), place(stroke.on), stroke.brush)
            }
            Self::Dry { fraction } if *fraction == 1.0 => "dry all".to_owned(),
            Self::Dry { fraction } => format!("dry {}", percent(*fraction)),
            Self::Palette(_) => "other pigments".to_owned(),
            Self::Light(lighting) => format!("light {}", lighting.illuminant),
            Self::Gloss { .. } => "gloss".to_owned(),
            Self::Stiffness { value } => format!("stiffness {value}"),
            Self::Opacity { layer, value } => {
                format!("{} of {}", percent(*value), layer_name(*layer, dry))
            }
            Self::Swap { layer, .. } => match pigments {
                ActionPigments::Swap { from, to } => {
                    format!("{} for {}, {}", name(*to), name(*from), layer_name(*layer, dry))
                }
                _ => "swap".to_owned(),
            },
            Self::Name { name, .. } if name.is_empty() => "no name for a layer".to_owned(),
            Self::Name { name, .. } => format!("name {name}"),
            Self::Visible { layer, value: true } => format!("show {}", layer_name(*layer, dry)),
            Self::Visible { layer, value: false } => format!("hide {}", layer_name(*layer, dry)),
            Self::Order { layer, to } => {
                format!("{} to place {}", layer_name(*layer, dry), to + 1)
            }
            Self::Merge { layer, with: None } => {
                format!("merge {} with the one below", layer_name(*layer, dry))
            }
            Self::Merge { layer, with: Some(with) } => {
                format!("merge {} with {}", layer_name(*layer, dry), layer_name(*with, dry))
            }
            Self::Squeeze(squeeze) => {
                let paint = match pigments {
                    ActionPigments::Recipe(parts) => match parts.as_slice() {
                        [] => "medium".to_owned(),
                        [(pigment, _)] => name(*pigment).to_owned(),
                        [(first, _), (second, _)] => {
                            format!("{} and {}", name(*first), name(*second))
                        }
                        parts => format!("{} pigments", parts.len()),
                    },
                    _ => "paint".to_owned(),
                };
                format!(
                    "squeeze {paint}{}",
                    if squeeze.on.is_canvas() { " on the canvas" } else { "" }
                )
            }
            Self::Mask(change) => match change {
                MaskChange::PolygonMm(_) => "mask".to_owned(),
                MaskChange::Layer(layer) => format!("mask by {}", layer_name(*layer, dry)),
                MaskChange::Painted {} => "mask by all paint".to_owned(),
                MaskChange::Inverse(_) => "mask inverted".to_owned(),
                MaskChange::Clear {} => "mask off".to_owned(),
            },
            Self::Scrape { on: SurfaceId::Canvas } => "scrape the canvas".to_owned(),
            Self::Scrape { on: SurfaceId::Palette } => "scrape the palette".to_owned(),
            Self::Load(_)
            | Self::Wipe { .. }
            | Self::Wash { .. }
            | Self::Undo {}
            | Self::Redo {}
            | Self::Save { .. } => self.kind().to_owned(),
        }
    }

    /// This action with its numbers rounded: samples to four decimals, all others to six
    /// significant digits. If you write and read a rounded action, it stays the same.
    #[must_use]
    pub fn rounded(&self) -> Self {
        let mut rounded = self.clone();
        if let Self::Stroke(stroke) | Self::Cut(stroke) = &mut rounded {
            stroke.tool = stroke.tool.map(six_digits);
            for sample in &mut stroke.samples {
                *sample = SampleDecimals::RECORDING.round(sample);
            }
        }
        rounded.numbers(f64::INFINITY).into_iter().for_each(Number::round);
        rounded
    }
}

/// A number of an action, with its limits.
struct Number<'a> {
    field: Cow<'static, str>,
    value: NumberRef<'a>,
    limits: RangeInclusive<f64>,
    /// Whether we refuse 0, although it is within the limits.
    above_zero: bool,
}

enum NumberRef<'a> {
    Double(&'a mut f64),
    Single(&'a mut f32),
}

impl Number<'_> {
    fn above_zero(self) -> Self {
        Self { above_zero: true, ..self }
    }

    fn check(&self, at: &CheckContext, prefix: &str) -> Checked {
        let value = match &self.value {
            NumberRef::Double(value) => **value,
            NumberRef::Single(value) => f64::from(**value),
        };
        let lowest = *self.limits.start();
        let highest = *self.limits.end();
        if (lowest..=highest).contains(&value) && (value > 0.0 || !self.above_zero) {
            return Ok(());
        }
        let field = format!("{prefix}{}", self.field);
        at.range(&field, value, lowest, highest)?;
        at.above_zero(&field, value)
    }

    fn round(self) {
        match self.value {
            NumberRef::Double(value) => *value = six_digits(*value),
            NumberRef::Single(value) => *value = six_digits(f64::from(*value)) as f32,
        }
    }
}

/// `value` rounded to six significant digits. This never gives -0, which a file cannot tell from 0.
pub(crate) fn six_digits(value: f64) -> f64 {
    digits::rounded(value) + 0.0
}

fn number<'a>(field: &'static str, value: &'a mut f64, limits: RangeInclusive<f64>) -> Number<'a> {
    let value = NumberRef::Double(value);
    Number { field: Cow::Borrowed(field), value, limits, above_zero: false }
}

fn share<'a>(field: &'static str, value: &'a mut f64) -> Number<'a> {
    number(field, value, 0.0..=1.0)
}

fn parts(recipe: &mut Recipe) -> impl Iterator<Item = Number<'_>> {
    recipe.iter_mut().map(|(pigment, parts)| Number {
        field: Cow::Owned(format!("recipe, {pigment}")),
        value: NumberRef::Double(parts),
        limits: 0.0..=1e6,
        above_zero: false,
    })
}

fn light_numbers(lighting: &mut Lighting) -> [Number<'_>; 5] {
    let Lighting { azimuth_deg, elevation_deg, ambient, relief, adaptation, .. } = lighting;
    [
        number("azimuth_deg", azimuth_deg, -360.0..=360.0),
        number("elevation_deg", elevation_deg, 0.0..=90.0).above_zero(),
        share("ambient", ambient),
        number("relief", relief, 0.0..=100.0),
        share("adaptation", adaptation),
    ]
}

fn single<'a>(field: &'static str, value: &'a mut f32, highest: f64) -> Number<'a> {
    Number {
        field: Cow::Borrowed(field),
        value: NumberRef::Single(value),
        limits: 0.0..=highest,
        above_zero: false,
    }
}

fn gloss_numbers<'a>(wet: &'a mut Gloss, dry: &'a mut Gloss) -> [Number<'a>; 4] {
    [
        single("wet.strength", &mut wet.strength, 100.0),
        single("wet.exponent", &mut wet.exponent, 1e6),
        single("dry.strength", &mut dry.strength, 100.0),
        single("dry.exponent", &mut dry.exponent, 1e6),
    ]
}

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
    /// Checks the numbers of an action, and that its surface exists. We look up the names of
    /// brushes and pigments elsewhere.
    pub(crate) fn check(&self, at: &CheckContext, action: &Action) -> Checked {
        match action {
            Action::Stroke(stroke) | Action::Cut(stroke) => return self.check_stroke(at, stroke),
            Action::Squeeze(Squeeze { on, .. }) | Action::Scrape { on } => {
                self.reach_mm(at, *on)?;
            }
            Action::Mask(change) => check_mask(at, change)?,
            _ => {}
        }
        let reach_mm = self.reach_mm(at, SurfaceId::Canvas)?;
        for number in action.clone().numbers(reach_mm) {
            number.check(at, "")?;
        }
        action.check_rules(at)
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

pub(crate) fn check_tool(at: &CheckContext, tool: StrokeTool) -> Checked {
    tool.check().map_err(|error| at.invalid(error.field, error.wanted, &error.found, error.hint()))
}

/// Checks that a brush is one of `known`.
pub(crate) fn check_brush<'a>(
    at: &CheckContext,
    brush: &str,
    known: impl Iterator<Item = &'a str> + Clone,
) -> Checked {
    let is_known = known.clone().any(|name| name == brush);
    if is_known { Ok(()) } else { Err(unknown_brush(at, brush, known)) }
}

/// The error about a brush that is none of `known`.
pub(crate) fn unknown_brush<'a>(
    at: &CheckContext,
    brush: &str,
    known: impl Iterator<Item = &'a str>,
) -> Box<InvalidValue> {
    let hint = did_you_mean(brush, known).or_else(|| Some(Hint::new("declare it under `brushes`")));
    at.invalid("brush", "one of `brushes`", &brush, hint)
}

/// The start of a long text, on one line, for messages.
fn shortened(text: &str) -> String {
    let start: String = text.chars().take(100).collect();
    let more = if start.len() < text.len() { ".." } else { "" };
    format!("{}{more}", start.escape_debug())
}

pub(crate) fn check_size(at: &CheckContext, field: &str, size_mm: f64) -> Checked {
    at.range(field, size_mm, 0.2, 100.0)
}

fn check_mask(at: &CheckContext, change: &MaskChange) -> Checked {
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
    Ok(())
}

/// Checks the lighting of a painting. Names of its fields begin with `prefix`.
pub(super) fn check_light(at: &CheckContext, prefix: &str, lighting: &Lighting) -> Checked {
    for number in light_numbers(&mut lighting.clone()) {
        number.check(at, prefix)?;
    }
    check_light_names(at, prefix, lighting)
}

fn check_light_names(at: &CheckContext, prefix: &str, lighting: &Lighting) -> Checked {
    if let Err(error) = light_from_text(&lighting.illuminant) {
        let field = format!("{prefix}illuminant");
        let wanted = "a CIE illuminant, a temperature or a lamp's file";
        return Err(at.invalid(&field, wanted, &lighting.illuminant, error.hint()));
    }
    if let Err(error) = Observer::named(&lighting.observer) {
        let field = format!("{prefix}observer");
        let hint = Some(Hint::new(error.to_string()));
        return Err(at.invalid(&field, "an observer", &lighting.observer, hint));
    }
    Ok(())
}

pub(super) fn check_medium(medium: &Medium) -> Checked {
    let at = CheckContext::default();
    at.range("medium.scattering_per_mm", medium.scattering_per_mm, 1e-3, 1e6)?;
    at.range("medium.stiffness", medium.stiffness, 0.0, 1.0)?;
    for number in gloss_numbers(&mut medium.wet.clone(), &mut medium.dry.clone()) {
        number.check(&at, "medium.")?;
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

fn check_recipe(at: &CheckContext, recipe: &Recipe, vehicle: f64) -> Checked {
    if recipe.len() > SLOTS {
        let wanted = format!("at most {SLOTS} pigments");
        return Err(at.invalid("recipe", &wanted, &recipe.len(), None));
    }
    let paint = recipe.values().fold(0.0, |sum, parts| sum + parts);
    if paint <= 0.0 && vehicle < 1.0 {
        let hint = Hint::new("clear vehicle alone is \"vehicle\": 1");
        return Err(at.invalid("recipe", "parts that sum to more than 0", &paint, Some(hint)));
    }
    Ok(())
}

/// Returns `None` if a script may save to `path`, else a description of the paths allowed. A path
/// is relative, at most 255 bytes long, without `..`, hidden names, names of Windows devices and
/// characters that Windows forbids, and ends in `.exr` or `.png`.
pub(super) fn violation(path: &str) -> Option<&'static str> {
    if path.len() > 255 {
        return Some("a path of at most 255 bytes");
    }
    if path.contains(|letter: char| letter.is_control() || "\\:*?\"<>|".contains(letter)) {
        return Some("a path without control characters and \\ : * ? \" < > |");
    }
    for part in path.split('/') {
        if part.is_empty() || part.starts_with('.') || part.ends_with(['.', ' ']) {
            return Some("a path below the script's folder, without `..` and hidden names");
        }
        let stem = part.split('.').next().unwrap_or(part).trim_end().to_ascii_lowercase();
        let numbered = stem.strip_prefix("com").or_else(|| stem.strip_prefix("lpt"));
        let device = ["con", "prn", "aux", "nul"].contains(&stem.as_str())
            || numbered.is_some_and(|rest| rest.len() == 1 && rest != "0");
        if device {
            return Some("a file, not a device");
        }
    }
    let lower = path.to_ascii_lowercase();
    let known = [".exr", ".png"].iter().any(|ending| lower.ends_with(ending));
    (!known).then_some("a path that ends in .exr or .png")
}

fn percent(share: f64) -> String {
    format!("{} %", (share * 1000.0).round() / 10.0)
}

fn layer_name(layer: LayerRef, dry: &[DryLayerState]) -> String {
    let (found, id) = match layer {
        LayerRef::Wet => return "wet paint".to_owned(),
        LayerRef::Dry(index) => (dry.get(index), LayerId::by_place(index)),
        LayerRef::Id(id) => (dry.iter().find(|layer| layer.id == id), id),
    };
    found.map_or_else(|| layer_label(id, ""), DryLayerState::label)
}

/// Names the surface of a stroke, if it is not the canvas.
fn place(on: SurfaceId) -> &'static str {
    if on.is_canvas() { "" } else { " on the palette" }
}

pub(crate) type Checked = Result<(), Box<InvalidValue>>;

/// Action and sample that are being checked.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CheckContext {
    /// Index of the action from 0, and its key. For the header of a script and for an action
    /// outside a script, this is `None`.
    action: Option<(usize, &'static str)>,
    sample: Option<usize>,
}

impl CheckContext {
    /// The action `index` of a script, whose key is `kind`.
    pub(super) fn action(index: usize, kind: &'static str) -> Self {
        Self { action: Some((index, kind)), sample: None }
    }

    /// The sample `index` of this stroke.
    pub(crate) fn sample(self, index: usize) -> Self {
        Self { sample: Some(index), ..self }
    }

    /// An error about `field` at this place.
    pub(crate) fn invalid(
        &self,
        field: &str,
        wanted: &str,
        found: &dyn std::fmt::Display,
        hint: Option<Hint>,
    ) -> Box<InvalidValue> {
        let action = self.action;
        let sample = self.sample;
        let location = ValueLocation { action, sample, field: field.to_owned() };
        Box::new(InvalidValue {
            location,
            wanted: wanted.to_owned(),
            found: found.to_string(),
            hint,
        })
    }

    pub(crate) fn range(&self, field: &str, value: f64, lowest: f64, highest: f64) -> Checked {
        if (lowest..=highest).contains(&value) {
            return Ok(());
        }
        // Large numbers have an exponent: written out, 1e300 would take 301 digits.
        let found = if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") };
        Err(self.invalid(field, &format!("{lowest} to {highest}"), &found, None))
    }

    pub(super) fn above_zero(&self, field: &str, value: f64) -> Checked {
        if value > 0.0 { Ok(()) } else { Err(self.invalid(field, "above 0", &value, None)) }
    }
}

/// "did you mean", with the names of `known` that are spelt like `name`.
pub(crate) fn did_you_mean<'a>(
    name: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<Hint> {
    documents::did_you_mean(name, known).map(Hint::new)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_save_below_their_folder_only() {
        for path in ["a.exr", "out/a b.png", "sub/dir/x.EXR", "compass.png", "x.y.png"] {
            assert_eq!(violation(path), None, "{path}");
        }
        for path in [
            "",
            "/a.exr",
            "../a.exr",
            "a/../../b.exr",
            "a//b.exr",
            "./a.exr",
            ".bashrc",
            "a/.b.png",
            "C:\\a.exr",
            "C:a.exr",
            "\\\\host\\a.exr",
            "a.sh",
            "a",
            "a.exr/",
            "nul.exr",
            "COM1.png",
            "a\n.exr",
            "a\0.exr",
            "~",
            "a.exr.",
            "a.exr ",
            "a /b.exr",
        ] {
            assert!(violation(path).is_some(), "{path:?}");
        }
        assert!(violation(&format!("{}.exr", "a".repeat(300))).is_some(), "too long");
    }
}
