//! Scripts with a mixing palette, and scripts that continue a painting.

use documents::hint::Explain;
use paint::document::Document;
use paint::layer::SLOTS;
use paint::optics::Gloss;
use paint::strokes::{Action, ScriptError, ScriptStartError, Squeeze, StrokeScript, SurfaceId};

use crate::SOUND;

const SAVE: &str = "{\"save\": {\"path\": \"out/study.exr\"}}";

/// [`SOUND`] with a mixing palette and six more actions, most of them on that palette.
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

fn told(text: &str) -> (String, String) {
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
    let first = "action 14 (squeeze), ";
    let cases = [
        ("\"volume_mm3\": 40", "\"volume_mm3\": -1", "volume_mm3: 0 to 1000000, found `-1`"),
        ("\"volume_mm3\": 40", "\"volume_mm3\": 0", "volume_mm3: above 0, found `0`"),
        ("\"x_mm\": 20", "\"x_mm\": 1e7", "x_mm: -1000000 to 1000000, found `10000000`"),
        ("\"y_mm\": 15", "\"y_mm\": -1e7", "y_mm: -1000000 to 1000000, found `-10000000`"),
        ("{\"W\": 1}", "{}", "recipe: parts that sum to more than 0, found `0`"),
    ];
    for (from, to, wanted) in cases {
        assert_eq!(told(&changed(from, to)).0, format!("{first}{wanted}"));
    }
    let (error, _) = told(&changed("\"strength\": 0.3", "\"strength\": 101"));
    assert_eq!(error, "action 19 (gloss), wet.strength: 0 to 100, found `101`");
    let (error, _) = told(&changed("\"exponent\": 70", "\"exponent\": -1"));
    assert_eq!(error, "action 19 (gloss), wet.exponent: 0 to 1000000, found `-1`");
    let (error, _) = told(&changed("{\"scrape\": {}}", "{\"scrape\": {\"on\": \"wall\"}}"));
    assert!(error.contains("unknown variant `wall`, expected `canvas` or `palette`"), "{error}");
}

#[test]
fn there_is_a_palette_only_where_it_is_described() {
    let bare = changed(
        "\"mixing\": {\"width_mm\": 64, \"height_mm\": 42, \"ground\": {\"kind\": \"panel\"}},",
        "",
    );
    let (error, hint) = told(&bare);
    let wanted =
        "action 14 (squeeze), on: the canvas, as there is no palette to mix on, found `palette`";
    assert_eq!(error, wanted);
    assert!(hint.contains("`mixing`"), "{hint}");
    for (action, kind) in [
        (
            "{\"stroke\": {\"brush\": \"knife\", \"on\": \"palette\", \"samples\": [[0, 1, 1, 1]]}}",
            "stroke",
        ),
        ("{\"scrape\": {\"on\": \"palette\"}}", "scrape"),
    ] {
        let (error, _) = told(&SOUND.replace(SAVE, action));
        assert!(error.starts_with(&format!("action 13 ({kind}), on: the canvas")), "{error}");
    }
    let (error, hint) = told(&changed("\"width_mm\": 64,", "\"width_mm\": 64, \"cell_mm\": 0.2,"));
    assert_eq!(error, "mixing.cell_mm: that of the canvas, 0.1, found `0.2`");
    assert_eq!(hint, "\"cell_mm\": 0.1");
    let (error, _) = told(&changed("\"height_mm\": 42", "\"height_mm\": -42"));
    assert_eq!(error, "mixing.height_mm: 0.001 to 1000000, found `-42`");
    let (error, _) = told(&changed("\"height_mm\": 42", "\"height_mm\": 42e4"));
    assert!(error.starts_with("mixing: at most 67108864 cells"), "{error}");
}

/// A painting of 25 x 20 cells of 1/30 mm, which has no finite decimal.
fn painting() -> Document {
    let text = SOUND.replace("\"cell_mm\": 0.1", "\"cell_mm\": 4");
    let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
    let (mut document, palette) = script.surfaces(&suite::oils::library(), None).unwrap();
    assert!(palette.is_none(), "none is described");
    document.cell_mm = 1.0 / 30.0;
    // Slot 0 is empty: pigments need not occupy the first slots.
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
    let library = suite::oils::library();
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
    let library = suite::oils::library();
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
        let (error, _) = told(&text.replace("before/study.exr", path));
        assert!(error.starts_with("start: the path of a painting"), "{error}");
    }
    let lit = "\"licence\": \"\",\n  \"lighting\": {\"illuminant\": \"A\", \"observer\": \"1931-2\", \
        \"azimuth_deg\": 0, \"elevation_deg\": 40, \"ambient\": 0, \"relief\": 1}";
    let (error, hint) = told(&text.replace("\"licence\": \"\"", lit));
    assert!(error.starts_with("lighting: left out with `start`"), "{error}");
    assert_eq!(hint, "leave `lighting` out");
}
