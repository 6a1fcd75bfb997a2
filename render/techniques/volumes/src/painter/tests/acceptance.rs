//! Tests pictures of whole worlds. For example, they must not depend on the order of volumes, on
//! threads or on how the mesh is cut into triangles, and a full grid must colour all that you see.
//! Also checks that every setting does something: to the volumes of a world, to a picture, or to a
//! film.

use super::*;
use crate::script::Script;

fn steps(world: &mut World, count: usize) {
    (0..count).for_each(|_| world.step().unwrap());
}

#[test]
fn pictures_do_not_depend_on_the_number_of_threads() {
    let mut scene = Scene::still_life();
    scene.settings.picture.samples = 2;
    scene.styles = vec![style(&[1.0, 0.9, 0.8], &[0.0, 0.4, 0.7, 1.0])];
    let world = scene.poured();
    let [one, two, eight] = [1, 2, 8].map(|threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bits(&scene.painted(&world)))
    });
    assert!(one == two && one == eight);
}

#[test]
fn pictures_do_not_depend_on_the_order_of_volumes() {
    let mut scene = Scene::still_life();
    scene.styles = vec![style(&[1.0, 0.8], &[0.0, 0.5, 1.0]), style(&[1.0], &[0.0, 0.6])];
    // Kicks differ with the number of a volume.
    scene.settings.motion.kick = 0.0;
    let [low, high] = scene.mesh.bounds();
    let side = (high - low).max_element();
    let painted = |order: &[usize]| {
        let mut world = scene.world();
        for &i in order {
            let [x, y, z, wide] = [7, 11, 3, 9].map(|by: usize| (i * by % 25) as f32 / 25.0);
            let center = low + (high - low) * Vec3::new(x, y, z);
            let own = single(center, side * (0.06 + 0.1 * wide), (i % 2) as u16);
            world.add_volume(&own).unwrap();
        }
        steps(&mut world, 30);
        bits(&scene.painted(&world))
    };
    let mut order: Vec<usize> = (0..24).collect();
    let one = painted(&order);
    order.rotate_left(7);
    order.swap(1, 12);
    assert!(painted(&order) == one);
    order.reverse();
    assert!(painted(&order) == one);
    assert!(painted(&order[1..]) != one);
}

#[test]
fn a_full_grid_colours_all_that_is_seen() {
    for shape in SampleModel::ALL {
        let mut scene = Scene::new(shape.mesh(6000), Framing::default());
        scene.settings.grid.cell = 0.125;
        let mut world = scene.world();
        for cell in 0..world.grid().cells.len() {
            let samples = &world.grid().samples;
            let place = samples.places[samples.of_cell(cell).start];
            let capacity = f64::from(world.grid().cells.capacities[cell]);
            let rate = 120.0 * capacity * world.quantum_mm3();
            world.pour(Pour::at(place, rate, 1.0 / 120.0, Recipe::of_slot(0))).unwrap();
        }
        steps(&mut world, 300);
        for azimuth_deg in [30.0, 210.0] {
            let aspect = SIZE.0 as f32 / SIZE.1 as f32;
            let framing = Framing { azimuth_deg, aspect, ..Framing::default() };
            scene.camera = framing.fit(&scene.mesh.positions);
            let plain = scene.plain();
            let seen = scene.seen();
            let bare = [-1.0, -0.2].map(|gate: f32| {
                scene.settings.drawing.gate = gate;
                let painted = scene.painted(&world);
                let pixels = painted.values().iter().zip(plain.values()).zip(seen.values());
                let shown = pixels.filter(|(_, seen)| seen.triangle != NO_TRIANGLE);
                shown.filter(|((found, plain), _)| found[..3] != plain[..3]).count()
            });
            assert_eq!(bare, [0, 0], "{} from {azimuth_deg}", shape.name());
        }
    }
}

/// Draws the masks of a plane of 2 triangles and of the same plane of 20,000 triangles. Returns the
/// number of pixels in which they differ, of pixels inside of volumes, and of all pixels.
fn differing(act: impl Fn(&mut World)) -> [usize; 3] {
    let scenes = [1, 100].map(|squares| {
        let mesh = sheet(squares, |u, v| [12.0 * u - 6.0, 0.0, 12.0 * v - 6.0]);
        let mut scene = Scene::new(mesh, Framing { elevation_deg: 50.0, ..Framing::default() });
        scene.settings.unit_mm = 1.0;
        scene.settings.motion.fastest = 3.0;
        scene
    });
    let size = (750, 570);
    let masks = scenes.each_ref().map(|scene| {
        let mut world = scene.world();
        act(&mut world);
        steps(&mut world, 240);
        scene.painter().shown(&world, &scenes[0].camera, size, Show::Mask).unwrap()
    });
    let pairs = masks[0].values().iter().zip(masks[1].values());
    let differ = pairs.filter(|(few, many)| few != many).count();
    let inside = masks[0].values().iter().filter(|mask| mask[0] > 0.5).count();
    [differ, inside, size.0 * size.1]
}

