//! Stroke scripts are equal, up to rounding, after writing and reading; the canonical JSON.

use std::collections::BTreeMap;

use paint::brush::HeadShape;
use paint::document::{LayerId, Lighting, Medium};
use paint::ground::GroundSpec;
use paint::optics::Gloss;
use paint::pose::Sample;
use paint::strokes::{
    Action, BrushSpec, Canvas, LayerRef, Load, MaskChange, PaletteSpec, Squeeze, Stroke,
    StrokeScript, StrokeTool, SurfaceId,
};
use proptest::prelude::*;

use crate::SOUND;

fn sample() -> impl Strategy<Value = Sample> {
    let tilt = || prop_oneof![Just(0.0), -90.0..=90.0];
    let place = (-100.0..200.0, -100.0..200.0, 0.0..=1.0);
    (0.0..0.1, place, tilt(), tilt(), tilt()).prop_map(
        |(seconds, (x_mm, y_mm, pressure), a, b, c)| Sample {
            seconds,
            x_mm,
            y_mm,
            pressure,
            tilt_x_deg: a,
            tilt_y_deg: b,
            twist_deg: c,
        },
    )
}

fn stroke() -> impl Strategy<Value = Action> {
    (surface(), tool(), prop::collection::vec(sample(), 1..20)).prop_map(
        |(on, tool, mut samples)| {
            let mut clock = 0.0;
            for sample in &mut samples {
                clock += sample.seconds;
                sample.seconds = clock;
            }
            Action::Stroke(Stroke { brush: "big".to_owned(), on, tool, samples })
        },
    )
}

fn mask() -> impl Strategy<Value = MaskChange> {
    let points = prop::collection::vec(prop::array::uniform2(-100.0..=100.0), 3..9);
    prop_oneof![
        points.prop_map(MaskChange::PolygonMm),
        layer().prop_map(MaskChange::Layer),
        Just(MaskChange::Painted {}),
        Just(MaskChange::Inverse(true)),
        Just(MaskChange::Clear {}),
    ]
}

fn tool() -> impl Strategy<Value = StrokeTool> {
    prop_oneof![
        Just(StrokeTool::Paint),
        (0.001..=1.0).prop_map(|strength| StrokeTool::Blend { strength }),
        (0.0..=10.0).prop_map(|height_mm| StrokeTool::Scrape { height_mm }),
        (0.001..=1.0).prop_map(|strength| StrokeTool::Erase { strength }),
    ]
}

fn surface() -> impl Strategy<Value = SurfaceId> {
    prop_oneof![Just(SurfaceId::Canvas), Just(SurfaceId::Palette)]
}

fn gloss() -> impl Strategy<Value = Gloss> {
    (0.0_f32..=100.0, 0.0_f32..=1e6).prop_map(|(strength, exponent)| Gloss { strength, exponent })
}

fn layer() -> impl Strategy<Value = LayerRef> {
    prop_oneof![
        Just(LayerRef::Wet),
        (0_usize..9).prop_map(LayerRef::Dry),
        any::<u32>().prop_map(|id| LayerRef::Id(LayerId(id))),
    ]
}

fn action() -> impl Strategy<Value = Action> {
    let name = "[A-Za-z \u{e9}\"\\\\]{1,9}";
    let recipe = prop::collection::btree_map(name, 0.001..1e6, 1..8);
    let place = (-1e6..1e6, -1e6..1e6, 0.001..1e6);
    let heap = (surface(), recipe.clone(), 0.0..=1.0, place).prop_map(
        |(on, recipe, vehicle, (x_mm, y_mm, volume_mm3))| {
            Action::Squeeze(Squeeze { on, recipe, vehicle, x_mm, y_mm, volume_mm3 })
        },
    );
    let load = (recipe, 0.0..=1.0, 0.0..100.0).prop_map(|(recipe, vehicle, amount_mm)| {
        Action::Load(Load { brush: "big".to_owned(), recipe, vehicle, amount_mm })
    });
    let pigments = prop::collection::vec(name, 1..8);
    prop_oneof![
        4 => stroke(),
        2 => load,
        1 => heap,
        1 => surface().prop_map(|on| Action::Scrape { on }),
        1 => mask().prop_map(Action::Mask),
        1 => (gloss(), gloss()).prop_map(|(wet, dry)| Action::Gloss { wet, dry }),
        1 => (0.0..=1.0).prop_map(|value| Action::Stiffness { value }),
        1 => (0.0..=1.0).prop_map(|keep| Action::Wipe { brush: "big".to_owned(), keep }),
        1 => Just(Action::Wash { brush: "big".to_owned() }),
        1 => (0.001..=1.0).prop_map(|fraction| Action::Dry { fraction }),
        1 => pigments.prop_map(|names| Action::Palette(PaletteSpec::from_names(names.iter().map(String::as_str)))),
        1 => Just(Action::Undo {}),
        1 => Just(Action::Redo {}),
        1 => (0.0..360.0).prop_map(|azimuth_deg| {
            Action::Light(Lighting { azimuth_deg, ..Lighting::default() })
        }),
        1 => (layer(), 0.0..1000.0).prop_map(|(layer, value)| Action::Opacity { layer, value }),
        1 => (layer(), name, name).prop_map(|(layer, from, to)| Action::Swap { layer, from, to }),
        1 => (1_usize..9)
            .prop_map(|layer| Action::Merge { layer: LayerRef::Dry(layer), with: None }),
        1 => (layer(), layer())
            .prop_map(|(layer, with)| Action::Merge { layer, with: Some(with) }),
        1 => (layer(), name).prop_map(|(layer, name)| {
            Action::Name { layer, name: name.trim().to_owned() }
        }),
        1 => (layer(), any::<bool>()).prop_map(|(layer, value)| Action::Visible { layer, value }),
        1 => (layer(), 0_usize..9).prop_map(|(layer, to)| Action::Order { layer, to }),
        1 => "[a-z]{1,8}".prop_map(|stem| Action::Save { path: format!("{stem}1.png") }),
    ]
}

