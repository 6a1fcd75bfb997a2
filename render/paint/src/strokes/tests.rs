//! Tests of rounding: writing and reading leave a rounded action unchanged.

use super::{
    Action, BrushSpec, Canvas, LayerRef, Load, MAX_MASK_POINTS, MaskChange, PaletteSpec, Recipe,
    Squeeze, Stroke, StrokeScript, StrokeTool, SurfaceId,
};
use crate::brush::HeadShape;
use crate::document::{LayerId, Lighting};
use crate::ground::GroundSpec;
use crate::optics::Gloss;
use crate::pose::Sample;

const ODD: f64 = 0.123_456_789_012;

fn odd() -> Vec<Action> {
    let recipe = || Recipe::from([("Zinc White".to_owned(), 1.0 / 3.0), ("B".to_owned(), ODD)]);
    let sample = Sample {
        seconds: ODD,
        x_mm: -1e-5,
        y_mm: 100.0 / 3.0,
        pressure: 1.0 / 3.0,
        tilt_x_deg: -1e-9,
        tilt_y_deg: 1e-9,
        twist_deg: 359.999_99,
    };
    let brush = || "big".to_owned();
    let gloss = Gloss { strength: 0.06, exponent: 20.123_457 };
    vec![
        Action::Load(Load { brush: brush(), recipe: recipe(), vehicle: ODD, amount_mm: ODD }),
        Action::Stroke(Stroke {
            brush: brush(),
            on: SurfaceId::Palette,
            tool: StrokeTool::Erase { strength: 1.0 / 3.0 },
            samples: vec![sample],
        }),
        Action::Wipe { brush: brush(), keep: 2.0 / 3.0 },
        Action::Dry { fraction: ODD },
        Action::Light(Lighting {
            azimuth_deg: -1e-12,
            elevation_deg: ODD,
            ambient: ODD,
            relief: 1.0 / 7.0,
            ..Lighting::default()
        }),
        Action::Opacity { layer: LayerRef::Dry(3), value: 1000.0 / 7.0 },
        Action::Squeeze(Squeeze {
            on: SurfaceId::Palette,
            recipe: recipe(),
            vehicle: ODD,
            x_mm: -1.0 / 7.0,
            y_mm: 123.456_789,
            volume_mm3: ODD,
        }),
        Action::Scrape { on: SurfaceId::Palette },
        Action::Name { layer: LayerRef::Id(LayerId(2)), name: "r\u{f6}tel \"2\"".to_owned() },
        Action::Visible { layer: LayerRef::Dry(1), value: false },
        Action::Order { layer: LayerRef::Id(LayerId(7)), to: 3 },
        Action::Merge { layer: LayerRef::Id(LayerId(7)), with: Some(LayerRef::Dry(0)) },
        Action::Mask(MaskChange::PolygonMm(vec![[ODD, 1.0], [2.0 / 3.0, -0.0], [5.0, ODD]])),
        Action::Gloss { wet: gloss, dry: gloss },
        Action::Stiffness { value: ODD },
    ]
}

/// Debug text of an action, in which -0 differs from 0.
fn bits(action: &Action) -> String {
    format!("{action:?}")
}

#[test]
fn a_rounded_action_is_read_as_it_was_written() {
    let canvas =
        || Canvas { width_mm: 100.0, height_mm: 80.0, cell_mm: 0.1, ground: GroundSpec::default() };
    let mut script = StrokeScript::new("", "", canvas(), PaletteSpec::from_names(["Zinc White"]));
    script.mixing = Some(canvas());
    let big = BrushSpec { shape: HeadShape::Flat, size_mm: 3.0 };
    script.brushes.insert("big".to_owned(), big);
    script.actions = odd().iter().map(Action::rounded).collect();
    let text = script.to_json().expect("it is sound");
    let read = StrokeScript::from_json("a.json", text.as_bytes()).expect("it is sound");
    assert_eq!(read.actions.len(), script.actions.len());
    for (read, written) in read.actions.iter().zip(&script.actions) {
        assert_eq!(bits(read), bits(written));
        assert_eq!(bits(&read.rounded()), bits(read), "rounding again changes nothing");
    }
    for (odd, written) in odd().iter().zip(&script.actions) {
        let whole = matches!(
            odd,
            Action::Scrape { .. }
                | Action::Name { .. }
                | Action::Visible { .. }
                | Action::Order { .. }
                | Action::Merge { .. }
        );
        assert_eq!(bits(odd) == bits(written), whole, "{odd:?} is rounded");
    }
}

