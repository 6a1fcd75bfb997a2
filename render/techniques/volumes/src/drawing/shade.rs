//! Light, texture and hatching. You get the colour of every sample, with its grey beside it.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::compute::{ColorImage, Compute, GpuCompute, Image, Plane};
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::surface::{
    DeviceModel, Fragment, Model, NO_TRIANGLE, PackedMaterial, PackedMesh, SurfacePoint, Vertex,
    VisibilityBuffer,
};
use graphics::tones::TONES;
use rayon::prelude::*;

use super::look::{DrawingError, DrawingLook, GreyWeights, Transfer};
use crate::hatching::{Coordinates, DIRECTIONS_MEET, Hatching, Inking, Placing};

/// Shades what `camera` sees of `model`. You must have drawn the model into `visible`. Each sample
/// has its encoded sRGB in 0..1, lit, textured and hatched, and as the fourth value the grey of
/// this colour. We compute both in one pass (ten Bosch 2005). Where you see no surface, all four
/// are 1. Use `visible` for the coverage.
///
/// # Errors
/// [`DrawingError::Setting`] for a setting out of range; [`DrawingError::Device`] if a device has
/// no memory left or was lost.
///
/// # Panics
/// If `visible` is of another mesh, or another form of [`Compute`] made an input.
pub fn shade(
    compute: &mut Compute,
    model: &Model,
    visible: &Image<Fragment>,
    camera: &Camera,
    look: &DrawingLook,
    hatching: &Hatching,
) -> Result<ColorImage, DrawingError> {
    look.check()?;
    let height_px = visible.height() / look.samples;
    let of_mesh = (hatching.mesh_is_useful, hatching.bounds);
    let placing = Placing::new(&look.hatching, of_mesh, camera, height_px);
    match compute {
        Compute::Cpu => {
            let shader = Shader::new(model.host().mesh(), look, camera, placing, hatching);
            Ok(shader.picture(visible.host()).into())
        }
        Compute::Gpu(gpu) => {
            let model = model.device();
            let params = ShadeParams::new(look, &placing, camera, visible.size());
            let planes = (visible.plane(), hatching.quads.plane());
            Ok(shade_on_gpu(gpu, model, planes, &params)?.into())
        }
    }
}

/// Shades like [`shade`], but keeps colour and hatching apart. Use this for pictures that lay both
/// in paint. It works on the processor. You get for each sample its colour, lit and textured, with
/// the grey of this colour as the fourth value. You also get the ink of the strokes at full
/// strength, 0 to 1. Where you see no surface, the colour is white and has no ink.
///
/// # Errors
/// [`DrawingError::Setting`] for a setting out of range.
///
/// # Panics
/// If `visible` is of another mesh, or `hatching` is in the memory of a device.
pub fn shade_apart(
    mesh: &PackedMesh,
    visible: &VisibilityBuffer,
    camera: &Camera,
    look: &DrawingLook,
    hatching: &Hatching,
) -> Result<(Field<[f32; 4]>, Field<f32>), DrawingError> {
    look.check()?;
    let height_px = visible.height() / look.samples;
    let of_mesh = (hatching.mesh_is_useful, hatching.bounds);
    let placing = Placing::new(&look.hatching, of_mesh, camera, height_px);
    let shader = Shader::new(mesh, look, camera, placing, hatching);
    let width = visible.width();
    let height = visible.height();
    let mut colors = Field::filled(width, height, [1.0; 4]);
    let mut inks = Field::filled(width, height, 0.0);
    let width = width.max(1);
    let rows = colors.values_mut().par_chunks_mut(width);
    let rows = rows.zip(inks.values_mut().par_chunks_mut(width));
    rows.zip(visible.values().par_chunks(width)).for_each(|((colors, inks), seen)| {
        for ((color, ink), fragment) in colors.iter_mut().zip(inks).zip(seen) {
            if fragment.triangle != NO_TRIANGLE {
                (*color, *ink) = shader.apart(*fragment);
            }
        }
    });
    Ok((colors, inks))
}

struct Shader<'a> {
    mesh: &'a PackedMesh,
    look: &'a DrawingLook,
    /// Direction towards the light in model coordinates, of length 1.
    light: Vec3,
    placing: Placing,
    inking: Inking<'a>,
    transfer: &'a Transfer,
}

