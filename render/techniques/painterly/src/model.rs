//! Meshes as subjects.

use std::sync::Arc;

use super::coloring::{Coloring, SubjectKind};
use super::painter::{Brushwork, PainterError};
use super::places::{Detail, Directions, NORMAL_ROUNDS, Subject, Surface, colors};
use super::regions::RegionMap;
use super::settings::{Settings, ToneSource};
use glam::Vec3;
use graphics::mesh::{DirectionField, DirectionSettings, Guide, Mesh};
use graphics::surface::PackedMesh;

/// If a model fills this share of the longer side of a picture, strokes have the size of the
/// settings. It is the height of a 4 : 3 picture less a margin.
const FILLED: f32 = 0.69;

/// We keep strokes up to this many times the density that we need if a model fills the picture.
const MORE: f32 = 2.0;

/// With default settings, smaller strokes show where a surface bends by more than this within half
/// a stroke, in radians.
const BEND: f32 = 0.6;

/// The mesh as a painter takes it, with guides for its strokes.
pub(super) fn subject(
    mesh: &Mesh,
    brushwork: &Brushwork<'_>,
    guides: &[Guide],
    settings: &Settings,
) -> Result<Subject, PainterError> {
    let regions = RegionMap::of_mesh(&brushwork.regions, mesh, &brushwork.names(), settings)?;
    let lines = DirectionSettings {
        along: settings.strokes.along.into(),
        normal_rounds: NORMAL_ROUNDS,
        smoothing: f64::from(settings.strokes.smoothing),
    };
    let field = DirectionField::of_curvature(mesh, &lines, guides)?;
    let directions = Arc::new(Directions::new(mesh, field, None));
    let rounds = settings.light.smoothing_rounds as usize;
    let lit = Arc::new(Mesh { normals: mesh.smoothed_normals(rounds), ..mesh.clone() });
    let packed = Arc::new(PackedMesh::new(&lit));
    let colors = colors(mesh, &packed);
    let maps = brushwork.art_maps();
    let coloring = Coloring::new(&maps, &colors, &settings.color, SubjectKind::Model);
    let lightness = (settings.light.tone == ToneSource::Color).then_some([0.0, 100.0]);
    let regions = Arc::new(regions);
    let units = 2.0 * radius(mesh) / FILLED;
    let surfaces = (0..settings.layers.count).map(|layer: u32| {
        let detail = match layer.checked_sub(1) {
            None => Detail::Everywhere,
            Some(below) => {
                let below = settings.of_layer(below);
                let [_, length_px] = below.strokes.radii_px();
                let length = length_px * units / below.reference_px;
                Detail::Bends(length / BEND, settings.layers.clone())
            }
        };
        Surface {
            mesh: Arc::clone(&lit),
            packed: Arc::clone(&packed),
            directions: Arc::clone(&directions),
            detail,
            regions: Arc::clone(&regions),
        }
    });
    Ok(Subject {
        surfaces: surfaces.collect(),
        packed: Arc::clone(&packed),
        closed: mesh.closed_parts(),
        coloring: Arc::new(coloring),
        lightness,
        units,
        more: MORE,
    })
}

