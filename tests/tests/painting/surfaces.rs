//! Sessions with a canvas and a palette: brushes that you use on both, one history and one light.

use documents::hint::Explain;
use paint::amount::mm_from_quanta;
use paint::brush::HeadShape;
use paint::document::{Lighting, Medium};
use paint::history::TILE_BYTES;
use paint::layer::SLOTS;
use paint::optics::Gloss;
use paint::painting::PaintingError;
use paint::session::{Outcome, PaintingSession};
use paint::strokes::{Action, LayerRef, PaletteSpec, SurfaceId};

use super::studio::{
    BACKENDS, CELL_MM, PALETTE, RED, along, header, live, load, loaded_session as loaded, pigment,
    random_action, seeded, sessions, set_up, spec, squeeze, wander, whole,
};

#[test]
fn whatever_was_done_on_either_surface_is_undone_and_redone_to_the_bit() {
    for mut session in sessions() {
        let mut random = seeded(11);
        loaded(&mut session);
        let mut past = vec![whole(&mut session)];
        for round in 0..40 {
            if random_action(&mut session, &mut random) {
                past.push(whole(&mut session));
                assert_eq!(session.history().1, past.len() - 1, "round {round}: one action");
            } else {
                let same = whole(&mut session) == past[past.len() - 1];
                assert!(same, "round {round}: a refused action changed something");
            }
        }
        assert!(past.len() > 25, "{} actions", past.len());
        for to in [0, past.len() - 1, 7, 20, 3, 19, past.len() - 1, 0, past.len() - 1] {
            session.go_to(to).unwrap();
            assert_eq!(session.history().1, to);
            assert!(whole(&mut session) == past[to], "state {to}");
        }
        assert!(!session.redo().unwrap(), "a redo after the last action");
    }
}

#[test]
fn what_one_surface_forgot_makes_all_before_it_unreachable() {
    for mut session in sessions() {
        let mut random = seeded(3);
        loaded(&mut session);
        // The palette has 2 x 2 tiles, so this limit drops its oldest steps after a few strokes.
        session.set_undo_bytes(4 * 9 * TILE_BYTES);
        let mut past = vec![whole(&mut session)];
        let mut done = 0;
        let mut forgot = 0;
        for _ in 0..30 {
            let before = session.history().1;
            if random_action(&mut session, &mut random) {
                done += 1;
                past.push(whole(&mut session));
            }
            forgot += usize::from(session.history().1 < before);
        }
        let reachable = session.history().1;
        assert!((1..done).contains(&reachable), "{reachable} of {done}, {forgot} times");
        let (used, limit) = session.undo_bytes();
        assert!(used <= limit, "{used} of {limit} bytes");
        for place in (done - reachable..done).rev() {
            assert!(session.undo().unwrap(), "{place}");
            assert!(whole(&mut session) == past[place], "state {place} after undo");
        }
        assert!(!session.undo().unwrap(), "an undo of a dropped step");
        // Undone dry layers also count towards the limit, so this may drop the last redo.
        let again = session.history().0.len();
        assert!((1..=reachable).contains(&again), "{again} of {reachable}");
        session.go_to(usize::MAX).unwrap();
        assert_eq!(session.history().1, again);
        assert!(whole(&mut session) == past[done - reachable + again], "state after redo");
        session.set_undo_bytes(0);
        // Actions that saved no paint, e.g. a light, stay.
        assert_eq!(session.undo_bytes().0, 0);
        let white = squeeze(SurfaceId::Palette, "Lead White", (9.0, 7.0));
        assert_eq!(session.apply(&white).unwrap(), Outcome::Done);
        assert_eq!(session.history(), (Vec::new(), 0), "too large for no memory");
    }
}

/// Wet paint on both surfaces and on their brushes, in quanta summed over cells, by slot and then
/// vehicle.
fn wet(session: &mut PaintingSession) -> [u64; SLOTS + 1] {
    let mut totals = [0; SLOTS + 1];
    for surface in [SurfaceId::Canvas, SurfaceId::Palette] {
        let mm = session.painting_mut(surface).unwrap().wet_totals_mm().unwrap();
        let quanta = mm.map(|mm| (mm / mm_from_quanta(1, CELL_MM)).round() as u64);
        totals.iter_mut().zip(quanta).for_each(|(total, more)| *total += more);
    }
    totals
}