impl<'a> Shader<'a> {
    fn new(
        mesh: &'a PackedMesh,
        look: &'a DrawingLook,
        camera: &Camera,
        placing: Placing,
        hatching: &'a Hatching,
    ) -> Self {
        let quads = hatching.quads.host().values();
        let inking = Inking::new(quads, look.hatching.softness, look.hatching.width_px);
        let light = look.light.direction(camera);
        Self { mesh, look, light, placing, inking, transfer: Transfer::get() }
    }

    fn picture(&self, visible: &VisibilityBuffer) -> Field<[f32; 4]> {
        let width = visible.width();
        let height = visible.height();
        let mut shaded = Field::filled(width, height, [1.0; 4]);
        shaded.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            for (shaded, fragment) in row.iter_mut().zip(visible.row(y, 0, width)) {
                if fragment.triangle != NO_TRIANGLE {
                    *shaded = self.shaded(*fragment);
                }
            }
        });
        shaded
    }

    #[inline(always)]
    fn shaded(&self, fragment: Fragment) -> [f32; 4] {
        let (look, hatching) = (self.look, &self.look.hatching);
        let (color, ink) = self.lit(fragment, hatching.inside.max(hatching.outside) > 0.0);
        let ink = ink * (1.0 - hatching.pencil);
        let inside = color * (1.0 - ink * hatching.inside);
        let outside = color * (1.0 - ink * hatching.outside);
        let grey = if look.pale > 0.0 {
            let bare = self.transfer.grey(color, look.weights);
            (bare + (1.0 - bare) * look.pale) * (1.0 - ink * hatching.outside)
        } else {
            self.transfer.grey(outside, look.weights)
        };
        inside.extend(grey).into()
    }

    fn apart(&self, fragment: Fragment) -> ([f32; 4], f32) {
        let look = self.look;
        let (color, ink) = self.lit(fragment, true);
        let grey = self.transfer.grey(color, look.weights);
        (color.extend(grey + (1.0 - grey) * look.pale).into(), ink)
    }

    /// Colour under the light. If `hatched` is set, also the ink of the strokes there.
    #[inline(always)]
    fn lit(&self, fragment: Fragment, hatched: bool) -> (Vec3, f32) {
        let point = SurfacePoint::new(self.mesh, fragment);
        let look = self.look;
        let normal = point.normal(self.placing.eye);
        let color = point.albedo();
        let (color, light) = if look.lit {
            let light = look.tones.grey(normal.dot(self.light));
            (color * (1.0 - look.shade * (1.0 - light)), light)
        } else {
            (color, look.tones.grey(lifted(self.transfer.grey(color, look.weights))))
        };
        let ink = match hatched {
            true => self.ink(fragment, point.position(), normal, light),
            false => 0.0,
        };
        (color, ink)
    }

    /// Ink of the strokes on a point, 0 to 1.
    #[inline(always)]
    fn ink(&self, fragment: Fragment, position: Vec3, normal: Vec3, light: f32) -> f32 {
        let hatching = &self.look.hatching;
        let tone = hatching.darkest + (1.0 - hatching.darkest) * light;
        if tone >= 1.0 {
            return 0.0;
        }
        let crossed = tone < DIRECTIONS_MEET;
        let mut ink = 0.0;
        for patch in self.placing.patches(self.mesh, fragment, (position, normal), crossed) {
            if patch.weight > 0.0 {
                ink += patch.weight * self.inking.ink(&patch, tone);
            }
        }
        ink.min(1.0)
    }
}