fn script() -> impl Strategy<Value = StrokeScript> {
    let canvas = (1.0..300.0, 1.0..300.0, 0.05..2.0, any::<u64>());
    let short = prop::collection::btree_map("[A-Z]", "[a-z ]{1,9}", 1..8);
    let medium = prop::option::of(
        (1.0..100.0)
            .prop_map(|scattering_per_mm| Medium { scattering_per_mm, ..Medium::default() }),
    );
    let actions = prop::collection::vec(action(), 0..20);
    (canvas, short, medium, any::<bool>(), 0.2..100.0, actions).prop_map(
        |((width_mm, height_mm, cell_mm, seed), short, medium, light, size_mm, actions)| {
            let ground = serde_json::json!({"kind": "paper", "seed": seed});
            let ground = serde_json::from_value(ground).unwrap();
            let canvas = Canvas { width_mm, height_mm, cell_mm, ground };
            let pigments = short.into_iter().map(|(short, name)| (Some(short), name)).collect();
            let mut script =
                StrokeScript::new("T\u{e9}st \"1\"", "CC0", canvas, PaletteSpec { pigments });
            script.mixing = Some(script.canvas.clone());
            script.medium = medium;
            script.lighting = light.then(Lighting::default);
            let big = BrushSpec { shape: HeadShape::Mop, size_mm };
            script.brushes = BTreeMap::from([("big".to_owned(), big)]);
            script.actions = actions;
            script
        },
    )
}

fn config() -> ProptestConfig {
    ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() }
}

/// All numbers of all samples of a script.
fn numbers(script: &StrokeScript) -> Vec<f64> {
    let strokes = script.actions.iter().filter_map(|action| match action {
        Action::Stroke(stroke) => Some(&stroke.samples),
        _ => None,
    });
    strokes
        .flatten()
        .flat_map(|s: &Sample| {
            [s.seconds, s.x_mm, s.y_mm, s.pressure, s.tilt_x_deg, s.tilt_y_deg, s.twist_deg]
        })
        .collect()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_script_comes_back_as_it_was_written(script in script()) {
        let text = script.to_json().unwrap();
        let back = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
        prop_assert_eq!(&back.to_json().unwrap(), &text);
        let written: Vec<Action> = script.actions.iter().map(Action::rounded).collect();
        prop_assert_eq!(&back.actions, &written);
        // Numbers are rounded once: a second round trip changes nothing.
        let again = StrokeScript::from_json("a.json", back.to_json().unwrap().as_bytes()).unwrap();
        prop_assert_eq!(&again, &back);
        prop_assert_eq!(back.actions.len(), script.actions.len());
        for (got, wanted) in numbers(&back).iter().zip(numbers(&script)) {
            prop_assert!((got - wanted).abs() <= 0.500_01e-4, "{} for {}", got, wanted);
        }
    }
}

#[test]
fn the_canonical_form_is_short_and_an_action_a_line() {
    let script = StrokeScript::from_json("a.json", SOUND.as_bytes()).unwrap();
    let text = script.to_json().unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[..3], ["{", "  \"format\": \"strokes\",", "  \"version\": 1,"]);
    assert_eq!(
        lines[5],
        "  \"canvas\": {\"width_mm\": 100, \"height_mm\": 80, \"cell_mm\": 0.1, \
        \"ground\": {\"kind\": \"linen\", \"seed\": 1, \"threads_per_cm\": 14, \"relief_mm\": 0.12, \
        \"reflectance\": {\"rgb\": \"#f4f1e8\"}}},"
    );
    let stroke = "    {\"stroke\": {\"brush\": \"big\", \"samples\": \
        [[0,10,10,0.2], [0.5,60,12,0.6,10,0,45]]}},";
    assert!(lines.contains(&stroke), "{text}");
    let actions = lines.iter().filter(|line| line.starts_with("    {\"")).count();
    assert_eq!(actions, script.actions.len(), "{text}");
    assert_eq!(StrokeScript::from_json("b.json", text.as_bytes()).unwrap(), script);
}

#[test]
fn what_may_be_left_out_has_its_usual_value() {
    let text = r#"{"format": "strokes", "version": 1, "canvas": {"width_mm": 10, "height_mm": 5},
        "palette": ["Zinc White"], "brushes": {}, "actions": [{"dry": {}}]}"#;
    let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
    assert_eq!((script.canvas.cell_mm, script.canvas.cells()), (0.1, (100, 50)));
    assert_eq!(script.canvas.ground, GroundSpec::default());
    assert_eq!(script.actions, [Action::Dry { fraction: 1.0 }]);
    let marked = [&b"\xef\xbb\xbf"[..], text.as_bytes()].concat();
    assert_eq!(StrokeScript::from_json("a.json", &marked).unwrap(), script);
}