#[test]
fn a_brush_takes_its_paint_along_and_an_undo_takes_it_back() {
    for mut session in sessions() {
        loaded(&mut session);
        let all = wet(&mut session);
        let before = whole(&mut session);
        let there = along(&[(3.0, 3.0), (15.0, 10.0)], 0.5);
        for on in [SurfaceId::Palette, SurfaceId::Canvas, SurfaceId::Palette] {
            session.begin_stroke(on, "flat").unwrap();
            session.extend(&there).unwrap();
            session.end_stroke().unwrap();
            assert_eq!(wet(&mut session), all, "paint was lost or created");
        }
        let after = whole(&mut session);
        let palette = after.1.as_ref().unwrap().wet.totals();
        assert!(palette[0] > 0 && after.0.wet.totals()[0] > 0, "it painted on both");
        session.go_to(0).unwrap();
        assert!(whole(&mut session) == before, "state after undoing all");
        // Loading a brush is not a step of the history: redo restores the paint that it had then.
        session.apply(&load("flat", "Vermilion", 0.2)).unwrap();
        session.go_to(3).unwrap();
        assert!(whole(&mut session) == after, "state after redo");
        assert_eq!(wet(&mut session), all);
    }
}

#[test]
fn pigments_that_are_wet_anywhere_stay_on_both_palettes() {
    for mut session in sessions() {
        let without_red = Action::Palette(PaletteSpec::from_names(PALETTE[..3].iter().copied()));
        let refused = |session: &mut PaintingSession| match session.apply(&without_red) {
            Err(PaintingError::StillWet(pigment)) => Some(pigment),
            _ => None,
        };
        let red = "Vermilion";
        session.apply(&squeeze(SurfaceId::Palette, red, (9.0, 7.0))).unwrap();
        let before = whole(&mut session);
        assert_eq!(refused(&mut session).as_deref(), Some(red), "a heap on the palette");
        assert!(whole(&mut session) == before, "the refused action changed something");
        session.apply(&Action::Scrape { on: SurfaceId::Palette }).unwrap();
        session.set_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
        session.apply(&load("flat", red, 0.3)).unwrap();
        assert_eq!(refused(&mut session).as_deref(), Some(red), "on the brush");
        // The brush is used on the palette and washed. Then no red is wet anywhere.
        session.begin_stroke(SurfaceId::Palette, "flat").unwrap();
        session.extend(&along(&[(3.0, 3.0), (9.0, 9.0)], 0.5)).unwrap();
        session.end_stroke().unwrap();
        session.apply(&Action::Wash { brush: "flat".to_owned() }).unwrap();
        session.apply(&Action::Scrape { on: SurfaceId::Palette }).unwrap();
        session.apply(&without_red).unwrap();
        let palette = session.painting(SurfaceId::Palette).unwrap().state().slots;
        assert_eq!(palette, session.canvas().state().slots);
        assert!(!palette.contains(&Some(pigment(red))));
        assert!(matches!(
            session.apply(&squeeze(SurfaceId::Palette, red, (9.0, 7.0))),
            Err(PaintingError::OffPalette(..))
        ));
    }
}

#[test]
fn paint_on_a_head_that_was_put_away_holds_no_pigment_back() {
    for mut session in sessions() {
        let red = "Vermilion";
        session.set_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
        session.apply(&load("flat", red, 0.3)).unwrap();
        session.begin_stroke(SurfaceId::Canvas, "flat").unwrap();
        session.extend(&along(&[(3.0, 3.0), (9.0, 9.0)], 0.5)).unwrap();
        session.end_stroke().unwrap();
        session.set_brush("flat", &spec(HeadShape::Flat, 3.0)).unwrap();
        assert_eq!(session.brush_paint("flat").unwrap(), None, "another head, and clean");
        // Undo restores the red on the first head, which belongs to no brush now.
        session.undo().unwrap();
        assert!(session.canvas_mut().wet_totals_mm().unwrap()[RED] > 0.0);
        session
            .apply(&Action::Palette(PaletteSpec::from_names(PALETTE[..3].iter().copied())))
            .unwrap();
        session.set_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
        let paint = session.brush_paint("flat").unwrap().unwrap();
        assert_eq!(paint.totals(), [0; SLOTS + 1]);
    }
}

