//! Tests of names, visibility, order and merging of dry layers.

use pigment::library::PigmentLibrary;

use super::{LayerRef, Painting, PaintingError};
use crate::document::{Document, LayerId, Lighting, Medium};
use crate::engine::PaintEngine;
use crate::ground::GroundSpec;
use crate::layer::{Cell, Layer};
use documents::hint::Explain;
use graphics::tile::Rect;

const WIDTH: usize = 90;
const HEIGHT: usize = 70;

fn id(number: u32) -> LayerRef {
    LayerRef::Id(LayerId(number))
}

/// An even film of the pigment in `slot`, `amount` quanta high, over `rect`.
fn film(slot: usize, amount: u32, rect: Rect) -> Layer {
    let mut layer = Layer::empty(WIDTH, HEIGHT);
    for y in rect.y..rect.y + rect.height {
        for x in rect.x..rect.x + rect.width {
            let mut cell = Cell::default();
            cell.pigments[slot] = amount;
            layer.set_cell(y * WIDTH + x, cell);
        }
    }
    layer
}

const fn rect(x: usize, width: usize) -> Rect {
    Rect { x, y: 10, width, height: 40 }
}

/// A painting with these dry layers, lowest first: slot, quanta and place of each film.
fn painting(films: &[(usize, u32, Rect)]) -> Painting {
    let library = PigmentLibrary::van_gogh_oils();
    let ground = GroundSpec::default().build(WIDTH, HEIGHT, 0.1, &library).unwrap();
    let [white, blue] = ["Lead White", "Prussian Blue"].map(|name| library.find(name).unwrap());
    let mut others = library.ids().filter(|&other| other != white && other != blue);
    let slots = std::array::from_fn(|slot| match slot {
        0 => Some(white),
        3 => Some(blue),
        _ => others.next(),
    });
    let medium = Medium::default();
    let lighting = Lighting::default();
    let mut document = Document::bare("", 0.1, ground, library, medium, slots, lighting);
    for &(slot, amount, rect) in films {
        document.push_dry(slots, film(slot, amount, rect));
    }
    opened(document)
}

fn opened(document: Document) -> Painting {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Painting::open(document, engine, 1 << 26).unwrap()
}

/// Asserts that the picture and the relief are those of the painting opened anew.
fn assert_as_new(painting: &mut Painting, after: &str) {
    let mut new = opened(painting.document().unwrap());
    assert!(painting.picture().unwrap() == new.picture().unwrap(), "picture after {after}");
    assert!(painting.engine.floor().unwrap() == new.engine.floor().unwrap(), "floor after {after}");
}

fn ids(painting: &Painting) -> Vec<u32> {
    painting.state().dry.iter().map(|layer| layer.id.0).collect()
}

const THICK: u32 = 1 << 20;

#[test]
fn a_moved_layer_covers_what_it_lies_over_and_the_relief_stays() {
    let mut painting =
        painting(&[(0, THICK, rect(5, 40)), (3, THICK, rect(25, 40)), (5, THICK, rect(10, 70))]);
    let before = painting.picture().unwrap();
    let whole = painting.document().unwrap();
    let floor = painting.engine.floor().unwrap();
    assert!(painting.move_layer(id(1), 2).unwrap(), "it lay below");
    assert_eq!(ids(&painting), [2, 3, 1]);
    assert!(painting.engine.floor().unwrap() == floor, "heights add up in any order");
    let after = painting.picture().unwrap();
    assert!(after[(30, 30)] != before[(30, 30)], "the first is on top now");
    assert_as_new(&mut painting, "a move");
    assert!(!painting.move_layer(id(1), 2).unwrap(), "it is there already");
    assert!(painting.undo().unwrap() && painting.document().unwrap() == whole, "undo");
    assert!(painting.picture().unwrap() == before, "the picture after undo");
    assert!(painting.redo().unwrap() && ids(&painting) == [2, 3, 1], "redo");
    assert!(painting.picture().unwrap() == after, "the picture after redo");
    let error = painting.move_layer(id(1), 3).unwrap_err();
    assert!(matches!(error, PaintingError::NoLayer { index: 3, count: 3 }), "{error}");
    assert_eq!(painting.undo_bytes().0, 0, "an order takes no memory");
}

