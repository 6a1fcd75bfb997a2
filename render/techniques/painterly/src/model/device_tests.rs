//! Models on a device against those on the processor.

use graphics::camera::Framing;
use graphics::compute::Compute;

use super::super::device_tones::ToneMemory;
use super::super::made_up::map;
use super::super::passes::painted;
use super::super::settings::{ColorSource, ColorSpace};
use super::super::test_device::{device, differences};
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
            let paint = |compute: &mut Compute| {
                let memory = ToneMemory::new(compute, divide.tones, divide.coloring).unwrap();
                let depth = compute.upload(&depth).unwrap();
                let seen = (&depth, splats.as_slice());
                painted(compute, seen, &divide, &memory, &settings.overlap).unwrap()
            };
            let [own, others] = [paint(&mut Compute::cpu()), paint(&mut gpu)];
            let ([cover, color, height], compared) = differences(&own, &others);
            let what = format!("{from:?} {space:?} {number}: {cover} {color} {height}, {compared}");
            assert!(cover <= 1.0 / 255.0 && color <= 1.0 / 255.0, "{what}");
            assert!(height <= 2.0 * divide.tones.step[3] && compared > 500, "{what}");
        }
    }
}