#[test]
fn light_gloss_stiffness_and_wet_swaps_are_those_of_both_surfaces() {
    for mut session in sessions() {
        let lamp = Lighting { illuminant: "A".to_owned(), relief: 0.5, ..Lighting::default() };
        session.apply(&Action::Light(lamp.clone())).unwrap();
        let wet = Gloss { strength: 0.5, exponent: 80.0 };
        session.apply(&Action::Gloss { wet, dry: wet }).unwrap();
        session.apply(&Action::Stiffness { value: 0.25 }).unwrap();
        let from = "Viridian".to_owned();
        let to = "Cobalt Blue".to_owned();
        session.apply(&Action::Swap { layer: LayerRef::Wet, from, to }).unwrap();
        for surface in [SurfaceId::Canvas, SurfaceId::Palette] {
            let painting = session.painting(surface).unwrap();
            assert_eq!(painting.state().lighting, lamp);
            assert_eq!(painting.medium().wet, wet);
            assert_eq!(painting.medium().stiffness, 0.25);
            assert!(painting.state().slots.contains(&Some(pigment("Cobalt Blue"))));
            let nodes = session.canvas().light().quadrature.rule.nodes_nm.clone();
            assert_eq!(painting.light().quadrature.rule.nodes_nm, nodes);
        }
        assert_eq!(
            session.history().0,
            ["light A", "gloss", "stiffness 0.25", "Cobalt Blue for Viridian, wet paint"]
        );
        session.go_to(0).unwrap();
        for surface in [SurfaceId::Canvas, SurfaceId::Palette] {
            let painting = session.painting(surface).unwrap();
            assert_eq!(painting.state().lighting, Lighting::default());
            assert!(painting.state().slots.contains(&Some(pigment("Viridian"))));
            assert_ne!(painting.medium().wet, wet);
            assert_eq!(painting.medium().stiffness, Medium::default().stiffness);
        }
    }
}

#[test]
fn a_slider_is_one_action_and_another_one_is_another() {
    for mut session in sessions() {
        loaded(&mut session);
        let mut random = seeded(2);
        live(&mut session, SurfaceId::Canvas, "flat", &mut random);
        session.apply(&Action::Dry { fraction: 1.0 }).unwrap();
        let before = whole(&mut session);
        fn turned(azimuth_deg: f64) -> Action {
            Action::Light(Lighting { azimuth_deg, ..Lighting::default() })
        }
        for azimuth_deg in [10.0, 20.0, 30.0] {
            session.adjust(&turned(azimuth_deg)).unwrap();
            assert_eq!(session.canvas().state().lighting.azimuth_deg, azimuth_deg, "not applied");
        }
        for value in [0.9, 0.3] {
            session.adjust(&Action::Opacity { layer: LayerRef::Dry(0), value }).unwrap();
        }
        session.end_adjustment();
        let labels = ["stroke, flat", "dry all", "light D65", "30 % of Layer 1"];
        assert_eq!(session.history(), (labels.to_vec(), 4));
        let after = whole(&mut session);
        session.go_to(2).unwrap();
        assert!(whole(&mut session) == before, "two undos restore the state before");
        session.go_to(4).unwrap();
        assert!(whole(&mut session) == after);
        // If an adjustment is refused, it changes neither the paint nor the history.
        let nowhere = Action::Opacity { layer: LayerRef::Dry(9), value: 0.5 };
        assert!(session.adjust(&nowhere).is_err());
        assert!(whole(&mut session) == after);
        assert!(matches!(
            session.adjust(&Action::Dry { fraction: 0.5 }),
            Err(PaintingError::NoControl("dry"))
        ));
        session.end_adjustment();
        assert_eq!(session.history().0, labels, "nothing was adjusted");
        session.undo().unwrap();
        assert_eq!(session.history().1, 3);
    }
}

#[test]
fn what_is_open_ends_before_anything_else() {
    for mut session in sessions() {
        loaded(&mut session);
        let mut random = seeded(4);
        session.begin_stroke(SurfaceId::Palette, "knife").unwrap();
        session.extend(&wander(&mut random, 5)).unwrap();
        let open = session.open_stroke().expect("a stroke is open").stroke();
        assert_eq!((open.on, open.brush.as_str()), (SurfaceId::Palette, "knife"));
        let (_, palette) = session.documents().unwrap();
        assert_eq!(palette.unwrap().wet.totals(), [0; SLOTS + 1], "nothing was painted yet");
        session.apply(&Action::Dry { fraction: 0.5 }).unwrap();
        assert!(session.open_stroke().is_none());
        assert_eq!(session.history().0, ["stroke on the palette, knife"], "no wet paint to dry");
        // A stroke without samples is not a step of the history.
        session.begin_stroke(SurfaceId::Canvas, "flat").unwrap();
        assert_eq!(session.advance(100).unwrap(), 0);
        assert_eq!(session.end_stroke().unwrap(), None);
        assert!(matches!(session.end_stroke(), Err(PaintingError::NoStroke)));
        assert!(matches!(session.extend(&wander(&mut random, 1)), Err(PaintingError::NoStroke)));
        assert_eq!(session.history().1, 1);
        session.begin_stroke(SurfaceId::Canvas, "flat").unwrap();
        let samples = wander(&mut random, 4);
        session.extend(&samples).unwrap();
        session.lift().unwrap();
        assert!(matches!(session.extend(&samples), Err(PaintingError::NoStroke)), "after lifting");
        assert!(session.undo().unwrap(), "the stroke that was open");
        assert_eq!(session.history(), (vec!["stroke on the palette, knife", "stroke, flat"], 1));
    }
}

