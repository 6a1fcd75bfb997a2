//! Light laid on wet dark paint stays light: a brush lays a skin over the wet paint below. Both films
//! are undone, saved, dried and shown.

use graphics::field::Field;
use paint::brush::HeadShape;
use paint::document::Document;
use paint::engine::BrushId;
use paint::file::{read, write};
use paint::layer::Layer;
use paint::painting::Painting;
use paint::strokes::{Action, StrokeTool};

use super::studio::{RED, WHITE, along, bare_on, lab, loaded, mean, on_both, on_cpu};

const WIDTH: usize = 200;
const HEIGHT: usize = 70;

/// A panel of 40 x 14 mm under wet red of 0.8 mm.
fn wet_red() -> Document {
    let mut document = bare_on(r#"{"kind": "panel", "seed": 1}"#, WIDTH, HEIGHT);
    let film = paint::amount::quanta_from_mm(0.8, document.cell_mm);
    for index in 0..WIDTH * HEIGHT {
        let mut cell = document.wet.cell(index);
        cell.pigments[RED] = film;
        document.wet.set_cell(index, cell);
    }
    document
}

/// Paints white from left to right.
fn lay_white(painting: &mut Painting) -> BrushId {
    let brush = loaded(painting, HeadShape::Filbert, 6.0, WHITE, 2.0);
    painting.stroke(brush, &along(&[(6.0, 7.0), (34.0, 7.0)], 0.3)).unwrap();
    brush
}

/// Mean lightness in the middle of the stroke.
fn lightness(picture: &Field<[f32; 4]>) -> f64 {
    let cells = (28..42).flat_map(|y| (70..130).map(move |x| (x, y)));
    mean(&cells.map(|at| lab(&picture[at]).lightness).collect::<Vec<_>>())
}

fn has_skin(layer: &Layer) -> bool {
    layer.painted_skin().is_some()
}

#[test]
fn white_on_wet_red_stays_light_on_both_backends_and_turns_to_pink_by_brushing() {
    let mut wet = Vec::new();
    for mut painting in on_both(&wet_red()) {
        let before = painting.wet().unwrap().totals();
        let brush = lay_white(&mut painting);
        let once = lightness(&painting.flat_picture().unwrap());
        assert!(once > 70.0, "L* {once}");
        for time in 0..7 {
            let (from, to) = if time % 2 == 0 { (34.0, 6.0) } else { (6.0, 34.0) };
            painting.stroke(brush, &along(&[(from, 7.0), (to, 7.0)], 0.3)).unwrap();
        }
        let brushed = lightness(&painting.flat_picture().unwrap());
        assert!(brushed < once - 10.0, "L* {once}, then {brushed}");
        let now = painting.wet().unwrap();
        let on_brush = painting.brush_paint(brush).unwrap().totals();
        assert_eq!(now.totals()[RED] + on_brush[RED], before[RED], "red");
        wet.push(now);
    }
    assert!(wet.iter().all(|layer| *layer == wet[0]), "the backends differ");
}

#[test]
fn a_stroke_on_bare_ground_has_no_skin() {
    let mut painting = on_cpu(bare_on(r#"{"kind": "panel", "seed": 1}"#, WIDTH, HEIGHT));
    let brush = lay_white(&mut painting);
    assert!(!has_skin(&painting.wet().unwrap()));
    // The stroke over it has the same paint, so the next one settles its skin.
    painting.stroke(brush, &along(&[(6.0, 7.0), (34.0, 7.0)], 0.3)).unwrap();
    painting.stroke(brush, &along(&[(6.0, 7.0), (34.0, 7.0)], 0.3)).unwrap();
    let wet = painting.wet().unwrap();
    let skin: u64 = wet.skin.as_ref().map_or(0, |skin| skin.totals().iter().sum());
    let all: u64 = wet.totals().iter().sum();
    assert!(skin < all / 2, "{skin} of {all} quanta");
}

#[test]
fn undo_takes_the_skin_back_and_redo_lays_it_again() {
    for mut painting in on_both(&wet_red()) {
        let before = painting.wet().unwrap();
        lay_white(&mut painting);
        let after = painting.wet().unwrap();
        assert!(has_skin(&after) && !has_skin(&before));
        assert!(painting.undo().unwrap());
        assert!(painting.wet().unwrap() == before, "undo");
        assert!(painting.redo().unwrap());
        assert!(painting.wet().unwrap() == after, "redo");
    }
}

#[test]
fn skins_are_saved_and_dry_without_a_change_of_colour() {
    for mut painting in on_both(&wet_red()) {
        lay_white(&mut painting);
        let document = painting.document().unwrap();
        let back = read("a.exr", &write(&document).unwrap()).unwrap();
        assert!(back == document && has_skin(&back.wet), "a file");
        let wet = lightness(&painting.flat_picture().unwrap());
        painting.apply(&Action::Dry { fraction: 1.0 }).unwrap();
        let dry = lightness(&painting.flat_picture().unwrap());
        assert!((wet - dry).abs() < 0.05, "L* {wet} wet, {dry} dry");
        let dried = painting.document().unwrap();
        assert!(has_skin(&dried.dry[0].paint) && !has_skin(&dried.wet));
        assert!(dried.dry[0].paint == document.wet, "all of it dried");
        assert!(painting.undo().unwrap());
        assert!(painting.wet().unwrap() == document.wet, "undo of drying");
    }
}

#[test]
fn a_stroke_in_portions_lays_the_same_skin() {
    let mut whole = on_cpu(wet_red());
    lay_white(&mut whole);
    let mut painting = on_cpu(wet_red());
    let brush = loaded(&mut painting, HeadShape::Filbert, 6.0, WHITE, 2.0);
    let samples = along(&[(6.0, 7.0), (34.0, 7.0)], 0.3);
    let mut stroke = painting.begin_stroke(StrokeTool::Paint, brush).unwrap();
    for sample in &samples {
        stroke.extend(std::slice::from_ref(sample)).unwrap();
        while stroke.advance(&mut painting, 7).unwrap() > 0 {}
    }
    stroke.finish(&mut painting).unwrap();
    assert!(painting.wet().unwrap() == whole.wet().unwrap(), "the films differ");
}
