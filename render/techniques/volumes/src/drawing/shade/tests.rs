//! Tests of shading: grey, light, hatching on a turntable, and the twin on a device.

use graphics::camera::Framing;
use graphics::coherence::{NoiseFrame, Popping, Projection, depth_field};
use graphics::mesh::{Mesh, SampleModel};

use super::*;
use crate::drawing::{grey_of, reveal};
use crate::hatching::{HatchingLook, sample_texture};
use crate::test_device::{device, far};
use graphics::distant_light::DistantLight;

struct Scene {
    compute: Compute,
    model: Model,
    hatching: Hatching,
}

impl Scene {
    fn new(mut compute: Compute, mesh: &Mesh) -> Self {
        let packed = PackedMesh::new(mesh);
        let hatching = Hatching::new(&mut compute, sample_texture(), &packed).unwrap();
        let model = Model::new(&mut compute, packed).unwrap();
        Self { compute, model, hatching }
    }

    fn shade(
        &mut self,
        camera: &Camera,
        (width, height): (usize, usize),
        look: &DrawingLook,
    ) -> (Field<[f32; 4]>, VisibilityBuffer) {
        let Self { compute, model, hatching } = self;
        let visible = model.visible(compute, camera, width, height).unwrap();
        let shaded = shade(compute, model, &visible, camera, look, hatching).unwrap();
        (compute.download(&shaded).unwrap(), compute.download(&visible).unwrap())
    }
}

impl Scene {
    /// The grey picture of two by two samples a pixel.
    fn grey(
        &mut self,
        camera: &Camera,
        (width, height): (usize, usize),
        look: &DrawingLook,
    ) -> Field<[f32; 4]> {
        let look = DrawingLook { samples: 2, ..look.clone() };
        let (shaded, visible) = self.shade(camera, (2 * width, 2 * height), &look);
        let shaded = shaded.into();
        let visible = visible.into();
        let picture = reveal(&mut self.compute, &shaded, &visible, &[], None, 2).unwrap();
        picture.into_host()
    }
}

fn camera(mesh: &Mesh, aspect: f32) -> Camera {
    Framing { aspect, ..Framing::default() }.fit(&mesh.positions)
}

#[test]
fn the_fourth_value_is_the_grey_of_the_colour() {
    let mesh = SampleModel::StillLife.mesh(4000);
    let mut scene = Scene::new(Compute::cpu(), &mesh);
    for weights in [GreyWeights::Luminance, GreyWeights::Rec601] {
        let look = DrawingLook { weights, ..DrawingLook::default() };
        let (shaded, visible) = scene.shade(&camera(&mesh, 1.5), (150, 100), &look);
        let mut seen = 0;
        for (pixel, fragment) in shaded.values().iter().zip(visible.values()) {
            if fragment.triangle == NO_TRIANGLE {
                assert_eq!(*pixel, [1.0; 4]);
                continue;
            }
            seen += 1;
            let [r, g, b, grey] = *pixel;
            assert_eq!(grey_of([r, g, b], weights), grey);
        }
        assert!(seen > 4000, "{seen}");
    }
}

#[test]
fn hatching_has_its_own_strength_inside_and_outside() {
    let mesh = SampleModel::StillLife.mesh(4000);
    let mut scene = Scene::new(Compute::cpu(), &mesh);
    let camera = camera(&mesh, 1.5);
    let mut shaded = |inside, outside| {
        let hatching = HatchingLook { inside, outside, ..HatchingLook::default() };
        let look = DrawingLook { hatching, ..DrawingLook::default() };
        scene.shade(&camera, (150, 100), &look).0
    };
    let [both, only_outside, none] =
        [(1.0, 1.0), (0.0, 1.0), (0.0, 0.0)].map(|(a, b)| shaded(a, b));
    let mut darker = 0;
    for i in 0..both.values().len() {
        let [both, outside, none] = [&both, &only_outside, &none].map(|field| field.values()[i]);
        assert_eq!(outside[..3], none[..3]);
        assert_eq!(outside[3], both[3]);
        darker += usize::from(both[0] < 0.7 * none[0]);
    }
    assert!(darker > 1000, "{darker}");
}