/// A script of these actions on a canvas of 100 x 80 mm.
fn script(actions: Vec<Action>) -> StrokeScript {
    let canvas =
        Canvas { width_mm: 100.0, height_mm: 80.0, cell_mm: 0.1, ground: GroundSpec::default() };
    let mut script = StrokeScript::new("", "", canvas, PaletteSpec::from_names(["Zinc White"]));
    let big = BrushSpec { shape: HeadShape::Flat, size_mm: 3.0 };
    script.brushes.insert("big".to_owned(), big);
    script.actions = actions;
    script
}

#[test]
fn masks_are_read_and_written_by_their_keys() {
    for (text, change) in [
        (
            r#"{"mask":{"polygon_mm":[[0.0,1.0],[5.0,1.5],[2.0,9.0]]}}"#,
            MaskChange::PolygonMm(vec![[0.0, 1.0], [5.0, 1.5], [2.0, 9.0]]),
        ),
        (r#"{"mask":{"layer":2}}"#, MaskChange::Layer(LayerRef::Dry(2))),
        (r#"{"mask":{"layer":"wet"}}"#, MaskChange::Layer(LayerRef::Wet)),
        (r#"{"mask":{"painted":{}}}"#, MaskChange::Painted {}),
        (r#"{"mask":{"inverse":true}}"#, MaskChange::Inverse(true)),
        (r#"{"mask":{"clear":{}}}"#, MaskChange::Clear {}),
    ] {
        let action = Action::Mask(change);
        assert_eq!(serde_json::from_str::<Action>(text).unwrap(), action);
        assert_eq!(serde_json::to_string(&action).unwrap(), text);
    }
    for text in [
        r#"{"mask":{"polygon":[]}}"#,
        r#"{"mask":{"layer":"dry"}}"#,
        r#"{"mask":{"clear":{"all":1}}}"#,
        r#"{"mask":{"polygon_mm":[[1,2,3]]}}"#,
        r#"{"mask":{"inverse":true,"clear":{}}}"#,
    ] {
        assert!(serde_json::from_str::<Action>(text).is_err(), "{text}");
    }
}

#[test]
fn tools_and_masks_out_of_range_are_refused_with_their_place() {
    let polygon = |points: Vec<[f64; 2]>| Action::Mask(MaskChange::PolygonMm(points));
    let stroke = |tool: StrokeTool| {
        let samples = vec![Sample::upright(0.0, 1.0, 2.0, 0.5)];
        Action::Stroke(Stroke { brush: "big".to_owned(), on: SurfaceId::Canvas, tool, samples })
    };
    for (action, wanted) in [
        (polygon(vec![[0.0, 0.0], [1.0, 1.0]]), "polygon_mm"),
        (polygon(vec![[0.0, 0.0]; MAX_MASK_POINTS + 1]), "polygon_mm"),
        (polygon(vec![[f64::NAN, 0.0]; 3]), "polygon_mm, x"),
        (polygon(vec![[0.0, 1e9]; 3]), "polygon_mm, y"),
        (Action::Mask(MaskChange::Inverse(false)), "inverse"),
        (stroke(StrokeTool::Erase { strength: 0.0 }), "strength"),
        (stroke(StrokeTool::Blend { strength: 1.5 }), "strength"),
        (stroke(StrokeTool::Scrape { height_mm: -0.1 }), "height_mm"),
    ] {
        let error = script(vec![Action::Undo {}, action]).check().unwrap_err().to_string();
        assert!(error.contains(wanted) && error.contains("action 1"), "{wanted}: {error}");
    }
    let sound = [polygon(vec![[0.0, 0.0]; MAX_MASK_POINTS]), stroke(StrokeTool::Paint)];
    script(sound.to_vec()).check().unwrap();
}
