//! A stroke script: its content, its check, and its JSON with one action per line.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use documents::hint::Hint;
use documents::{excerpt, name_violation};
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::action::{Action, PaletteSpec, SurfaceId, distinct_keys};
use super::table::{
    ActionLimits, CheckContext, Checked, check_brush, check_light, check_medium, check_palette,
    check_size,
};
use super::{MAX_ACTIONS, MAX_CELLS, MAX_FILE_BYTES, MAX_SAMPLES, ScriptError};
use crate::brush::{HeadShape, StrokeTool};
use crate::document::{Canvas, Document, Lighting, Medium};
use crate::layer::Layer;

/// A script: canvas, pigments and brushes, and the actions done with them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StrokeScript {
    /// The name `strokes`.
    pub(super) format: FormatName,
    /// The version number 1.
    pub(super) version: FormatVersion,
    /// Title of the painting.
    #[serde(default)]
    pub title: String,
    /// Licence of the script, for example `CC0-1.0`.
    #[serde(default)]
    pub licence: String,
    /// Size and ground of the canvas.
    pub canvas: Canvas,
    /// Size and ground of the palette that paint is mixed on, if there is one. Its cells
    /// are as wide as the canvas's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mixing: Option<Canvas>,
    /// Path of a painting (`.exr`) that you continue instead of a bare canvas. Size, pigments,
    /// medium and light come from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<String>,
    /// Whether you take the palette with its paint and the loads of the brushes from the file of
    /// `start` as well.
    #[serde(default, skip_serializing_if = "is_false")]
    pub table: bool,
    /// The binder. Oil by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub medium: Option<Medium>,
    /// The light. Daylight from the upper left by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lighting: Option<Lighting>,
    /// Pigment library for which you made the script: a path, or the title of a library.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<String>,
    /// Pigments of the wet layer before the first action.
    pub palette: PaletteSpec,
    /// Brushes by name.
    #[serde(deserialize_with = "distinct_keys")]
    pub brushes: BTreeMap<String, BrushSpec>,
    /// The actions in order.
    #[serde(deserialize_with = "bounded_actions")]
    pub actions: Vec<Action>,
}

impl StrokeScript {
    /// A script without brushes and actions.
    #[must_use]
    pub fn new(title: &str, licence: &str, canvas: Canvas, palette: PaletteSpec) -> Self {
        Self {
            format: FormatName::Strokes,
            version: FormatVersion,
            title: title.to_owned(),
            licence: licence.to_owned(),
            canvas,
            mixing: None,
            start: None,
            table: false,
            medium: None,
            lighting: None,
            library: None,
            palette,
            brushes: BTreeMap::new(),
            actions: Vec::new(),
        }
    }

    /// The script without its actions.
    #[must_use]
    pub fn header(&self) -> Self {
        let Self { format, version, title, licence, canvas, mixing, start, .. } = self;
        let Self { medium, lighting, library, palette, brushes, .. } = self;
        Self {
            format: *format,
            version: *version,
            title: title.clone(),
            licence: licence.clone(),
            canvas: canvas.clone(),
            mixing: mixing.clone(),
            start: start.clone(),
            table: self.table,
            medium: medium.clone(),
            lighting: lighting.clone(),
            library: library.clone(),
            palette: palette.clone(),
            brushes: brushes.clone(),
            actions: Vec::new(),
        }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_false(value: &bool) -> bool {
    !*value
}

/// Deserializes a list of actions, and stops at the first beyond [`MAX_ACTIONS`].
fn bounded_actions<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Action>, D::Error> {
    struct Actions;

    impl<'de> Visitor<'de> for Actions {
        type Value = Vec<Action>;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("a list of actions")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<Action>, A::Error> {
            let mut actions = Vec::new();
            while let Some(action) = list.next_element()? {
                if actions.len() == MAX_ACTIONS {
                    return Err(de::Error::custom(format!("more than {MAX_ACTIONS} actions")));
                }
                actions.push(action);
            }
            Ok(actions)
        }
    }

    deserializer.deserialize_seq(Actions)
}

/// Shape and size of a brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BrushSpec {
    /// The shape of its head.
    pub shape: HeadShape,
    /// Width of its mark at half pressure in mm, 0.2 to 100.
    pub size_mm: f64,
}

/// The name of the format. Serde refuses any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum FormatName {
    /// Written `strokes` in a file.
    Strokes,
}

/// The version that we read and write. Serde refuses any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "u64", into = "u64")]
pub(super) struct FormatVersion;

impl FormatVersion {
    /// Version number in a file.
    pub(super) const NUMBER: u64 = 1;
}

impl From<FormatVersion> for u64 {
    fn from(_: FormatVersion) -> Self {
        FormatVersion::NUMBER
    }
}

impl TryFrom<u64> for FormatVersion {
    type Error = String;

    fn try_from(version: u64) -> Result<Self, String> {
        if version == Self::NUMBER { Ok(Self) } else { Err(format!("version `{version}`")) }
    }
}

/// A brush with the paint that its head holds.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptBrush {
    /// Name of the brush.
    pub name: String,
    /// Shape and size of its head.
    pub spec: BrushSpec,
    /// Surface where it was last used.
    pub at: SurfaceId,
    /// Paint on the cells of its head, with the pigments of the palette. `None` if it is clean.
    pub paint: Option<Layer>,
}

