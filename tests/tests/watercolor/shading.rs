//! Visibility of meshes and toon shading, on CPU and GPU.

use glam::{Vec2, Vec3};
use graphics::camera::{Camera, Framing};
use graphics::compute::Compute;
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::mesh::{Material, Mesh, Texture};
use graphics::surface::{Model, NO_TRIANGLE, PackedMesh, RASTER, VisibilityBuffer, position_at};
use graphics::tones::ToneRamp;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use suite::program::device;
use watercolor::{ModelPainter, Settings, ShadowMap, Toon, shade_toon};

use super::seen::{inside_them, random_triangles};

/// A chequered texture of 7 x 5 texels.
fn checks() -> Texture {
    let texels = (0..5).flat_map(|y| (0..7).map(move |x: u32| (x, y)));
    let texels = texels.map(|(x, y)| match (x / 2 + y) % 2 {
        0 => u32::from_le_bytes([240, 200, 40 * y as u8, 255]),
        _ => u32::from_le_bytes([20 * x as u8, 90, 160, 255]),
    });
    let texels = texels.collect();
    Texture { width: 7, height: 5, texels }
}

/// One mesh of a torus knot with vertex colours and a textured ball.
fn two() -> Mesh {
    let mut mesh = Mesh::torus_knot(3000);
    for (color, i) in mesh.colors.iter_mut().zip(0u8..=255) {
        *color = [0.5 + f32::from(i) / 512.0, 1.0, 0.7];
    }
    mesh.materials.push(Material { texture: Some(checks()), ..Material::plain([0.9, 0.8, 1.0]) });
    let ball = Mesh::sphere(800);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(&ball.positions);
    mesh.normals.extend(&ball.normals);
    mesh.texture_coordinates
        .extend(ball.texture_coordinates.iter().map(|[u, v]| [3.0 * u - 1.0, 2.0 * v]));
    mesh.colors.extend(&ball.colors);
    mesh.triangles.extend(ball.triangles.iter().map(|triangle| graphics::mesh::Triangle {
        corners: triangle.corners.map(|at| at + first),
        material: 1,
    }));
    mesh
}

fn seen(
    compute: &mut Compute,
    mesh: &Mesh,
    camera: &Camera,
    (width, height): (usize, usize),
) -> VisibilityBuffer {
    let mut model = Model::new(compute, PackedMesh::new(mesh)).unwrap();
    let visible = model.visible(compute, camera, width, height).unwrap();
    compute.download(&visible).unwrap()
}

fn shaded(
    compute: &mut Compute,
    mesh: &Mesh,
    camera: &Camera,
    (width, height): (usize, usize),
    toon: &Toon,
) -> Field<[f32; 4]> {
    let mut model = Model::new(compute, PackedMesh::new(mesh)).unwrap();
    let samples = toon.samples;
    let visible = model.visible(compute, camera, width * samples, height * samples).unwrap();
    let color = shade_toon(compute, &model, &visible, camera, toon, None).unwrap();
    compute.download(&color).unwrap()
}

/// The picture of [`shaded`] with cast shadows.
fn shadowed(
    compute: &mut Compute,
    mesh: &Mesh,
    camera: &Camera,
    (width, height): (usize, usize),
    toon: &Toon,
) -> Field<[f32; 4]> {
    let mut model = Model::new(compute, PackedMesh::new(mesh)).unwrap();
    let [low, high] = mesh.bounds();
    let sphere = ((low + high) / 2.0, low.distance(high) / 2.0);
    let light = toon.light.direction(camera);
    let map = ShadowMap::new(compute, &mut model, light, sphere, 256).unwrap();
    let samples = toon.samples;
    let visible = model.visible(compute, camera, width * samples, height * samples).unwrap();
    let color = shade_toon(compute, &model, &visible, camera, toon, Some(&map)).unwrap();
    compute.download(&color).unwrap()
}

/// A ball of radius 1 that floats over a floor at -1.5.
fn ball_over_floor() -> Mesh {
    let mut mesh = Mesh::sphere(2000);
    mesh.colors.fill([1.0; 3]);
    let first = mesh.positions.len();
    let cells = graphics::mesh::GridSize { columns: 9, rows: 9 };
    mesh.add_grid(cells, 0, |Vec2 { x, y }| Vec3::new(12.0 * x - 6.0, -1.5, 12.0 * y - 6.0));
    mesh.normals[first..].fill([0.0, 1.0, 0.0]);
    mesh
}

