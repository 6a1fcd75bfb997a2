//! Imports brushes of MyPaint as far as their settings mean something for a brush with hairs. A
//! `.myb` file (version 3) holds settings, each with a base value and dynamics.
//!
//! | MyPaint | here |
//! | --- | --- |
//! | `radius_logarithmic` | size in mm: the diameter at half pressure, where a pixel is [`MM_PER_PIXEL`] wide |
//! | `radius_logarithmic` by `pressure` | curve of the pressure: the radius as a share of the largest |
//! | `opaque_multiply` or `opaque` by `pressure` | curve of the pressure, if the radius has none |
//! | `opaque` | share of clear medium in a load: one minus the value |
//! | `smudge` | height of a load: 0.3 mm times one minus the value, and no load from 0.95 on |
//! | `slow_tracking` | moving average over the path of a pen at 100 mm/s: 2 mm per unit, because MyPaint's filter lags by 0.01 s per unit and an average by half its length |
//! | `elliptical_dab_ratio` | from 1.5 on a flat, else a round |
//! | `elliptical_dab_angle` | fixed twist, or across the stroke with dynamics by `direction`, or with the pen by `tilt_ascension` |
//!
//! The settings have the names of MyPaint's public documentation (`brushsettings.json`). The import
//! lists every other setting and dynamic as meaningless, so nothing is dropped silently.

use documents::hint::Hint;
use paint::brush::HeadShape;
use paint::strokes::{BrushSpec, Recipe};
use serde_json::Value;

use super::options::{BrushOptions, LengthUnit, StabiliserMethod, StabiliserSettings, TwistUse};
use super::points::{CurvePoints, PressureCurve};
use super::reading::{BrushFileError, Object};
use super::set::{BrushPreset, PresetLoad, proper_name};

/// Millimetres per pixel of MyPaint unless you pass another value: the width of a cell of a new
/// canvas, so that a brush covers as many cells here as it covered pixels there.
pub const MM_PER_PIXEL: f64 = 0.1;

const LOAD_MM: f64 = 0.3;

/// A brush that smudges at least this much takes no load.
const SMUDGES_ONLY: f64 = 0.95;

const MM_PER_TRACKING: f64 = 2.0;

/// From this ratio of a dab's axes on, the brush is a flat.
const FLAT_RATIO: f64 = 1.5;

/// An imported brush, and what happened to each of its settings.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedBrush {
    /// The brush in our own format.
    pub preset: BrushPreset,
    /// Settings that we imported, each with its effect, e.g. `opaque: 80 % medium in a load`.
    pub taken: Vec<String>,
    /// Settings and dynamics that mean nothing here.
    pub meaningless: Vec<String>,
}

/// Settings of a file that have not been used yet.
struct Import {
    settings: Vec<MybSetting>,
    taken: Vec<String>,
    meaningless: Vec<String>,
}

/// Imports the brush that the text of a `.myb` file describes. Errors call the file `file`, and the
/// brush is named after it, without folder and extension. `mm_per_pixel` is the width of a pixel.
///
/// # Errors
/// [`BrushFileError`] if the text is not a MyPaint brush of version 3, with the key at fault.
pub fn brush_of_myb(
    text: &str,
    file: &str,
    mm_per_pixel: f64,
) -> Result<ImportedBrush, BrushFileError> {
    let (settings, described) = read(text, file)?;
    let mut import = Import { settings, taken: Vec::new(), meaningless: Vec::new() };
    let (size_mm, by_radius) = import.radius(mm_per_pixel);
    let (vehicle, by_opacity) = import.opacity(by_radius.is_some());
    let amount_mm = import.smudge();
    let stabiliser = import.tracking();
    let shape = import.ratio();
    let twist = import.angle(shape);
    for setting in std::mem::take(&mut import.settings) {
        let inputs: Vec<&str> = setting.inputs.iter().map(|(input, _)| input.as_str()).collect();
        let by =
            if inputs.is_empty() { String::new() } else { format!(" by {}", inputs.join(", ")) };
        import.meaningless.push(format!("{}{by}", setting.name));
    }
    let described = described.into_iter().filter(|key| key != "notes");
    import.meaningless.extend(described);
    let curve = by_radius.or(by_opacity);
    let options = BrushOptions { twist, curve, stabiliser, ..BrushOptions::default() };
    let amount =
        amount_mm.map(|amount_mm| PresetLoad { recipe: Recipe::new(), vehicle, amount_mm });
    let stem = std::path::Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
    let name = proper_name(&stem).unwrap_or_else(|| "brush".to_owned());
    let brush = BrushSpec { shape, size_mm };
    let preset = BrushPreset { name, brush, options, load: amount };
    Ok(ImportedBrush { preset, taken: import.taken, meaningless: import.meaningless })
}

impl Import {
    /// Removes a setting. Lists its dynamics as meaningless, except those named in `used`.
    fn take(&mut self, name: &str, used: &[&str]) -> Option<MybSetting> {
        let at = self.settings.iter().position(|setting| setting.name == name)?;
        let setting = self.settings.remove(at);
        for (input, _) in setting.inputs.iter().filter(|(input, _)| !used.contains(&&input[..])) {
            self.meaningless.push(format!("{name} by {input}"));
        }
        Some(setting)
    }

