//! A set of the painter's own brushes, and its file (`impasto-brushes`, version 1).
//!
//! ```json
//! {
//!   "format": "impasto-brushes",
//!   "version": 1,
//!   "name": "Portraits",
//!   "presets": [
//!     {
//!       "name": "soft filbert",
//!       "brush": { "shape": "filbert", "size_mm": 8 },
//!       "options": { "tilt": "ignored", "twist": { "fixed": 30 }, "range": [0.1, 0.9],
//!                    "curve": { "power": 1.6 },
//!                    "stabiliser": { "method": "string", "length": 4, "unit": "mm" } },
//!       "load": { "recipe": { "Zinc White": 1 }, "vehicle": 0.2, "amount_mm": 0.3 }
//!     }
//!   ]
//! }
//! ```
//!
//! You may leave out `options`, `load` and any key of `options`. A curve is a `power`, or 2 to 8
//! `points` `[x, y]` from 0 to 1. Unknown keys are refused.

use paint::strokes::{BrushSpec, Load, Recipe};
use serde::Serialize;
use serde_json::{Value, json};

use super::options::BrushOptions;
use super::reading::{BrushFileError, Object};

const MOST_PRESETS: usize = 1000;

/// Brushes that a painter saves together. Each has a different name.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BrushSet {
    name: String,
    presets: Vec<BrushPreset>,
}

impl BrushSet {
    /// Name of the format in a file.
    pub const FORMAT: &'static str = "impasto-brushes";

    /// Version of the format that is read and written.
    pub const VERSION: u64 = 1;

    /// An empty set. A name without letters becomes `Brushes`.
    #[must_use]
    pub fn new(name: &str) -> Self {
        let name = proper_name(name).unwrap_or_else(|| "Brushes".to_owned());
        Self { name, presets: Vec::new() }
    }

    /// Renames the set. A name without letters changes nothing.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.name = proper_name(name).unwrap_or(self.name);
        self
    }

    /// Name of the set.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The brushes in the painter's order.
    #[must_use]
    pub fn presets(&self) -> &[BrushPreset] {
        &self.presets
    }

    /// Adds a brush at the end and returns its name, which gets a number if another brush has it.
    /// If there are 1000 brushes already, this adds nothing and returns `None`.
    pub fn add(&mut self, preset: BrushPreset) -> Option<String> {
        if self.presets.len() >= MOST_PRESETS {
            return None;
        }
        let name = self.free_name(&preset.name);
        self.presets.push(BrushPreset { name: name.clone(), ..preset });
        Some(name)
    }

    /// Replaces the brush of the same name, or adds it.
    pub fn put(&mut self, preset: BrushPreset) {
        match self.presets.iter_mut().find(|own| own.name == preset.name) {
            Some(own) => *own = preset,
            None => {
                self.add(preset);
            }
        }
    }

    /// Renames a brush. If the name is taken, it gets a number. A name without letters changes
    /// nothing.
    pub fn rename(&mut self, index: usize, name: &str) {
        let Some(name) = proper_name(name) else { return };
        if self.presets.get(index).is_none_or(|preset| preset.name == name) {
            return;
        }
        self.presets[index].name = self.free_name(&name);
    }

    /// Removes a brush, if it is there.
    pub fn remove(&mut self, index: usize) {
        if index < self.presets.len() {
            self.presets.remove(index);
        }
    }

    /// Moves a brush to another place of the list. A place after the end means the end.
    pub fn move_to(&mut self, index: usize, place: usize) {
        if index < self.presets.len() {
            let preset = self.presets.remove(index);
            self.presets.insert(place.min(self.presets.len()), preset);
        }
    }

    /// Adds brushes of another set while there is room, and returns how many.
    pub fn add_all(&mut self, other: Self) -> usize {
        other.presets.into_iter().filter_map(|preset| self.add(preset)).count()
    }

    /// Reads the text of a file. Errors call the file `file`.
    ///
    /// # Errors
    /// [`BrushFileError`] with the key that is unknown, missing or out of range.
    pub fn of_json(text: &str, file: &str) -> Result<Self, BrushFileError> {
        let mut object = Object::of_text(text, file)?;
        let format: String = object.need("format")?;
        if format != Self::FORMAT {
            return Err(object.fault_at("format", format!("is not `{}`", Self::FORMAT)));
        }
        let version: u64 = object.need("version")?;
        if version != Self::VERSION {
            return Err(object.fault_at("version", format!("{version} is not known, only 1 is")));
        }
        let name: String = object.need("name")?;
        let mut set = Self::new(&name);
        let presets = object.need_objects("presets")?;
        if presets.len() > MOST_PRESETS {
            return Err(object.fault_at("presets", format!("holds more than {MOST_PRESETS}")));
        }
        for preset in presets {
            let twice = preset.fault("has the name of a brush before it");
            let preset = BrushPreset::read(preset)?;
            if set.presets.iter().any(|own| own.name == preset.name) {
                return Err(twice);
            }
            set.presets.push(preset);
        }
        object.end()?;
        Ok(set)
    }

    /// Text of the file.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Names, numbers and lists always have a JSON form.
        let presets = serde_json::to_value(&self.presets).unwrap_or(Value::Null);
        let format = Self::FORMAT;
        let version = Self::VERSION;
        let name = &self.name;
        let value =
            json!({ "format": format, "version": version, "name": name, "presets": presets });
        pigment::library::to_text(&value)
    }

    /// Appends a number to a name that is taken.
    fn free_name(&self, name: &str) -> String {
        let name = proper_name(name).unwrap_or_else(|| "brush".to_owned());
        let stem: String = name.chars().take(72).collect();
        let mut free = name;
        let mut number = 2;
        while self.presets.iter().any(|own| own.name == free) {
            free = format!("{stem} {number}");
            number += 1;
        }
        free
    }
}