#[test]
fn a_hidden_layer_keeps_opacity_and_relief() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (3, THICK, rect(25, 40))]);
    painting.set_opacity(id(2), 0.7).unwrap();
    let shown = painting.picture().unwrap();
    let floor = painting.engine.floor().unwrap();
    painting.show_layer(id(2), false).unwrap();
    assert!(painting.picture().unwrap() != shown, "nothing was hidden");
    assert_as_new(&mut painting, "hiding");
    let layer = painting.state().dry[1].clone();
    assert_eq!((layer.opacity, layer.shown_opacity()), (0.7, 0.0));
    assert!(painting.engine.floor().unwrap() == floor, "its height stays");
    painting.show_layer(id(2), true).unwrap();
    assert!(painting.picture().unwrap() == shown, "not as before");
    painting.undo().unwrap();
    assert!(!painting.state().dry[1].visible, "undone");
}

#[test]
fn names_are_undone_and_checked() {
    let mut painting = painting(&[(0, THICK, rect(5, 40))]);
    painting.name_layer(LayerRef::Dry(0), "sky").unwrap();
    assert_eq!(painting.state().dry[0].label(), "sky");
    assert!(painting.undo().unwrap() && painting.state().dry[0].label() == "Layer 1");
    assert!(painting.redo().unwrap() && painting.state().dry[0].label() == "sky");
    let error = painting.name_layer(id(1), "a\nb").unwrap_err();
    assert!(matches!(error, PaintingError::LayerName { .. }) && error.hint().is_some());
    let error = painting.name_layer(LayerRef::Wet, "wet").unwrap_err();
    assert!(matches!(error, PaintingError::WetLayer { .. }), "{error}");
    let error = painting.name_layer(id(7), "x").unwrap_err().to_string();
    assert_eq!(error, "there is no layer 7; the painting has 1");
}

#[test]
fn an_identity_is_not_given_again_after_a_merge() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (0, THICK, rect(25, 40))]);
    painting.merge(id(2), id(1)).unwrap();
    assert_eq!(ids(&painting), [1]);
    let mut again = opened(painting.document().unwrap());
    again.squeeze(&[1.0; 8], 0.0, 4.0, 3.0, 1.0).unwrap();
    again.dry(1.0).unwrap();
    assert_eq!(ids(&again), [1, 3], "2 was the merged one");
}

#[test]
fn layers_apart_merge_past_films_that_they_do_not_touch() {
    let left = rect(5, 20);
    let right = rect(30, 20);
    let mut painting = painting(&[(0, THICK, left), (3, THICK, right), (5, THICK, rect(70, 10))]);
    painting.name_layer(id(3), "edge").unwrap();
    let picture = painting.picture().unwrap();
    let whole = painting.document().unwrap();
    painting.merge(id(1), id(3)).unwrap();
    assert_eq!(ids(&painting), [1, 2]);
    assert_eq!(painting.state().dry[0].name, "edge", "the lower had no name");
    assert!(painting.picture().unwrap() == picture, "it shows");
    assert_as_new(&mut painting, "a merge");
    assert!(painting.undo().unwrap() && painting.document().unwrap() == whole, "undo");
    assert!(painting.redo().unwrap() && ids(&painting) == [1, 2], "redo");
    assert_as_new(&mut painting, "redo");
}

#[test]
fn the_lower_layer_rises_if_only_it_is_free() {
    let mut painting =
        painting(&[(0, THICK, rect(5, 20)), (3, THICK, rect(40, 20)), (0, THICK, rect(30, 20))]);
    painting.merge(id(3), id(1)).unwrap();
    assert_eq!(ids(&painting), [2, 1], "it lies where the upper was");
    assert_as_new(&mut painting, "a merge");
}

