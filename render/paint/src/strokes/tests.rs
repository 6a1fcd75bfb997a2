//! Tests of rounding: writing and reading leave a rounded action unchanged.

use super::{
    Action, BrushSpec, Canvas, LayerRef, Load, PaletteSpec, Recipe, Squeeze, Stroke, StrokeScript,
    SurfaceId,
};
use crate::brush::HeadShape;
use crate::document::Lighting;
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
        Action::Stroke(Stroke { brush: brush(), on: SurfaceId::Palette, samples: vec![sample] }),
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
        let scrape = matches!(odd, Action::Scrape { .. });
        assert_eq!(bits(odd) == bits(written), scrape, "{odd:?} is rounded");
    }
}