/// Radius of the sphere around the middle of the bounding box that holds all vertices.
fn radius(mesh: &Mesh) -> f32 {
    let [low, high] = mesh.bounds();
    let middle = (low + high) / 2.0;
    let squares = mesh.positions.iter().map(|&at| Vec3::from(at).distance_squared(middle));
    squares.fold(0.0, f32::max).sqrt().max(f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod painting_tests {
    use artmap::map::ArtMap;
    use std::sync::Arc;

    use artmap::sample::{PaintOfSamples, TexelPaint};
    use graphics::camera::Framing;
    use graphics::field::Field;
    use graphics::mesh::SampleModel;
    use paint::amount::mm_from_quanta;
    use paint::document::Document;
    use paint::ground::GroundKind;
    use paint::layer::SLOTS;
    use pigment::{PigmentId, PigmentLibrary};
    use rayon::ThreadPoolBuilder;

    use super::super::painter::Painter;
    use super::super::passes::amounts;
    use super::super::regions::{Region, RegionArea, Regions};
    use super::super::test_scenes::map;
    use super::*;

    /// Slot of the pigment of the map.
    const SLOT: usize = 3;

    /// A map with paint half as high as its relief, with a third as much vehicle.
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
        fn mm(quanta: u32, document: &Document) -> f64 {
            mm_from_quanta(quanta, document.cell_mm)
        }
        let mut covered = 0;
        let mut off = 0.0_f64;
        for (index, height) in shown.height_mm.values().iter().enumerate() {
            let cell = layer.cell(index);
            let paint = mm(cell.pigments[SLOT], &document);
            let vehicle = mm(cell.vehicle, &document);
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
        fn with(threads: usize, map: &ArtMap) -> Document {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| painting(map, &settings()).unwrap())
        }
        assert!(with(1, &map) == with(3, &map));
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
        let mesh = SampleModel::StillLife.mesh(3000);
        let camera = Framing::default().fit(&mesh.positions);
        let mut painter = Painter::of_model_with(&mesh, &brushwork, &[], &settings()).unwrap();
        assert!(painter.paint(&camera, (40, 30), 0.0).is_ok());
        let ground = GroundKind::Panel.spec(1);
        let error = painter.painting(&camera, (40, 30), 0.0, ("a", &ground)).unwrap_err();
        assert!(matches!(error, PainterError::Maps(_)), "{error}");
    }
}

#[cfg(test)]
mod baseline_tests {
    //! Popping of brushwork that ignores the model, compared with ours.

    use graphics::mesh::SampleModel;
    use graphics::tile::Rect;

    use super::super::painter::Painter;
    use super::super::settings::Offsets;
    use super::super::test_scenes::map;
    use super::tests::{TURNED, front, lit_with_the_model, popping_of};
    use super::*;

    /// Popping over `degrees` of a turn: of our strokes, of brushwork that stands still on the screen
    /// while the model turns under it (a shower door), and of strokes thrown anew for each frame.
    fn figures(mesh: &Mesh, degrees: f32, steps: usize) -> [f64; 3] {
        let mut settings = lit_with_the_model();
        // One tone: shading stays on the model whatever strokes do.
        (settings.light.darkest, settings.light.lightest) = (0.5, 0.5);
        let map = map(3);
        let mut painter = Painter::of_model(mesh, &map, &settings).unwrap();
        let ours = popping_of(mesh, degrees, steps, |camera, _| {
            painter.paint(camera, TURNED, 0.0).unwrap().color
        });
        let screen = front(&Settings::default(), TURNED.0);
        let screen = screen.part(Rect { x: 0, y: 0, width: TURNED.0, height: TURNED.1 });
        let fixed = popping_of(mesh, degrees, steps, |_, _| screen.clone());
        let random = popping_of(mesh, degrees, steps, |camera, number| {
            let mut settings = settings.clone();
            settings.strokes.seed = 100 + number as u64;
            settings.overlap.offsets = Offsets::Random;
            let mut painter = Painter::of_model(mesh, &map, &settings).unwrap();
            painter.paint(camera, TURNED, 0.0).unwrap().color
        });
        [ours, fixed, random]
    }

    #[test]
    fn strokes_pop_far_less_than_a_texture_of_the_screen_and_than_random_ones() {
        // Over 6 degrees a texture that stands still loses the model as much as random strokes do.
        for (shape, degrees, steps, least) in [
            (SampleModel::Sphere, 1.5, 1, 1.05),
            (SampleModel::TorusKnot, 1.5, 1, 1.05),
            (SampleModel::TorusKnot, 6.0, 2, 0.95),
        ] {
            let [ours, fixed, random] = figures(&shape.mesh(8000), degrees, steps);
            let what = format!("{} {degrees}: {ours:.3}, {fixed:.3}, {random:.3}", shape.name());
            assert!((fixed - 1.0).abs() < 1e-9, "{what}");
            assert!(random > least, "{what}");
            assert!(ours < 0.35 && ours < 0.3 * random, "{what}");
        }
    }
}

#[cfg(test)]
mod strange_tests {
    //! Meshes as they come from other programs: damaged, degenerate, or very large.
    //!
    //! With the environment variable `IMPASTO_PAINTERLY` the large mesh has 10 million triangles.

    use documents::hint::Explain;
    use graphics::camera::{Camera, Framing};
    use graphics::mesh::{GridSize, Material, SampleModel, Triangle};

    use super::super::painter::Painter;
    use super::super::passes::PaintedPicture;
    use super::super::test_scenes::map;
    use super::tests::flat;
    use super::*;

    const SIZE: (usize, usize) = (120, 90);

    fn painter(mesh: &Mesh) -> Result<Painter, PainterError> {
        let mut settings = Settings::default();
        // About 3 pixels in a picture of this size.
        settings.strokes.width_px = 25.0;
        Painter::of_model(mesh, &map(2), &settings)
    }

    fn camera(mesh: &Mesh) -> Camera {
        Framing { aspect: 4.0 / 3.0, ..Framing::default() }.fit(&mesh.positions)
    }

    /// Paints a mesh and checks that every number of the picture is finite. Returns the number of
    /// pixels that show the mesh, and how many of them strokes cover.
    fn covered(mesh: &Mesh, camera: &Camera) -> [usize; 2] {
        let mut painter = painter(mesh).unwrap();
        let (depth, _) = painter.splats(camera, SIZE, 0.0).unwrap();
        let PaintedPicture { color, height_mm } = painter.paint(camera, SIZE, 0.0).unwrap();
        assert!(color.values().iter().flatten().all(|value| (0.0..=1.0).contains(value)));
        assert!(height_mm.values().iter().all(|height| height.is_finite()));
        let seen: Vec<bool> = depth.values().iter().map(|depth| *depth < 1.0).collect();
        let pixels = color.values().iter().zip(&seen);
        let painted = pixels.filter(|(pixel, seen)| **seen && pixel[3] > 0.5).count();
        [seen.iter().filter(|seen| **seen).count(), painted]
    }

    /// Strokes cover what shows of a mesh, but for one pixel in 100.
    fn assert_covered(mesh: &Mesh, camera: &Camera, least: usize) {
        let [seen, painted] = covered(mesh, camera);
        assert!(seen >= least && painted * 100 >= seen * 99, "{painted} of {seen}");
    }

    /// The flat square as a grid of this number of columns and rows.
    fn square(columns: usize, rows: usize) -> Mesh {
        let mut mesh = Mesh { materials: vec![Material::plain([0.8; 3])], ..Mesh::default() };
        mesh.add_grid(GridSize { columns, rows }, 0, |at| {
            Vec3::new(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0)
        });
        mesh
    }

    #[test]
    fn needles_and_triangles_without_area_are_painted_over() {
        let mut needles = square(3000, 1);
        let [seen, _] = covered(&needles, &camera(&needles));
        // Corners on a line, and three times the same corner.
        let added = [[0, 1, 2], [0, 1500, 3000], [7, 7, 7]];
        needles.triangles.extend(added.map(|corners| Triangle { corners, material: 0 }));
        assert_covered(&needles, &camera(&needles), seen);
        let mut one = square(1, 1);
        one.triangles.truncate(1);
        assert_covered(&one, &camera(&one), 1000);
    }

    #[test]
    fn numbers_that_are_none_are_refused_with_their_vertex() {
        type Spoil = fn(&mut Mesh);
        let spoilt: [(Spoil, &str); 5] = [
            (|mesh| mesh.positions[5][1] = f32::NAN, "vertex 5 has the position"),
            (|mesh| mesh.positions[9][0] = f32::INFINITY, "vertex 9 has the position"),
            (|mesh| mesh.normals[3][2] = f32::NAN, "vertex 3 has the normal"),
            (|mesh| mesh.normals.clear(), "0 normals for 625 vertices"),
            (|mesh| mesh.triangles[2].corners[0] = 700, "triangle 2 has vertex 700, of 625"),
        ];
        for (spoil, message) in spoilt {
            let mut mesh = flat();
            spoil(&mut mesh);
            let error = painter(&mesh).unwrap_err();
            assert!(error.to_string().starts_with(message), "{error}");
            assert!(error.hint().is_some(), "{error}");
        }
    }

    #[test]
    fn normals_of_no_length_or_all_alike_do_not_leave_holes() {
        let ball = Mesh::sphere(3000);
        for normal in [[0.0; 3], [0.0, 1.0, 0.0], [1e-30; 3], [1e30; 3]] {
            let mut mesh = ball.clone();
            mesh.normals.iter_mut().for_each(|own| *own = normal);
            assert_covered(&mesh, &camera(&mesh), 2000);
        }
    }

    #[test]
    fn sheets_that_share_an_edge_and_meshes_that_are_open_are_painted() {
        // Three pages at one spine, one of them wound the other way round.
        let page = square(12, 12);
        let mut book = Mesh { materials: page.materials.clone(), ..Mesh::default() };
        for (turn, flipped) in [(0.3_f32, false), (1.5, true), (2.6, false)] {
            let first = book.positions.len() as u32;
            book.positions.extend(
                page.positions
                    .iter()
                    .copied()
                    .map(|[x, y, _]: [f32; 3]| [(x + 1.0) * turn.cos(), y, (x + 1.0) * turn.sin()]),
            );
            let side = if flipped { 1.0 } else { -1.0 };
            let normal = [side * turn.sin(), 0.0, -side * turn.cos()];
            book.normals.extend(page.normals.iter().map(|_| normal));
            book.texture_coordinates.extend(&page.texture_coordinates);
            book.colors.extend(&page.colors);
            book.triangles.extend(page.triangles.iter().map(|triangle| {
                let [a, b, c] = triangle.corners.map(|corner| corner + first);
                Triangle { corners: if flipped { [a, c, b] } else { [a, b, c] }, material: 0 }
            }));
        }
        assert_covered(&book, &camera(&book), 500);
        let mut torn = Mesh::torus_knot(4000);
        let mut number = 0;
        torn.triangles.retain(|_| {
            number += 1;
            number % 7 != 0
        });
        assert_covered(&torn, &camera(&torn), 500);
    }

    #[test]
    fn a_ball_that_bends_alike_in_all_directions_has_strokes_everywhere() {
        for triangles in [100, 20_000] {
            let ball = Mesh::sphere(triangles);
            assert_covered(&ball, &camera(&ball), 800);
            let inside = Camera { eye: Vec3::ZERO, target: Vec3::X, near: 0.01, ..camera(&ball) };
            assert_covered(&ball, &inside, SIZE.0 * SIZE.1);
        }
        // Faces of a ball of six triangles are so steep that planes of splats miss some of their pixels.
        let coarse = Mesh::sphere(6);
        let [seen, painted] = covered(&coarse, &camera(&coarse));
        assert!(seen > 2000 && painted * 100 > seen * 95, "{painted} of {seen}");
    }

    #[test]
    fn the_size_of_a_model_and_its_place_do_not_matter() {
        for (scale, away) in [(1e-6, 0.0), (1e6, 0.0), (1e-3, 1.0), (1.0, 300.0)] {
            let mut mesh = Mesh::torus_knot(3000);
            mesh.positions.iter_mut().flatten().for_each(|at| *at = *at * scale + away);
            assert_covered(&mesh, &camera(&mesh), 1000);
        }
    }

    #[test]
    fn a_large_mesh_is_painted() {
        let whole = std::env::var_os("IMPASTO_PAINTERLY").is_some();
        let triangles = if whole { 10_000_000 } else { 100_000 };
        let mesh = SampleModel::TorusKnot.mesh(triangles);
        assert!(mesh.triangles.len() > triangles * 9 / 10);
        assert_covered(&mesh, &camera(&mesh), 1000);
    }

    #[test]
    fn cameras_around_a_model_see_it_from_outside() {
        for shape in [SampleModel::TorusKnot, SampleModel::StillLife] {
            let mesh = shape.mesh(3000);
            let painter = Painter::of_model(&mesh, &map(1), &Settings::default()).unwrap();
            let framing = Framing::default();
            for camera in framing.fit_turntable(&mesh.positions, 24) {
                assert!(!painter.holds(&camera), "{}: {camera:?}", shape.name());
            }
            let camera = framing.fit(&mesh.positions);
            let near = Camera { near: (camera.eye - camera.target).length(), ..camera };
            assert!(painter.holds(&near), "the near plane cuts it");
            let inside =
                Camera { eye: camera.target + 0.01 * (camera.eye - camera.target), ..camera };
            assert!(painter.holds(&inside), "the eye is inside");
        }
    }
}

#[cfg(test)]
mod device_tests {
    //! Models on a device against those on the processor.

    use graphics::camera::Framing;
    use graphics::compute::Compute;

    use super::super::painter::Painter;
    use super::super::passes::painted;
    use super::super::settings::{ColorSource, ColorSpace};
    use super::super::test_scenes::map;
    use super::super::test_scenes::{device, differences};
    use super::super::tones::ToneMemory;
    use super::*;

    #[test]
    fn a_device_paints_models_as_the_processor_does() {
        let Some(mut gpu) = device() else { return };
        let mesh = Mesh::torus_knot(4000);
        let size = (161, 119);
        let camera = Framing { aspect: 4.0 / 3.0, ..Framing::default() }.fit(&mesh.positions);
        for (from, space, line_px) in [
            (ColorSource::Model, ColorSpace::Cielab, 0.0),
            (ColorSource::Model, ColorSpace::Yuv, 30.0),
            (ColorSource::Map, ColorSpace::Cielab, 30.0),
        ] {
            let mut settings = Settings::default();
            (settings.color.from, settings.color.space) = (from, space);
            settings.silhouette.width_px = line_px;
            settings.strokes.width_px = 30.0;
            settings.layers.count = 2;
            let mut painter = Painter::of_model(&mesh, &map(3), &settings).unwrap();
            let (depth, layers) = painter.splats(&camera, size, 0.0).unwrap();
            for (number, splats) in layers.iter().enumerate() {
                let divide = painter.divide(number);
                let on = [&mut Compute::cpu(), &mut gpu];
                let [own, others] = on.map(|compute: &mut Compute| {
                    let memory = ToneMemory::new(compute, divide.tones, divide.coloring).unwrap();
                    let depth = compute.upload(&depth).unwrap();
                    let seen = (&depth, splats.as_slice());
                    painted(compute, seen, &divide, &memory, &settings.overlap).unwrap()
                });
                let ([cover, color, height], compared) = differences(&own, &others);
                let what =
                    format!("{from:?} {space:?} {number}: {cover} {color} {height}, {compared}");
                assert!(cover <= 1.0 / 255.0 && color <= 1.0 / 255.0, "{what}");
                assert!(height <= 2.0 * divide.tones.step[3] && compared > 500, "{what}");
            }
        }
    }
}
