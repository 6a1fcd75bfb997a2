//! Incremental pictures: `refresh` renders and reports the changed tiles only, and reading those
//! keeps a window correct.

use graphics::field::Field;
use graphics::tile::{Rect, TileSet};
use paint::brush::HeadShape;
use paint::document::Lighting;
use paint::painting::{LayerRef, Painting};

use super::studio::{
    BLUE, CELL_MM, WHITE, along, bare, crossing, loaded, on_both, on_cpu, on_gpu, pigment, pure,
};

/// Size of the canvas in cells: 5 x 3 tiles.
const WIDTH: usize = 300;
const HEIGHT: usize = 180;

/// A window's copy of the picture; reads only the tiles that `refresh` reports.
struct Window {
    second: bool,
    shown: Field<[f32; 4]>,
}

impl Window {
    fn new(second: bool) -> Self {
        Self { second, shown: Field::filled(WIDTH, HEIGHT, [f32::NAN; 4]) }
    }

    /// Reads the changed tiles; returns their number.
    fn follow(&mut self, painting: &mut Painting) -> usize {
        let bounds = painting.bounds();
        let tiles = painting.refresh(self.second).unwrap();
        for tile in tiles.iter() {
            let rect = tile.rect(bounds);
            let part = painting.picture_in(self.second, rect).unwrap();
            self.shown.put((rect.x, rect.y), &part);
        }
        tiles.len()
    }
}

fn lamp_light() -> Lighting {
    Lighting {
        illuminant: "A".into(),
        azimuth_deg: 100.0,
        elevation_deg: 35.0,
        ..Lighting::default()
    }
}

/// Picture of a newly opened copy of `painting`, under its own light or under `other`.
fn anew(painting: &mut Painting, other: Option<&Lighting>) -> Field<[f32; 4]> {
    let mut document = painting.document().unwrap();
    let gpu = !painting.backend().starts_with("the processor");
    document.lighting = Lighting::default();
    let lighting = other.unwrap_or(&painting.state().lighting).clone();
    let mut opened = if gpu { on_gpu(document).unwrap() } else { on_cpu(document) };
    opened.relight(lighting).unwrap();
    opened.picture().unwrap()
}

#[test]
fn a_window_that_reads_what_changed_shows_what_is_there_under_both_lights() {
    for mut painting in on_both(&bare(WIDTH, HEIGHT)) {
        painting.set_second_light(Some(lamp_light())).unwrap();
        let mut first = Window::new(false);
        let mut second = Window::new(true);
        let brush = loaded(&mut painting, HeadShape::Flat, 4.0, WHITE, 0.5);
        let blue = loaded(&mut painting, HeadShape::Round, 3.0, BLUE, 0.5);
        let mut check = |painting: &mut Painting, most: usize, after: &str| {
            for (window, other) in [(&mut first, None), (&mut second, Some(lamp_light()))] {
                let tiles = window.follow(painting);
                assert!((1..=most).contains(&tiles), "after {after}: {tiles} tiles");
                assert!(window.shown == anew(painting, other.as_ref()), "after {after}");
                assert_eq!(window.follow(painting), 0, "twice after {after}");
            }
        };
        check(&mut painting, 15, "nothing");
        painting.stroke(brush, &along(&[(3.0, 4.0), (12.0, 5.0)], 0.5)).unwrap();
        check(&mut painting, 6, "a stroke");
        let mut stroke = painting.begin_stroke(blue).unwrap();
        stroke.extend(&along(&[(40.0, 26.0), (56.0, 30.0), (58.0, 34.0)], 0.5)).unwrap();
        assert!(stroke.advance(&mut painting, 30).unwrap() > 0, "a stroke of 30 sub-steps");
        check(&mut painting, 6, "half a stroke");
        stroke.finish(&mut painting).unwrap();
        check(&mut painting, 6, "the rest of it");
        painting.undo().unwrap();
        check(&mut painting, 12, "undo");
        // Reading the whole picture must not clear the set of changed tiles.
        painting.redo().unwrap();
        painting.picture().unwrap();
        check(&mut painting, 12, "redo");
        painting.dry(0.5).unwrap();
        check(&mut painting, 12, "drying");
        painting.set_opacity(LayerRef::Dry(0), 0.5).unwrap();
        check(&mut painting, 15, "opacity");
        let from = pigment("Lead White");
        let to = pigment("Zinc White");
        painting.swap_pigment(LayerRef::Wet, from, to).unwrap();
        check(&mut painting, 15, "another pigment");
        painting.undo().unwrap();
        check(&mut painting, 15, "undoing that");
        painting.flat_picture().unwrap();
        painting.set_second_light(Some(lamp_light())).unwrap();
        check(&mut painting, 15, "a flat picture, and the same light again");
    }
}

