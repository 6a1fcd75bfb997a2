//! Benchmarks of volumes as films of pigments: the steps of one frame of a still life. The grid has
//! 64 volumes with level of detail 2.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::hint::black_box;
use std::sync::{Arc, OnceLock};

use divan::Bencher;
use glam::Vec3;
use graphics::camera::{Camera, Framing};
use graphics::field::Field;
use graphics::mesh::SampleModel;
use graphics::surface::{Crossings, PackedMesh, SurfacePoint, VisibilityBuffer, visible};
use paint::document::{Lighting, palette_slots};
use paint::ground::GroundKind;
use paint::layer::Cell;
use pigment::PigmentLibrary;
use volumes::pigments::{
    Density, Drawing, Facets, Film, FilmCounter, FilmHeights, FilmKind, FilmMaterial,
    FilmOnSurface, FilmPainter, FilmPainterSettings, FilmProfile, FilmScale, FilmThrough, FilmView,
    InsidePaint, SampleLattice, SampledSurface, SeenPlaces, UnderPainting,
};
use volumes::surfaces::VolumeSurfaces;
use volumes::volume::Volume;
use volumes::wetting::{SAMPLES_PER_CELL, SurfaceSamples};

const SIZE: (usize, usize) = (750, 570);
const SCALE: FilmScale = FilmScale { quantum_mm3: 1e-7, unit_mm: 40.0, cell_mm: 0.2 };

struct Scene {
    mesh: PackedMesh,
    facets: Facets,
    camera: Camera,
    visible: VisibilityBuffer,
    samples: SurfaceSamples,
    lattice: SampleLattice,
    volumes: Vec<Volume>,
    films: Vec<Film>,
    surfaces: VolumeSurfaces,
    color: Field<[f32; 4]>,
    ink: Field<f32>,
}

fn scene() -> &'static Scene {
    static SCENE: OnceLock<Scene> = OnceLock::new();
    SCENE.get_or_init(|| {
        let mesh = SampleModel::StillLife.mesh(60_000);
        let (width, height) = SIZE;
        let framing = Framing { aspect: width as f32 / height as f32, ..Framing::default() };
        let camera = framing.fit(&mesh.positions);
        let [low, high] = mesh.bounds();
        let cell = (high - low).max_element() / 12.0;
        let samples = SurfaceSamples::of(&mesh, cell, SAMPLES_PER_CELL, 1).unwrap();
        let lattice = SampleLattice::of(&samples.places, cell);
        let mut cells: Vec<(Vec3, Vec3)> = (0..samples.cell_count())
            .map(|cell| {
                let own = samples.of_cell(cell);
                let count = own.len() as f32;
                let place = samples.places[own.clone()].iter().sum::<Vec3>() / count;
                (place, samples.normals[own].iter().sum::<Vec3>().normalize_or_zero())
            })
            .collect();
        cells.sort_by(|a, b| a.0.distance(camera.eye).total_cmp(&b.0.distance(camera.eye)));
        cells.truncate(64);
        let volumes: Vec<Volume> = cells
            .iter()
            .enumerate()
            .map(|(seed, (place, normal)): (usize, &(Vec3, Vec3))| {
                let radius = cell * (0.5 + 0.05 * (seed % 8) as f32);
                let mut volume = Volume::ball(*place, radius, 2, seed as u64);
                volume.paint = Cell { pigments: [0; 8], vehicle: 100_000 };
                volume.paint.pigments[seed % 3] = 3_000_000;
                volume.normal = *normal;
                volume
            })
            .collect();
        let surface = SampledSurface::from(&samples);
        let profile = FilmProfile::default();
        let films = Film::of_volumes(&volumes, profile, (&surface, &lattice), &SCALE);
        let visible = visible(&mesh, &camera, width, height);
        let mesh = PackedMesh::new(&mesh);
        let lit = visible.values().iter().map(|&fragment| {
            if fragment.depth >= 1.0 {
                return [1.0; 4];
            }
            let point = SurfacePoint::new(&mesh, fragment);
            let tone = 0.3 + 0.7 * point.normal(camera.eye).y.max(0.0);
            let [r, g, b] = (point.albedo() * tone).to_array();
            [r, g, b, 0.2 * r + 0.7 * g + 0.1 * b]
        });
        let color = Field::from_values(width, height, lit.collect());
        let ink = Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|at: usize| if (at % width + at / width) % 9 < 3 { 0.7 } else { 0.0 })
                .collect(),
        );
        let surfaces = VolumeSurfaces::of(&volumes);
        let facets = Facets::of(&mesh);
        Scene {
            mesh,
            facets,
            camera,
            visible,
            samples,
            lattice,
            volumes,
            films,
            surfaces,
            color,
            ink,
        }
    })
}