#[test]
fn a_ball_casts_its_shadow_on_the_floor_and_none_on_itself() {
    let mesh = ball_over_floor();
    let camera = Camera::framing(mesh.bounds(), 0.0, 60.0, 30.0);
    let light = DistantLight::WithModel(Vec3::new(1.0, 1.0, 0.0));
    let steps = ToneRamp::steps(2, 0.0);
    let toon = Toon { light, tones: steps, samples: 1, ..Toon::default() };
    let size = (200, 200);
    let lit = shaded(&mut Compute::cpu(), &mesh, &camera, size, &toon);
    let cast = shadowed(&mut Compute::cpu(), &mesh, &camera, size, &toon);
    let seen = seen(&mut Compute::cpu(), &mesh, &camera, size);
    let [mut inside, mut outside, mut on_ball] = [0; 3];
    for y in 0..200 {
        for x in 0..200 {
            if seen[(x, y)].triangle == NO_TRIANGLE {
                continue;
            }
            let place = position_at(&mesh, seen[(x, y)]);
            let darker = cast[(x, y)][1] < lit[(x, y)][1] - 0.02;
            if place.y > -1.4 {
                on_ball += usize::from(darker);
                continue;
            }
            // A ray towards the light passes the middle of the ball at this distance.
            let ray = Vec3::new(1.0, 1.0, 0.0).normalize();
            let away = (place - ray * place.dot(ray)).length();
            match away {
                away if away < 0.8 => {
                    assert!(darker, "light in the shadow at {place}");
                    inside += 1;
                }
                away if away > 1.2 => {
                    assert!(!darker, "a shadow without a ball at {place}");
                    outside += 1;
                }
                _ => {}
            }
        }
    }
    assert!(inside > 60 && outside > 2000, "{inside} {outside}");
    assert!(on_ball < 15, "{on_ball} pixels of the ball are in its own shadow");
    let none = Toon { shadow: 0.0, ..toon };
    assert_eq!(shadowed(&mut Compute::cpu(), &mesh, &camera, size, &none), lit);
}

#[test]
fn the_device_casts_the_shadows_of_the_processor() {
    let Some(mut on_gpu) = device().map(Compute::gpu) else { return };
    let mesh = ball_over_floor();
    let camera = Camera::framing(mesh.bounds(), 20.0, 40.0, 35.0);
    let toon = Toon { samples: 2, shadow_color: [0.7, 0.7, 0.8], ..Toon::default() };
    let a = shadowed(&mut Compute::cpu(), &mesh, &camera, (131, 99), &toon);
    let b = shadowed(&mut on_gpu, &mesh, &camera, (131, 99), &toon);
    let without = shaded(&mut Compute::cpu(), &mesh, &camera, (131, 99), &toon);
    let [shadow, off] = [&without, &b].map(|other| {
        let pairs = a.values().iter().zip(other.values());
        pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 0.02)).count()
    });
    assert!(shadow > 40, "{shadow} pixels in shadow");
    assert!(off * 200 < a.values().len(), "{off} pixels differ");
}

#[test]
fn the_raster_shader_is_valid_and_bound_as_it_says() {
    let module = naga::front::wgsl::parse_str(RASTER.source).unwrap();
    let valid = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
    assert!(valid.is_ok(), "{valid:?}");
    assert_eq!(module.global_variables.len(), RASTER.buffers + 1);
    for layout in RASTER.structs.iter().chain([&RASTER.parameters]) {
        let mut types = module.types.iter().map(|(_, ty)| ty);
        let ty = types.find(|ty| ty.name.as_deref() == Some(layout.name)).unwrap();
        let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{ty:?}") };
        let found: Vec<_> =
            members.iter().map(|m| (m.name.as_deref().unwrap(), m.offset as usize)).collect();
        assert_eq!((*span as usize, &found[..]), (layout.bytes, layout.fields));
    }
}

#[test]
fn the_device_sees_what_the_processor_sees() {
    let Some(mut on_gpu) = device().map(Compute::gpu) else { return };
    let knot = two();
    let around = Camera::framing(knot.bounds(), 20.0, 30.0, 35.0);
    let cases = [
        (&random_triangles(200, 1), inside_them(), (97, 61)),
        (&knot, around, (160, 120)),
        (&knot, around, (203, 90)),
        (&Mesh::sphere(25_000), around, (250, 250)),
    ];
    for (mesh, camera, size) in cases {
        let on_cpu = seen(&mut Compute::cpu(), mesh, &camera, size);
        let found = seen(&mut on_gpu, mesh, &camera, size);
        let mut differ = 0;
        let mut shown = 0;
        for (a, b) in on_cpu.values().iter().zip(found.values()) {
            if a.triangle != b.triangle {
                differ += 1;
            } else if a.triangle != NO_TRIANGLE {
                shown += 1;
                // A GPU may compute weights from vertices that are not rounded. This changes them
                // in triangles of a few pixels, but the position agrees.
                let off = position_at(mesh, *a).distance(position_at(mesh, *b));
                assert!(off < 6e-3, "{size:?}: {off} off: {a:?} {b:?}");
                assert!((a.depth - b.depth).abs() < 5e-4, "{size:?}: {a:?} {b:?}");
            } else {
                assert_eq!(a, b);
            }
        }
        let all = size.0 * size.1;
        assert!(differ * 500 <= all && shown * 10 > all, "{size:?}: {differ} {shown} of {all}");
    }
}

