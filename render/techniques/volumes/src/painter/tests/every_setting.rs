//! Every setting does something: to the volumes of a world, to a picture, or to a film.

use super::*;
use crate::script::Script;

/// Settings of forces and cells, each other than usual.
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

/// Settings of the regions that a script does not describe itself.
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
