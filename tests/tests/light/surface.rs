//! Shading of relief and gloss.

use calibrate::evaluate::Viewing;
use render::light::Light;
use render::optics::{Gloss, Scene};
use render::paint::document::Lighting;
use render::paint::ground::GroundSpec;
use render::paint::scene::{picture, scene};
use render::shade::{RowHeights, TopMaterial, shade_row};

use TopMaterial::{Dry, Ground, Wet};

use crate::made_up::{CELL_MM, document, glazes_over_mixtures, lay};

/// Linear green of a grey cell whose surface rises by `slopes` along x and y, in cells per cell.
fn lit(scene: &Scene, slopes: (f32, f32), material: TopMaterial) -> f32 {
    let quanta = |cells: f32| (cells * (1 << 21) as f32) as i32;
    let (x, y) = (quanta(slopes.0), quanta(slopes.1));
    let mut out = [[0.0; 4]];
    let heights = RowHeights { above: &[0, -y, 0], here: &[-x, 0, x], below: &[0, y, 0] };
    shade_row(scene, &heights, &[[0.5; 8]], &[material], &mut out);
    assert_eq!(out[0][3], 1.0, "alpha");
    out[0][1]
}

fn studio(lighting: Lighting) -> Scene {
    let document = render::paint::document::Document { lighting, ..document(1, 1, &[]) };
    scene(&document, &Light::new(&document.library, &Viewing::default()).unwrap())
}

#[test]
fn a_level_surface_shows_what_was_measured() {
    let flat = studio(Lighting { relief: 0.0, ..Lighting::default() });
    let measured = lit(&flat, (0.0, 0.0), Wet);
    for elevation_deg in [5.0, 50.0, 90.0] {
        for ambient in [0.0, 0.5, 1.0] {
            let mut scene = studio(Lighting { elevation_deg, ambient, ..Lighting::default() });
            scene.lamp.ground = Gloss { strength: 3.0, exponent: 8.0 };
            for material in [Wet, Dry, Ground] {
                let found = lit(&scene, (0.0, 0.0), material);
                let off = (found - measured).abs();
                assert!(off < 1e-6, "{elevation_deg} {ambient} {material:?}");
            }
        }
    }
    // A whole picture of paint of even height on a level ground.
    let mut level = document(4, 4, &["Vermilion"]);
    for cell in (0..4).flat_map(|y| (0..4).map(move |x| (x, y))) {
        lay(&mut level.wet, cell, &[0.1]);
    }
    let light = Light::new(&level.library, &Viewing::default()).unwrap();
    let without = picture(&level, &scene(&level, &light));
    level.lighting = Lighting::default();
    let with = picture(&level, &scene(&level, &light));
    for (with, without) in with.values().iter().zip(without.values()) {
        for channel in 0..3 {
            assert!((with[channel] - without[channel]).abs() < 1e-6, "{with:?} {without:?}");
        }
    }
}

#[test]
fn slopes_towards_the_lamp_are_lighter_and_away_darker() {
    // The lamp is at the upper left: a surface that rises to the right or downwards faces it.
    let scene = studio(Lighting::default());
    let level = lit(&scene, (0.0, 0.0), Ground);
    assert!(lit(&scene, (0.2, 0.0), Ground) > level * 1.02);
    assert!(lit(&scene, (0.0, 0.2), Ground) > level * 1.02);
    assert!(lit(&scene, (-0.2, 0.0), Ground) < level * 0.98);
    assert!(lit(&scene, (0.0, -0.2), Ground) < level * 0.98);
    // Half of the light is ambient; the other half follows Lambert's law, relative to level paint.
    let [x, y, z] = scene.lamp.direction;
    let (a, b) = (0.3f32, -0.1f32);
    let lambert = (z - a * x - b * y) / (1.0 + a * a + b * b).sqrt() / z;
    let found = lit(&scene, (a, b), Ground) / level;
    assert!((found - (0.5 + 0.5 * lambert)).abs() < 1e-5, "{found} {lambert}");
    // With ambient light only, slopes do not show.
    let soft = studio(Lighting { ambient: 1.0, ..Lighting::default() });
    assert!((lit(&soft, (0.2, 0.1), Wet) - level).abs() < 1e-6);
    // A slope that faces away from the lamp receives the ambient light only.
    let steep = lit(&scene, (-5.0, -5.0), Ground) / level;
    assert!((steep - 0.5).abs() < 1e-5, "{steep}");
}

