//! Stroke scripts survive a round trip through JSON. Invalid ones are refused with the location of
//! the fault.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod hostile;
mod round_trip;

use documents::hint::Explain;
use paint::strokes::{Action, ScriptError, StrokeScript};

/// A script with every action.
const SOUND: &str = r##"{
  "format": "strokes", "version": 1, "title": "A study", "licence": "CC0-1.0",
  "canvas": {"width_mm": 100, "height_mm": 80, "cell_mm": 0.1,
    "ground": {"kind": "linen", "seed": 1, "reflectance": {"rgb": "#f4f1e8"}}},
  "medium": {"scattering_per_mm": 50, "wet": {"strength": 0.25, "exponent": 60},
    "dry": {"strength": 0.06, "exponent": 20}},
  "library": "oils.json",
  "palette": {"W": "Zinc White", "B": "Prussian Blue"},
  "brushes": {"big": {"shape": "flat", "size_mm": 12}, "knife": {"shape": "knife", "size_mm": 30}},
  "actions": [
    {"load": {"brush": "big", "recipe": {"W": 3, "B": 1}, "vehicle": 0.2, "amount_mm": 0.3}},
    {"stroke": {"brush": "big", "samples": [[0, 10, 10, 0.2], [0.5, 60, 12, 0.6, 10, 0, 45]]}},
    {"wipe": {"brush": "big", "keep": 0.2}},
    {"wash": {"brush": "big"}},
    {"dry": {"fraction": 0.5}},
    {"dry": {}},
    {"palette": ["Zinc White", "Viridian"]},
    {"undo": {}},
    {"redo": {}},
    {"light": {"illuminant": "A", "observer": "1931-2", "azimuth_deg": 90, "elevation_deg": 30,
      "ambient": 0.5, "relief": 1}},
    {"opacity": {"layer": 0, "value": 0.5}},
    {"swap": {"layer": "wet", "from": "Viridian", "to": "Prussian Blue"}},
    {"merge": {"layer": 1}},
    {"save": {"path": "out/study.exr"}}
  ]
}"##;

/// The error of [`SOUND`] with `from` replaced by `to`.
fn refused(from: &str, to: &str) -> ScriptError {
    assert_eq!(SOUND.matches(from).count(), 1, "`{from}` stands once");
    let error = StrokeScript::from_json("a.json", SOUND.replace(from, to).as_bytes()).unwrap_err();
    assert!(error.to_string().starts_with("a.json: "), "{error}");
    error
}

#[test]
fn the_guide_shows_scripts_that_can_be_painted() {
    let page =
        std::fs::read_to_string(suite::program::repository("docs/guide/painting.md")).unwrap();
    let shown = page.split("```json\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let (actions, shown): (Vec<&str>, Vec<&str>) = shown
        .filter(|text| !text.contains("impasto-brushes"))
        .partition(|text| !text.contains("\"width_mm\""));
    let [script, keys] = shown[..] else { panic!("{} scripts", shown.len()) };
    assert_eq!(actions.len(), 3, "examples of actions");
    for text in actions {
        let listed: Result<Vec<Action>, _> = serde_json::from_str(&format!("[{text}]"));
        assert!(listed.is_ok_and(|listed| !listed.is_empty()), "{text}");
    }
    // The second example has only keys, which replace the keys of the first.
    let mut mixed: serde_json::Value = serde_json::from_str(script).unwrap();
    let keys: serde_json::Value = serde_json::from_str(&format!("{{{keys}}}")).unwrap();
    for (key, value) in keys.as_object().unwrap() {
        mixed[key] = value.clone();
    }
    for text in [script, &mixed.to_string()] {
        let script = StrokeScript::from_json("docs/guide/painting.md", text.as_bytes()).unwrap();
        script.resolve(&suite::oils::library()).unwrap();
    }
}

#[test]
fn lights_and_observers_nobody_knows_are_refused_before_painting() {
    let error = refused("\"illuminant\": \"A\"", "\"illuminant\": \"D666\"");
    assert!(
        error.to_string().contains("action 10 (light), illuminant: a CIE illuminant"),
        "{error}"
    );
    let error = refused("\"observer\": \"1931-2\"", "\"observer\": \"1932\"");
    assert!(error.to_string().contains("action 10 (light), observer"), "{error}");
    assert!(error.hint().unwrap().to_string().contains("1931-2"), "{:?}", error.hint());
}