#[test]
fn what_cannot_be_is_told_as_in_a_script() {
    let mut session = set_up(&header(), BACKENDS[0]).unwrap();
    loaded(&mut session);
    let before = whole(&mut session);
    let mut refusal = |action: Action| {
        let error = session.apply(&action).unwrap_err();
        (error.to_string(), error.hint().map(|hint| hint.to_string()).unwrap_or_default())
    };
    let (error, hint) = refusal(load("flatt", "Lead White", 0.1));
    assert_eq!((&*error, &*hint), ("brush: one of `brushes`, found `flatt`", "did you mean flat?"));
    let (error, hint) = refusal(load("flat", "Lead Wite", 0.1));
    assert_eq!(error, "recipe: a pigment of the library, found `Lead Wite`");
    assert_eq!(hint, "did you mean Lead White?");
    let (error, hint) = refusal(load("flat", "Ultramarine", 0.1));
    assert_eq!(error, "recipe: pigments of the palette, found `Ultramarine`");
    assert!(hint.contains("Lead White, Chrome Yellow"), "{hint}");
    let (error, _) = refusal(load("flat", "Lead White", f64::NAN));
    assert_eq!(error, "amount_mm: 0 to 100, found `NaN`");
    let (error, hint) = refusal(load("flat", "Lead White", 99.0));
    assert!(error.contains("has room for") && hint.contains("larger cells"), "{error} {hint}");
    let (error, _) = refusal(Action::Save { path: "a.exr".to_owned() });
    assert_eq!(error, "a session does not save files");
    let mut samples = along(&[(1.0, 1.0), (9.0, 9.0)], 0.5);
    samples[1].pressure = 1.5;
    session.begin_stroke(SurfaceId::Canvas, "flat").unwrap();
    let error = session.extend(&samples).unwrap_err().to_string();
    assert_eq!(error, "sample 1, pressure: 0 to 1, found `1.5`");
    session.end_stroke().unwrap();
    assert_eq!(session.history().0, ["stroke, flat"], "the samples before the refused one");
    session.undo().unwrap();
    assert!(whole(&mut session) == before, "a refused action changed something");

    let mut alone =
        PaintingSession::new(super::studio::on_cpu(super::studio::bare(60, 40)), None).unwrap();
    let error = alone.apply(&Action::Scrape { on: SurfaceId::Palette }).unwrap_err();
    assert!(error.to_string().starts_with("on: the canvas, as there is no palette"), "{error}");
    let error = alone.set_brush("flat", &spec(HeadShape::Flat, 0.1)).unwrap_err();
    assert_eq!(error.to_string(), "size_mm: 0.2 to 100, found `0.1`");
    let error = alone.begin_stroke(SurfaceId::Canvas, "flat").unwrap_err();
    assert!(error.to_string().starts_with("brush: one of `brushes`"), "{error}");
}

#[test]
fn surfaces_that_do_not_go_together_are_refused() {
    let (canvas, palette) = header().surfaces(super::studio::oils(), None).unwrap();
    let palette = palette.unwrap();
    let together = |change: fn(&mut paint::document::Document)| {
        let mut palette = palette.clone();
        change(&mut palette);
        let canvas = super::studio::on_cpu(canvas.clone());
        let palette = super::studio::on_cpu(palette);
        PaintingSession::new(canvas, Some(palette)).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(together(|_| ()), Ok(()));
    for (change, what) in [
        ((|palette| palette.cell_mm = 0.1) as fn(&mut paint::document::Document), "cells"),
        (|palette| palette.slots.swap(0, 1), "pigments"),
        (|palette| palette.lighting.relief = 0.0, "lights"),
        (|palette| palette.medium.scattering_per_mm = 1.0, "media"),
        (|palette| palette.library.title.clear(), "pigment libraries"),
    ] {
        assert_eq!(together(change), Err(format!("canvas and palette have different {what}")));
    }
}