#[test]
fn gloss_is_that_of_what_lies_on_top_and_brightest_at_the_mirror_angle() {
    let mut scene = studio(Lighting { ambient: 0.0, ..Lighting::default() });
    scene.lamp.wet = Gloss { strength: 0.5, exponent: 60.0 };
    scene.lamp.dry = Gloss { strength: 0.25, exponent: 60.0 };
    scene.lamp.ground = Gloss { strength: 0.0, exponent: 60.0 };
    let [x, y, z] = scene.lamp.direction;
    // Slopes -h_x / h_z and -h_y / h_z: the normal is the halfway vector h of lamp and viewer.
    let mirror = (-x / (z + 1.0), -y / (z + 1.0));
    let [wet, dry, ground] = [Wet, Dry, Ground].map(|material| lit(&scene, mirror, material));
    let veil = (1.0 - ((1.0 + z) / (2.0 + 2.0 * z).sqrt()).powf(60.0)) as f64;
    assert!((f64::from(wet - ground) - 0.5 * veil).abs() < 1e-4, "{wet} {ground} {veil}");
    assert!((f64::from(dry - ground) - 0.25 * veil).abs() < 1e-4, "{dry} {ground} {veil}");
    for off in [0.8, 1.2] {
        let slopes = (mirror.0 * off, mirror.1 * off);
        assert!(lit(&scene, slopes, Wet) - lit(&scene, slopes, Ground) < wet - ground, "{off}");
    }
    let away = (-mirror.0, -mirror.1);
    assert_eq!(lit(&scene, away, Wet), lit(&scene, away, Ground), "no gloss away from the lamp");
}

#[test]
fn a_row_may_be_cut_anywhere() {
    let mut document = glazes_over_mixtures();
    document.lighting = Lighting::default();
    let linen = GroundSpec::default().build(48, 48, CELL_MM, &document.library).unwrap();
    document.ground.height = linen.height;
    let light = Light::new(&document.library, &Viewing::default()).unwrap();
    let scene = scene(&document, &light);
    let whole = picture(&document, &scene);
    let (y, width) = (20, 48);
    for first in [0, 1, 13, 40] {
        for count in [1, 7, 8] {
            let mut internal = vec![scene.ground; count];
            for (layer, coat) in
                [(&document.dry[0].paint, &scene.dry[0]), (&document.wet, &scene.wet)]
            {
                let cells = layer.pigments.row(y, first, count);
                render::composite::composite_row(coat, cells, &mut internal);
            }
            let top = |x: usize, y: usize| {
                let index = y * width + x.clamp(1, width) - 1;
                let paint =
                    document.dry[0].paint.cell(index).volume() + document.wet.cell(index).volume();
                document.ground.height.values()[index] + paint as i32
            };
            let row = |y: usize| (first..first + count + 2).map(|x| top(x, y)).collect::<Vec<_>>();
            let (above, here, below) = (row(y - 1), row(y), row(y + 1));
            let materials: Vec<TopMaterial> = (first..first + count)
                .map(|x| {
                    match (
                        document.wet.cell(y * width + x).volume(),
                        document.dry[0].paint.cell(y * width + x).volume(),
                    ) {
                        (0, 0) => Ground,
                        (0, _) => Dry,
                        _ => Wet,
                    }
                })
                .collect();
            let mut out = vec![[0.0; 4]; count];
            let heights = RowHeights { above: &above, here: &here, below: &below };
            shade_row(&scene, &heights, &internal, &materials, &mut out);
            assert_eq!(out, whole.row(y, first, count), "{first} {count}");
        }
    }
}
