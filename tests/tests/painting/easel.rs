//! Canvas and palette as one: brushes between them, one history.

use render::amount::mm_from_quanta;
use render::layer::SLOTS;
use render::optics::Gloss;
use render::paint::brush::HeadShape;
use render::paint::document::Lighting;
use render::paint::easel::{Easel, EaselError, Outcome};
use render::paint::history::TILE_BYTES;
use render::paint::painting::PaintingError;
use render::paint::strokes::{Action, LayerName, Palette, Surface};

use super::easels::{
    BACKENDS, easels, header, live, load, loaded, seeded, set_up, something, spec, squeeze, wander,
    whole,
};
use super::studio::{CELL_MM, PALETTE, RED, along, pigment};

#[test]
fn whatever_was_done_on_either_surface_is_undone_and_redone_to_the_bit() {
    for mut easel in easels() {
        let mut random = seeded(11);
        loaded(&mut easel);
        let mut past = vec![whole(&mut easel)];
        for round in 0..40 {
            if something(&mut easel, &mut random) {
                past.push(whole(&mut easel));
                assert_eq!(easel.history().1, past.len() - 1, "round {round}: one action");
            } else {
                let same = whole(&mut easel) == past[past.len() - 1];
                assert!(same, "round {round}: refused, and yet something changed");
            }
        }
        assert!(past.len() > 25, "{} actions", past.len());
        for to in [0, past.len() - 1, 7, 20, 3, 19, past.len() - 1, 0, past.len() - 1] {
            easel.travel(to).unwrap();
            assert_eq!(easel.history().1, to);
            assert!(whole(&mut easel) == past[to], "after travelling to {to}");
        }
        assert!(!easel.redo().unwrap(), "there is nothing more to do again");
    }
}

#[test]
fn what_one_surface_forgot_makes_all_before_it_unreachable() {
    for mut easel in easels() {
        let mut random = seeded(3);
        loaded(&mut easel);
        // The palette has 2 x 2 tiles: it forgets after a few strokes.
        easel.set_undo_bytes(4 * 9 * TILE_BYTES);
        let mut past = vec![whole(&mut easel)];
        let mut done = 0;
        let mut forgot = 0;
        for _ in 0..30 {
            let before = easel.history().1;
            if something(&mut easel, &mut random) {
                done += 1;
                past.push(whole(&mut easel));
            }
            forgot += usize::from(easel.history().1 < before);
        }
        let reachable = easel.history().1;
        assert!((1..done).contains(&reachable), "{reachable} of {done}, {forgot} times");
        let (used, limit) = easel.undo_bytes();
        assert!(used <= limit, "{used} of {limit} bytes");
        for place in (done - reachable..done).rev() {
            assert!(easel.undo().unwrap(), "{place}");
            assert!(whole(&mut easel) == past[place], "back to {place}, in the order of doing");
        }
        assert!(!easel.undo().unwrap(), "what is before that cannot be reached");
        // Dry layers that were taken back take memory too: the last may be lost.
        let again = easel.history().0.len();
        assert!((1..=reachable).contains(&again), "{again} of {reachable}");
        easel.travel(usize::MAX).unwrap();
        assert_eq!(easel.history().1, again);
        assert!(whole(&mut easel) == past[done - reachable + again], "and forth");
        easel.set_undo_bytes(0);
        assert_eq!(easel.history(), (Vec::new(), 0));
        let white = squeeze(Surface::Palette, "Lead White", (9.0, 7.0));
        assert_eq!(easel.act(&white).unwrap(), Outcome::Done);
        assert_eq!(easel.history(), (Vec::new(), 0), "too large for no memory");
    }
}

/// Heights of each pigment and of vehicle on both surfaces and all brushes there,
/// in quanta summed over cells.
fn wet(easel: &mut Easel) -> [u64; SLOTS + 1] {
    let mut totals = [0; SLOTS + 1];
    for surface in [Surface::Canvas, Surface::Palette] {
        let mm = easel.painting_mut(surface).unwrap().wet_totals_mm().unwrap();
        let quanta = mm.map(|mm| (mm / mm_from_quanta(1, CELL_MM)).round() as u64);
        totals.iter_mut().zip(quanta).for_each(|(total, more)| *total += more);
    }
    totals
}

