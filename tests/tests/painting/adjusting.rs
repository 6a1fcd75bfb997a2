//! Continuous adjustments, gloss, the memory limit of undo, and setting the paint on a brush.

use paint::brush::HeadShape;
use paint::document::Lighting;
use paint::optics::Gloss;
use paint::painting::{LayerRef, PaintingError};

use super::studio::{WHITE, along, bare, crossing, loaded, on_both, pure};

#[test]
fn a_slider_that_is_dragged_is_one_action_and_shows_every_state() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        painting.dry(1.0).unwrap();
        let before = (painting.document().unwrap(), painting.picture().unwrap());
        let actions = painting.undo_count();
        painting.begin_adjusting();
        let mut seen = vec![before.1.clone()];
        for share in 1..4 {
            painting.set_opacity(LayerRef::Dry(0), 1.0 + f64::from(share)).unwrap();
            seen.push(painting.picture().unwrap());
            let azimuth_deg = 30.0 * f64::from(share);
            painting.relight(Lighting { azimuth_deg, ..Lighting::default() }).unwrap();
            seen.push(painting.picture().unwrap());
            let shine = Gloss { strength: 0.3 * share as f32, exponent: 30.0 };
            painting.set_gloss(shine, shine).unwrap();
            seen.push(painting.picture().unwrap());
        }
        assert!(painting.set_opacity(LayerRef::Dry(0), -1.0).is_err(), "an opacity below 0");
        painting.end_adjusting();
        assert!(seen.windows(2).all(|pair| pair[0] != pair[1]), "a state was not shown");
        assert_eq!(painting.undo_count(), actions + 1);
        let after = (painting.document().unwrap(), painting.picture().unwrap());
        assert!(painting.undo().unwrap(), "no undo");
        assert!((painting.document().unwrap(), painting.picture().unwrap()) == before, "undo");
        assert!(painting.redo().unwrap(), "no redo");
        assert!((painting.document().unwrap(), painting.picture().unwrap()) == after, "redo");
    }
}

#[test]
fn a_slider_that_is_only_touched_is_no_action() {
    for mut painting in on_both(&bare(130, 100)) {
        painting.squeeze(&pure(WHITE), 0.0, 9.0, 9.0, 5.0).unwrap();
        painting.undo().unwrap();
        painting.begin_adjusting();
        painting.end_adjusting();
        assert_eq!((painting.undo_count(), painting.redo_count()), (0, 1));
    }
}

#[test]
#[should_panic(expected = "an adjustment is open")]
fn no_undo_while_a_slider_is_dragged() {
    let mut painting = on_both(&bare(40, 40)).remove(0);
    painting.begin_adjusting();
    let _ = painting.undo();
}

#[test]
fn gloss_changes_what_shines_is_kept_by_the_file_and_undone() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        let before = painting.picture().unwrap();
        let medium = painting.medium().clone();
        let wet = Gloss { strength: 0.9, exponent: 90.0 };
        let dry = medium.dry;
        painting.set_gloss(wet, dry).unwrap();
        assert!(painting.picture().unwrap() != before, "the gloss changed nothing");
        let found = painting.document().unwrap().medium;
        assert_eq!((found.wet, found.dry), (wet, dry));
        assert!(found.scattering_per_mm == medium.scattering_per_mm, "the scattering changed");
        painting.undo().unwrap();
        assert!(painting.picture().unwrap() == before, "undo");
        assert_eq!(painting.medium(), &medium);
        for strength in [-0.1, f32::NAN, 1e3] {
            let error = painting.set_gloss(wet, Gloss { strength, ..dry }).unwrap_err();
            assert!(matches!(error, PaintingError::Gloss { .. }), "{error}");
        }
        assert_eq!(painting.medium(), &medium);
    }
}

#[test]
fn what_undo_may_keep_is_told_and_can_be_less() {
    for mut painting in on_both(&bare(300, 200)) {
        let brush = loaded(&mut painting, HeadShape::Flat, 4.0, WHITE, 0.5);
        for y_mm in [5.0, 15.0, 25.0, 35.0] {
            painting.stroke(brush, &along(&[(5.0, y_mm), (50.0, y_mm)], 0.5)).unwrap();
        }
        let (used, limit) = painting.undo_bytes();
        assert!(used > 0 && used <= limit, "{used} of {limit}");
        painting.undo().unwrap();
        assert_eq!((painting.undo_count(), painting.redo_count()), (3, 1));
        let wet = painting.wet().unwrap();
        painting.set_undo_bytes(used / 2);
        let (kept, limit) = painting.undo_bytes();
        assert!(kept <= limit && limit == used / 2, "{kept} of {limit}");
        let actions = painting.undo_count() + painting.redo_count();
        assert!((1..4).contains(&actions), "{actions} actions");
        assert!(painting.wet().unwrap() == wet, "the limit changed the paint");
        while painting.undo().unwrap() {}
        painting.set_undo_bytes(0);
        assert_eq!((painting.undo_bytes(), painting.undo_count()), ((0, 0), 0));
    }
}

#[test]
fn paint_put_on_a_brush_from_elsewhere_is_what_it_holds() {
    for mut painting in on_both(&bare(130, 100)) {
        let brush = loaded(&mut painting, HeadShape::Flat, 4.0, WHITE, 0.5);
        let paint = painting.brush_paint(brush).unwrap();
        painting.wash(brush).unwrap();
        painting.set_brush_paint(brush, &paint).unwrap();
        assert!(painting.brush_paint(brush).unwrap() == paint, "the brush holds other paint");
        assert_eq!(painting.undo_count(), 0);
        assert_eq!(painting.head(brush).shape(), HeadShape::Flat);
    }
}
