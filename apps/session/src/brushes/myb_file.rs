//! A brush file of MyPaint (`.myb`, version 3): settings with a base value and dynamics.

use documents::hint::Hint;
use serde_json::Value;

use super::error::BrushFileError;
use super::reading::Object;

/// Most points of one dynamic.
const MOST_POINTS: usize = 64;

/// One setting of a MyPaint brush.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MybSetting {
    /// Name of the setting.
    pub(super) name: String,
    /// Value without any input.
    pub(super) base: f64,
    /// Inputs that have an effect, each with points of input and what is added to the base.
    pub(super) inputs: Vec<(String, Vec<[f64; 2]>)>,
}

impl MybSetting {
    /// Points of an input, if it has an effect.
    pub(super) fn input(&self, name: &str) -> Option<&[[f64; 2]]> {
        self.inputs.iter().find(|(input, _)| input == name).map(|(_, points)| &points[..])
    }

    /// The value at an input, with all other inputs absent: linear between the points.
    pub(super) fn at(&self, input: &str, x: f64) -> f64 {
        self.base + self.input(input).map_or(0.0, |points| interpolated(points, x))
    }
}

fn interpolated(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.iter().position(|point| point[0] > x);
    match after {
        Some(0) => points[0][1],
        None => points.last().map_or(0.0, |point| point[1]),
        Some(after) => {
            let [x0, y0] = points[after - 1];
            let [x1, y1] = points[after];
            y0 + (y1 - y0) * (x - x0) / (x1 - x0)
        }
    }
}

/// The settings of a file in the order of their names, and its keys beside them, which describe
/// the brush.
pub(super) fn read(
    text: &str,
    file: &str,
) -> Result<(Vec<MybSetting>, Vec<String>), BrushFileError> {
    if text.trim_start().starts_with('#') {
        return Err(BrushFileError {
            file: file.to_owned(),
            key: String::new(),
            what: "is a brush of MyPaint 1.0 or older, which is not JSON".to_owned(),
            hint: Some(Hint::new(
                "open and save it in MyPaint 1.1 or later, which writes version 3",
            )),
        });
    }
    let mut object = Object::of_text(text, file)?;
    let version: u64 = object.need("version")?;
    if version != 3 {
        return Err(object.fault_at("version", format!("{version} is not known, only 3 is")));
    }
    let Some(settings) = object.take_object("settings")? else {
        return Err(object.fault_at("settings", "is missing"));
    };
    let settings = settings.rest();
    let settings: Result<Vec<MybSetting>, BrushFileError> =
        settings.into_iter().map(|(name, value)| setting(name, value, file)).collect();
    Ok((settings?, object.rest().into_iter().map(|(key, _)| key).collect()))
}

fn setting(name: String, value: Value, file: &str) -> Result<MybSetting, BrushFileError> {
    let mut object = Object::of_value(value, file, format!("settings.{name}"))?;
    let base: f64 = object.need("base_value")?;
    let inputs = object.take_object("inputs")?;
    let mut found = Vec::new();
    if let Some(mut inputs) = inputs {
        for input in inputs.names() {
            let points: Vec<[f64; 2]> = inputs.need(&input)?;
            if points.len() > MOST_POINTS {
                return Err(inputs.fault_at(&input, format!("has more than {MOST_POINTS} points")));
            }
            if points.windows(2).any(|pair| pair[1][0] <= pair[0][0]) {
                return Err(inputs.fault_at(&input, "has points that are not in ascending order"));
            }
            if points.iter().any(|point| point[1] != 0.0) {
                found.push((input, points));
            }
        }
    }
    object.end()?;
    Ok(MybSetting { name, base, inputs: found })
}
