//! Stroke scripts are equal, up to rounding, after writing and reading. Also their pigments by name
//! (unknown names, pigments off the palette), scripts with a mixing palette, and scripts that
//! continue a painting.

use std::collections::BTreeMap;

use documents::hint::Explain;
use paint::brush::HeadShape;
use paint::document::{Document, LayerId, Lighting, Medium};
use paint::ground::GroundSpec;
use paint::layer::SLOTS;
use paint::optics::Gloss;
use paint::pose::Sample;
use paint::strokes::{
    Action, ActionPigments, BrushSpec, Canvas, LayerRef, Load, MaskChange, PaletteSpec,
    ScriptError, ScriptStartError, Squeeze, Stroke, StrokeScript, StrokeTool, SurfaceId,
};
use proptest::prelude::*;
use suite::oils::library;

use crate::SOUND;

fn sample() -> impl Strategy<Value = Sample> {
    fn tilt() -> impl Strategy<Value = f64> {
        prop_oneof![Just(0.0), -90.0..=90.0]
    }
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
        // Numbers are rounded once, so a second round trip changes nothing.
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

fn resolved(from: &str, to: &str) -> Result<paint::strokes::Resolved, (String, String)> {
    let script = StrokeScript::from_json("a.json", SOUND.replace(from, to).as_bytes()).unwrap();
    let resolved = script.resolve(&library());
    resolved.map_err(|error| {
        (error.to_string(), error.hint().map(|hint| hint.to_string()).unwrap_or_default())
    })
}

#[test]
fn names_and_short_names_become_pigments() {
    let library = library();
    let [white, blue, green] =
        ["Zinc White", "Prussian Blue", "Viridian"].map(|name| library.find(name).unwrap());
    let found = resolved("\"W\": 3", "\"zinc white\": 3").unwrap();
    assert_eq!(found.slots[..3], [Some(white), Some(blue), None]);
    let mut wanted = vec![(white, 3.0), (blue, 1.0)];
    wanted.sort_by_key(|(pigment, _)| *pigment);
    assert_eq!(found.actions.len(), 14);
    assert_eq!(found.actions[0], ActionPigments::Recipe(wanted));
    assert_eq!(found.actions[1], ActionPigments::None);
    let slots = [Some(white), Some(green), None, None, None, None, None, None];
    assert_eq!(found.actions[6], ActionPigments::Palette(slots));
    assert_eq!(found.actions[11], ActionPigments::Swap { from: green, to: blue });
}

#[test]
fn unknown_pigments_are_told_with_the_nearest() {
    let (error, hint) = resolved("\"W\": \"Zinc White\"", "\"W\": \"Zink Wite\"").unwrap_err();
    assert_eq!(error, "palette: a pigment of the library, found `Zink Wite`");
    assert_eq!(hint, "did you mean Zinc White?");
    let (error, hint) = resolved("\"B\": 1", "\"Octarine\": 1").unwrap_err();
    assert_eq!(error, "action 1 (load), recipe: a pigment of the library, found `Octarine`");
    assert!(hint.starts_with("pigments: "), "{hint}");
    let (error, _) = resolved("\"from\": \"Viridian\"", "\"from\": \"Viridium\"").unwrap_err();
    assert!(error.starts_with("action 12 (swap), from: "), "{error}");
}

#[test]
fn recipes_keep_to_the_palette_and_name_a_pigment_once() {
    let (error, hint) = resolved("\"B\": 1", "\"Viridian\": 1").unwrap_err();
    assert_eq!(error, "action 1 (load), recipe: pigments of the palette, found `Viridian`");
    assert_eq!(hint, "the palette has Zinc White, Prussian Blue");
    let (error, _) = resolved("\"B\": 1", "\"Zinc White\": 1").unwrap_err();
    assert!(error.contains("recipe: each pigment once"), "{error}");
    let (error, _) =
        resolved("[\"Zinc White\", \"Viridian\"]", "[\"Viridian\", \"Viridian\"]").unwrap_err();
    assert!(error.starts_with("action 7 (palette), palette: each pigment once"), "{error}");
}

const SAVE: &str = "{\"save\": {\"path\": \"out/study.exr\"}}";

/// [`SOUND`] with a mixing palette and six more actions, most of them on this palette.
fn mixed() -> String {
    let actions = "{\"squeeze\": {\"on\": \"palette\", \"recipe\": {\"W\": 1}, \"x_mm\": 20, \
        \"y_mm\": 15, \"volume_mm3\": 40}},
    {\"squeeze\": {\"recipe\": {\"B\": 1}, \"vehicle\": 0.1, \"x_mm\": 2, \"y_mm\": 3, \
        \"volume_mm3\": 5}},
    {\"stroke\": {\"brush\": \"knife\", \"on\": \"palette\", \"samples\": [[0, 20, 15, 0.5]]}},
    {\"scrape\": {\"on\": \"palette\"}},
    {\"scrape\": {}},
    {\"gloss\": {\"wet\": {\"strength\": 0.3, \"exponent\": 70}, \
        \"dry\": {\"strength\": 0.1, \"exponent\": 20}}}";
    let mixing =
        "\"mixing\": {\"width_mm\": 64, \"height_mm\": 42, \"ground\": {\"kind\": \"panel\"}}";
    SOUND
        .replace(SAVE, &[SAVE, actions].join(",\n    "))
        .replace("\"library\": \"oils.json\"", &["\"library\": \"oils.json\"", mixing].join(", "))
}

fn error_and_hint(text: &str) -> (String, String) {
    let error = StrokeScript::from_json("a.json", text.as_bytes()).unwrap_err();
    let text = error.to_string();
    (
        text.strip_prefix("a.json: ").unwrap().to_owned(),
        error.hint().map(|hint| hint.to_string()).unwrap_or_default(),
    )
}

fn changed(from: &str, to: &str) -> String {
    let text = mixed();
    assert_eq!(text.matches(from).count(), 1, "`{from}` stands once");
    text.replace(from, to)
}

#[test]
fn what_is_done_on_the_palette_is_read_and_written() {
    let script = StrokeScript::from_json("a.json", mixed().as_bytes()).unwrap();
    assert_eq!(script.mixing.as_ref().unwrap().cells(), (640, 420));
    let Action::Squeeze(heap) = &script.actions[14] else { panic!("a heap") };
    let Squeeze { on, vehicle, x_mm, y_mm, volume_mm3, .. } = *heap;
    assert_eq!((on, vehicle, x_mm, y_mm, volume_mm3), (SurfaceId::Palette, 0.0, 20.0, 15.0, 40.0));
    let Action::Squeeze(heap) = &script.actions[15] else { panic!("a heap") };
    assert_eq!((heap.on, heap.vehicle), (SurfaceId::Canvas, 0.1));
    let Action::Stroke(stroke) = &script.actions[16] else { panic!("a stroke") };
    assert_eq!(stroke.on, SurfaceId::Palette);
    assert_eq!(script.actions[17], Action::Scrape { on: SurfaceId::Palette });
    assert_eq!(script.actions[18], Action::Scrape { on: SurfaceId::Canvas });
    let wet = Gloss { strength: 0.3, exponent: 70.0 };
    assert!(matches!(script.actions[19], Action::Gloss { wet: found, .. } if found == wet));
    let written = script.to_json().unwrap();
    assert!(written.contains("{\"scrape\": {}}"), "`on` is left out for the canvas: {written}");
    assert_eq!(StrokeScript::from_json("b.json", written.as_bytes()).unwrap(), script);
}

#[test]
fn numbers_of_heaps_and_shine_are_told_with_their_place() {
    let first = "action 15 (squeeze), ";
    let cases = [
        ("\"volume_mm3\": 40", "\"volume_mm3\": -1", "volume_mm3: 0 to 1000000, found `-1`"),
        ("\"volume_mm3\": 40", "\"volume_mm3\": 0", "volume_mm3: above 0, found `0`"),
        ("\"x_mm\": 20", "\"x_mm\": 1e7", "x_mm: -1000000 to 1000000, found `10000000`"),
        ("\"y_mm\": 15", "\"y_mm\": -1e7", "y_mm: -1000000 to 1000000, found `-10000000`"),
        ("{\"W\": 1}", "{}", "recipe: parts that sum to more than 0, found `0`"),
    ];
    for (from, to, wanted) in cases {
        assert_eq!(error_and_hint(&changed(from, to)).0, format!("{first}{wanted}"));
    }
    let (error, _) = error_and_hint(&changed("\"strength\": 0.3", "\"strength\": 101"));
    assert_eq!(error, "action 20 (gloss), wet.strength: 0 to 100, found `101`");
    let (error, _) = error_and_hint(&changed("\"exponent\": 70", "\"exponent\": -1"));
    assert_eq!(error, "action 20 (gloss), wet.exponent: 0 to 1000000, found `-1`");
    let (error, _) =
        error_and_hint(&changed("{\"scrape\": {}}", "{\"scrape\": {\"on\": \"wall\"}}"));
    assert!(error.contains("unknown variant `wall`, expected `canvas` or `palette`"), "{error}");
}

#[test]
fn there_is_a_palette_only_where_it_is_described() {
    let bare = changed(
        "\"mixing\": {\"width_mm\": 64, \"height_mm\": 42, \"ground\": {\"kind\": \"panel\"}},",
        "",
    );
    let (error, hint) = error_and_hint(&bare);
    let wanted =
        "action 15 (squeeze), on: the canvas, as there is no palette to mix on, found `palette`";
    assert_eq!(error, wanted);
    assert!(hint.contains("`mixing`"), "{hint}");
    for (action, kind) in [
        (
            "{\"stroke\": {\"brush\": \"knife\", \"on\": \"palette\", \"samples\": [[0, 1, 1, 1]]}}",
            "stroke",
        ),
        ("{\"scrape\": {\"on\": \"palette\"}}", "scrape"),
    ] {
        let (error, _) = error_and_hint(&SOUND.replace(SAVE, action));
        assert!(error.starts_with(&format!("action 14 ({kind}), on: the canvas")), "{error}");
    }
    let (error, hint) =
        error_and_hint(&changed("\"width_mm\": 64,", "\"width_mm\": 64, \"cell_mm\": 0.2,"));
    assert_eq!(error, "mixing.cell_mm: that of the canvas, 0.1, found `0.2`");
    assert_eq!(hint, "\"cell_mm\": 0.1");
    let (error, _) = error_and_hint(&changed("\"height_mm\": 42", "\"height_mm\": -42"));
    assert_eq!(error, "mixing.height_mm: 0.001 to 1000000, found `-42`");
    let (error, _) = error_and_hint(&changed("\"height_mm\": 42", "\"height_mm\": 42e4"));
    assert!(error.starts_with("mixing: at most 67108864 cells"), "{error}");
}

/// A painting of 25 x 20 cells of 1/30 mm, a width without a finite decimal.
fn painting() -> Document {
    let text = SOUND.replace("\"cell_mm\": 0.1", "\"cell_mm\": 4");
    let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
    let (mut document, palette) = script.surfaces(&library(), None).unwrap();
    assert!(palette.is_none(), "none is described");
    document.cell_mm = 1.0 / 30.0;
    // Slot 0 is empty: pigments need not be in the first slots.
    document.slots.swap(0, SLOTS - 1);
    document
}

fn continue_from() -> StrokeScript {
    let mut script = StrokeScript::continue_from("before/study.exr", &painting());
    script = StrokeScript::from_json("a.json", script.to_json().unwrap().as_bytes()).unwrap();
    script
}

#[test]
fn a_script_goes_on_with_a_painting() {
    let library = library();
    let painting = painting();
    let script = continue_from();
    assert_eq!(script.start.as_deref(), Some("before/study.exr"));
    let (canvas, palette) = script.surfaces(&library, Some(painting.clone())).unwrap();
    assert_eq!((canvas, palette), (painting.clone(), None));
    // A mixing palette has the painting's pigments in the same slots.
    let mut mixing = script.clone();
    mixing.mixing = Some(script.canvas.clone());
    let (_, palette) = mixing.surfaces(&library, Some(painting.clone())).unwrap();
    let palette = palette.unwrap();
    assert_eq!((palette.slots, palette.cell_mm), (painting.slots, painting.cell_mm));
    assert_eq!(palette.medium, painting.medium);
}

#[test]
fn any_number_of_cells_comes_back_from_a_script() {
    for cell_mm in [1.0 / 30.0, 25.4 / 300.0, 0.1, 0.199_999_9] {
        let mut document = painting();
        document.cell_mm = cell_mm;
        for cells in (1..3000).step_by(7) {
            let row = graphics::field::Field::filled(cells, 1, 0);
            document.ground.height = row;
            let found = StrokeScript::continue_from("a.exr", &document).canvas.cells();
            assert_eq!(found, (cells, 1), "cells of {cell_mm} mm");
        }
    }
}

#[test]
fn another_painting_is_refused() {
    let library = library();
    let refused = |script: &StrokeScript, start: Option<Document>| {
        let error = script.surfaces(&library, start).unwrap_err();
        assert!(matches!(error, ScriptStartError::Script(ScriptError::Invalid(_))), "{error}");
        error.to_string()
    };
    let mut wider = continue_from();
    wider.canvas.width_mm += wider.canvas.cell_mm;
    let error = refused(&wider, Some(painting()));
    assert_eq!(error, "canvas: as many cells as the painting has, 25 x 20, found `26 x 20`");
    let mut coarser = continue_from();
    coarser.canvas.cell_mm *= 2.0;
    coarser.canvas.width_mm *= 2.0;
    coarser.canvas.height_mm *= 2.0;
    let error = refused(&coarser, Some(painting()));
    assert!(error.starts_with("canvas.cell_mm: that of the painting, 0.0333333"), "{error}");
    let mut other = painting();
    other.slots[3] = Some(library.find("Viridian").unwrap());
    let error = refused(&continue_from(), Some(other));
    assert!(error.starts_with("palette: that of the painting, "), "{error}");
    let error = refused(&continue_from(), None);
    let wanted = "start: the painting that the script begins on, before/study.exr, found `none`";
    assert_eq!(error, wanted);
    let bare = StrokeScript::from_json("a.json", SOUND.as_bytes()).unwrap();
    let error = refused(&bare, Some(painting()));
    assert!(error.starts_with("start: the painting that the script begins on, none"), "{error}");
}

#[test]
fn a_start_is_a_painting_with_a_light_of_its_own() {
    let text = continue_from().to_json().unwrap();
    for path in ["", "study.png", "a\\nb.exr"] {
        let (error, _) = error_and_hint(&text.replace("before/study.exr", path));
        assert!(error.starts_with("start: the path of a painting"), "{error}");
    }
    let lit = "\"licence\": \"\",\n  \"lighting\": {\"illuminant\": \"A\", \"observer\": \"1931-2\", \
        \"azimuth_deg\": 0, \"elevation_deg\": 40, \"ambient\": 0, \"relief\": 1}";
    let (error, hint) = error_and_hint(&text.replace("\"licence\": \"\"", lit));
    assert!(error.starts_with("lighting: left out with `start`"), "{error}");
    assert_eq!(hint, "leave `lighting` out");
}
