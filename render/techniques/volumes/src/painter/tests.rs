//! Pictures and paintings of scenes with their volumes, also of bodies that lie on one another.

use std::sync::Arc;

use glam::Vec3;
use graphics::camera::{Camera, Framing};
use graphics::compute::Compute;
use graphics::encoding::encoded_from_linear;
use graphics::field::Field;
use graphics::mesh::{Mesh, SampleModel};
use graphics::surface::{Model, NO_TRIANGLE, PackedMesh, SurfacePoint, VisibilityBuffer, visible};
use paint::document::{Document, Lighting, palette_slots};
use paint::ground::GroundKind;
use paint::light::Light;
use paint::scene::{picture, scene};
use pigment::PigmentLibrary;

use super::*;
use crate::containing::Inside;
use crate::drawing::shade;
use crate::hatching::{Hatching, ThresholdTexture};
use crate::motion::KeepIn;
use crate::script::RegionStyle;
use crate::settings::{self, Inside as BodiesTestsInside, Settings};
use crate::test_volumes;
use crate::test_volumes::{joined, sheet};
use crate::world::{Pour, Recipe, Single, World, WorldSettings};

mod acceptance;

const SIZE: (usize, usize) = (150, 114);

struct Scene {
    mesh: Mesh,
    camera: Camera,
    settings: Settings,
    styles: Vec<RegionStyle>,
}

impl Scene {
    fn new(mesh: Mesh, framing: Framing) -> Self {
        let aspect = SIZE.0 as f32 / SIZE.1 as f32;
        let camera = Framing { aspect, ..framing }.fit(&mesh.positions);
        let mut settings = Settings::default();
        settings.picture.samples = 1;
        settings.picture.paper = "#dfe7f1".to_owned();
        Self { mesh, camera, settings, styles: vec![style(&[1.0], &[0.0, 1.0])] }
    }

    fn still_life() -> Self {
        Self::new(SampleModel::StillLife.mesh(6000), Framing::default())
    }

    fn painter(&self) -> VolumePainter {
        VolumePainter::new(&self.mesh, &self.settings, &self.styles).unwrap()
    }

    fn world(&self) -> World {
        World::of(&self.mesh, &WorldSettings::from(&self.settings)).unwrap()
    }

    fn painted(&self, world: &World) -> Field<[f32; 4]> {
        self.painter().paint(world, &self.camera, SIZE).unwrap()
    }

    fn seen(&self) -> VisibilityBuffer {
        visible(&self.mesh, &self.camera, SIZE.0, SIZE.1)
    }

    fn place(&self, packed: &PackedMesh, seen: &VisibilityBuffer, pixel: usize) -> Option<Vec3> {
        let fragment = seen.values()[pixel];
        (fragment.triangle != NO_TRIANGLE).then(|| SurfacePoint::new(packed, fragment).position())
    }

    /// The plain colour picture without paper. Its fourth value is the grey.
    fn plain(&self) -> Field<[f32; 4]> {
        let mut compute = Compute::cpu();
        let packed = PackedMesh::new(&self.mesh);
        let texture = ThresholdTexture::new(u64::from(self.settings.seed));
        let hatching = Hatching::new(&mut compute, &texture, &packed).unwrap();
        let mut model = Model::new(&mut compute, packed).unwrap();
        let visible = model.visible(&mut compute, &self.camera, SIZE.0, SIZE.1).unwrap();
        let look = in_sight::drawing_look(&self.settings);
        shade(&mut compute, &model, &visible, &self.camera, &look, &hatching).unwrap().into_host()
    }

    /// A world with paint in two places that you see.
    fn poured(&self) -> World {
        let seen = self.seen();
        let packed = PackedMesh::new(&self.mesh);
        let mut world = self.world();
        let shown = (0..SIZE.0 * SIZE.1).filter_map(|pixel| self.place(&packed, &seen, pixel));
        let shown: Vec<Vec3> = shown.collect();
        for (slot, place) in [shown[shown.len() / 4], shown[shown.len() / 2]].iter().enumerate() {
            world.pour(Pour::at(*place, 60.0, 1.0, Recipe::of_slot(slot))).unwrap();
        }
        (0..240).for_each(|_| world.step().unwrap());
        world
    }
}

