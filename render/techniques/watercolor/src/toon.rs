//! Toon shading: surfaces in a few steps of light.
//!
//! We follow Bousseau, Kaplan, Thollot and Sillion 2006, section 3.1. The diffuse term n . l
//! selects a grey from a one-dimensional texture. This grey sets the density d at which we paint
//! the colour C of the surface: `C (1 - (1 - C) (d - 1))` with `d = 1 + strength (0.5 - grey)`, at
//! least 0. So shade is thick paint, light is thin paint, and white stays white. Where another
//! surface stands between the light and a point, the point lies in the shade.

use glam::{Mat4, Vec3, Vec4};
use rayon::prelude::*;

use super::shadow_map::{GRAZING, OFFSET_PX, ShadowMap, ShadowView};
use graphics::camera::Camera;
use graphics::compute::{ColorImage, Compute, GpuCompute, Image, Plane};
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::gpu::{DeviceError, Kernel, Storage, layout};
use graphics::surface::{
    DeviceModel, FourPoints, Fragment, Model, NO_TRIANGLE, PackedMaterial, PackedMesh,
    SurfacePoint, Vertex, VisibilityBuffer, dot_products,
};
use graphics::tones::{TONES, ToneRamp};

/// How surfaces are lit.
#[derive(Debug, Clone, PartialEq)]
pub struct Toon {
    /// Direction of the light.
    pub light: DistantLight,
    /// Grey by the cosine between light and surface.
    pub tones: ToneRamp,
    /// Density gained from grey 1 to grey 0. 0 shows colours without light.
    pub strength: f32,
    /// Darkness of cast shadows: 1 is as dark as the shade, 0 casts none.
    pub shadow: f32,
    /// Encoded sRGB of the glaze that cast shadows lay over the surface.
    pub shadow_color: [f32; 3],
    /// Samples along each side of a pixel, 1 and up. The visibility buffer is this many
    /// times as wide and high as the picture.
    pub samples: usize,
}

impl Default for Toon {
    /// Four soft steps, lit from the upper left.
    fn default() -> Self {
        Self {
            light: DistantLight::with_camera(315.0, 40.0),
            tones: ToneRamp::steps(4, 0.15),
            strength: 1.6,
            shadow: 1.0,
            shadow_color: [1.0; 3],
            samples: 1,
        }
    }
}

/// Shades what `camera` sees of `model`, which you have drawn into `visible`. The result is encoded
/// sRGB in 0..1 with the share of the pixel that surfaces cover, and (1, 1, 1, 0) where there are
/// none. The picture is `toon.samples` times smaller than `visible`. If you pass `shadows`, a map
/// of the light of `toon`, its surfaces cast shadows.
///
/// # Errors
/// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
/// processor.
///
/// # Panics
/// If `visible` is of another mesh, its size is not a multiple of the samples, or another form of
/// [`Compute`] made an input.
pub fn shade_toon(
    compute: &mut Compute,
    model: &Model,
    visible: &Image<Fragment>,
    camera: &Camera,
    toon: &Toon,
    shadows: Option<&ShadowMap>,
) -> Result<ColorImage, DeviceError> {
    let (width, height) = visible.size();
    let samples = toon.samples;
    let whole = samples > 0 && width.is_multiple_of(samples) && height.is_multiple_of(samples);
    assert!(whole, "a visibility buffer of {width} x {height} for {samples} samples a pixel");
    let size = (width / samples, height / samples);
    match compute {
        Compute::Cpu => {
            let mesh = model.host().mesh();
            Ok(shade_toon_on_cpu(mesh, visible.host(), size, camera, toon, shadows).into())
        }
        Compute::Gpu(gpu) => {
            let visible = visible.plane();
            shade_toon_on_gpu(gpu, model.device(), visible, size, camera, toon, shadows)
                .map(Image::from)
        }
    }
}

const PAPER: [f32; 4] = [1.0, 1.0, 1.0, 0.0];

fn shade_toon_on_cpu(
    mesh: &PackedMesh,
    visible: &VisibilityBuffer,
    (width, height): (usize, usize),
    camera: &Camera,
    toon: &Toon,
    shadows: Option<&ShadowMap>,
) -> Field<[f32; 4]> {
    let mut color = Field::filled(width, height, PAPER);
    let light = toon.light.direction(camera);
    let shadows = shadows.map(|map| (map.view(), map.fragments.host()));
    let shader = Shader { mesh, eye: camera.eye, light, toon, shadows };
    color.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        if toon.samples == 1 {
            for (pixel, fragment) in row.iter_mut().zip(visible.row(y, 0, width)) {
                if fragment.triangle != NO_TRIANGLE {
                    *pixel = shader.color(*fragment, &mut None).extend(1.0).into();
                }
            }
            return;
        }
        let lines = match toon.samples {
            2 => [2 * y, 2 * y + 1].map(|line| visible.row(line, 0, 2 * width).as_chunks().0),
            _ => [&[][..]; 2],
        };
        for (x, pixel) in row.iter_mut().enumerate() {
            if let [Some([a, b]), Some([c, d])] = lines.map(|line| line.get(x))
                && let Some(points) = FourPoints::new(mesh, [*a, *b, *c, *d])
            {
                *pixel = shader.mean_color(&points).extend(1.0).into();
                continue;
            }
            let mut sum = Vec4::ZERO;
            let mut last = None;
            for line in 0..toon.samples {
                let y = y * toon.samples + line;
                for fragment in visible.row(y, x * toon.samples, toon.samples) {
                    if fragment.triangle != NO_TRIANGLE {
                        sum += shader.color(*fragment, &mut last).extend(1.0);
                    }
                }
            }
            if sum.w > 0.0 {
                let share = sum.w / (toon.samples * toon.samples) as f32;
                *pixel = (sum.truncate() / sum.w).extend(share).into();
            }
        }
    });
    color
}

