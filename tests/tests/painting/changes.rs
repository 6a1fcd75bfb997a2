//! Relighting, swapping a pigment or changing an opacity gives the same painting as making it
//! with those settings from the start.

use calibrate::PigmentId;
use paint::brush::HeadShape;
use paint::document::{Document, Lighting, Slots};
use paint::painting::{LayerRef, Painting, PaintingError, UNDO_BYTES};

use super::studio::{
    RED, YELLOW, along, bare, crossing, differences, loaded, on_both, on_cpu, pigment, pure,
};

/// Paints two dry layers; 30 % of the paint of the last stroke stays wet.
fn layered(mut painting: Painting) -> Painting {
    crossing(&mut painting);
    painting.dry(1.0).unwrap();
    let brush = loaded(&mut painting, HeadShape::Flat, 6.0, RED, 0.3);
    painting.stroke(brush, &along(&[(3.0, 9.0), (21.0, 9.0)], 0.5)).unwrap();
    painting.dry(0.7).unwrap();
    painting
}

#[test]
fn relighting_gives_what_a_painting_opened_under_that_light_shows() {
    let lamp = Lighting {
        illuminant: "A".into(),
        azimuth_deg: 45.0,
        elevation_deg: 30.0,
        ..Lighting::default()
    };
    for painting in on_both(&bare(130, 100)) {
        let mut painting = layered(painting);
        let daylight = painting.picture().unwrap();
        painting.relight(lamp.clone()).unwrap();
        let relit = painting.picture().unwrap();
        let document = painting.document().unwrap();
        let engine = paint::engine::PaintEngine::on_cpu(document.ground.height.clone());
        let mut opened = Painting::open(document, engine, UNDO_BYTES).unwrap();
        let off = differences(&relit, &opened.picture().unwrap());
        assert!(off[off.len() - 1] < 0.01, "{:?} off", off.last());
        let moved = differences(&daylight, &relit);
        assert!(moved[moved.len() - 1] > 1.0, "the lamp changed nothing");
        // Only the direction of the light changes: the reflectance of dry layers is not recomputed.
        painting.relight(Lighting { azimuth_deg: 200.0, ..lamp.clone() }).unwrap();
        let moved = painting.picture().unwrap();
        assert!(moved != relit, "the azimuth changed nothing");
        painting.relight(lamp.clone()).unwrap();
        assert!(painting.picture().unwrap() == relit, "picture at the first azimuth");
        assert!(painting.undo().unwrap() && painting.picture().unwrap() == moved, "after undo");
    }
}

#[test]
fn a_swapped_pigment_looks_as_if_it_had_been_painted_with() {
    let vermilion = pigment("Vermilion");
    let minium = pigment("Minium");
    for (painting, mut other) in on_both(&bare(130, 100)).into_iter().zip({
        let mut document = bare(130, 100);
        document.slots = exchanged(document.slots, vermilion, minium);
        on_both(&document)
    }) {
        let mut painting = layered(painting);
        let before = painting.picture().unwrap();
        painting.swap_pigment(LayerRef::Dry(1), vermilion, minium).unwrap();
        painting.swap_pigment(LayerRef::Dry(0), vermilion, minium).unwrap();
        painting.swap_pigment(LayerRef::Wet, vermilion, minium).unwrap();
        assert!(painting.picture().unwrap() != before, "the swap changed nothing");
        other = layered(other);
        assert!(painting.picture().unwrap() == other.picture().unwrap(), "not the same picture");
        assert!(painting.document().unwrap() == other.document().unwrap(), "not the same painting");
        let error = painting.swap_pigment(LayerRef::Wet, vermilion, minium).unwrap_err();
        assert!(matches!(error, PaintingError::AlreadyThere { .. }), "{error}");
        let error = painting.swap_pigment(LayerRef::Wet, vermilion, pigment("Eosin Lake"));
        assert!(matches!(error, Err(PaintingError::NotThere { .. })), "{error:?}");
    }
}

fn exchanged(slots: Slots, from: PigmentId, to: PigmentId) -> Slots {
    slots.map(|slot| if slot == Some(from) { Some(to) } else { slot })
}

#[test]
fn a_layer_of_no_opacity_is_as_good_as_not_there() {
    for painting in on_both(&bare(130, 100)) {
        let mut painting = layered(painting);
        painting.set_opacity(LayerRef::Dry(1), 0.0).unwrap();
        let hidden = painting.flat_picture().unwrap();
        let mut document: Document = painting.document().unwrap();
        document.dry.remove(1);
        assert!(on_cpu(document).flat_picture().is_ok_and(|without| {
            let off = differences(&hidden, &without);
            off[off.len() - 1] < 0.01
        }));
        painting.set_opacity(LayerRef::Dry(1), 1.0).unwrap();
        let off = differences(&hidden, &painting.flat_picture().unwrap());
        assert!(off[off.len() - 1] > 5.0, "{:?}", off.last());
        for wrong in [f64::NAN, -0.1, 1001.0] {
            let error = painting.set_opacity(LayerRef::Dry(0), wrong).unwrap_err();
            assert!(matches!(error, PaintingError::Opacity { .. }), "{error}");
        }
    }
}

#[test]
fn a_palette_changes_only_where_nothing_wet_would_be_left_behind() {
    let mut painting = on_cpu(bare(60, 60));
    let brush = loaded(&mut painting, HeadShape::Round, 2.0, YELLOW, 0.2);
    let without: Vec<PigmentId> = [pigment("Lead White"), pigment("Ultramarine")].to_vec();
    let error = painting.set_palette(&without).unwrap_err();
    assert!(
        matches!(&error, PaintingError::StillWet { pigment } if pigment == "Chrome Yellow"),
        "{error}"
    );
    painting.wash(brush).unwrap();
    painting.set_palette(&without).unwrap();
    let slots = painting.slots(LayerRef::Wet).unwrap();
    assert_eq!(slots.iter().flatten().count(), 2);
    assert_eq!(slots[0], Some(pigment("Lead White")), "slot of a pigment that stays");
    let error = painting.load(brush, &pure(RED), 0.0, 0.1).unwrap_err();
    assert!(matches!(error, PaintingError::EmptySlot { slot: RED }), "{error}");
    let nine: Vec<PigmentId> = (0..9).map(PigmentId).collect();
    let error = painting.set_palette(&nine).unwrap_err();
    assert!(matches!(error, PaintingError::TooManyPigments { found: 9 }), "{error}");
}