const LONGEST_NAME: usize = 80;

/// Paint that a saved brush takes up when you choose it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PresetLoad {
    /// Parts of each pigment by name. If this is empty, only the share of medium and the height of
    /// the next loads are set.
    pub recipe: Recipe,
    /// Share of clear medium, 0 to 1.
    pub vehicle: f64,
    /// Height of the paint on the head in mm, 0 to 10.
    pub amount_mm: f64,
}

impl PresetLoad {
    /// The action that loads the brush of this name. Returns `None` if there is no pigment.
    #[must_use]
    pub fn for_brush(&self, brush: &str) -> Option<Load> {
        let Self { recipe, vehicle, amount_mm } = self;
        (!recipe.is_empty()).then(|| Load {
            brush: brush.to_owned(),
            recipe: recipe.clone(),
            vehicle: *vehicle,
            amount_mm: *amount_mm,
        })
    }
}

/// A brush that is saved under a name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BrushPreset {
    /// Name of the brush, 1 to 80 letters. The brush of a painting gets the same name.
    pub name: String,
    /// Shape and size of its head.
    pub brush: BrushSpec,
    /// How the pen controls it.
    #[serde(skip_serializing_if = "is_default")]
    pub options: BrushOptions,
    /// Paint that it takes up when you choose it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load: Option<PresetLoad>,
}

fn is_default(options: &BrushOptions) -> bool {
    *options == BrushOptions::default()
}

/// A name as it is saved: trimmed, without control characters, at most 80 letters. Returns `None`
/// if nothing is left.
pub(super) fn proper_name(typed: &str) -> Option<String> {
    let name: String = typed.trim().chars().filter(|letter| !letter.is_control()).collect();
    let name: String = name.chars().take(LONGEST_NAME).collect();
    (!name.is_empty()).then_some(name)
}

impl BrushPreset {
    /// Reads a brush of a file.
    pub(super) fn read(mut object: Object<'_>) -> Result<Self, BrushFileError> {
        let name: String = object.need("name")?;
        if proper_name(&name).as_ref() != Some(&name) {
            return Err(object.fault_at("name", "must have 1 to 80 letters"));
        }
        let brush: BrushSpec = object.need("brush")?;
        if !(0.2..=100.0).contains(&brush.size_mm) {
            return Err(object.fault_at("brush.size_mm", "is not within 0.2 to 100"));
        }
        let options = object.take_object("options")?;
        let options = options.map_or_else(|| Ok(BrushOptions::default()), BrushOptions::read)?;
        let load = object.take_object("load")?.map(read_load).transpose()?;
        object.end()?;
        Ok(Self { name, brush, options, load })
    }
}

fn read_load(mut object: Object<'_>) -> Result<PresetLoad, BrushFileError> {
    let load = PresetLoad {
        recipe: object.need("recipe")?,
        vehicle: object.need("vehicle")?,
        amount_mm: object.need("amount_mm")?,
    };
    if let Some((name, _)) =
        load.recipe.iter().find(|(_, part)| !(part.is_finite() && **part > 0.0))
    {
        return Err(object.fault_at("recipe", format!("the part of {name} is not above 0")));
    }
    if !(0.0..=1.0).contains(&load.vehicle) {
        return Err(object.fault_at("vehicle", "is not within 0 to 1"));
    }
    if !(load.amount_mm > 0.0 && load.amount_mm <= 10.0) {
        return Err(object.fault_at("amount_mm", "is not above 0 and at most 10"));
    }
    object.end()?;
    Ok(load)
}

#[cfg(test)]
mod tests {
    use super::super::{
        BrushOptions, LengthUnit, PresetLoad, PressureCurve, StabiliserMethod, StabiliserSettings,
        TiltUse, TwistUse,
    };
    use super::*;
    use paint::brush::HeadShape;
    use paint::strokes::BrushSpec;

    fn preset(name: &str) -> BrushPreset {
        let brush = BrushSpec { shape: HeadShape::Filbert, size_mm: 8.0 };
        BrushPreset { name: name.to_owned(), brush, options: BrushOptions::default(), load: None }
    }

