//! Pictures of paintings, made from eight wavelengths, against exact spectra of the same amounts.

use std::sync::Arc;

use artmap::map::ArtMap;
use artmap::sample::{PaintOfSamples, TexelPaint};
use graphics::camera::Framing;
use graphics::field::Field;
use graphics::mesh::Mesh;
use paint::document::{Document, Lighting};
use paint::ground::GroundKind;
use paint::layer::SLOTS;
use paint::light::Light;
use paint::palette::palette_slots;
use paint::scene::{SpectralDocument, picture, scene};
use pigment::PigmentLibrary;
use spectra::color::{Adaptation, Lab, RgbSpace, delta_e_ciede2000};

use super::made_up::map;
use super::painter::Painter;
use super::settings::Settings;

/// The made-up map in paint: each tone another mixture of ochre, blue and white, in furrows with
/// more blue than on ridges.
fn painted_map() -> ArtMap {
    let mut map = map(4);
    let library = PigmentLibrary::van_gogh_oils();
    let names = ["Lead White", "Chrome Yellow", "Ultramarine", "Vermilion", "Viridian"];
    let slots = palette_slots(&names.map(str::to_owned), &library).unwrap();
    for (tone, key) in map.keys.iter_mut().enumerate() {
        let heights = key.tile.height_mm.as_ref().unwrap();
        let texels = heights
            .values()
            .iter()
            .map(|mm: &f32| {
                let share = (mm / 0.2).clamp(0.0, 1.0);
                let tone = tone as f32 / 3.0;
                let mut pigments_mm = [0.0; SLOTS];
                let parts = [0.1 + tone, share, 0.3 * (1.0 - share), 0.4 - 0.3 * tone, 0.2 * tone];
                pigments_mm.iter_mut().zip(parts).for_each(|(own, part)| *own = part * (0.01 + mm));
                TexelPaint { pigments_mm, vehicle_mm: 0.01 }
            })
            .collect();
        key.tile.paint = Some(Field::from_values(heights.width(), heights.height(), texels));
    }
    map.paint = Some(PaintOfSamples { library: Arc::new(library), slots });
    map.mm_per_texel = Some(0.25);
    map
}

/// CIEDE2000 of the picture of a document without relief against its exact spectra, by cell.
fn differences(document: &Document) -> Vec<f64> {
    let light = Light::named(&document.library, "D65", "1931-2").unwrap();
    let seen = picture(document, &scene(document, &light));
    let spectral = SpectralDocument::full(document);
    let weights = light.viewing.weights(document.library.grid).unwrap();
    let lab = |rgb: [f64; 3]| {
        let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb);
        Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white())
    };
    let cell = |index: usize| {
        let x = index % seen.width();
        let y = index / seen.width();
        let xyz = weights.xyz(&spectral.measured_reflectance(x, y));
        let white = light.quadrature.rule.white;
        let exact = RgbSpace::Srgb.linear_from_xyz(xyz, white, Adaptation::Bradford).0;
        let [r, g, b, _] = seen[(x, y)].map(f64::from);
        delta_e_ciede2000(lab(exact), lab([r, g, b]))
    };
    (0..seen.values().len()).map(cell).collect()
}

#[test]
fn pictures_of_paintings_are_those_of_exact_spectra() {
    let mesh = Mesh::torus_knot(4000);
    let camera = Framing::default().fit(&mesh.positions);
    let settings = Settings::default().changed("test", "colour.from = \"map\"").unwrap();
    let mut painter = Painter::of_model(&mesh, &painted_map(), &settings).unwrap();
    let ground = GroundKind::Panel.spec(1);
    let document = painter.painting(&camera, (96, 72), 0.0, ("knot", &ground)).unwrap();
    let level = Lighting { relief: 0.0, ..Lighting::default() };
    let document = Document { lighting: level, ..document };
    let differences = differences(&document);
    let layer = &document.dry[0].paint;
    let painted: Vec<f64> = differences
        .iter()
        .enumerate()
        .filter(|(index, _)| layer.cell(*index).volume() > 0)
        .map(|(_, difference)| *difference)
        .collect();
    let mean = painted.iter().sum::<f64>() / painted.len() as f64;
    let most = painted.iter().fold(0.0_f64, |most, off| most.max(*off));
    assert!(painted.len() > 1000 && mean <= 0.3, "{mean} over {} cells", painted.len());
    assert!(most > 0.0, "nothing was compared");
}
