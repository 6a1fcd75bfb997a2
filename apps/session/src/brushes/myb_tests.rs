//! Tests of brushes taken over from MyPaint, on files written for them.

use paint::brush::HeadShape;

use super::{
    BrushOptions, BrushPreset, ImportedBrush, MM_PER_PIXEL, StabiliserMethod, TwistUse,
    brush_of_myb,
};

fn myb(settings: &str) -> String {
    format!(
        r#"{{"version": 3, "comment": "", "group": "x", "notes": "", "settings": {{{settings}}}}}"#
    )
}

fn base(name: &str, value: f64) -> String {
    format!(r#""{name}": {{"base_value": {value}, "inputs": {{}}}}"#)
}

fn taken(settings: &[String]) -> ImportedBrush {
    brush_of_myb(&myb(&settings.join(", ")), "/a/ink pen.myb", MM_PER_PIXEL).unwrap()
}

#[test]
fn a_plain_brush_has_its_size_and_the_painters_own_pressure() {
    let found = taken(&[base("radius_logarithmic", 3.0), base("opaque", 0.8)]);
    let BrushPreset { name, brush, options, load } = found.preset;
    assert_eq!((name.as_str(), brush.shape), ("ink pen", HeadShape::Round));
    // Twice exp(3) pixels of 0.1 mm.
    assert!((brush.size_mm - 4.017).abs() < 1e-3, "{}", brush.size_mm);
    assert_eq!(options, BrushOptions::default());
    let load = load.unwrap();
    assert!((load.vehicle - 0.2).abs() < 1e-12 && load.amount_mm == 0.3, "{load:?}");
    assert_eq!(load.for_brush("a"), None, "no pigment is named");
    assert_eq!(found.meaningless, ["comment", "group"]);
}

#[test]
fn dynamics_by_pressure_become_the_curve() {
    let radius = r#""radius_logarithmic": {"base_value": 2.0, "inputs":
        {"pressure": [[0.0, -1.0], [1.0, 1.0]], "speed1": [[0, 0], [4, 1]]}}"#;
    let opaque =
        r#""opaque_multiply": {"base_value": 0.0, "inputs": {"pressure": [[0, 0], [1, 1]]}}"#;
    let found = taken(&[radius.to_owned(), opaque.to_owned()]);
    let curve = found.preset.options.curve.unwrap();
    for pressure in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let share = (2.0 * pressure - 2.0_f64).exp();
        assert!((curve.at(pressure) - share).abs() < 1e-9, "{pressure}: {}", curve.at(pressure));
    }
    // The size belongs to half pressure, where the dynamics add nothing.
    assert!((found.preset.brush.size_mm - 0.2 * 2.0_f64.exp()).abs() < 1e-9);
    let meaningless = &found.meaningless;
    for name in ["radius_logarithmic by speed1", "opaque_multiply by pressure"] {
        assert!(meaningless.iter().any(|line| line == name), "{name} in {meaningless:?}");
    }
    // If the radius has no dynamics, the dynamics of the opacity become the curve.
    let found = taken(&[base("radius_logarithmic", 2.0), opaque.to_owned()]);
    let curve = found.preset.options.curve.unwrap();
    assert!((curve.at(0.3) - 0.3).abs() < 1e-9, "{curve:?}");
    let falls = opaque.replace("[[0, 0], [1, 1]]", "[[0, 1], [1, 0]]");
    let found = taken(&[falls]);
    assert_eq!(found.preset.options.curve, None);
    assert!(found.meaningless.contains(&"opaque_multiply by pressure, which falls".to_owned()));
}

#[test]
fn ellipses_tracking_and_smudging_have_their_meaning() {
    let found = taken(&[
        base("elliptical_dab_ratio", 4.0),
        base("elliptical_dab_angle", 200.0),
        base("slow_tracking", 3.0),
        base("smudge", 0.5),
        base("hardness", 0.7),
    ]);
    let BrushPreset { brush, options, load, .. } = found.preset;
    assert_eq!((brush.shape, options.twist), (HeadShape::Flat, TwistUse::Fixed(20.0)));
    let stabiliser = options.stabiliser.unwrap();
    assert_eq!((stabiliser.method, stabiliser.length), (StabiliserMethod::Average, 6.0));
    assert!((load.unwrap().amount_mm - 0.15).abs() < 1e-12, "half a load");
    assert!(found.meaningless.contains(&"hardness".to_owned()), "{:?}", found.meaningless);
    let direction = r#""elliptical_dab_angle": {"base_value": 0, "inputs": {"direction": [[0, 0], [180, 180]]}}"#;
    let found =
        taken(&[base("elliptical_dab_ratio", 2.0), direction.to_owned(), base("smudge", 1.0)]);
    assert_eq!((found.preset.options.twist, found.preset.load), (TwistUse::Stroke, None));
}

#[test]
fn every_setting_is_told() {
    let names = ["eraser", "radius_logarithmic", "color_h", "opaque", "dabs_per_second", "smudge"];
    let settings = names.map(|name| base(name, 0.4));
    let found = taken(&settings);
    for name in names {
        let mut lines = found.taken.iter().chain(&found.meaningless);
        assert!(lines.any(|line| line.starts_with(name)), "{name} of {found:?}");
    }
}

#[test]
fn other_files_are_refused_with_the_key() {
    for (text, key, what) in [
        ("# mypaint brush file\nversion 2\n".to_owned(), "", "MyPaint 1.0"),
        (r#"{"version": 2, "settings": {}}"#.to_owned(), "version", "only 3"),
        (r#"{"version": 3}"#.to_owned(), "settings", "is missing"),
        (myb(r#""opaque": 3"#), "settings.opaque", "object"),
        (myb(r#""opaque": {}"#), "settings.opaque.base_value", "is missing"),
        (
            myb(r#""opaque": {"base_value": 1, "inputs": {"pressure": [[1, 0], [0, 1]]}}"#),
            "settings.opaque.inputs.pressure",
            "ascending",
        ),
    ] {
        let error = brush_of_myb(&text, "a.myb", MM_PER_PIXEL).unwrap_err();
        assert_eq!(error.key, key, "{text}");
        assert!(error.what.contains(what), "{error}");
    }
}