#[test]
fn without_light_colours_stay_and_their_grey_sets_the_tone() {
    let mut mesh = Mesh::default();
    mesh.materials = vec![graphics::mesh::Material::plain([0.2, 0.6, 0.4])];
    let cells = graphics::mesh::GridSize { columns: 3, rows: 3 };
    mesh.add_grid(cells, 0, |uv| Vec3::new(uv.x, -uv.y, 0.0));
    let mut scene = Scene::new(Compute::cpu(), &mesh);
    let camera =
        Framing { azimuth_deg: 0.0, elevation_deg: 0.0, ..Framing::default() }.fit(&mesh.positions);
    let mut look = DrawingLook { lit: false, ..DrawingLook::default() };
    look.hatching.inside = 0.0;
    look.hatching.outside = 0.0;
    let (plain, _) = scene.shade(&camera, (60, 60), &look);
    assert_eq!(plain[(30, 30)][..3], [0.2, 0.6, 0.4]);
    look.hatching.inside = 1.0;
    look.hatching.darkest = 0.0;
    let (hatched, _) = scene.shade(&camera, (200, 200), &look);
    let grey = grey_of([0.2, 0.6, 0.4], GreyWeights::Luminance);
    let tone = look.tones.grey(lifted(grey));
    let mut ink = 0.0;
    let mut seen = 0.0;
    for pixel in hatched.values().iter().filter(|pixel| **pixel != [1.0; 4]) {
        ink += (1.0 - pixel[1] / 0.6) / 0.85;
        seen += 1.0;
    }
    assert!((ink / seen - (1.0 - tone)).abs() < 0.06, "{} {tone}", ink / seen);
}

#[test]
fn numbers_that_are_none_are_refused() {
    let mesh = Mesh::sphere(200);
    let Scene { mut compute, mut model, hatching } = Scene::new(Compute::cpu(), &mesh);
    let camera = camera(&mesh, 1.0);
    let visible = model.visible(&mut compute, &camera, 8, 8).unwrap();
    let look = DrawingLook { shade: f32::NAN, ..DrawingLook::default() };
    let refused = shade(&mut compute, &model, &visible, &camera, &look, &hatching);
    assert!(matches!(refused, Err(DrawingError::Setting { name: "shade", .. })));
}

/// Root mean square change of the grey at the same point of a model between frames of a turntable
/// of 60, by that of the same picture standing still.
fn popping(mesh: &Mesh, look: &DrawingLook, steps: usize) -> f64 {
    let size = (400, 300);
    let mut scene = Scene::new(Compute::cpu(), mesh);
    let framing = Framing { aspect: 4.0 / 3.0, ..Framing::default() };
    let cameras = framing.fit_turntable(&mesh.positions, 60);
    let [mut moved, mut still] = [Popping::default(); 2];
    let mut frame = |number: usize| {
        let Scene { compute, model, .. } = &mut scene;
        let visible = model.visible(compute, &cameras[number], size.0, size.1).unwrap();
        let visible = compute.download(&visible).unwrap();
        let picture = scene.grey(&cameras[number], size, look);
        let grey = picture.values().iter().map(|pixel| pixel[0]).collect();
        let projection = Projection::new(&cameras[number], size.0, size.1);
        (projection, depth_field(&visible), Field::from_values(size.0, size.1, grey))
    };
    for step in 0..steps {
        let first = step * 60 / steps;
        let [before, mut after] = [first, (first + 1) % 60].map(&mut frame);
        // Where the picture that stands still shows no model it cannot be compared.
        let pairs = after.1.values_mut().iter_mut().zip(before.1.values());
        pairs.filter(|(_, before)| **before == 1.0).for_each(|(after, _)| *after = 1.0);
        let last = NoiseFrame { projection: &before.0, depth: &before.1, noise: &before.2 };
        let next = |noise| NoiseFrame { projection: &after.0, depth: &after.1, noise };
        moved = moved.merge(Popping::between(last, next(&after.2)));
        still = still.merge(Popping::between(last, next(&before.2)));
    }
    moved.rms() / still.rms()
}