/// Shades single fragments on the processor.
struct Shader<'a> {
    mesh: &'a PackedMesh,
    eye: Vec3,
    /// Direction towards the light in model coordinates, of length 1.
    light: Vec3,
    toon: &'a Toon,
    shadows: Option<(ShadowView, &'a VisibilityBuffer)>,
}

/// The share of light that reached the last triangle that was shaded.
type LastLit = Option<(u32, f32)>;

impl Shader<'_> {
    /// The colour of a sample. The samples of a pixel that show one triangle share the light that
    /// reaches the first of them. We keep this light in `last`.
    #[inline]
    fn color(&self, fragment: Fragment, last: &mut LastLit) -> Vec3 {
        let point = SurfacePoint::new(self.mesh, fragment);
        let normal = point.normal(self.eye);
        let mut cosine = normal.dot(self.light);
        let mut albedo = point.albedo();
        if cosine > 0.0
            && let Some((view, map)) = &self.shadows
        {
            let lit = match *last {
                Some((triangle, lit)) if triangle == fragment.triangle => lit,
                _ => view.lit(map, point.position(), normal, cosine),
            };
            *last = Some((fragment.triangle, lit));
            // At grazing light a coarse mesh would shadow the rounder surface that its normals describe.
            let shadow = self.toon.shadow * (1.0 - lit) * (cosine / GRAZING).min(1.0);
            cosine *= 1.0 - shadow;
            // Density darkens colours by itself. White needs the glaze.
            let glaze = shadow * albedo.min_element();
            albedo *= Vec3::ONE + (Vec3::from(self.toon.shadow_color) - Vec3::ONE) * glaze;
        }
        let grey = self.toon.tones.grey(cosine);
        let excess = (self.toon.strength * (0.5 - grey)).max(-1.0);
        (albedo * (Vec3::ONE - (Vec3::ONE - albedo) * excess)).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

impl Shader<'_> {
    /// The mean of [`Self::color`] over the four samples of a pixel, bit for bit.
    #[inline]
    fn mean_color(&self, points: &FourPoints<'_>) -> Vec3 {
        let normals = points.normals(self.eye);
        let mut cosines = dot_products(normals, self.light.to_array().map(Vec4::splat));
        let mut albedo = points.albedo();
        if let Some((view, map)) = &self.shadows
            && let Some(first) = cosines.to_array().iter().position(|&cosine| cosine > 0.0)
        {
            let normal = Vec3::from(normals.map(|axis| axis[first]));
            let lit = view.lit(map, points.point(first).position(), normal, cosines[first]);
            if lit < 1.0 {
                let grazing = (cosines / GRAZING).min(Vec4::ONE);
                let shadow = Vec4::splat(self.toon.shadow * (1.0 - lit)) * grazing;
                let shadow = Vec4::select(cosines.cmpgt(Vec4::ZERO), shadow, Vec4::ZERO);
                cosines *= Vec4::ONE - shadow;
                let glaze = shadow * albedo[0].min(albedo[1]).min(albedo[2]);
                for (channel, shade) in albedo.iter_mut().zip(self.toon.shadow_color) {
                    *channel *= Vec4::ONE + glaze * (shade - 1.0);
                }
            }
        }
        let greys = Vec4::from_array(cosines.to_array().map(|at| self.toon.tones.grey(at)));
        let excess = (self.toon.strength * (Vec4::splat(0.5) - greys)).max(Vec4::splat(-1.0));
        Vec3::from(albedo.map(|own: Vec4| {
            let color = own * (Vec4::ONE - (Vec4::ONE - own) * excess);
            let [a, b, c, d] = color.clamp(Vec4::ZERO, Vec4::ONE).to_array();
            (a + b + c + d) / 4.0
        }))
    }
}

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct ToonParams {
    eye: [f32; 3],
    strength: f32,
    light: [f32; 3],
    samples: u32,
    size: [u32; 2],
    /// Width and height of the shadow map, or 0 without shadows.
    side: u32,
    /// Darkness of cast shadows.
    shadow: f32,
    /// Columns of the matrix from model coordinates to the light's picture.
    light_clip: [[f32; 4]; 4],
    /// Near and far plane of the light, offset and tolerance in the unit of the model.
    light_view: [f32; 4],
    /// Colour of cast shadows.
    shadow_color: [f32; 4],
    /// To the right in the shadow map, in model coordinates, and half the width of a border.
    light_right: [f32; 4],
    /// Upwards in the shadow map, and the width of its pixel in the unit of the model.
    light_up: [f32; 4],
    greys: [[f32; 4]; TONES / 4],
}

