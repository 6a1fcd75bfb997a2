//! Reading and checking of scripts: JSON with one action per line, the checks of a whole script, and
//! the place of a value that is refused.
//!
//! A script saves only below the folder that its player chose.

use documents::hint::{Explain, Hint};
use serde::Deserialize;
use serde_json::Value;
use spectra::{Observer, light_from_text};

use super::action::{Action, Load, PaletteSpec, Recipe, Squeeze, Stroke, SurfaceId, numbers};
use super::script::{FormatVersion, StrokeScript};
use super::{
    InvalidValue, MAX_ACTIONS, MAX_CELLS, MAX_FILE_BYTES, MAX_MASK_POINTS, MAX_SAMPLES,
    ScriptError, ValueLocation,
};
use crate::brush::StrokeTool;
use crate::document::{Canvas, Lighting, Medium};
use crate::layer::{SLOTS, layer_name_violation};
use crate::optics::Gloss;
use crate::painting::{LayerRef, MaskChange};
use crate::pose::Sample;

/// Result of a check.
pub(crate) type Checked = Result<(), Box<InvalidValue>>;

/// Action and sample that are being checked.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CheckContext {
    /// Index of the action from 0, and its key; `None` for the header of a script and for
    /// an action that is in no script.
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

    /// Checks that `value` lies in `lowest..=highest`.
    pub(crate) fn range(&self, field: &str, value: f64, lowest: f64, highest: f64) -> Checked {
        if (lowest..=highest).contains(&value) {
            return Ok(());
        }
        // Large numbers have an exponent: written out, 1e300 would take 301 digits.
        let found = if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") };
        Err(self.invalid(field, &format!("{lowest} to {highest}"), &found, None))
    }

    /// Checks that `value` is above 0.
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
            Action::Save { path } => match violation(path) {
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

/// `None` if a script may save to `path`, else a description of the paths allowed. A path
/// is relative, at most 255 bytes long, without `..`, hidden names, names of Windows
/// devices and characters that Windows forbids, and ends in `.exr` or `.png`.
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

impl StrokeScript {
    /// Checks that every number is in range and every brush is declared. Pigments are
    /// looked up by [`StrokeScript::resolve`].
    ///
    /// # Errors
    /// [`ScriptError::Invalid`] with action, sample and field.
    pub fn check(&self) -> Result<(), ScriptError> {
        Ok(self.check_values()?)
    }

    pub(super) fn check_values(&self) -> Checked {
        self.check_header()?;
        let mut samples = 0;
        if self.actions.len() > MAX_ACTIONS {
            let wanted = format!("at most {MAX_ACTIONS}");
            return Err(CheckContext::default().invalid(
                "actions",
                &wanted,
                &self.actions.len(),
                None,
            ));
        }
        let limits = self.limits();
        for (index, action) in self.actions.iter().enumerate() {
            let at = CheckContext::action(index, action.kind());
            if let Some(brush) = action.brush() {
                check_brush(&at, brush, self.brushes.keys().map(String::as_str))?;
            }
            limits.check(&at, action)?;
            if let Some(stroke) = action.stroke() {
                samples += stroke.samples.len();
            }
            if samples > MAX_SAMPLES {
                let wanted = format!("at most {MAX_SAMPLES} of all strokes so far");
                let hint = Hint::new("record fewer samples a second, or several scripts");
                return Err(at.invalid("samples", &wanted, &samples, Some(hint)));
            }
        }
        Ok(())
    }

    fn check_header(&self) -> Checked {
        let top = CheckContext::default();
        check_canvas("canvas", &self.canvas)?;
        if let Some(mixing) = &self.mixing {
            check_canvas("mixing", mixing)?;
            let cell_mm = self.canvas.cell_mm;
            if mixing.cell_mm != cell_mm {
                let hint = Some(Hint::new(format!("\"cell_mm\": {cell_mm}")));
                let wanted = format!("that of the canvas, {cell_mm}");
                return Err(top.invalid("mixing.cell_mm", &wanted, &mixing.cell_mm, hint));
            }
        }
        if let Some(start) = &self.start {
            check_start(start)?;
            let own = [("medium", self.medium.is_some()), ("lighting", self.lighting.is_some())];
            if let Some((field, _)) = own.iter().find(|(_, given)| *given) {
                let wanted = "left out with `start`: that painting has its own";
                return Err(top.invalid(
                    field,
                    wanted,
                    &"both",
                    Some(Hint::new(format!("leave `{field}` out"))),
                ));
            }
        }
        if self.table && (self.start.is_none() || self.mixing.is_none()) {
            let hint = Some(Hint::new("name the painting as `start`, and describe `mixing`"));
            return Err(top.invalid("table", "only with `start` and `mixing`", &true, hint));
        }
        if let Some(medium) = &self.medium {
            check_medium(medium)?;
        }
        if let Some(lighting) = &self.lighting {
            check_light(&top, "lighting.", lighting)?;
        }
        check_palette(&top, &self.palette)?;
        for (name, brush) in &self.brushes {
            check_size(&top, &format!("brushes.{name}.size_mm"), brush.size_mm)?;
        }
        Ok(())
    }

    /// Limits of the script's actions.
    pub(crate) fn limits(&self) -> ActionLimits {
        ActionLimits {
            canvas_mm: self.canvas.longer_side_mm(),
            palette_mm: self.mixing.as_ref().map(Canvas::longer_side_mm),
        }
    }
}

fn check_canvas(key: &str, canvas: &Canvas) -> Checked {
    let at = CheckContext::default();
    at.range(&format!("{key}.cell_mm"), canvas.cell_mm, 0.001, 10.0)?;
    for (field, side) in [("width_mm", canvas.width_mm), ("height_mm", canvas.height_mm)] {
        at.range(&format!("{key}.{field}"), side, 0.001, 1e6)?;
    }
    let (width, height) = canvas.cells();
    if (width as u64).saturating_mul(height as u64) > MAX_CELLS {
        let wanted = format!("at most {MAX_CELLS} cells, which take 6 GB");
        let least = (canvas.width_mm * canvas.height_mm / MAX_CELLS as f64).sqrt();
        let cell_mm = (least * 1000.0).ceil() / 1000.0 + 0.001;
        let hint = Hint::new(format!("\"cell_mm\": {cell_mm:.3}"));
        return Err(at.invalid(key, &wanted, &format!("{width} x {height}"), Some(hint)));
    }
    Ok(())
}

/// Checks the path of the painting that a script continues. Like the path of a library, it
/// may lead to any folder.
fn check_start(path: &str) -> Checked {
    let fits = (1..=1024).contains(&path.len())
        && !path.contains(char::is_control)
        && path.to_ascii_lowercase().ends_with(".exr");
    if fits {
        return Ok(());
    }
    let wanted = "the path of a painting, which ends in .exr";
    let hint = Hint::new("save the painting as an .exr file");
    Err(CheckContext::default().invalid("start", wanted, &path, Some(hint)))
}

fn check_medium(medium: &Medium) -> Checked {
    let at = CheckContext::default();
    at.range("medium.scattering_per_mm", medium.scattering_per_mm, 1e-3, 1e6)?;
    at.range("medium.stiffness", medium.stiffness, 0.0, 1.0)?;
    check_gloss(&at, "medium.", medium.wet, medium.dry)
}

impl StrokeScript {
    /// Reads a script from `bytes`, the content of the file named `file`.
    ///
    /// # Errors
    /// [`ScriptError`] for a file that is too long, not UTF-8, not JSON, or of another
    /// format or version, for unknown, missing and repeated keys, and for values out of
    /// range (see [`StrokeScript::check`]).
    pub fn from_json(file: &str, bytes: &[u8]) -> Result<Self, ScriptError> {
        let named = || file.to_owned();
        if bytes.len() > MAX_FILE_BYTES {
            let bytes = bytes.len();
            let limit = MAX_FILE_BYTES;
            return Err(ScriptError::TooLong { file: named(), bytes, limit });
        }
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let (sound, rest) = bytes.split_at(error.valid_up_to());
            let line = 1 + sound.iter().filter(|byte| **byte == b'\n').count();
            ScriptError::Encoding { file: named(), line, byte: rest.first().copied().unwrap_or(0) }
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let script: Self =
            serde_json::from_str(text).map_err(|error| explained(file, text, &error))?;
        script.check_values().map_err(|invalid| ScriptError::Value { file: named(), invalid })?;
        Ok(script)
    }

    /// The script without its actions, with numbers rounded to the digits of a file.
    ///
    /// # Errors
    /// [`ScriptError`] for values out of range (see [`StrokeScript::check`]).
    pub fn rounded_header(&self) -> Result<Self, ScriptError> {
        Self::from_json(&self.title, self.header().to_json()?.as_bytes())
    }

    /// Writes the script as JSON with one action per line. Samples have four decimals, all
    /// other numbers six significant digits. The same script gives the same bytes.
    ///
    /// # Errors
    /// [`ScriptError`] for values out of range (see [`StrokeScript::check`]).
    pub fn to_json(&self) -> Result<String, ScriptError> {
        self.check()?;
        let unwritable = |error: serde_json::Error| ScriptError::Syntax {
            file: self.title.clone(),
            line: 0,
            column: 0,
            reason: error.to_string(),
        };
        // The actions are written one by one: as one value they would take much memory.
        let head = serde_json::to_value(self.header()).map_err(unwritable)?;
        let mut text = "{\n".to_owned();
        for (key, value) in
            head.as_object().into_iter().flatten().filter(|(key, _)| *key != "actions")
        {
            text.push_str(&format!("  \"{key}\": "));
            write(value, &mut text);
            text.push_str(",\n");
        }
        text.push_str("  \"actions\": [");
        for (index, action) in self.actions.iter().enumerate() {
            text.push_str(if index == 0 { "\n    " } else { ",\n    " });
            text.push_str(&action_line(action).map_err(unwritable)?);
        }
        text.push_str(if self.actions.is_empty() { "]\n}\n" } else { "\n  ]\n}\n" });
        Ok(text)
    }
}

/// An action as one line of a file, with its numbers rounded.
pub(crate) fn action_line(action: &Action) -> Result<String, serde_json::Error> {
    let action = &action.rounded();
    let mut text = String::new();
    write(&serde_json::to_value(action)?, &mut text);
    Ok(text)
}

/// Converts an error of the parser; if the cause is another format or version, names that.
fn explained(file: &str, text: &str, error: &serde_json::Error) -> ScriptError {
    #[derive(Deserialize)]
    struct Kind {
        #[serde(default)]
        format: Value,
        #[serde(default)]
        version: Value,
    }
    let file = file.to_owned();
    if error.is_data()
        && let Ok(Kind { format, version }) = serde_json::from_str(text)
    {
        if format != "strokes" {
            return ScriptError::Format { file, found: format.to_string() };
        }
        if version != FormatVersion::NUMBER {
            let newest = FormatVersion::NUMBER;
            return ScriptError::Version { file, found: version.to_string(), newest };
        }
    }
    // The parser's message ends with line and column, which this error states separately.
    let reason = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let reason = reason.strip_suffix(&place).unwrap_or(&reason);
    let reason = documents::plain_parser_message(reason);
    ScriptError::Syntax { file, line: error.line(), column: error.column(), reason }
}

/// Appends `value` to `text` on one line.
fn write(value: &Value, text: &mut String) {
    match value {
        Value::Object(map) => {
            text.push('{');
            for (index, (key, item)) in map.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { ", " });
                text.push_str(&Value::from(key.as_str()).to_string());
                text.push_str(": ");
                write(item, text);
            }
            text.push('}');
        }
        Value::Array(items) => {
            text.push('[');
            for (index, item) in items.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { ", " });
                match item {
                    // Numbers of samples are already rounded.
                    Value::Array(row) => write_row(row, text),
                    _ => write(item, text),
                }
            }
            text.push(']');
        }
        Value::Number(number) => match number.as_f64() {
            Some(value) if number.is_f64() => {
                text.push_str(&plain(pigment::digits::rounded(value)));
            }
            _ => text.push_str(&number.to_string()),
        },
        _ => text.push_str(&value.to_string()),
    }
}

fn write_row(row: &[Value], text: &mut String) {
    text.push('[');
    for (index, item) in row.iter().enumerate() {
        text.push_str(if index == 0 { "" } else { "," });
        match item.as_f64() {
            Some(number) => text.push_str(&plain(number)),
            None => write(item, text),
        }
    }
    text.push(']');
}

/// A number without `.0`, and without the sign of -0.
fn plain(number: f64) -> String {
    if number == 0.0 { "0".to_owned() } else { number.to_string() }
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