#[test]
fn strokes_stay_on_a_turning_model() {
    let light = DistantLight::WithModel(Vec3::new(-0.5, 0.7, 0.5));
    let mut look = DrawingLook { light, shade: 0.0, ..DrawingLook::default() };
    // On the sphere's own coordinates strokes run along the turn and hardly differ from those that
    // stand still, against which they are measured.
    for (shape, coordinates, most) in [
        (SampleModel::Sphere, Coordinates::Own, 0.28),
        (SampleModel::Sphere, Coordinates::ThreePlanes, 0.25),
        (SampleModel::StillLife, Coordinates::ThreePlanes, 0.25),
        (SampleModel::StillLife, Coordinates::Own, 0.25),
        (SampleModel::TorusKnot, Coordinates::Own, 0.25),
    ] {
        let mut mesh = shape.mesh(8000);
        // Strokes alone: colours that stay where they are would flatter the measure.
        mesh.colors.iter_mut().for_each(|color| *color = [1.0; 3]);
        mesh.materials.iter_mut().for_each(|material| {
            material.color = [1.0; 3];
            material.texture = None;
        });
        look.hatching.coordinates = Some(coordinates);
        let found = popping(&mesh, &look, 6);
        assert!(found <= most, "{} {coordinates:?}: {found}", shape.name());
    }
}

#[test]
fn a_picture_has_the_same_bits_on_any_number_of_threads() {
    let mesh = SampleModel::StillLife.mesh(4000);
    let camera = camera(&mesh, 1.5);
    let pictures = [1, 2, 5].map(|threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
            Scene::new(Compute::cpu(), &mesh).grey(&camera, (75, 50), &DrawingLook::default())
        })
    });
    let bits = |picture: &Field<[f32; 4]>| -> Vec<u32> {
        picture.values().iter().flatten().map(|value| value.to_bits()).collect()
    };
    assert!(pictures.iter().all(|picture| bits(picture) == bits(&pictures[0])));
}

#[test]
fn a_pale_drawing_is_lighter_outside_and_unchanged_inside() {
    let mesh = SampleModel::StillLife.mesh(4000);
    let mut scene = Scene::new(Compute::cpu(), &mesh);
    let camera = camera(&mesh, 1.5);
    let mut shaded = |pale| {
        let look = DrawingLook { pale, ..DrawingLook::default() };
        scene.shade(&camera, (75, 50), &look).0
    };
    let plain = shaded(0.0);
    let pale = shaded(0.6);
    for (plain, pale) in plain.values().iter().zip(pale.values()) {
        assert_eq!(plain[..3], pale[..3]);
        assert!((0.0..=1.0).contains(&pale[3]), "{pale:?}");
    }
    let dark = |field: &Field<[f32; 4]>| -> f32 {
        field.values().iter().map(|pixel| 1.0 - pixel[3]).sum()
    };
    assert!(dark(&pale) < 0.8 * dark(&plain), "{} {}", dark(&pale), dark(&plain));
}

#[test]
fn a_device_draws_the_same_picture() {
    let Some(gpu) = device() else { return };
    let mesh = SampleModel::StillLife.mesh(4000);
    let mut scenes = [Compute::cpu(), gpu].map(|compute| Scene::new(compute, &mesh));
    for (width, height) in [(1, 1), (8, 8), (67, 33), (160, 120)] {
        for (lit, coordinates) in [(true, Coordinates::ThreePlanes), (false, Coordinates::Own)] {
            let mut look = DrawingLook { lit, ..DrawingLook::default() };
            look.hatching.coordinates = Some(coordinates);
            look.hatching.outside = 0.7;
            look.pale = if lit { 0.5 } else { 0.0 };
            let camera = camera(&mesh, width as f32 / height as f32);
            // One visibility buffer for both, since rasterisers differ at edges.
            let [cpu, gpu] = &mut scenes;
            let seen = cpu.model.visible(&mut cpu.compute, &camera, width, height).unwrap();
            let draw = |scene: &mut Scene| {
                let Scene { compute, model, hatching } = scene;
                let visible = compute.upload(seen.host()).unwrap();
                let shaded = shade(compute, model, &visible, &camera, &look, hatching).unwrap();
                compute.download(&shaded).unwrap()
            };
            let wanted = draw(cpu);
            let found = draw(gpu);
            let (most, _) = far(&wanted, &found);
            assert!(most <= 1.0 / 255.0, "{width} x {height} {coordinates:?}: {most}");
        }
    }
}