#[test]
fn the_device_shades_as_the_processor_does() {
    let Some(mut on_gpu) = device().map(Compute::gpu) else { return };
    let mesh = two();
    let camera = Camera::framing(mesh.bounds(), 200.0, 30.0, 35.0);
    for (samples, light) in [
        (1, DistantLight::with_camera(315.0, 40.0)),
        (2, DistantLight::WithModel(Vec3::new(1.0, 2.0, 0.5))),
    ] {
        let toon = Toon { samples, light, tones: ToneRamp::steps(3, 0.6), ..Toon::default() };
        let a = shaded(&mut Compute::cpu(), &mesh, &camera, (131, 99), &toon);
        let b = shaded(&mut on_gpu, &mesh, &camera, (131, 99), &toon);
        let differ = a.values().iter().zip(b.values()).filter(|(a, b)| {
            assert!(b.iter().all(|value| (0.0..=1.0).contains(value)), "{b:?}");
            a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 0.01)
        });
        let differ = differ.count();
        let all = a.values().len();
        assert!(differ * 200 < all, "{samples} samples: {differ} of {all} pixels differ");
    }
}

#[test]
fn without_strength_surfaces_keep_their_colors() {
    let mut mesh = two();
    let camera = Camera::framing(mesh.bounds(), 50.0, 20.0, 35.0);
    mesh.colors.fill([1.0; 3]);
    mesh.materials[1] = Material::plain([0.1, 0.6, 0.3]);
    let toon = Toon { strength: 0.0, ..Toon::default() };
    let picture = shaded(&mut Compute::cpu(), &mesh, &camera, (120, 90), &toon);
    let wanted = [[1.0, 1.0, 1.0, 0.0], [0.25, 0.47, 0.62, 1.0], [0.1, 0.6, 0.3, 1.0]];
    let mut counts = [0; 3];
    for pixel in picture.values() {
        counts[wanted
            .iter()
            .position(|wanted: &[f32; 4]| {
                wanted.iter().zip(pixel).all(|(a, b)| (a - b).abs() < 1e-6)
            })
            .unwrap_or_else(|| panic!("{pixel:?}"))] += 1;
    }
    assert!(counts.iter().all(|&count| count > 50), "{counts:?}");
}

#[test]
fn shade_is_dense_paint_and_light_is_thin() {
    // A wall seen from the front. `cosine` belongs to the angle between its normal and the light.
    fn wall(cosine: f32) -> Mesh {
        let mut mesh = Mesh::default();
        mesh.materials.push(Material::plain([0.6, 0.5, 1.0]));
        let cells = graphics::mesh::GridSize { columns: 3, rows: 2 };
        mesh.add_grid(cells, 0, |Vec2 { x, y }| Vec3::new(x, -y, 0.0));
        mesh.normals.fill([(1.0 - cosine * cosine).sqrt(), 0.0, cosine]);
        mesh
    }
    fn shade(cosine: f32, strength: f32) -> [f32; 4] {
        let mesh = wall(cosine);
        let camera = Camera::framing(mesh.bounds(), 0.0, 0.0, 30.0);
        let toon = Toon {
            light: DistantLight::WithModel(Vec3::Z),
            tones: ToneRamp::from_greys(&[0.0, 1.0]).unwrap(),
            strength,
            shadow: 0.0,
            shadow_color: [1.0; 3],
            samples: 1,
        };
        shaded(&mut Compute::cpu(), &mesh, &camera, (20, 20), &toon)[(10, 10)]
    }
    fn near(found: [f32; 4], wanted: [f32; 3]) {
        let off = found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off < 1e-3 && found[3] == 1.0, "{found:?} {wanted:?}");
    }
    // Density 1 + 2 (0.5 - grey): 2 (the square of the colour) in shade, 1, and 0 in light.
    near(shade(0.0, 2.0), [0.36, 0.25, 1.0]);
    near(shade(0.5, 2.0), [0.6, 0.5, 1.0]);
    near(shade(1.0, 2.0), [0.6 * 1.4, 0.5 * 1.5, 1.0]);
    near(shade(-0.7, 2.0), [0.36, 0.25, 1.0]);
    // The density is at least 0.
    near(shade(1.0, 9.0), [0.6 * 1.4, 0.5 * 1.5, 1.0]);
}