#[test]
fn a_film_between_that_touches_both_forbids_a_merge_and_is_named() {
    let mut painting =
        painting(&[(0, THICK, rect(5, 30)), (3, THICK, rect(25, 30)), (0, THICK, rect(40, 30))]);
    painting.name_layer(id(2), "water").unwrap();
    let whole = painting.document().unwrap();
    let error = painting.merge(id(1), id(3)).unwrap_err();
    assert_eq!(error.to_string(), "`water` lies between the two layers and overlaps both");
    assert!(error.hint().is_some_and(|hint| hint.to_string().contains("move that layer")));
    assert!(painting.document().unwrap() == whole, "something changed");
    painting.move_layer(id(2), 2).unwrap();
    painting.merge(id(1), id(3)).unwrap();
    assert_eq!(ids(&painting), [1, 2]);
}

#[test]
fn opacities_become_part_of_the_merged_paint() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (0, THICK, rect(30, 40))]);
    painting.set_opacity(id(1), 0.25).unwrap();
    painting.set_opacity(id(2), 0.5).unwrap();
    let picture = painting.picture().unwrap();
    let floor = painting.engine.floor().unwrap();
    painting.merge(id(1), id(2)).unwrap();
    let layer = &painting.document().unwrap().dry[0];
    let cell = |x: usize| layer.paint.cell(30 * WIDTH + x);
    assert_eq!((layer.opacity, cell(10).pigments[0]), (0.5, THICK / 2), "a quarter of it shows");
    assert_eq!((cell(10).vehicle, cell(60).vehicle), (THICK / 2, 0));
    assert_eq!(cell(35).pigments[0], THICK + THICK / 2, "both in one cell");
    assert!(painting.engine.floor().unwrap() == floor, "heights stay");
    let merged = painting.picture().unwrap();
    let far = |a: &[f32; 4], b: &[f32; 4]| (0..3).any(|i| (a[i] - b[i]).abs() > 1e-4);
    let moved = picture.values().iter().zip(merged.values()).filter(|(a, b)| far(a, b)).count();
    assert_eq!(moved, 0, "cells that changed colour");
    painting.undo().unwrap();
    painting.show_layer(id(2), false).unwrap();
    let error = painting.merge(id(1), id(2)).unwrap_err();
    assert!(matches!(error, PaintingError::UnlikeVisibility), "{error}");
}

#[test]
fn hidden_layers_merge_only_if_it_would_not_show() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (3, THICK, rect(30, 40))]);
    for layer in [id(1), id(2)] {
        painting.show_layer(layer, false).unwrap();
    }
    let error = painting.merge(id(1), id(2)).unwrap_err();
    assert!(matches!(error, PaintingError::MergeShows { .. }), "{error}");
    assert!(!painting.state().dry[0].visible, "it is shown after the trial");
    assert_as_new(&mut painting, "a refused merge");
}

#[test]
fn more_pigments_than_a_layer_holds_are_named() {
    let mut document = painting(&[]).document().unwrap();
    let place = |at: usize| Rect { x: 10 * at, y: 3, width: 8, height: 8 };
    let mut eight = Layer::empty(WIDTH, HEIGHT);
    for slot in 0..8 {
        let mut cell = eight.cell(slot);
        cell.pigments[slot] = 100;
        eight.set_cell(slot, cell);
    }
    let slots = document.slots;
    document.push_dry(slots, eight);
    let mut others = slots;
    let library = document.library.clone();
    let mut more = library.ids().filter(|&more| !slots.contains(&Some(more)));
    (others[0], others[1]) = (more.next(), more.next());
    document.push_dry(others, film(0, 100, place(4)));
    let mut painting = opened(document);
    let error = painting.merge(id(2), id(1)).unwrap_err();
    let PaintingError::MergedPigments { pigments } = &error else { panic!("{error}") };
    let ninth = library[others[0].unwrap()].name.clone();
    // The tenth is on the palette of the second layer, but not in its paint.
    assert_eq!((pigments.len(), pigments.last()), (9, Some(&ninth)));
    assert!(error.to_string().contains(&ninth) && error.hint().is_some(), "{error}");
    let error = painting.merge(id(2), id(2)).unwrap_err();
    assert!(matches!(error, PaintingError::SameLayer), "{error}");
}