#[test]
fn a_brush_takes_its_paint_along_and_an_undo_takes_it_back() {
    for mut easel in easels() {
        loaded(&mut easel);
        let all = wet(&mut easel);
        let before = whole(&mut easel);
        let there = along(&[(3.0, 3.0), (15.0, 10.0)], 0.5);
        for on in [Surface::Palette, Surface::Canvas, Surface::Palette] {
            easel.begin_stroke(on, "flat").unwrap();
            easel.extend(&there).unwrap();
            easel.end_stroke().unwrap();
            assert_eq!(wet(&mut easel), all, "paint is only moved");
        }
        let after = whole(&mut easel);
        let palette = after.1.as_ref().unwrap().wet.totals();
        assert!(palette[0] > 0 && after.0.wet.totals()[0] > 0, "it painted on both");
        easel.travel(0).unwrap();
        assert!(whole(&mut easel) == before, "all is back on the brush");
        // A brush that was loaded in between does as one on a canvas alone.
        easel.act(&load("flat", "Vermilion", 0.2)).unwrap();
        easel.travel(3).unwrap();
        assert!(whole(&mut easel) == after, "what was done is done again");
        assert_eq!(wet(&mut easel), all);
    }
}

#[test]
fn pigments_that_are_wet_anywhere_stay_on_both_palettes() {
    for mut easel in easels() {
        let without_red = Action::Palette(Palette::of(PALETTE[..3].iter().copied()));
        let refused = |easel: &mut Easel| match easel.act(&without_red) {
            Err(EaselError::Painting(PaintingError::StillWet { pigment })) => Some(pigment),
            _ => None,
        };
        let red = "Vermilion";
        easel.act(&squeeze(Surface::Palette, red, (9.0, 7.0))).unwrap();
        let before = whole(&mut easel);
        assert_eq!(refused(&mut easel).as_deref(), Some(red), "a heap on the palette");
        assert!(whole(&mut easel) == before, "refused on both");
        easel.act(&Action::Scrape { on: Surface::Palette }).unwrap();
        easel.take_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
        easel.act(&load("flat", red, 0.3)).unwrap();
        assert_eq!(refused(&mut easel).as_deref(), Some(red), "on the brush");
        // It goes to the palette, where it is washed: nothing of it is left behind.
        easel.begin_stroke(Surface::Palette, "flat").unwrap();
        easel.extend(&along(&[(3.0, 3.0), (9.0, 9.0)], 0.5)).unwrap();
        easel.end_stroke().unwrap();
        easel.act(&Action::Wash { brush: "flat".to_owned() }).unwrap();
        easel.act(&Action::Scrape { on: Surface::Palette }).unwrap();
        easel.act(&without_red).unwrap();
        let palette = easel.painting(Surface::Palette).unwrap().state().slots;
        assert_eq!(palette, easel.canvas().state().slots);
        assert!(!palette.contains(&Some(pigment(red))));
        assert!(matches!(
            easel.act(&squeeze(Surface::Palette, red, (9.0, 7.0))),
            Err(EaselError::Painting(PaintingError::OffPalette { .. }))
        ));
    }
}

#[test]
fn paint_on_a_head_that_was_put_away_holds_no_pigment_back() {
    for mut easel in easels() {
        let red = "Vermilion";
        easel.take_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
        easel.act(&load("flat", red, 0.3)).unwrap();
        easel.begin_stroke(Surface::Canvas, "flat").unwrap();
        easel.extend(&along(&[(3.0, 3.0), (9.0, 9.0)], 0.5)).unwrap();
        easel.end_stroke().unwrap();
        easel.take_brush("flat", &spec(HeadShape::Flat, 3.0)).unwrap();
        assert_eq!(easel.brush_paint("flat").unwrap(), None, "another head, and clean");
        // The first head has its red again, though nobody holds it.
        easel.undo().unwrap();
        assert!(easel.canvas_mut().wet_totals_mm().unwrap()[RED] > 0.0);
        easel.act(&Action::Palette(Palette::of(PALETTE[..3].iter().copied()))).unwrap();
        easel.take_brush("flat", &spec(HeadShape::Flat, 5.0)).unwrap();
        let paint = easel.brush_paint("flat").unwrap().unwrap();
        assert_eq!(paint.totals(), [0; SLOTS + 1]);
    }
}