#[test]
fn masks_do_not_depend_on_the_cut_into_triangles() {
    let [differ, inside, all] = differing(|world| {
        for (x, z) in [(-3.0, -2.0), (0.4, 1.0), (2.0, -3.1)] {
            world.add_volume(&single(Vec3::new(x, 0.2, z), 1.5, 0)).unwrap();
        }
    });
    assert!(inside > 20_000 && differ * 2000 <= all, "{differ} of {inside}");
    // Where you pour paint the radii come from other samples of the surface.
    let [differ, inside, all] = differing(|world| {
        let pour = Pour::at(Vec3::new(0.5, 0.0, 0.5), 0.8, 1.0, Recipe::of_slot(0));
        world.pour(pour).unwrap();
    });
    assert!(inside > 40_000 && differ * 200 <= all, "{differ} of {inside}");
}

#[test]
fn films_lie_on_the_surface_of_each_world() {
    let mut scene = Scene::still_life();
    scene.styles[0].inside = settings::Inside::Glaze;
    let [low, high] = scene.mesh.bounds();
    let [mut used, mut other] =
        [(); 2].map(|()| scene.painter().with_pigments(pigments()).unwrap());
    let mut world = scene.poured();
    let paint = |painter: &mut VolumePainter, world: &World| {
        bits(&painter.paint(world, &scene.camera, SIZE).unwrap())
    };
    let whole = paint(&mut used, &world);
    world.keep(KeepIn::Above { point: (low + high) / 2.0, normal: Vec3::X }).unwrap();
    steps(&mut world, 30);
    let kept = paint(&mut used, &world);
    assert!(kept != whole && kept == paint(&mut other, &world));
}

#[test]
fn films_of_single_volumes_lie_on_all_that_they_hold() {
    let framing = Framing { elevation_deg: -40.0, ..Framing::default() };
    let mut scene = Scene::new(plates(), framing);
    scene.settings.unit_mm = 1.0;
    scene.styles[0].inside = settings::Inside::Glaze;
    let mut painter = scene.painter().with_pigments(pigments()).unwrap();
    // We pour more on the upper plate than on the lower one, and see only the lower one.
    let [painted, bare] = [Some(Recipe::of_slot(0)), None].map(|recipe| {
        let mut world = scene.world();
        let own = Single { recipe, ..single(Vec3::new(0.0, 0.3, 0.0), 2.0, 0) };
        world.add_volume(&own).unwrap();
        steps(&mut world, 30);
        painter.paint(&world, &scene.camera, SIZE).unwrap()
    });
    let differ = painted.values().iter().zip(bare.values()).filter(|(a, b)| a != b).count();
    assert!(differ > 100, "{differ}");
}

#[test]
fn regions_count_their_own_volumes_alone() {
    let mut scene = Scene::still_life();
    scene.styles = vec![style(&[1.0], &[0.0, 0.3]), style(&[1.0], &[0.0, 1.0])];
    let [low, high] = scene.mesh.bounds();
    let mut world = scene.world();
    world.add_volume(&single((low + high) / 2.0, 2.0 * (high - low).length(), 0)).unwrap();
    let painted = scene.painted(&world);
    let plain = scene.plain();
    let seen = scene.seen();
    for (pixel, found) in painted.values().iter().enumerate() {
        if seen.values()[pixel].triangle != NO_TRIANGLE {
            let [r, g, b, grey] = plain.values()[pixel];
            let [r, g, b] = [r, g, b].map(|color| grey * (1.0 - 0.3) + color * 0.3);
            assert_eq!(*found, [r, g, b, 1.0]);
        }
    }
}

#[test]
fn where_a_device_knows_no_gates_the_processor_counts() {
    let Some(device) = test_volumes::device() else { return };
    let mut scene = Scene::new(plates(), Framing::default());
    scene.mesh.colors.fill([0.8, 0.2, 0.1]);
    scene.settings.unit_mm = 1.0;
    let mut world = scene.world();
    world.pour(Pour::at(Vec3::new(0.3, 0.0, 0.2), 1.0, 1.0, Recipe::of_slot(0))).unwrap();
    steps(&mut world, 300);
    assert!(!scene.painter().counts_elsewhere());
    let mut painter = scene.painter().on(device).unwrap();
    let mut colored = |elevation_deg: f32, gates: bool| {
        let framing = Framing { elevation_deg, aspect: 150.0 / 114.0, ..Framing::default() };
        painter.drawer.scene.gates &= gates;
        assert!(gates || painter.counts_elsewhere());
        let camera = framing.fit(&scene.mesh.positions);
        let picture = painter.paint(&world, &camera, SIZE).unwrap();
        picture.values().iter().filter(|[red, _, blue, _]| red - blue > 0.02).count()
    };
    let own = colored(40.0, true);
    assert_eq!(colored(-40.0, false), 0, "from below, through the wall");
    let counted = colored(40.0, false);
    assert!(own > 200 && counted.abs_diff(own) * 500 <= SIZE.0 * SIZE.1, "{own} {counted}");
}