    fn radius(&mut self, mm_per_pixel: f64) -> (f64, Option<PressureCurve>) {
        let Some(radius) = self.take("radius_logarithmic", &["pressure"]) else {
            self.taken.push("no radius_logarithmic: size 6 mm".to_owned());
            return (6.0, None);
        };
        let pixels = 2.0 * radius.at("pressure", 0.5).exp();
        let wanted = pixels * mm_per_pixel;
        let size_mm = if wanted.is_finite() { wanted.clamp(0.2, 100.0) } else { 100.0 };
        let limit = if size_mm == wanted { "" } else { ", the nearest that there is" };
        self.taken.push(format!(
            "radius_logarithmic: {pixels:.1} pixels of {mm_per_pixel} mm, size {size_mm:.2} mm{limit}"
        ));
        let curve = self.curve(&radius, |x| radius.at("pressure", x).exp());
        (size_mm, curve)
    }

    fn opacity(&mut self, has_curve: bool) -> (f64, Option<PressureCurve>) {
        let used: &[&str] = if has_curve { &[] } else { &["pressure"] };
        let factor = self.take("opaque_multiply", used);
        let opaque = self.take("opaque", used);
        let mut curve = None;
        let sources = [factor, opaque.clone()];
        for source in sources.iter().flatten().filter(|_| !has_curve) {
            if curve.is_none() {
                curve = self.curve(source, |x| source.at("pressure", x).max(0.0));
            } else if source.input("pressure").is_some() {
                self.meaningless.push(format!("{} by pressure", source.name));
            }
        }
        let base = opaque.map(|opaque| opaque.base.clamp(0.0, 1.0));
        if let Some(base) = base {
            self.taken.push(format!("opaque: {:.0} % medium in a load", 100.0 * (1.0 - base)));
        }
        (base.map_or(0.0, |base| 1.0 - base), curve)
    }

    /// The curve of a setting's dynamics by pressure, as shares of the largest value.
    fn curve(&mut self, setting: &MybSetting, value: impl Fn(f64) -> f64) -> Option<PressureCurve> {
        setting.input("pressure")?;
        let values: Vec<[f64; 2]> =
            (0..=4).map(|at| f64::from(at) / 4.0).map(|x| [x, value(x)]).collect();
        let most = values.iter().fold(0.0, |most: f64, point| most.max(point[1]));
        let shares: Vec<[f64; 2]> =
            values.iter().map(|[x, y]| [*x, (y / most).clamp(0.0, 1.0)]).collect();
        let name = &setting.name;
        match CurvePoints::try_from(shares) {
            Ok(points) if most > 0.0 => {
                self.taken.push(format!("{name} by pressure: curve of the pressure"));
                Some(PressureCurve::Points(points))
            }
            _ => {
                self.meaningless.push(format!("{name} by pressure, which falls"));
                None
            }
        }
    }

    fn smudge(&mut self) -> Option<f64> {
        let smudge = self.take("smudge", &[]).map_or(0.0, |smudge| smudge.base.clamp(0.0, 1.0));
        if smudge == 0.0 {
            return Some(LOAD_MM);
        }
        if smudge >= SMUDGES_ONLY {
            self.taken.push("smudge: no load, moves the paint that lies there".to_owned());
            return None;
        }
        let amount_mm = LOAD_MM * (1.0 - smudge);
        self.taken.push(format!("smudge: loads of {amount_mm:.2} mm"));
        Some(amount_mm)
    }

    fn tracking(&mut self) -> Option<StabiliserSettings> {
        let tracking = self.take("slow_tracking", &[])?.base;
        let length = (MM_PER_TRACKING * tracking).min(100.0);
        let settings =
            StabiliserSettings { method: StabiliserMethod::Average, length, unit: LengthUnit::Mm };
        let used = settings.is_valid();
        let meaning = if used { format!("average over {length:.1} mm") } else { "off".to_owned() };
        self.taken.push(format!("slow_tracking: stabiliser, {meaning}"));
        used.then_some(settings)
    }

    fn ratio(&mut self) -> HeadShape {
        let Some(MybSetting { base: ratio, .. }) = self.take("elliptical_dab_ratio", &[]) else {
            return HeadShape::Round;
        };
        let shape = if ratio >= FLAT_RATIO { HeadShape::Flat } else { HeadShape::Round };
        self.taken.push(format!("elliptical_dab_ratio: {ratio:.1}, a {shape}"));
        shape
    }

    fn angle(&mut self, shape: HeadShape) -> TwistUse {
        let used = ["direction", "tilt_ascension"];
        let Some(angle) = self.take("elliptical_dab_angle", &used) else { return TwistUse::AsSet };
        if shape == HeadShape::Round {
            self.meaningless.push("elliptical_dab_angle of a round".to_owned());
            return TwistUse::AsSet;
        }
        let (twist, meaning) = if angle.input("direction").is_some() {
            (TwistUse::Stroke, "turns across the stroke".to_owned())
        } else if angle.input("tilt_ascension").is_some() {
            (TwistUse::Device, "turns with the pen".to_owned())
        } else {
            let degrees = angle.base.rem_euclid(180.0);
            (TwistUse::Fixed(degrees), format!("held at {degrees:.0} degrees"))
        };
        self.taken.push(format!("elliptical_dab_angle: {meaning}"));
        twist
    }
}

const MOST_POINTS: usize = 64;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct MybSetting {
    pub(super) name: String,
    pub(super) base: f64,
    /// Inputs that have an effect. Each point is an input value and what it adds to the base.
    pub(super) inputs: Vec<(String, Vec<[f64; 2]>)>,
}

impl MybSetting {
    /// Points of an input, if it has an effect.
    pub(super) fn input(&self, name: &str) -> Option<&[[f64; 2]]> {
        self.inputs.iter().find(|(input, _)| input == name).map(|(_, points)| &points[..])
    }

    /// The value at an input while all other inputs are absent, linear between the points.
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

/// The settings of a file sorted by name, and the other keys, which describe the brush.
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