/// The light that selects the tone of hatching where surfaces are not lit, from the grey of their
/// colour. It is lighter than this grey between black and white, because the colour that you see
/// between the strokes is dark itself.
#[inline(always)]
pub(super) fn lifted(grey: f32) -> f32 {
    grey * (2.0 - grey)
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct ShadeParams {
    eye: [f32; 3],
    pixel: f32,
    light: [f32; 3],
    lit: u32,
    origin: [f32; 3],
    tiles: f32,
    size: [u32; 2],
    turn: [f32; 2],
    shade: f32,
    rec601: u32,
    three_planes: u32,
    darkest: f32,
    inside: f32,
    outside: f32,
    pencil: f32,
    softness: f32,
    scale: f32,
    pale: f32,
    padding: [f32; 2],
    greys: [[f32; 4]; TONES / 4],
}

impl ShadeParams {
    fn new(look: &DrawingLook, placing: &Placing, camera: &Camera, size: (usize, usize)) -> Self {
        let hatching = &look.hatching;
        Self {
            eye: placing.eye.into(),
            pixel: placing.pixel,
            light: look.light.direction(camera).into(),
            lit: look.lit.into(),
            origin: placing.origin.into(),
            tiles: placing.tiles,
            size: [size.0 as u32, size.1 as u32],
            turn: placing.turn.into(),
            shade: look.shade,
            rec601: (look.weights == GreyWeights::Rec601).into(),
            three_planes: (placing.coordinates == Coordinates::ThreePlanes).into(),
            darkest: hatching.darkest,
            inside: hatching.inside,
            outside: hatching.outside,
            pencil: hatching.pencil,
            softness: hatching.softness,
            scale: Inking::scale(hatching.width_px),
            pale: look.pale,
            padding: [0.0; 2],
            greys: bytemuck::cast(*look.tones.greys()),
        }
    }
}

pub(crate) static SHADE: Kernel = Kernel {
    name: "volumes_shade",
    source: concat!(
        include_str!("../../../../graphics/src/surface/textured.wgsl"),
        include_str!("../hatching/ink.wgsl"),
        include_str!("shade.wgsl"),
    ),
    parameters: layout!(ShadeParams {
        eye,
        pixel,
        light,
        lit,
        origin,
        tiles,
        size,
        turn,
        shade,
        rec601,
        three_planes,
        darkest,
        inside,
        outside,
        pencil,
        softness,
        scale,
        pale,
        padding,
        greys
    }),
    structs: &[Vertex::LAYOUT, PackedMaterial::LAYOUT, Fragment::LAYOUT],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
    ],
};

fn shade_on_gpu(
    gpu: &mut GpuCompute,
    model: &DeviceModel,
    (visible, quads): (&Plane<Fragment>, &Plane<u32>),
    params: &ShadeParams,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let (width, height) = visible.size();
    let shaded = gpu.plane(width, height)?;
    let DeviceModel { vertices, triangles, materials, texels, .. } = model;
    let visible = visible.buffer();
    let quads = quads.buffer();
    let buffers = [vertices, triangles, materials, texels, visible, quads, shaded.buffer()];
    gpu.dispatch(&SHADE, params, &buffers, (width, height));
    Ok(shaded)
}

#[cfg(test)]
mod tests {
    //! Tests of shading: grey, light, hatching on a turntable, the twin on a device, and the width
    //! of strokes on pictures of models.