#[test]
fn a_scene_turned_inside_out_is_painted_alike() {
    fn inside_out(faces: bool, normals: bool) -> usize {
        let mut scene = Scene::still_life();
        let mesh = &mut scene.mesh;
        if faces {
            mesh.triangles.iter_mut().for_each(|triangle| triangle.corners.swap(1, 2));
        }
        if normals {
            let along = mesh.normals.iter_mut().flatten();
            along.for_each(|along| *along = -*along);
        }
        let world = scene.poured();
        let mask = scene.painter().shown(&world, &scene.camera, SIZE, Show::Mask).unwrap();
        mask.values().iter().filter(|mask| mask[0] > 0.5).count()
    }
    let own = inside_out(false, false);
    assert!(own > 300, "{own}");
    for (faces, normals) in [(true, true), (true, false), (false, true)] {
        let found = inside_out(faces, normals);
        assert!(found.abs_diff(own) * 20 <= own, "{faces} {normals}: {found} of {own}");
    }
}

/// Settings of forces and cells. Each differs from the default.
const OF_WORLDS: [&str; 18] = [
    "unit_mm = 50.0",
    "seed = 2",
    "motion.pressure = 300.0",
    "motion.elastic = 150.0",
    "motion.cohesion = 100.0",
    "motion.friction = 20.0",
    "motion.kick = 0.5",
    "motion.microstructure = 0.1",
    "motion.grain = 0.7",
    "motion.fastest = 0.5",
    "motion.surface_pull = 10.0",
    "motion.gravity = 5.0",
    "motion.keep = 500.0",
    "grid.cell = 0.1",
    "grid.film_mm = 0.03",
    "grid.rate = 0.02",
    "grid.slope = 2.0",
    "grid.samples = 32",
];

/// Settings of light, grey and strokes, and the gate.
const OF_PICTURES: [&str; 18] = [
    "drawing.gate = 0.9",
    "hatching.inside = 0.5",
    "hatching.outside = 0.5",
    "hatching.along = \"texture\"",
    "hatching.pencil = 0.4",
    "hatching.width_px = 4.0",
    "hatching.softness = 0.05",
    "hatching.darkest = 0.4",
    "hatching.angle_deg = 80.0",
    "light.lit = false",
    "light.with = \"model\"",
    "light.azimuth_deg = 80.0",
    "light.elevation_deg = 10.0",
    "light.levels = 3",
    "light.softness = 1.0",
    "light.shade = 0.7",
    "grey.weights = \"rec601\"",
    "grey.pale = 0.5",
];

const OF_SAMPLES: [&str; 2] = ["picture.samples = 2", "picture.paper = \"#102030\""];

/// Settings for regions that a script does not describe.
const OF_REGIONS: [&str; 4] = [
    "drawing.shells = [1.0, 0.5]",
    "drawing.tint = [0.0, 0.1, 0.2, 0.9, 1.0]",
    "drawing.stain = \"#ffe0c0\"",
    "drawing.inside = \"glaze\"",
];

const OF_FILMS: [&str; 3] =
    ["drawing.film = \"through\"", "drawing.rim = 0.4", "drawing.edge = 2.0"];

const UNDER_FILMS: [&str; 2] = ["drawing.neutral = false", "drawing.under = \"none\""];

fn changed(settings: &Settings, change: &str) -> Settings {
    let changed = settings.changed("test.toml", change).unwrap();
    assert_ne!(changed, *settings, "{change}");
    changed
}

#[test]
fn every_setting_is_among_those_that_do_something() {
    let lists: [&[&str]; 6] =
        [&OF_WORLDS, &OF_PICTURES, &OF_SAMPLES, &OF_REGIONS, &OF_FILMS, &UNDER_FILMS];
    let mut listed: Vec<&str> =
        lists.concat().iter().filter_map(|change| change.split(' ').next()).collect();
    let rows = documents::settings::rows::<Settings>();
    let mut all: Vec<&str> = rows.iter().map(|(key, _)| key.as_str()).collect();
    listed.sort_unstable();
    all.sort_unstable();
    assert_eq!(listed, all);
}