fn painter(inside: InsidePaint) -> (FilmPainter, FilmView) {
    let library = Arc::new(PigmentLibrary::van_gogh_oils());
    let names = ["Ultramarine", "Chrome Yellow", "Vermilion", "Lead White", "Viridian"];
    let slots = palette_slots(&names.map(str::to_owned), &library).unwrap();
    let lighting = Lighting { relief: 0.0, ..Lighting::default() };
    let ground = GroundKind::Panel.spec(1);
    let material = FilmMaterial::new(library, ground, lighting.clone()).unwrap();
    let under = UnderPainting::Grisaille;
    let settings = FilmPainterSettings { under, inside, ..FilmPainterSettings::default() };
    let painter = FilmPainter::new(material, slots, None, settings).unwrap();
    let view = FilmView::new(&painter, &lighting).unwrap();
    (painter, view)
}

fn heights(scene: &Scene) -> Field<FilmHeights> {
    let seen = SeenPlaces::of(&scene.mesh, &scene.facets, &scene.visible);
    let films = FilmOnSurface { films: &scene.films, seen: &seen };
    Crossings::default().sum(&films, scene.surfaces.closed(), &scene.camera, &scene.visible)
}

#[divan::bench]
fn films_of_volumes(bencher: Bencher<'_, '_>) {
    let Scene { volumes, samples, lattice, .. } = scene();
    let surface = SampledSurface::from(samples);
    bencher.bench_local(|| {
        let profile = FilmProfile::default();
        black_box(Film::of_volumes(volumes, profile, (&surface, lattice), &SCALE))
    });
}

#[divan::bench]
fn seen_places(bencher: Bencher<'_, '_>) {
    let Scene { mesh, facets, visible, .. } = scene();
    bencher.bench_local(|| black_box(SeenPlaces::of(mesh, facets, visible)));
}

#[divan::bench]
fn heights_on_surface(bencher: Bencher<'_, '_>) {
    let Scene { mesh, facets, visible, films, surfaces, camera, .. } = scene();
    let seen = SeenPlaces::of(mesh, facets, visible);
    let films = FilmOnSurface { films, seen: &seen };
    let mut crossings = Crossings::default();
    bencher.bench_local(|| crossings.sum(&films, surfaces.closed(), camera, visible));
}

#[divan::bench]
fn heights_along_rays(bencher: Bencher<'_, '_>) {
    let Scene { mesh, facets, visible, volumes, surfaces, camera, .. } = scene();
    let seen = SeenPlaces::of(mesh, facets, visible);
    let densities: Vec<Density> = volumes.iter().map(|one| Density::of(one, &SCALE)).collect();
    let mut crossings = Crossings::default();
    bencher.bench_local(|| {
        let films = FilmThrough::new(&densities, camera, &seen.places, false);
        crossings.sum(&films, surfaces.closed(), camera, visible)
    });
}

#[divan::bench(args = ["glaze", "both"])]
fn picture(bencher: Bencher<'_, '_>, inside: &str) {
    let inside = if inside == "both" { InsidePaint::Both } else { InsidePaint::Glaze };
    let scene = scene();
    let (painter, view) = painter(inside);
    let films = heights(scene);
    let tint = films
        .values()
        .iter()
        .map(|heights: &FilmHeights| f32::from(u8::from(*heights != FilmHeights::default())))
        .collect();
    let tint = Field::from_values(SIZE.0, SIZE.1, tint);
    let drawing = Drawing {
        color: &scene.color,
        cover: None,
        ink: Some(&scene.ink),
        tint: Some(&tint),
        films: Some(&films),
    };
    bencher.bench_local(|| view.picture(&painter, &drawing).unwrap());
}

/// All that films add to a frame.
#[divan::bench]
fn frame(bencher: Bencher<'_, '_>) {
    let scene = scene();
    let (painter, view) = painter(InsidePaint::Glaze);
    let Scene { mesh, volumes, samples, camera, visible, color, ink, .. } = scene;
    let surface = SampledSurface::from(samples);
    let side = samples.lattice.cell;
    let mut counter = FilmCounter::new(mesh, &surface, side, FilmProfile::default(), SCALE);
    bencher.bench_local(|| {
        let films = counter.heights((mesh, &surface), volumes, FilmKind::Surface, camera, visible);
        let films = Some(&films);
        let ink = Some(ink);
        let drawing = Drawing { color, cover: None, ink, tint: None, films };
        view.picture(&painter, &drawing).unwrap()
    });
}

fn main() {
    divan::main();
}