pub(super) static TOON: Kernel = Kernel {
    name: "watercolor_toon",
    source: concat!(
        include_str!("../../../graphics/src/surface/textured.wgsl"),
        include_str!("toon.wgsl"),
    ),
    parameters: layout!(ToonParams {
        eye,
        strength,
        light,
        samples,
        size,
        side,
        shadow,
        light_clip,
        light_view,
        shadow_color,
        light_right,
        light_up,
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

fn shade_toon_on_gpu(
    gpu: &mut GpuCompute,
    model: &DeviceModel,
    visible: &Plane<Fragment>,
    (width, height): (usize, usize),
    camera: &Camera,
    toon: &Toon,
    shadows: Option<&ShadowMap>,
) -> Result<Plane<[f32; 4]>, DeviceError> {
    let view = shadows.map(ShadowMap::view);
    let [near, far] = view.map_or([0.0; 2], |view| view.planes);
    let offset = view.map_or(0.0, |view| OFFSET_PX * view.pixel);
    let [red, green, blue] = toon.shadow_color;
    let clip = view.map_or(Mat4::ZERO, |view| view.clip_from_model);
    let params = ToonParams {
        eye: camera.eye.into(),
        strength: toon.strength,
        light: toon.light.direction(camera).into(),
        samples: toon.samples as u32,
        size: [width as u32, height as u32],
        side: shadows.map_or(0, |map| map.fragments.size().0 as u32),
        shadow: toon.shadow,
        light_clip: clip.to_cols_array_2d(),
        light_view: [near, far, offset, offset],
        shadow_color: [red, green, blue, 0.0],
        light_right: view.map_or([0.0; 4], |view| view.axes[0].extend(view.soft as f32).into()),
        light_up: view.map_or([0.0; 4], |view| view.axes[1].extend(view.pixel).into()),
        greys: bytemuck::cast(*toon.tones.greys()),
    };
    let color = gpu.plane(width, height)?;
    let DeviceModel { vertices, triangles, materials, texels, .. } = model;
    // The binding needs a buffer even if the kernel does not read it.
    let map = shadows.map_or(visible, |map| map.fragments.plane()).buffer();
    let buffers = [vertices, triangles, materials, texels, visible.buffer(), map, color.buffer()];
    gpu.dispatch(&TOON, &params, &buffers, (width, height));
    Ok(color)
}

#[cfg(test)]
mod tests {
    use super::*;
    use graphics::mesh::{GridSize, Mesh};

    #[test]
    fn four_samples_at_once_are_shaded_as_one_by_one() {
        // A ball over a floor, which lies partly in its shadow.
        let mut mesh = Mesh::sphere(400);
        mesh.colors.fill([0.8, 0.6, 0.9]);
        let first = mesh.positions.len();
        mesh.add_grid(GridSize { columns: 7, rows: 7 }, 0, |at| {
            Vec3::new(9.0 * at.x - 4.5, -1.4, 9.0 * at.y - 4.5)
        });
        mesh.normals[first..].fill([0.0, 1.0, 0.0]);
        let camera = Camera::framing(mesh.bounds(), 15.0, 50.0, 30.0);
        let toon = Toon {
            light: DistantLight::WithModel(Vec3::new(1.0, 1.2, 0.2)),
            shadow: 0.8,
            shadow_color: [0.7, 0.75, 0.9],
            samples: 2,
            ..Toon::default()
        };
        let compute = &mut Compute::cpu();
        let mut model = Model::new(compute, PackedMesh::new(&mesh)).unwrap();
        let light = toon.light.direction(&camera);
        let map = ShadowMap::new(compute, &mut model, light, (Vec3::ZERO, 7.0), 128).unwrap();
        let visible = model.visible(compute, &camera, 320, 240).unwrap();
        let seen = visible.host();
        let mesh = model.host().mesh();
        for shadows in [None, Some((map.view(), map.fragments.host()))] {
            let shader = Shader { mesh, eye: camera.eye, light, toon: &toon, shadows };
            let mut fours = 0;
            let mut shaded = 0;
            for (x, y) in (0..120).flat_map(|y| (0..160).map(move |x| (2 * x, 2 * y))) {
                let at = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|at| seen[at]);
                let Some(points) = FourPoints::new(mesh, at) else { continue };
                let mut sum = Vec3::ZERO;
                let mut last = None;
                at.iter().for_each(|fragment| sum += shader.color(*fragment, &mut last));
                let [found, wanted] = [shader.mean_color(&points), sum / 4.0]
                    .map(|color| color.to_array().map(f32::to_bits));
                assert_eq!(found, wanted, "{x} {y}");
                fours += 1;
                shaded += usize::from(last.is_some_and(|(_, lit)| lit < 1.0));
            }
            assert!(fours > 3000 && (shaded > 100) == shadows.is_some(), "{fours} {shaded}");
        }
    }
}