#[test]
fn settings_of_forces_and_cells_change_the_volumes() {
    let mesh = SampleModel::StillLife.mesh(2000);
    let [low, high] = mesh.bounds();
    let volumes = |settings: &Settings| {
        let mut world = World::of(&mesh, &WorldSettings::from(settings)).unwrap();
        let place = world.grid().samples.places[700];
        let wall = place - Vec3::X * 0.02 * (high - low).max_element();
        world.keep(KeepIn::Above { point: wall, normal: Vec3::X }).unwrap();
        world.pour(Pour::at(place, 600.0, 0.4, Recipe::of_slot(0))).unwrap();
        (0..90).for_each(|_| world.step().unwrap());
        world.volumes().to_vec()
    };
    let usual = volumes(&Settings::default());
    assert!(usual.len() > 3 && usual == volumes(&Settings::default()), "{}", usual.len());
    for change in OF_WORLDS {
        assert!(volumes(&changed(&Settings::default(), change)) != usual, "{change}");
    }
}

#[test]
fn settings_of_light_grey_and_strokes_change_the_picture() {
    let scene = Scene::still_life();
    let world = scene.poured();
    let mut painter = scene.painter();
    let mut paint = |settings: &Settings| {
        painter.set_drawing(settings).unwrap();
        bits(&painter.paint(&world, &scene.camera, SIZE).unwrap())
    };
    let usual = paint(&scene.settings);
    for change in OF_PICTURES.iter().chain(&OF_SAMPLES) {
        assert!(paint(&changed(&scene.settings, change)) != usual, "{change}");
    }
    assert!(paint(&scene.settings) == usual);
}

#[test]
fn settings_of_regions_change_the_picture() {
    let header = "format = \"paint-volumes\"\nversion = 1\nsubject = \"shape:sphere\"\n\
                  seconds = 1.0\n";
    let script = Script::from_text("test.toml", header).unwrap();
    let mut scene = Scene::still_life();
    let world = scene.poured();
    let mut paint = |settings: &Settings| {
        scene.styles = script.region_styles(settings);
        (scene.styles.clone(), bits(&scene.painted(&world)))
    };
    let usual = paint(&Settings::default());
    for change in OF_REGIONS {
        let (styles, picture) = paint(&changed(&Settings::default(), change));
        assert!(styles != usual.0, "{change}");
        // Without pigments volumes show the colours of the scene.
        assert!(picture != usual.1 || change.contains("inside"), "{change}");
    }
}

#[test]
fn settings_of_films_change_the_picture() {
    let mut scene = Scene::still_life();
    scene.styles[0].inside = settings::Inside::Glaze;
    let world = scene.poured();
    let mut painter = scene.painter().with_pigments(pigments()).unwrap();
    let mut usual = Vec::new();
    for change in [""].iter().chain(&OF_FILMS) {
        let settings = match change.is_empty() {
            true => scene.settings.clone(),
            false => changed(&scene.settings, change),
        };
        painter.set_drawing(&settings).unwrap();
        let picture = bits(&painter.paint(&world, &scene.camera, SIZE).unwrap());
        assert!(picture != usual, "{change}");
        if change.is_empty() {
            usual = picture;
        }
    }
    let own = scene.settings.clone();
    for change in UNDER_FILMS {
        scene.settings = changed(&own, change);
        let mut painter = scene.painter().with_pigments(pigments()).unwrap();
        let picture = bits(&painter.paint(&world, &scene.camera, SIZE).unwrap());
        assert!(picture != usual, "{change}");
    }
}

#[test]
fn strokes_have_strengths_of_their_own_inside_and_outside() {
    let scene = Scene::still_life();
    let [low, high] = scene.mesh.bounds();
    let outside = scene.world();
    let mut inside = scene.world();
    let radius = 2.0 * (high - low).length();
    inside.add_volume(&single((low + high) / 2.0, radius, 0)).unwrap();
    let in_pigments = scene.painter().with_pigments(pigments()).unwrap();
    for mut painter in [scene.painter(), in_pigments] {
        let mut paint = |world: &World, settings: &Settings| {
            painter.set_drawing(settings).unwrap();
            bits(&painter.paint(world, &scene.camera, SIZE).unwrap())
        };
        for (change, of_inside) in
            [("hatching.inside = 0.3", true), ("hatching.outside = 0.3", false)]
        {
            let settings = changed(&scene.settings, change);
            for (world, is_inside) in [(&inside, true), (&outside, false)] {
                let same = paint(world, &settings) == paint(world, &scene.settings);
                assert_eq!(same, of_inside != is_inside, "{change}");
            }
        }
    }
}