#[test]
fn light_shine_and_wet_swaps_are_those_of_both_surfaces() {
    for mut easel in easels() {
        let lamp = Lighting { illuminant: "A".to_owned(), relief: 0.5, ..Lighting::default() };
        easel.act(&Action::Light(lamp.clone())).unwrap();
        let wet = Gloss { strength: 0.5, exponent: 80.0 };
        easel.act(&Action::Gloss { wet, dry: wet }).unwrap();
        let (from, to) = ("Viridian".to_owned(), "Cobalt Blue".to_owned());
        easel.act(&Action::Swap { layer: LayerName::Wet, from, to }).unwrap();
        for surface in [Surface::Canvas, Surface::Palette] {
            let painting = easel.painting(surface).unwrap();
            assert_eq!(painting.state().lighting, lamp);
            assert_eq!(painting.medium().wet, wet);
            assert!(painting.state().slots.contains(&Some(pigment("Cobalt Blue"))));
            let nodes = easel.canvas().light().quadrature.nodes_nm.clone();
            assert_eq!(painting.light().quadrature.nodes_nm, nodes);
        }
        assert_eq!(easel.history().0, ["light A", "gloss", "Cobalt Blue for Viridian, wet paint"]);
        easel.travel(0).unwrap();
        for surface in [Surface::Canvas, Surface::Palette] {
            let painting = easel.painting(surface).unwrap();
            assert_eq!(painting.state().lighting, Lighting::default());
            assert!(painting.state().slots.contains(&Some(pigment("Viridian"))));
            assert_ne!(painting.medium().wet, wet);
        }
    }
}

#[test]
fn a_slider_is_one_action_and_another_one_is_another() {
    for mut easel in easels() {
        loaded(&mut easel);
        let mut random = seeded(2);
        live(&mut easel, Surface::Canvas, "flat", &mut random);
        easel.act(&Action::Dry { fraction: 1.0 }).unwrap();
        let before = whole(&mut easel);
        let turned = |azimuth_deg| Action::Light(Lighting { azimuth_deg, ..Lighting::default() });
        for azimuth_deg in [10.0, 20.0, 30.0] {
            easel.adjust(&turned(azimuth_deg)).unwrap();
            assert_eq!(easel.canvas().state().lighting.azimuth_deg, azimuth_deg, "seen at once");
        }
        for value in [0.9, 0.3] {
            easel.adjust(&Action::Opacity { layer: LayerName::Dry(0), value }).unwrap();
        }
        easel.settle();
        let labels = ["stroke, flat", "dry all", "light D65", "30 % of layer 0"];
        assert_eq!(easel.history(), (labels.to_vec(), 4));
        let after = whole(&mut easel);
        easel.travel(2).unwrap();
        assert!(whole(&mut easel) == before, "two undos take both back");
        easel.travel(4).unwrap();
        assert!(whole(&mut easel) == after);
        // Refused, at first and in between, it leaves nothing behind.
        let nowhere = Action::Opacity { layer: LayerName::Dry(9), value: 0.5 };
        assert!(easel.adjust(&nowhere).is_err());
        assert!(whole(&mut easel) == after);
        assert!(matches!(
            easel.adjust(&Action::Dry { fraction: 0.5 }),
            Err(EaselError::NoControl { kind: "dry" })
        ));
        easel.settle();
        assert_eq!(easel.history().0, labels, "nothing was adjusted");
        easel.undo().unwrap();
        assert_eq!(easel.history().1, 3);
    }
}

#[test]
fn what_is_open_ends_before_anything_else() {
    for mut easel in easels() {
        loaded(&mut easel);
        let mut random = seeded(4);
        easel.begin_stroke(Surface::Palette, "knife").unwrap();
        easel.extend(&wander(&mut random, 5)).unwrap();
        assert_eq!(easel.open_stroke(), Some((Surface::Palette, "knife")));
        let (_, palette) = easel.documents().unwrap();
        assert_eq!(palette.unwrap().wet.totals(), [0; SLOTS + 1], "nothing was painted yet");
        easel.act(&Action::Dry { fraction: 0.5 }).unwrap();
        assert_eq!(easel.open_stroke(), None);
        assert_eq!(easel.history().0, ["stroke on the palette, knife"], "no wet paint to dry");
        // A brush that was set down and told nothing leaves no action.
        easel.begin_stroke(Surface::Canvas, "flat").unwrap();
        assert_eq!(easel.advance(100).unwrap(), 0);
        assert_eq!(easel.end_stroke().unwrap(), None);
        assert!(matches!(easel.end_stroke(), Err(EaselError::NoStroke)));
        assert!(matches!(easel.extend(&wander(&mut random, 1)), Err(EaselError::NoStroke)));
        assert_eq!(easel.history().1, 1);
        easel.begin_stroke(Surface::Canvas, "flat").unwrap();
        let samples = wander(&mut random, 4);
        easel.extend(&samples).unwrap();
        easel.lift().unwrap();
        assert!(matches!(easel.extend(&samples), Err(EaselError::NoStroke)), "it was lifted");
        assert!(easel.undo().unwrap(), "the stroke that was open");
        assert_eq!(easel.history(), (vec!["stroke on the palette, knife", "stroke, flat"], 1));
    }
}

