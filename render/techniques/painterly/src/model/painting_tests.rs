use std::sync::Arc;

use artmap::sample::{PaintOfSamples, TexelPaint};
use graphics::camera::Framing;
use graphics::field::Field;
use paint::amount::mm_from_quanta;
use paint::document::Document;
use paint::ground::GroundKind;
use paint::layer::SLOTS;
use pigment::{PigmentId, PigmentLibrary};
use rayon::ThreadPoolBuilder;

use super::super::amounts::amounts;
use super::super::made_up::map;
use super::super::regions::{Region, RegionArea, Regions};
use super::*;

/// Slot of the pigment of the map.
const SLOT: usize = 3;

/// A map whose paint is half as high as its relief, with a third as much vehicle.
fn painted_map() -> ArtMap {
    let mut map = map(3);
    for key in &mut map.keys {
        let height = key.tile.height_mm.as_ref().unwrap();
        let texels = height
            .values()
            .iter()
            .map(|mm: &f32| {
                let mut pigments_mm = [0.0; SLOTS];
                pigments_mm[SLOT] = 0.5 * mm;
                TexelPaint { pigments_mm, vehicle_mm: mm / 3.0 }
            })
            .collect();
        key.tile.paint = Some(Field::from_values(height.width(), height.height(), texels));
    }
    let mut slots = paint::layer::Slots::default();
    slots[SLOT] = Some(PigmentId(0));
    let library = Arc::new(PigmentLibrary::van_gogh_oils());
    map.paint = Some(PaintOfSamples { library, slots });
    map.mm_per_texel = Some(0.25);
    map
}

fn settings() -> Settings {
    // All heights within the bytes of the map, so that both ways can be compared.
    let text = "colour.from = \"map\"";
    Settings::default().changed("test", text).unwrap()
}

fn painting(map: &ArtMap, settings: &Settings) -> Result<Document, PainterError> {
    let mesh = Mesh::torus_knot(4000);
    let camera = Framing::default().fit(&mesh.positions);
    let mut painter = Painter::of_model(&mesh, map, settings)?;
    painter.painting(&camera, (96, 72), 0.0, ("knot", &GroundKind::Panel.spec(1)))
}

#[test]
fn a_painting_has_the_means_of_the_amounts_that_its_strokes_show() {
    let map = painted_map();
    let document = painting(&map, &settings()).unwrap();
    // Ten pixels of the reference to ten texels of 0.25 mm, in a picture of a tenth of its size.
    let wanted = 10.0 * 0.25 / 0.96;
    assert!((document.cell_mm / wanted - 1.0).abs() < 1e-6, "{}", document.cell_mm);
    let mesh = Mesh::torus_knot(4000);
    let camera = Framing::default().fit(&mesh.positions);
    let mut painter = Painter::of_model(&mesh, &map, &settings()).unwrap();
    let shown = painter.paint(&camera, (96, 72), 0.0).unwrap();
    let layer = &document.dry[0].paint;
    let mm = |quanta: u32| mm_from_quanta(quanta, document.cell_mm);
    let mut covered = 0;
    let mut off = 0.0_f64;
    for (index, height) in shown.height_mm.values().iter().enumerate() {
        let cell = layer.cell(index);
        let paint = mm(cell.pigments[SLOT]);
        let vehicle = mm(cell.vehicle);
        assert!((0..SLOTS).all(|slot| slot == SLOT || cell.pigments[slot] == 0));
        assert!((vehicle - paint / 1.5).abs() < 1e-3 * paint + 2e-3, "{paint} {vehicle}");
        if shown.color.values()[index][3] == 0.0 {
            assert_eq!((paint, vehicle), (0.0, 0.0), "no paint beyond the model");
            continue;
        }
        // Heights are bytes, of which a few lumps and pits are cut.
        off += (paint - 0.5 * f64::from(*height)).abs();
        covered += 1;
    }
    let mean = off / f64::from(covered);
    assert!(covered > 1000 && mean < 0.004, "{covered} {mean}");
}

#[test]
fn totals_of_a_painting_are_those_of_sums_in_double_precision() {
    let map = painted_map();
    let mesh = Mesh::torus_knot(4000);
    let camera = Framing::default().fit(&mesh.positions);
    let mut painter = Painter::of_model(&mesh, &map, &settings()).unwrap();
    let (depth, splats) = painter.splats(&camera, (96, 72), 0.0).unwrap();
    let overlap = &painter.settings().overlap;
    let divide = painter.divide(0);
    let paint = painter.paint_tones().unwrap().unwrap();
    let sums = amounts(&depth, &splats[0], &divide, paint, overlap);
    let wanted: f64 = sums.values().iter().map(|amounts| f64::from(amounts[SLOT])).sum();
    let document = painting(&map, &settings()).unwrap();
    let quanta: f64 = document.dry[0].paint.totals()[SLOT] as f64;
    let found = quanta * mm_from_quanta(1, document.cell_mm);
    assert!(wanted > 1.0 && (found / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
}

#[test]
fn paintings_do_not_depend_on_threads() {
    let map = painted_map();
    let with = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| painting(&map, &settings()).unwrap())
    };
    assert!(with(1) == with(3));
}

#[test]
fn colours_of_maps_without_pigments_are_refused() {
    let error = painting(&map(2), &settings()).unwrap_err();
    assert!(matches!(error, PainterError::NoPaint), "{error}");
}

#[test]
fn colours_of_the_model_are_mixed_of_a_palette_that_suits_them_layer_by_layer() {
    let text = "colour.from = \"model\"\nlayers.count = 2\nlayers.detail = 0.6";
    let of_model = Settings::default().changed("test", text).unwrap();
    // A map without pigments has the oils.
    let document = painting(&map(2), &of_model).unwrap();
    let [lower, upper] = &document.dry[..] else { panic!("{} layers", document.dry.len()) };
    let names: Vec<&str> =
        lower.slots.iter().flatten().map(|&id| &document.library[id].name[..]).collect();
    // The knot is blue.
    assert!(
        names.iter().any(|name| ["Ultramarine", "Cobalt Blue", "Prussian Blue"].contains(name)),
        "{names:?}"
    );
    let [below, above] = [lower, upper].map(|layer| layer.paint.totals().iter().sum::<u64>());
    assert!(above > 0 && above < below, "{above} over {below}");
    // Ten pixels of the reference to 3 mm, in a picture of a tenth of its size.
    assert!((document.cell_mm / 3.125 - 1.0).abs() < 1e-6, "{}", document.cell_mm);
}

#[test]
fn maps_of_different_libraries_paint_pictures_but_not_with_their_pigments() {
    let first = painted_map();
    let mut second = painted_map();
    let mut other = PigmentLibrary::van_gogh_oils();
    other.title = "another".into();
    second.paint.as_mut().unwrap().library = Arc::new(other);
    let area = RegionArea::Material("fruit".to_owned());
    let region = Region { map: Some("b".to_owned()), ..Region::new("fruit", area) };
    let regions = Regions { list: vec![region], ..Regions::default() };
    let brushwork = Brushwork { maps: vec![("a", &first), ("b", &second)], regions };
    let mesh = Mesh::still_life(3000);
    let camera = Framing::default().fit(&mesh.positions);
    let mut painter = Painter::of_model_with(&mesh, &brushwork, &[], &settings()).unwrap();
    assert!(painter.paint(&camera, (40, 30), 0.0).is_ok());
    let ground = GroundKind::Panel.spec(1);
    let error = painter.painting(&camera, (40, 30), 0.0, ("a", &ground)).unwrap_err();
    assert!(matches!(error, PainterError::Maps(_)), "{error}");
}