#[test]
fn relighting_changes_the_first_view_alone_and_the_second_comes_and_goes() {
    for mut painting in on_both(&bare(WIDTH, HEIGHT)) {
        crossing(&mut painting);
        assert!(painting.second_light().is_none(), "a second light from the start");
        painting.set_second_light(Some(lamp_light())).unwrap();
        assert_eq!(painting.refresh(true).unwrap().len(), 15);
        let before = painting.picture_in(true, painting.bounds()).unwrap();
        painting.refresh(false).unwrap();
        painting.relight(Lighting { azimuth_deg: 45.0, ..Lighting::default() }).unwrap();
        assert!(painting.refresh(true).unwrap().is_empty(), "the second view changed");
        assert_eq!(painting.refresh(false).unwrap().len(), 15);
        let unknown = Lighting { illuminant: "moon".into(), ..Lighting::default() };
        assert!(painting.set_second_light(Some(unknown)).is_err(), "an unknown light");
        assert_eq!(painting.second_light(), Some(&lamp_light()));
        // The direction of the second light changes and changes back; undo leaves that light alone.
        let moved = Lighting { azimuth_deg: 200.0, ..lamp_light() };
        painting.set_second_light(Some(moved)).unwrap();
        painting.refresh(true).unwrap();
        assert!(painting.picture_in(true, painting.bounds()).unwrap() != before, "not moved");
        painting.set_second_light(Some(lamp_light())).unwrap();
        painting.undo().unwrap();
        painting.refresh(true).unwrap();
        assert!(painting.picture_in(true, painting.bounds()).unwrap() == before, "moved back");
        painting.set_second_light(None).unwrap();
        painting.set_second_light(Some(lamp_light())).unwrap();
        assert_eq!(painting.refresh(true).unwrap().len(), 15);
        assert!(painting.picture_in(true, painting.bounds()).unwrap() == before, "set again");
    }
}

#[test]
fn a_heap_that_ends_with_its_tile_is_seen_beyond_it() {
    for mut painting in on_both(&bare(130, 100)) {
        let mut ended = 0;
        for step in 0..12 {
            // From well inside the first tile (64 cells wide) until the heap crosses its edge.
            let x_mm = (56.0 + 0.25 * f64::from(step)) * CELL_MM;
            painting.squeeze(&pure(WHITE), 0.0, x_mm, 6.0, 3.0).unwrap();
            let wet = painting.wet().unwrap();
            let painted = |x: usize| (0..64).any(|y| wet.cell(y * 130 + x).volume() > 0);
            ended += usize::from(painted(63) && !painted(64));
            let seen = painting.picture().unwrap();
            assert!(seen == anew(&mut painting, None), "step {step}");
            painting.scrape().unwrap();
            let seen = painting.picture().unwrap();
            assert!(seen == anew(&mut painting, None), "scraped, step {step}");
        }
        assert!(ended > 0, "no heap ended with its tile");
    }
}

#[test]
#[should_panic(expected = "the painting has a second light")]
fn no_second_view_without_a_second_light() {
    let mut painting = on_both(&bare(40, 40)).remove(0);
    let _: Result<TileSet, _> = painting.refresh(true);
}

#[test]
fn a_part_of_the_picture_is_that_of_the_whole() {
    for mut painting in on_both(&bare(130, 100)) {
        crossing(&mut painting);
        let whole = painting.picture().unwrap();
        for rect in [
            Rect { x: 0, y: 0, width: 130, height: 100 },
            Rect { x: 0, y: 40, width: 130, height: 7 },
            Rect { x: 17, y: 31, width: 1, height: 1 },
            Rect { x: 60, y: 50, width: 70, height: 50 },
            Rect { x: 5, y: 5, width: 0, height: 0 },
        ] {
            assert!(painting.picture_in(false, rect).unwrap() == whole.part(rect), "{rect:?}");
        }
    }
}
