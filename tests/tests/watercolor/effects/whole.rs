//! All effects together.

use render::field::Field;
use render::watercolor::{Controls, OnCpu, OnGpu, Preset, Settings, Stage, Textures, Wash, paint};
use suite::adapter::device;
use suite::near::assert_near;

use super::{any_grey, any_picture, numbers};

/// Pictures on their way.
type Stages = Vec<(Stage, Field<[f32; 4]>)>;

fn painted<B: render::watercolor::Watercolor>(
    backend: &mut B,
    wash: &Wash,
    settings: &Settings,
    watched: bool,
) -> (Field<[f32; 4]>, Stages) {
    let textures = Textures::new(wash.color.width(), wash.color.height(), settings).unwrap();
    let on = textures.on(backend).unwrap();
    let wash = wash.on(backend).unwrap();
    let mut stages = Vec::new();
    let mut keep = |backend: &mut B, stage, color: &B::Color| {
        stages.push((stage, backend.color_field(color)?));
        Ok(())
    };
    let watcher: Option<render::watercolor::Watcher<'_, B>> =
        if watched { Some(&mut keep) } else { None };
    let painted = paint(backend, wash, &on.flow, &on.dispersion, &on.paper, settings, watcher);
    let painted = painted.unwrap();
    (backend.color_field(&painted).unwrap(), stages)
}

fn wash(width: usize, height: usize) -> Wash {
    let controls = Controls {
        dry_brush: Some(any_grey(width, height, 31)),
        density: Some(any_grey(width, height, 32)),
    };
    Wash { color: any_picture(width, height, 33), controls }
}

#[test]
fn without_effects_what_comes_in_goes_out() {
    let settings = Settings::default().for_size(48, 40).without_effects();
    for color in [[0.3, 0.6, 0.9, 1.0], [0.0, 0.0, 0.0, 1.0], [1.0; 4], [0.123_456_7; 4]] {
        let mut color = color;
        color[3] = 1.0;
        let field = Field::filled(48, 40, color);
        let plain = Wash { color: field.clone(), controls: Controls::default() };
        let (found, stages) = painted(&mut OnCpu, &plain, &settings, true);
        assert_eq!(found, field);
        assert_eq!(stages.len(), Stage::ALL.len());
        for (stage, picture) in stages {
            assert_eq!(picture, field, "{stage:?}");
        }
        let Some(mut gpu) = device().map(OnGpu::new) else { continue };
        let (found, stages) = painted(&mut gpu, &plain, &settings, true);
        assert_eq!(found, field, "on the device");
        stages.iter().for_each(|(stage, picture)| assert_eq!(*picture, field, "{stage:?}"));
    }
}

#[test]
fn nobody_changes_the_picture_by_looking_and_every_stage_does_something() {
    let wash = wash(90, 70);
    for preset in Preset::ALL {
        let mut settings = preset.settings().for_size(90, 70);
        settings.wobble.amount_px = 1.0;
        settings.dry_brush.amount = 0.3;
        settings.dry_brush.patches = 0.0;
        let (alone, none) = painted(&mut OnCpu, &wash, &settings, false);
        let (watched, stages) = painted(&mut OnCpu, &wash, &settings, true);
        assert!(none.is_empty());
        assert_eq!(alone, watched, "{preset:?}");
        let order: Vec<Stage> = stages.iter().map(|(stage, _)| *stage).collect();
        assert_eq!(order, Stage::ALL);
        for pair in stages.windows(2) {
            assert_ne!(pair[0].1, pair[1].1, "{preset:?}: {:?}", pair[1].0);
        }
        assert_eq!(stages.last().unwrap().1, watched);
    }
}

#[test]
fn both_backends_paint_the_same() {
    let Some(mut gpu) = device().map(OnGpu::new) else { return };
    let wash = wash(130, 90);
    for preset in Preset::ALL {
        let mut settings = preset.settings().for_size(900, 600);
        settings.dry_brush.color = Some("#808080".to_owned());
        for watched in [false, true] {
            let (here, before) = painted(&mut OnCpu, &wash, &settings, watched);
            let (there, after) = painted(&mut gpu, &wash, &settings, watched);
            // Displacing, then a narrow band of the dry brush: what rounds grows.
            assert_near(format!("{preset:?}"), &numbers(&there), &numbers(&here), 5e-4);
            for ((stage, here), (_, there)) in before.iter().zip(&after) {
                let case = format!("{preset:?}, {stage:?}");
                assert_near(case, &numbers(there), &numbers(here), 5e-4);
            }
        }
    }
}