fn style(shells: &[f32], tints: &[f32]) -> RegionStyle {
    let inside = settings::Inside::OwnColors;
    let shells = shells.to_vec();
    let tints = tints.to_vec();
    RegionStyle { name: String::new(), inside, shells, tints, stain: "#ffffff".to_owned() }
}

fn single(center: Vec3, radius: f32, region: u16) -> Single {
    Single { center, radius, detail: 3, recipe: None, region }
}

fn is_grey([r, g, b, _]: [f32; 4]) -> bool {
    r == g && g == b
}

fn bits(picture: &Field<[f32; 4]>) -> Vec<[u32; 4]> {
    picture.values().iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

#[test]
fn without_volumes_all_is_the_grey_of_the_colour_picture() {
    let scene = Scene::still_life();
    let painted = scene.painted(&scene.world());
    let plain = scene.plain();
    let seen = scene.seen();
    fn linear(value: f32) -> f64 {
        match f64::from(value) {
            value if value <= 0.040_45 => value / 12.92,
            value => ((value + 0.055) / 1.055).powf(2.4),
        }
    }
    let mut colorful = 0;
    for (pixel, found) in painted.values().iter().enumerate() {
        let [r, g, b, grey] = plain.values()[pixel];
        if seen.values()[pixel].triangle == NO_TRIANGLE {
            let paper = [0xdf, 0xe7, 0xf1].map(|value: u8| f32::from(value) / 255.0);
            assert_eq!(*found, [paper[0], paper[1], paper[2], 1.0]);
            continue;
        }
        assert_eq!(*found, [grey, grey, grey, 1.0]);
        // The grey is as light as the colour: its luminance, encoded again.
        let y = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        assert!((linear(grey) - y).abs() < 1.0 / 255.0, "{grey} of {r} {g} {b}");
        colorful += usize::from((r - b).abs() > 0.1);
    }
    assert!(colorful > 1000, "{colorful}");
}

#[test]
fn a_volume_round_everything_shows_the_colour_picture() {
    let scene = Scene::still_life();
    let mut world = scene.world();
    let [low, high] = scene.mesh.bounds();
    let radius = 2.0 * (high - low).length();
    world.add_volume(&single((low + high) / 2.0, radius, 0)).unwrap();
    let painted = scene.painted(&world);
    let plain = scene.plain();
    let seen = scene.seen();
    for (pixel, found) in painted.values().iter().enumerate() {
        if seen.values()[pixel].triangle != NO_TRIANGLE {
            let [r, g, b, _] = plain.values()[pixel];
            assert_eq!(*found, [r, g, b, 1.0]);
        }
    }
}

#[test]
fn colour_is_shown_where_a_volume_holds_the_surface() {
    let scene = Scene::still_life();
    let mut world = scene.world();
    let [low, high] = scene.mesh.bounds();
    let radius = 0.3 * (high - low).max_element();
    let index = world.add_volume(&single((low + high) / 2.0, radius, 0)).unwrap();
    (0..20).for_each(|_| world.step().unwrap());
    let inside = Inside::of(&world.volumes()[index]);
    let painted = scene.painted(&world);
    let plain = scene.plain();
    let seen = scene.seen();
    let packed = PackedMesh::new(&scene.mesh);
    let mut all = 0;
    let mut held = 0;
    let mut wrong = 0;
    for (pixel, found) in painted.values().iter().enumerate() {
        let Some(place) = scene.place(&packed, &seen, pixel) else { continue };
        let [r, g, b, grey] = plain.values()[pixel];
        let holds = inside.holds(place);
        let expected = if holds { [r, g, b, 1.0] } else { [grey, grey, grey, 1.0] };
        all += 1;
        held += usize::from(holds);
        wrong += usize::from(*found != expected);
    }
    assert!(held > all / 10 && held < all / 2, "{held} of {all}");
    // We round vertices to the 256th of a pixel.
    assert!(wrong * 500 <= all, "{wrong} of {all}");
}

#[test]
fn regions_are_laid_one_over_the_other() {
    let mut scene = Scene::still_life();
    scene.styles = vec![style(&[1.0], &[0.0, 0.3]), style(&[1.0, 0.5], &[0.0, 0.25, 0.6])];
    let mut world = scene.world();
    let [low, high] = scene.mesh.bounds();
    let radius = 2.0 * (high - low).length();
    for region in [1, 0] {
        world.add_volume(&single((low + high) / 2.0, radius, region)).unwrap();
    }
    let painted = scene.painted(&world);
    let plain = scene.plain();
    let seen = scene.seen();
    for (pixel, found) in painted.values().iter().enumerate() {
        if seen.values()[pixel].triangle == NO_TRIANGLE {
            continue;
        }
        let [r, g, b, grey] = plain.values()[pixel];
        fn laid(under: f32, color: f32, tint: f32) -> f32 {
            under * (1.0 - tint) + color * tint
        }
        let [r, g, b] = [r, g, b].map(|color| laid(laid(grey, color, 0.3), color, 0.6));
        assert_eq!(*found, [r, g, b, 1.0]);
    }
    scene.styles.pop();
    let refused = scene.painter().paint(&world, &scene.camera, SIZE).unwrap_err();
    assert!(matches!(refused, PaintingError::Region { region: 1, regions: 1 }), "{refused}");
}

/// A wall nearly a cell thick: two plates of 12 by 12 cells, and the side between them.
fn plates() -> Mesh {
    fn part(normal: [f32; 3], at: fn(f32, f32) -> [f32; 3]) -> Mesh {
        let mut mesh = sheet(12, |u, v| at(12.0 * u - 6.0, 12.0 * v - 6.0));
        mesh.normals.fill(normal);
        mesh
    }
    let top = part([0.0, 1.0, 0.0], |x, z| [x, 0.0, z]);
    let below = part([0.0, -1.0, 0.0], |x, z| [x, -0.9, z]);
    joined(joined(top, &below), &part([-1.0, 0.0, 0.0], |x, z| [-6.0, (x + 6.0) / 12.0 * -0.9, z]))
}

#[test]
fn paint_on_one_side_of_a_wall_does_not_show_on_the_other() {
    fn colored(elevation_deg: f32, gate: f32) -> usize {
        let framing = Framing { elevation_deg, ..Framing::default() };
        let mut scene = Scene::new(plates(), framing);
        scene.mesh.colors.fill([0.8, 0.2, 0.1]);
        scene.settings.unit_mm = 1.0;
        scene.settings.drawing.gate = gate;
        let mut world = scene.world();
        let pour = Pour::at(Vec3::new(0.3, 0.0, 0.2), 1.0, 1.0, Recipe::of_slot(0));
        world.pour(pour).unwrap();
        (0..300).for_each(|_| world.step().unwrap());
        let picture = scene.painted(&world);
        let seen = scene.seen();
        let pixels = picture.values().iter().zip(seen.values());
        let shown = pixels.filter(|(_, seen)| seen.triangle != NO_TRIANGLE);
        shown.filter(|(pixel, _)| !is_grey(**pixel)).count()
    }
    assert_eq!(colored(-40.0, -0.2), 0, "from below");
    assert!(colored(40.0, -0.2) > 200, "from above");
    assert!(colored(-40.0, -1.0) > 20, "from below without a gate");
}

#[test]
fn a_gate_leaves_single_volumes_as_they_are() {
    let mut scene = Scene::still_life();
    let mut world = scene.world();
    let [low, high] = scene.mesh.bounds();
    world.add_volume(&single((low + high) / 2.0, 0.3 * (high - low).length(), 0)).unwrap();
    let open = scene.painted(&world);
    scene.settings.drawing.gate = 1.0;
    assert_eq!(bits(&scene.painted(&world)), bits(&open));
    let bare = scene.painted(&scene.world());
    let held = open.values().iter().zip(bare.values()).filter(|(a, b)| a != b).count();
    assert!(held > 1000, "{held}");
}

#[test]
fn no_colour_shows_beyond_a_region_to_stay_in() {
    let scene = Scene::still_life();
    let [low, high] = scene.mesh.bounds();
    let mut world = scene.world();
    let middle = (low + high) / 2.0;
    let seen = scene.seen();
    let packed = PackedMesh::new(&scene.mesh);
    let wall = KeepIn::Above { point: middle, normal: Vec3::X };
    world.keep(wall).unwrap();
    let shown = (0..SIZE.0 * SIZE.1).filter_map(|pixel| scene.place(&packed, &seen, pixel));
    let place = shown
        .filter(|at: &Vec3| {
            at.y.abs() < 1e-3 && (0.1..0.2).contains(&((at.x - middle.x) / (high.x - low.x)))
        })
        .nth(10)
        .unwrap();
    world.pour(Pour::at(place, 400.0, 1.0, Recipe::of_slot(0))).unwrap();
    (0..420).for_each(|_| world.step().unwrap());
    let painted = scene.painted(&world);
    let plain = scene.plain();
    let mut held = 0;
    let mut at_wall = 0;
    for (pixel, found) in painted.values().iter().enumerate() {
        let Some(place) = scene.place(&packed, &seen, pixel) else { continue };
        let [r, g, b, _] = plain.values()[pixel];
        if !is_grey([r, g, b, 1.0]) && *found == [r, g, b, 1.0] {
            assert!(place.x > middle.x - 1e-3, "{place}");
            held += 1;
            at_wall += usize::from(place.x < middle.x + 0.05 * (high.x - low.x));
        }
    }
    assert!(held > 300 && at_wall > 30, "{held} {at_wall}");
}

#[test]
fn a_picture_does_not_depend_on_the_pictures_before() {
    let scene = Scene::still_life();
    let empty = scene.world();
    let full = scene.poured();
    let mut painter = scene.painter();
    let mut paint = |world, size| bits(&painter.paint(world, &scene.camera, size).unwrap());
    let first = paint(&full, SIZE);
    let small = paint(&full, (40, 31));
    assert_eq!(paint(&empty, SIZE), bits(&scene.painted(&empty)));
    assert_eq!((paint(&full, SIZE), paint(&full, (40, 31))), (first, small));
}

#[test]
fn a_device_paints_what_the_processor_paints() {
    let Some(device) = test_volumes::device() else { return };
    let mut scene = Scene::new(plates(), Framing::default());
    scene.mesh.colors.fill([0.8, 0.2, 0.1]);
    scene.settings.unit_mm = 1.0;
    scene.styles = vec![style(&[1.0, 0.8], &[0.0, 0.5, 1.0])];
    let mut world = scene.world();
    for (x, z) in [(0.3, 0.2), (-4.0, 2.0), (3.5, -3.0)] {
        let pour = Pour::at(Vec3::new(x, 0.0, z), 0.4, 1.0, Recipe::of_slot(0));
        world.pour(pour).unwrap();
    }
    world.add_volume(&single(Vec3::new(-2.0, 0.0, -3.0), 1.5, 0)).unwrap();
    (0..180).for_each(|_| world.step().unwrap());
    let mut on_device = scene.painter().on(device).unwrap();
    for elevation_deg in [25.0, -25.0] {
        let framing = Framing { elevation_deg, aspect: 150.0 / 114.0, ..Framing::default() };
        scene.camera = framing.fit(&scene.mesh.positions);
        let found = on_device.paint(&world, &scene.camera, SIZE).unwrap();
        let on_cpu = scene.painted(&world);
        let seen = scene.seen();
        let held = |picture: &Field<[f32; 4]>, pixel: usize| {
            let [r, _, b, _] = picture.values()[pixel];
            seen.values()[pixel].triangle != NO_TRIANGLE && r - b > 0.02
        };
        let mut wet = 0;
        let mut differ = 0;
        for pixel in 0..SIZE.0 * SIZE.1 {
            let own = held(&on_cpu, pixel);
            wet += usize::from(own);
            if held(&found, pixel) != own {
                differ += 1;
                let x = pixel % SIZE.0;
                let y = pixel / SIZE.0;
                let lines = y.saturating_sub(1)..(y + 2).min(SIZE.1);
                let mut near = lines.flat_map(|y| {
                    (x.saturating_sub(1)..(x + 2).min(SIZE.0)).map(move |x| y * SIZE.0 + x)
                });
                assert!(near.any(|near| held(&on_cpu, near) != own), "{x} {y}");
            }
        }
        assert!(differ * 500 <= SIZE.0 * SIZE.1, "{elevation_deg}: {differ}");
        match elevation_deg > 0.0 {
            true => assert!(wet > 300, "{wet}"),
            // The single volume alone reaches through.
            false => assert!(wet > 20, "{wet}"),
        }
    }
}

fn pigments() -> VolumePigments {
    let library = Arc::new(PigmentLibrary::van_gogh_oils());
    let names = ["Ultramarine", "Chrome Yellow"].map(str::to_owned);
    VolumePigments {
        slots: palette_slots(&names, &library).unwrap(),
        library,
        own_colors: None,
        ground: GroundKind::Panel.spec(1),
        lighting: Lighting { relief: 0.0, ..Lighting::default() },
    }
}

fn shown(document: &Document) -> Field<[f32; 4]> {
    let Lighting { illuminant, observer, .. } = &document.lighting;
    let light = Light::named(&document.library, illuminant, observer).unwrap();
    encoded_from_linear(&picture(document, &scene(document, &light)))
}

#[test]
fn a_painting_is_the_picture_also_after_its_file() {
    let mut scene = Scene::still_life();
    scene.styles[0].inside = settings::Inside::Glaze;
    let missing = scene.painter().painting(&scene.world(), &scene.camera, SIZE, "").unwrap_err();
    assert!(matches!(missing, PaintingError::NoPigments));
    let mut painter = scene.painter().with_pigments(pigments()).unwrap();
    let world = scene.poured();
    let painted = painter.paint(&world, &scene.camera, SIZE).unwrap();
    let document = painter.painting(&world, &scene.camera, SIZE, "A jug").unwrap();
    let bytes = paint::file::write(&document).unwrap();
    let read = paint::file::read("test.exr", &bytes).unwrap();
    assert_eq!((read.title.as_str(), read.dry.len()), ("A jug", 3));
    fn most(a: &Field<[f32; 4]>, b: &Field<[f32; 4]>) -> f32 {
        let pairs = a.values().iter().flatten().zip(b.values().iter().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    }
    assert!(most(&painted, &shown(&read)) <= 0.0002);
    let bare = painter.paint(&scene.world(), &scene.camera, SIZE).unwrap();
    let glazed = painted.values().iter().zip(bare.values()).filter(|(a, b)| a != b).count();
    assert!(glazed > 300, "{glazed}");
}

/// Counts red and blue pixels after you pour paint beside a red ball on a blue sheet. The ball is
/// sunk into the sheet by this much.
fn red_and_blue(sunk: f32) -> [usize; 2] {
    // The ball is smaller than a cell, so that volumes on the sheet reach above its middle.
    let mut ball = Mesh::sphere(2000);
    ball.positions.iter_mut().flatten().for_each(|along| *along *= 0.4);
    let floor = sheet(20, |u, v| [6.0 * (u - 0.5), sunk - 0.4, 6.0 * (v - 0.5)]);
    let mut mesh = joined(floor, &ball);
    let sheet_corners = 21 * 21;
    mesh.colors[..sheet_corners].fill([0.0, 0.0, 1.0]);
    mesh.colors[sheet_corners..].fill([1.0, 0.0, 0.0]);
    let mut world = World::of(&mesh, &WorldSettings::default()).unwrap();
    // 60 mm^3 fill eleven of 144 cells of the sheet.
    let place = Vec3::new(0.4, sunk - 0.4, 0.4);
    world.pour(Pour::at(place, 60.0, 1.0, Recipe::of_slot(0))).unwrap();
    (0..360).for_each(|_| world.step().unwrap());
    let style = RegionStyle {
        name: String::new(),
        inside: BodiesTestsInside::OwnColors,
        shells: vec![1.0],
        tints: vec![0.0, 1.0],
        stain: "#ffffff".to_owned(),
    };
    let mut painter = VolumePainter::new(&mesh, &Settings::default(), &[style]).unwrap();
    let framing = Framing { aspect: 1.25, ..Framing::default() };
    let picture = painter.paint(&world, &framing.fit(&mesh.positions), (150, 120)).unwrap();
    [(0, 2), (2, 0)].map(|(one, other): (usize, usize)| {
        picture.values().iter().filter(|color| color[one] > color[other] + 0.1).count()
    })
}

#[test]
fn paint_does_not_climb_from_a_cloth_onto_what_lies_on_it() {
    for sunk in [0.0, 0.012, 0.04] {
        let [red, blue] = red_and_blue(sunk);
        assert!(red == 0 && blue > 300, "{sunk}: {red} {blue}");
    }
    // A dome rises from the sheet at right angles.
    let [red, blue] = red_and_blue(0.4);
    assert!(red > 5 && blue > 100, "{red} {blue}");
}