/// The palette with its paint, and all brushes with theirs.
#[derive(Debug, Clone, PartialEq)]
pub struct SideTable {
    /// The palette that paint is mixed on, with the pigments, light and medium of the canvas.
    pub palette: Document,
    /// The brushes in the order of their names.
    pub brushes: Vec<KeptBrush>,
}

impl StrokeScript {
    /// Finds the brushes that paint on the canvas before you load them or move them over the
    /// palette. You get the index of the first such stroke and the brush's name, in order. Such a
    /// stroke only moves the paint that lies there. We leave out brushes of `kept`, which come with
    /// paint of an earlier session.
    #[must_use]
    pub fn unloaded_brushes(&self, kept: &BTreeSet<&str>) -> Vec<(usize, &str)> {
        let mut seen = kept.clone();
        let mut found = Vec::new();
        for (index, action) in self.actions.iter().enumerate() {
            match action {
                Action::Load(load) => {
                    seen.insert(&load.brush);
                }
                Action::Stroke(stroke) | Action::Cut(stroke) => {
                    let paints = stroke.on.is_canvas() && stroke.tool == StrokeTool::Paint;
                    let is_first = seen.insert(&stroke.brush);
                    if paints && is_first {
                        found.push((index, stroke.brush.as_str()));
                    }
                }
                _ => {}
            }
        }
        found
    }
}

impl StrokeScript {
    /// Checks that every number is in range and every brush is declared. To look up the pigments,
    /// call [`StrokeScript::resolve`].
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
        for (field, names) in [
            ("brushes", self.brushes.keys().collect::<Vec<_>>()),
            (
                "palette",
                self.palette.pigments.iter().filter_map(|(short, _)| short.as_ref()).collect(),
            ),
        ] {
            let wrong = names.iter().find_map(|name| Some((name_violation(name)?, name)));
            if let Some((wanted, name)) = wrong {
                return Err(top.invalid(field, wanted, &excerpt(name), None));
            }
        }
        for (name, brush) in &self.brushes {
            check_size(&top, &format!("brushes.{name}.size_mm"), brush.size_mm)?;
        }
        Ok(())
    }

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

/// Checks the path of the painting that a script continues. The program decides which folders
/// it may lead to ([`documents::file::NamedFiles`]).
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

impl StrokeScript {
    /// Reads a script from `bytes`, the content of the file named `file`.
    ///
    /// # Errors
    /// [`ScriptError`] for a file that is too long, not UTF-8, not JSON, or of another
    /// format or version, for unknown, missing and repeated keys, and for values out of
    /// range (see [`StrokeScript::check`]).
    pub fn from_json(file: &str, bytes: &[u8]) -> Result<Self, ScriptError> {
        if bytes.len() > MAX_FILE_BYTES {
            let bytes = bytes.len();
            let limit = MAX_FILE_BYTES;
            return Err(ScriptError::TooLong { file: file.to_owned(), bytes, limit });
        }
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let (sound, rest) = bytes.split_at(error.valid_up_to());
            let line = 1 + sound.iter().filter(|byte| **byte == b'\n').count();
            let byte = rest.first().copied().unwrap_or(0);
            ScriptError::Encoding { file: file.to_owned(), line, byte }
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let script: Self =
            serde_json::from_str(text).map_err(|error| explained(file, text, &error))?;
        script.check().map_err(|error| error.in_file(file))?;
        Ok(script)
    }

    /// The script without its actions, with numbers rounded to the digits of a file.
    ///
    /// # Errors
    /// [`ScriptError`] for values out of range (see [`StrokeScript::check`]).
    pub fn rounded_header(&self) -> Result<Self, ScriptError> {
        Self::from_json(&self.title, self.header().to_json()?.as_bytes())
    }

    /// Writes the script as JSON with one action per line. Samples have four decimals, all other
    /// numbers six significant digits. Equal scripts give equal bytes.
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
        // We write the actions one by one, because they would take much memory as one value.
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

/// Converts an error of the parser. If the cause is another format or version, you get an error
/// about this.
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
    fn brushes_without_paint_are_found_once() {
        let actions = [
            stroke("dry", ""),
            stroke("dry", ""),
            r#"{"load": {"brush": "wet", "recipe": {"W": 1}, "amount_mm": 0.3}}"#.to_owned(),
            stroke("wet", ""),
            stroke("soft", r#""tool": "blend","#),
            stroke("kept", ""),
        ];
        let brush = r#"{"shape": "flat", "size_mm": 5}"#;
        let brushes = ["dry", "wet", "soft", "kept"].map(|name| format!(r#""{name}": {brush}"#));
        let text = format!(
            r#"{{"format": "strokes", "version": 1, "title": "", "palette": {{"W": "Lead White"}},
            "canvas": {{"width_mm": 9, "height_mm": 9, "cell_mm": 0.2}},
            "brushes": {{{}}}, "actions": [{}]}}"#,
            brushes.join(", "),
            actions.join(", ")
        );
        let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
        assert_eq!(script.unloaded_brushes(&BTreeSet::from(["kept"])), [(0, "dry")]);
        assert_eq!(script.unloaded_brushes(&BTreeSet::new()), [(0, "dry"), (5, "kept")]);
    }

    fn stroke(brush: &str, more: &str) -> String {
        format!(r#"{{"stroke": {{"brush": "{brush}", {more} "samples": [[0, 1, 1, 0.5]]}}}}"#)
    }
}