#[test]
fn both_sides_of_a_surface_are_lit_from_where_they_are_seen() {
    let mut mesh = Mesh::default();
    mesh.materials.push(Material::plain([0.5; 3]));
    mesh.add_grid(graphics::mesh::GridSize { columns: 3, rows: 2 }, 0, |Vec2 { x, y }| {
        Vec3::new(x, -y, 0.0)
    });
    let toon = Toon { light: DistantLight::with_camera(0.0, 90.0), ..Toon::default() };
    let [front, back] = [0.0, 180.0].map(|azimuth| {
        let camera = Camera::framing(mesh.bounds(), azimuth, 0.0, 30.0);
        shaded(&mut Compute::cpu(), &mesh, &camera, (20, 20), &toon)[(10, 10)]
    });
    assert_eq!(front, back);
    assert!(front[0] > 0.5, "{front:?}");
}

#[test]
fn samples_soften_silhouettes_only() {
    let mesh = Mesh::sphere(3000);
    let camera = Camera::framing(mesh.bounds(), 0.0, 0.0, 30.0);
    let toon = Toon { samples: 2, strength: 0.0, ..Toon::default() };
    let picture = shaded(&mut Compute::cpu(), &mesh, &camera, (60, 60), &toon);
    let shares = picture.values().iter().map(|pixel| (pixel[3] * 4.0).round() as usize);
    let mut counts = [0; 5];
    shares.for_each(|share| counts[share] += 1);
    assert!(counts[1..4].iter().all(|&count| count > 4) && counts[4] > 1500, "{counts:?}");
    let area: f32 = picture.values().iter().map(|pixel| pixel[3]).sum();
    let sharp = shaded(&mut Compute::cpu(), &mesh, &camera, (60, 60), &Toon { samples: 1, ..toon });
    let jagged: f32 = sharp.values().iter().map(|pixel| pixel[3]).sum();
    assert!((area / jagged - 1.0).abs() < 0.02, "{area} {jagged}");
}

#[test]
fn a_picture_that_no_device_draws_is_refused() {
    let Some(mut on_gpu) = device().map(Compute::gpu) else { return };
    let mut model = Model::new(&mut on_gpu, PackedMesh::new(&Mesh::sphere(100))).unwrap();
    for (width, height) in [(1 << 20, 4), (0, 4)] {
        let error = model.visible(&mut on_gpu, &inside_them(), width, height).unwrap_err();
        assert!(matches!(error, DeviceError::Refused { .. }), "{error}");
    }
    assert!(model.visible(&mut on_gpu, &inside_them(), 8, 4).is_ok());
}

#[test]
fn greys_of_a_picture_take_the_place_of_steps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("greys.png");
    let greys = image::GrayImage::from_fn(2, 1, |x, _| image::Luma([x as u8 * 255]));
    greys.save(&path).unwrap();
    let mut settings = Settings::default().for_size(64, 64);
    settings.toon.levels = 1;
    settings.toon.shadow = 0.0;
    let framing = Framing::default();
    let shaded = |settings: &Settings| {
        let mesh = Mesh::sphere(500);
        let camera = framing.fit(&mesh.positions);
        let painter = ModelPainter::new(Compute::cpu(), mesh, settings, (64, 64)).unwrap();
        painter.with_samples(1).wash(&camera).unwrap().0.color
    };
    fn of(field: &Field<[f32; 4]>) -> [f32; 2] {
        let seen = field.values().iter().filter(|color| color[3] == 1.0);
        let greens = seen.map(|color| color[1]);
        greens.fold([1.0f32, 0.0], |[low, high], value| [low.min(value), high.max(value)])
    }
    let [low, high] = of(&shaded(&settings));
    assert!(high - low < 1e-6, "one step gives several colours: {low} {high}");
    settings.toon.greys = Some(path.display().to_string());
    let [low, high] = of(&shaded(&settings));
    assert!(high - low > 0.2, "a ramp gives one colour: {low} {high}");
    settings.toon.greys = Some("no/such.png".to_owned());
    let painter = ModelPainter::new(Compute::cpu(), Mesh::sphere(500), &settings, (8, 8));
    assert!(painter.unwrap_err().to_string().contains("no/such.png"));
}