    fn rich() -> BrushPreset {
        let options = BrushOptions {
            tilt: TiltUse::Ignored,
            twist: TwistUse::Fixed(30.0),
            range: [0.1, 0.9],
            curve: Some(PressureCurve::Points(PressureCurve::FIRM.points())),
            stabiliser: Some(StabiliserSettings {
                method: StabiliserMethod::String,
                length: 40.0,
                unit: LengthUnit::Px,
            }),
        };
        let recipe = [("Zinc White".to_owned(), 1.0)].into();
        let load = Some(PresetLoad { recipe, vehicle: 0.2, amount_mm: 0.3 });
        BrushPreset { options, load, ..preset("rich") }
    }

    fn names(set: &BrushSet) -> Vec<&str> {
        set.presets().iter().map(|preset| preset.name.as_str()).collect()
    }

    #[test]
    fn a_set_survives_its_file() {
        let mut set = BrushSet::new("Portraits");
        set.add(rich());
        set.add(preset("plain"));
        let text = set.to_json();
        assert_eq!(BrushSet::of_json(&text, "a.json"), Ok(set), "{text}");
    }

    #[test]
    fn the_example_of_the_guide_is_read() {
        let guide = include_str!("../../../../docs/guide/painting.md");
        let mut blocks = guide.split("```json").skip(1).filter_map(|rest| rest.split("```").next());
        let example = blocks.find(|block| block.contains(BrushSet::FORMAT)).unwrap();
        let set = BrushSet::of_json(example, "painting.md").unwrap();
        let preset = &set.presets()[0];
        assert_eq!((preset.name.as_str(), preset.options.tilt), ("soft filbert", TiltUse::Ignored));
        assert!(preset.options.curve.is_some() && preset.load.is_some(), "{preset:?}");
    }

    #[test]
    fn a_faulty_file_is_refused_with_its_key() {
        fn file(preset: &str) -> String {
            let head = r#""format": "impasto-brushes", "version": 1, "name": "A""#;
            format!("{{{head}, \"presets\": [{preset}]}}")
        }
        let brush = r#""name": "a", "brush": {"shape": "flat", "size_mm": 4}"#;
        for (text, key, what) in [
            ("[]".to_owned(), "", "must be an object"),
            ("{".to_owned(), "", "is not JSON"),
            (r#"{"format": "strokes"}"#.to_owned(), "format", "is not `impasto-brushes`"),
            (r#"{"format": "impasto-brushes", "version": 2}"#.to_owned(), "version", "only 1"),
            (file("3"), "presets[0]", "must be an object"),
            (file(&format!("{{{brush}, \"hue\": 1}}")), "presets[0].hue", "is unknown"),
            (file(r#"{"name": "a"}"#), "presets[0].brush", "is missing"),
            (file(r#"{"name": " a", "brush": 3}"#), "presets[0].name", "1 to 80 letters"),
            (
                file(&format!("{{{}}}", brush.replace("flat", "spoon"))),
                "presets[0].brush",
                "unknown variant",
            ),
            (
                file(&format!("{{{}}}", brush.replace("4}", "400}"))),
                "presets[0].brush.size_mm",
                "0.2 to 100",
            ),
            (
                file(&format!("{{{brush}, \"options\": {{\"range\": [0.5, 0.2]}}}}")),
                "presets[0].options.range",
                "ascending",
            ),
            (
                file(&format!("{{{brush}, \"options\": {{\"curve\": {{\"power\": 9}}}}}}")),
                "presets[0].options.curve",
                "exponent",
            ),
            (
                file(&format!(
                    "{{{brush}, \"load\": {{\"recipe\": {{}}, \"vehicle\": 3, \"amount_mm\": 1}}}}"
                )),
                "presets[0].load.vehicle",
                "0 to 1",
            ),
            (file(&format!("{{{brush}}}, {{{brush}}}")), "presets[1]", "a brush before it"),
        ] {
            let error = BrushSet::of_json(&text, "a.json").unwrap_err();
            assert_eq!((error.key.as_str(), error.file.as_str()), (key, "a.json"), "{text}");
            assert!(error.what.contains(what), "{text}: {error}");
        }
    }

    #[test]
    fn brushes_are_renamed_ordered_and_removed() {
        let mut set = BrushSet::new("  ");
        assert_eq!(set.name(), "Brushes");
        for name in ["a", "b", "a", "c"] {
            set.add(preset(name));
        }
        assert_eq!(names(&set), ["a", "b", "a 2", "c"]);
        set.rename(3, " b ");
        set.rename(0, " ");
        set.rename(9, "x");
        assert_eq!(names(&set), ["a", "b", "a 2", "b 2"]);
        set.move_to(3, 0);
        set.move_to(1, 99);
        assert_eq!(names(&set), ["b 2", "b", "a 2", "a"]);
        set.remove(1);
        set.put(BrushPreset { name: "a 2".to_owned(), ..rich() });
        assert_eq!(names(&set), ["b 2", "a 2", "a"]);
        assert_eq!(set.presets()[1].options, rich().options);
        assert_eq!(set.clone().add_all(set.clone()), 3);
    }
}