    use super::*;
    use crate::drawing::{grey_of, reveal};
    use crate::hatching::{HatchingLook, sample_texture};
    use crate::test_volumes::{device, far};
    use graphics::camera::Framing;
    use graphics::coherence::{NoiseFrame, Popping, Projection, depth_field};
    use graphics::distant_light::DistantLight;
    use graphics::mesh::{Mesh, SampleModel};

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
        let strengths = [(1.0, 1.0), (0.0, 1.0), (0.0, 0.0)];
        let [both, only_outside, none] = strengths.map(|(inside, outside)| {
            let hatching = HatchingLook { inside, outside, ..HatchingLook::default() };
            let look = DrawingLook { hatching, ..DrawingLook::default() };
            scene.shade(&camera, (150, 100), &look).0
        });
        let mut darker = 0;
        for i in 0..both.values().len() {
            let [both, outside, none] =
                [&both, &only_outside, &none].map(|field| field.values()[i]);
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
        let camera = Framing { azimuth_deg: 0.0, elevation_deg: 0.0, ..Framing::default() }
            .fit(&mesh.positions);
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

    /// How strongly strokes pop on a turntable of 60 frames: the root mean square change of the
    /// grey at the same point of a model between frames. We divide it by the change when the same
    /// picture stands still.
    fn popping(mesh: &Mesh, look: &DrawingLook, steps: usize) -> f64 {
        let size = (400, 300);
        let mut scene = Scene::new(Compute::cpu(), mesh);
        let framing = Framing { aspect: 4.0 / 3.0, ..Framing::default() };
        let cameras = framing.fit_turntable(&mesh.positions, 60);
        let [mut moved, mut still] = [Popping::default(); 2];
        for step in 0..steps {
            let first = step * 60 / steps;
            let [before, mut after] = [first, (first + 1) % 60].map(|number: usize| {
                let Scene { compute, model, .. } = &mut scene;
                let visible = model.visible(compute, &cameras[number], size.0, size.1).unwrap();
                let visible = compute.download(&visible).unwrap();
                let picture = scene.grey(&cameras[number], size, look);
                let grey = picture.values().iter().map(|pixel| pixel[0]).collect();
                let projection = Projection::new(&cameras[number], size.0, size.1);
                (projection, depth_field(&visible), Field::from_values(size.0, size.1, grey))
            });
            // We cannot compare where the picture that stands still shows no model.
            let pairs = after.1.values_mut().iter_mut().zip(before.1.values());
            pairs.filter(|(_, before)| **before == 1.0).for_each(|(after, _)| *after = 1.0);
            let last = NoiseFrame { projection: &before.0, depth: &before.1, noise: &before.2 };
            let next = NoiseFrame { projection: &after.0, depth: &after.1, noise: &after.2 };
            moved = moved.merge(Popping::between(last, next));
            let next = NoiseFrame { noise: &before.2, ..next };
            still = still.merge(Popping::between(last, next));
        }
        moved.rms() / still.rms()
    }

    #[test]
    fn strokes_stay_on_a_turning_model() {
        let light = DistantLight::WithModel(Vec3::new(-0.5, 0.7, 0.5));
        let mut look = DrawingLook { light, shade: 0.0, ..DrawingLook::default() };
        // On the sphere's own coordinates strokes run along the turn. They hardly differ from the
        // still strokes that we compare them with.
        for (shape, coordinates, most) in [
            (SampleModel::Sphere, Coordinates::Own, 0.28),
            (SampleModel::Sphere, Coordinates::ThreePlanes, 0.25),
            (SampleModel::StillLife, Coordinates::ThreePlanes, 0.25),
            (SampleModel::StillLife, Coordinates::Own, 0.25),
            (SampleModel::TorusKnot, Coordinates::Own, 0.25),
        ] {
            let mut mesh = shape.mesh(8000);
            // We measure strokes alone: colours that stay where they are would flatter the
            // measure.
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
        fn bits(picture: &Field<[f32; 4]>) -> Vec<u32> {
            picture.values().iter().flatten().map(|value| value.to_bits()).collect()
        }
        assert!(pictures.iter().all(|picture| bits(picture) == bits(&pictures[0])));
    }

    #[test]
    fn a_pale_drawing_is_lighter_outside_and_unchanged_inside() {
        let mesh = SampleModel::StillLife.mesh(4000);
        let mut scene = Scene::new(Compute::cpu(), &mesh);
        let camera = camera(&mesh, 1.5);
        let [plain, pale] = [0.0, 0.6].map(|pale| {
            let look = DrawingLook { pale, ..DrawingLook::default() };
            scene.shade(&camera, (75, 50), &look).0
        });
        for (plain, pale) in plain.values().iter().zip(pale.values()) {
            assert_eq!(plain[..3], pale[..3]);
            assert!((0.0..=1.0).contains(&pale[3]), "{pale:?}");
        }
        fn dark(field: &Field<[f32; 4]>) -> f32 {
            field.values().iter().map(|pixel| 1.0 - pixel[3]).sum()
        }
        assert!(dark(&pale) < 0.8 * dark(&plain), "{} {}", dark(&pale), dark(&plain));
    }

    #[test]
    fn a_device_draws_the_same_picture() {
        let Some(gpu) = device() else { return };
        let mesh = SampleModel::StillLife.mesh(4000);
        let mut scenes = [Compute::cpu(), gpu].map(|compute| Scene::new(compute, &mesh));
        for (width, height) in [(1, 1), (8, 8), (67, 33), (160, 120)] {
            for (lit, coordinates) in [(true, Coordinates::ThreePlanes), (false, Coordinates::Own)]
            {
                let mut look = DrawingLook { lit, ..DrawingLook::default() };
                look.hatching.coordinates = Some(coordinates);
                look.hatching.outside = 0.7;
                look.pale = if lit { 0.5 } else { 0.0 };
                let camera = camera(&mesh, width as f32 / height as f32);
                // We use one visibility buffer for both, since rasterisers differ at edges.
                let [cpu, gpu] = &mut scenes;
                let seen = cpu.model.visible(&mut cpu.compute, &camera, width, height).unwrap();
                let [wanted, found] = [cpu, gpu].map(|scene: &mut Scene| {
                    let Scene { compute, model, hatching } = scene;
                    let visible = compute.upload(seen.host()).unwrap();
                    let shaded = shade(compute, model, &visible, &camera, &look, hatching).unwrap();
                    compute.download(&shaded).unwrap()
                });
                let (most, _) = far(&wanted, &found);
                assert!(most <= 1.0 / 255.0, "{width} x {height} {coordinates:?}: {most}");
            }
        }
    }

    /// Mean width of the dark strips of a picture: twice their area over the length of their
    /// outline. This length is the mean number of dark runs along parallel lines a pixel apart,
    /// over all directions, times pi (Crofton's formula). We take four directions.
    fn width_of_strips((width, height): (i32, i32), dark: impl Fn(i32, i32) -> bool) -> f32 {
        let mut area = 0.0;
        let mut crossings = 0.0;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            if dark(x, y) {
                area += 1.0;
                // Lines along the diagonals lie closer together.
                let diagonal = std::f64::consts::FRAC_1_SQRT_2;
                for (dx, dy, apart) in
                    [(1, 0, 1.0), (0, 1, 1.0), (1, 1, diagonal), (-1, 1, diagonal)]
                {
                    crossings += if dark(x - dx, y - dy) { 0.0 } else { apart };
                }
            }
        }
        (8.0 * area / (std::f64::consts::PI * crossings)) as f32
    }

    #[test]
    fn strips_of_a_known_width_are_measured() {
        for (slope, width) in [(0.0, 3.0), (0.3, 3.0), (1.0, 4.0), (2.5, 6.0)] {
            let across = f64::hypot(1.0, slope);
            let found = f64::from(width_of_strips((400, 400), |x: i32, y: i32| {
                (0..400).contains(&x)
                    && (0..400).contains(&y)
                    && ((f64::from(y) + slope * f64::from(x)) / across).rem_euclid(20.0) < width
            }));
            assert!((found / width - 1.0).abs() < 0.12, "{slope} {width}: {found}");
        }
    }

    #[test]
    fn strokes_on_a_village_are_2_to_4_pixels_wide_from_near_and_far() {
        let mut mesh = SampleModel::Village.mesh(8000);
        // Without light, black has the darkest tone. In this scene all surfaces are black.
        mesh.colors.iter_mut().for_each(|color| *color = [0.0; 3]);
        let packed = PackedMesh::new(&mesh);
        let mut compute = Compute::cpu();
        let hatching = Hatching::new(&mut compute, sample_texture(), &packed).unwrap();
        let mut model = Model::new(&mut compute, packed).unwrap();
        for ((width, height), zoom, tone) in [
            ((750, 570), 1.0, 0.65),
            ((750, 570), 2.9, 0.8),
            ((750, 570), 8.0, 0.6),
            ((1280, 800), 1.0, 0.65),
            ((1280, 800), 4.3, 0.65),
            ((1920, 1080), 1.0, 0.65),
            ((1920, 1080), 8.0, 0.65),
        ] {
            let aspect = width as f32 / height as f32;
            let mut camera = Framing { aspect, ..Framing::default() }.fit(&mesh.positions);
            let half = (0.5 * camera.field_of_view_deg).to_radians().tan() / zoom;
            camera.field_of_view_deg = 2.0 * half.atan().to_degrees();
            let mut look = DrawingLook { lit: false, ..DrawingLook::default() };
            look.hatching.coordinates = Some(Coordinates::ThreePlanes);
            look.hatching.darkest = tone;
            let visible = model.visible(&mut compute, &camera, width, height).unwrap();
            let mesh = model.host().mesh();
            let (_, ink) = shade_apart(mesh, visible.host(), &camera, &look, &hatching).unwrap();
            fn within(at: i32, end: usize) -> bool {
                usize::try_from(at).is_ok_and(|at| at < end)
            }
            let found = width_of_strips((width as i32, height as i32), |x: i32, y: i32| {
                within(x, width) && within(y, height) && ink[(x as usize, y as usize)] > 0.5
            });
            assert!(
                (2.0..4.0).contains(&found),
                "{width} x {height}, x{zoom}, tone {tone}: {found}"
            );
        }
    }
}
