//! The pipeline of all effects: its stages, their observer, and CPU against GPU.

use graphics::compute::Compute;
use graphics::field::Field;
use suite::adapter::device;
use suite::near::assert_near;
use watercolor::{
    Controls, FrameTextures, Preset, Settings, Stage, StageObserver, Textures, Wash, paint,
};

use super::{any_grey, any_picture, numbers, without_effects};

/// The picture after each stage.
type Stages = Vec<(Stage, Field<[f32; 4]>)>;

fn painted(
    compute: &mut Compute,
    wash: &Wash,
    settings: &Settings,
    observed: bool,
) -> (Field<[f32; 4]>, Stages) {
    let textures = Textures::of_photograph(&wash.color, settings).unwrap();
    let textures = textures.upload(compute).unwrap();
    let wash = wash.upload(compute).unwrap();
    let mut stages = Vec::new();
    let mut keep = |stage, color| stages.push((stage, color));
    let observer: Option<StageObserver<'_>> = if observed { Some(&mut keep) } else { None };
    let textures = FrameTextures::from(&textures);
    let color = paint(compute, wash, textures, settings, observer).unwrap();
    (compute.download(&color).unwrap(), stages)
}

fn wash(width: usize, height: usize) -> Wash {
    let controls = Controls {
        dry_brush: Some(any_grey(width, height, 31)),
        density: Some(any_grey(width, height, 32)),
    };
    Wash { color: any_picture(width, height, 33), controls }
}

#[test]
fn without_effects_the_picture_stays() {
    let settings = without_effects(Settings::default().for_size(48, 40));
    for color in [[0.3, 0.6, 0.9, 1.0], [0.0, 0.0, 0.0, 1.0], [1.0; 4], [0.123_456_7; 4]] {
        let mut color = color;
        color[3] = 1.0;
        let field = Field::filled(48, 40, color);
        let plain = Wash { color: field.clone(), controls: Controls::default() };
        let (found, stages) = painted(&mut Compute::cpu(), &plain, &settings, true);
        assert_eq!(found, field);
        assert_eq!(stages.len(), Stage::ALL.len());
        for (stage, picture) in stages {
            assert_eq!(picture, field, "{stage:?}");
        }
        let Some(mut gpu) = device().map(Compute::gpu) else { continue };
        let (found, stages) = painted(&mut gpu, &plain, &settings, true);
        assert_eq!(found, field, "on the device");
        stages.iter().for_each(|(stage, picture)| assert_eq!(*picture, field, "{stage:?}"));
    }
}

#[test]
fn an_observer_changes_nothing_and_every_stage_does_something() {
    let wash = wash(90, 70);
    for preset in Preset::ALL {
        let mut settings = preset.settings().for_size(90, 70);
        settings.wobble.amount_px = 1.0;
        settings.dry_brush.amount = 0.3;
        settings.dry_brush.patches = 0.0;
        settings.dry_brush.outline_px = 0.0;
        settings.back_runs.strength = 1.0;
        settings.back_runs.share = 1.0;
        let (alone, none) = painted(&mut Compute::cpu(), &wash, &settings, false);
        let (observed, stages) = painted(&mut Compute::cpu(), &wash, &settings, true);
        assert!(none.is_empty());
        assert_eq!(alone, observed, "{preset:?}");
        let order: Vec<Stage> = stages.iter().map(|(stage, _)| *stage).collect();
        assert_eq!(order, Stage::ALL);
        for pair in stages.windows(2) {
            assert_ne!(pair[0].1, pair[1].1, "{preset:?}: {:?}", pair[1].0);
        }
        assert_eq!(stages.last().unwrap().1, observed);
    }
}

#[test]
fn processor_and_device_paint_the_same() {
    let Some(mut gpu) = device().map(Compute::gpu) else { return };
    let wash = wash(130, 90);
    for preset in Preset::ALL {
        let mut settings = preset.settings().for_size(900, 600);
        settings.dry_brush.color = Some("#808080".to_owned());
        for observed in [false, true] {
            let (here, before) = painted(&mut Compute::cpu(), &wash, &settings, observed);
            let (there, after) = painted(&mut gpu, &wash, &settings, observed);
            // Displacement and a narrow band of the dry brush enlarge rounding errors.
            assert_near(format!("{preset:?}"), &numbers(&there), &numbers(&here), 5e-4);
            for ((stage, here), (_, there)) in before.iter().zip(&after) {
                let case = format!("{preset:?}, {stage:?}");
                assert_near(case, &numbers(there), &numbers(here), 5e-4);
            }
        }
    }
}