#[test]
fn what_cannot_be_is_told_as_in_a_script() {
    let mut easel = set_up(&header(), BACKENDS[0]).unwrap();
    loaded(&mut easel);
    let before = whole(&mut easel);
    let mut told = |action: Action| {
        let error = easel.act(&action).unwrap_err();
        (error.to_string(), error.hint().unwrap_or_default())
    };
    let (error, hint) = told(load("flatt", "Lead White", 0.1));
    assert_eq!((&*error, &*hint), ("brush: one of `brushes`, found `flatt`", "did you mean flat?"));
    let (error, hint) = told(load("flat", "Lead Wite", 0.1));
    assert_eq!(error, "recipe: a pigment of the library, found `Lead Wite`");
    assert_eq!(hint, "did you mean Lead White?");
    let (error, hint) = told(load("flat", "Ultramarine", 0.1));
    assert_eq!(error, "recipe: pigments of the palette, found `Ultramarine`");
    assert!(hint.contains("Lead White, Chrome Yellow"), "{hint}");
    let (error, _) = told(load("flat", "Lead White", f64::NAN));
    assert_eq!(error, "amount_mm: 0 to 100, found `NaN`");
    let (error, hint) = told(load("flat", "Lead White", 99.0));
    assert!(error.contains("holds") && hint.contains("wipe"), "{error} {hint}");
    let (error, _) = told(Action::Save { path: "a.exr".to_owned() });
    assert_eq!(error, "an easel saves nothing");
    let mut samples = along(&[(1.0, 1.0), (9.0, 9.0)], 0.5);
    samples[1].pressure = 1.5;
    easel.begin_stroke(Surface::Canvas, "flat").unwrap();
    let error = easel.extend(&samples).unwrap_err().to_string();
    assert_eq!(error, "sample 1, pressure: 0 to 1, found `1.5`");
    easel.end_stroke().unwrap();
    assert_eq!(easel.history().0, ["stroke, flat"], "as far as it was sound");
    easel.undo().unwrap();
    assert!(whole(&mut easel) == before, "nothing else was done");

    let mut alone = Easel::new(super::studio::on_cpu(super::studio::bare(60, 40)), None).unwrap();
    let error = alone.act(&Action::Scrape { on: Surface::Palette }).unwrap_err();
    assert!(error.to_string().starts_with("on: the canvas, as there is no palette"), "{error}");
    let error = alone.take_brush("flat", &spec(HeadShape::Flat, 0.1)).unwrap_err();
    assert_eq!(error.to_string(), "size_mm: 0.2 to 100, found `0.1`");
    let error = alone.begin_stroke(Surface::Canvas, "flat").unwrap_err();
    assert!(error.to_string().starts_with("brush: one of `brushes`"), "{error}");
}

#[test]
fn surfaces_that_do_not_go_together_are_refused() {
    let (canvas, palette) = header().surfaces(super::studio::oils(), None).unwrap();
    let palette = palette.unwrap();
    let together = |change: fn(&mut render::paint::document::Document)| {
        let mut palette = palette.clone();
        change(&mut palette);
        let (canvas, palette) =
            (super::studio::on_cpu(canvas.clone()), super::studio::on_cpu(palette));
        Easel::new(canvas, Some(palette)).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(together(|_| ()), Ok(()));
    let refused = |what: &str| Err(format!("canvas and palette have different {what}"));
    assert_eq!(together(|palette| palette.cell_mm = 0.1), refused("cells"));
    assert_eq!(together(|palette| palette.slots.swap(0, 1)), refused("pigments"));
    assert_eq!(together(|palette| palette.lighting.relief = 0.0), refused("lights"));
    assert_eq!(together(|palette| palette.medium.scattering_per_mm = 1.0), refused("media"));
    assert_eq!(together(|palette| palette.library.title.clear()), refused("pigment libraries"));
}
