//! Benchmarks of painterly rendering: frames of the sizes and numbers of strokes of table 1 of Yan,
//! Chi, Lee and Lin (2008), and what a model costs once.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::fmt;
use std::sync::OnceLock;

use artmap::map::ArtMap;
use artmap::painted::{PaintedSettings, Style, painted_samples};
use artmap::sample::PaintOfSamples;
use artmap::synthesis::SynthesisSettings;
use divan::{Bencher, black_box};
use graphics::camera::{Camera, Framing, PictureView};
use graphics::export::frame_png;
use graphics::field::Field;
use graphics::mesh::{Mesh, SampleModel};
use graphics::picture::Photograph;
use paint::document::{Document, Lighting};
use paint::ground::GroundKind;
use paint::light::Light;
use paint::scene::{picture, scene};
use painterly::{ColorPaint, ColorPaintSettings, FilmHeight, Painter, Settings, paint_layer};

/// A row of the table.
#[derive(Clone, Copy)]
struct Row {
    name: &'static str,
    shape: SampleModel,
    splats: usize,
    /// Number of splats along outlines.
    outlines: usize,
    size: (usize, usize),
    /// Frames per second that the paper reports.
    published: f64,
}

const LARGE: (usize, usize) = (1280, 1024);

const ROWS: [Row; 8] = [
    Row {
        name: "ball",
        shape: SampleModel::Sphere,
        splats: 3311,
        outlines: 0,
        size: (640, 480),
        published: 72.0,
    },
    Row {
        name: "bunny, hatching",
        shape: SampleModel::TorusKnot,
        splats: 8549,
        outlines: 0,
        size: LARGE,
        published: 28.1,
    },
    Row {
        name: "bunny",
        shape: SampleModel::TorusKnot,
        splats: 9941,
        outlines: 0,
        size: LARGE,
        published: 21.4,
    },
    Row {
        name: "lion vase",
        shape: SampleModel::StillLife,
        splats: 17_972,
        outlines: 0,
        size: LARGE,
        published: 15.6,
    },
    Row {
        name: "gargoyle",
        shape: SampleModel::Village,
        splats: 22_248,
        outlines: 0,
        size: LARGE,
        published: 9.7,
    },
    Row {
        name: "lion vase with outlines",
        shape: SampleModel::StillLife,
        splats: 17_972,
        outlines: 6848,
        size: LARGE,
        published: 10.0,
    },
    Row {
        name: "David with outlines",
        shape: SampleModel::TorusKnot,
        splats: 9776,
        outlines: 23_232,
        size: LARGE,
        published: 7.9,
    },
    Row {
        name: "gargoyle with outlines",
        shape: SampleModel::Village,
        splats: 22_248,
        outlines: 14_240,
        size: LARGE,
        published: 6.4,
    },
];

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, splats, outlines, published, .. } = self;
        let most = 1000.0 / published;
        write!(f, "{name} ({splats} + {outlines} splats; published {published} fps, {most:.1} ms)")
    }
}

fn map() -> &'static ArtMap {
    static MAP: OnceLock<ArtMap> = OnceLock::new();
    MAP.get_or_init(|| {
        let mut style = Style::named("oil-flat").unwrap();
        style.canvas.side_cells = 160;
        let settings = PaintedSettings { tones: 4, ..PaintedSettings::default() };
        let samples = painted_samples(&style, &settings).unwrap();
        ArtMap::of(&samples, &SynthesisSettings::default()).unwrap()
    })
}

fn camera(mesh: &Mesh, (width, height): (usize, usize)) -> Camera {
    let framing = Framing { aspect: width as f32 / height as f32, ..Framing::default() };
    framing.fit(&mesh.positions)
}

/// A painter with strokes and outlines so wide that as many splats are drawn as the row has.
fn painter(row: Row) -> (Painter, Camera) {
    let mesh = row.shape.mesh(20_000);
    let camera = camera(&mesh, row.size);
    let mut settings = Settings::default();
    let count = |settings: &Settings| {
        let mut painter = Painter::of_model(&mesh, map(), settings).unwrap();
        let splats = painter.splats(&camera, row.size, 0.0).unwrap().1.concat().len();
        (painter, splats as f32)
    };
    let (mut painter, strokes) = loop {
        let (painter, found) = count(&settings);
        let ratio = found / row.splats as f32;
        if (ratio - 1.0).abs() < 0.02 {
            break (painter, found);
        }
        settings.strokes.width_px *= ratio.sqrt();
    };
    if row.outlines > 0 {
        settings.silhouette.width_px = 4.0;
        loop {
            let found;
            (painter, found) = count(&settings);
            let ratio = (found - strokes) / row.outlines as f32;
            if (ratio - 1.0).abs() < 0.05 {
                break;
            }
            // Of splats twice as wide and long a line of twice the width has fewer: 1 / 2^1.5.
            settings.silhouette.width_px *= ratio.powf(2.0 / 3.0);
        }
    }
    (painter, camera)
}

/// A whole frame: its strokes and the three passes.
#[divan::bench(args = ROWS, sample_count = 20)]
fn frame(bencher: Bencher<'_, '_>, row: Row) {
    let (mut painter, camera) = painter(row);
    bencher.bench_local(|| painter.paint(black_box(&camera), row.size, 0.0).unwrap());
}

/// The depth of the mesh and the strokes of a view.
#[divan::bench(args = ROWS, sample_count = 20)]
fn strokes(bencher: Bencher<'_, '_>, row: Row) {
    let (mut painter, camera) = painter(row);
    bencher.bench_local(|| painter.splats(black_box(&camera), row.size, 0.0).unwrap());
}

/// The row that pigments are measured with, about as many splats as the bunny of the paper.
const PAINTED: Row = Row { splats: 10_000, ..ROWS[2] };

/// A painting with the pigments of the map.
fn document(painter: &mut Painter, camera: &Camera) -> Document {
    let ground = GroundKind::Panel.spec(1);
    painter.painting(camera, PAINTED.size, 0.0, ("bench", &ground)).unwrap()
}

/// From the camera to the lit picture of a painting with pigments and relief.
#[divan::bench(sample_count = 10)]
fn lit_painting(bencher: Bencher<'_, '_>) {
    let (mut painter, camera) = painter(PAINTED);
    let first = document(&mut painter, &camera);
    let light = Light::named(&first.library, "D65", "1931-2").unwrap();
    bencher.bench_local(|| {
        let document = document(&mut painter, black_box(&camera));
        picture(&document, &scene(&document, &light))
    });
}

/// The strokes of the lit painting alone.
#[divan::bench(sample_count = 10)]
fn lit_painting_strokes(bencher: Bencher<'_, '_>) {
    let (mut painter, camera) = painter(PAINTED);
    bencher.bench_local(|| painter.splats(black_box(&camera), PAINTED.size, 0.0).unwrap());
}

/// The strokes, amounts and document of the lit painting.
#[divan::bench(sample_count = 10)]
fn lit_painting_document(bencher: Bencher<'_, '_>) {
    let (mut painter, camera) = painter(PAINTED);
    bencher.bench_local(|| document(&mut painter, black_box(&camera)));
}

/// The ground of the lit painting alone.
#[divan::bench(sample_count = 10)]
fn lit_painting_ground(bencher: Bencher<'_, '_>) {
    let (mut painter, camera) = painter(PAINTED);
    let Document { library, cell_mm, .. } = document(&mut painter, &camera);
    let spec = GroundKind::Panel.spec(1);
    let (width, height) = PAINTED.size;
    bencher.bench_local(|| spec.build(width, height, black_box(cell_mm), &library).unwrap());
}

/// The light of the lit painting alone.
#[divan::bench(sample_count = 10)]
fn lit_painting_light(bencher: Bencher<'_, '_>) {
    let (mut painter, camera) = painter(PAINTED);
    let document = document(&mut painter, &camera);
    let light = Light::named(&document.library, "D65", "1931-2").unwrap();
    bencher.bench_local(|| {
        let document = black_box(&document);
        picture(document, &scene(document, &light))
    });
}

/// Amounts of pigments for the colours of a picture, and a layer made of them.
#[divan::bench(sample_count = 10)]
fn paint_of_colors(bencher: Bencher<'_, '_>) {
    let (mut painter, camera) = painter(PAINTED);
    let painted = painter.paint(&camera, PAINTED.size, 0.0).unwrap();
    let paint = color_paint();
    let film = FilmHeight::of(map());
    bencher.bench_local(|| paint_layer(&paint.amounts(black_box(&painted), film), 0.25));
}

/// One-time cost of the mixtures of a palette.
#[divan::bench(sample_count = 3)]
fn mixtures(bencher: Bencher<'_, '_>) {
    bencher.bench_local(color_paint);
}

fn color_paint() -> ColorPaint {
    let PaintOfSamples { library, slots } = map().paint.clone().unwrap();
    let ground = GroundKind::Panel.spec(1);
    let settings = ColorPaintSettings::default();
    ColorPaint::new(library, slots, (&ground, &Lighting::default()), &settings).unwrap()
}

/// A photograph of one megapixel, from its pixels to the painted picture. This includes laying out
/// the map. The paper reports no figure.
#[divan::bench(sample_count = 5)]
fn photograph(bencher: Bencher<'_, '_>) {
    let pixels = Field::from_values(
        1224,
        817,
        (0..1224 * 817)
            .map(|at: usize| {
                let x = at % 1224;
                let y = at / 1224;
                let wave = (x as f32 * 0.02).sin() * (y as f32 * 0.013).cos();
                [128.0 + 90.0 * wave, 120.0 - 70.0 * wave, (x % 97) as f32 + 60.0]
                    .map(|value| value as u8)
            })
            .collect(),
    );
    let photograph = Photograph::from_bytes("bench", &frame_png(&pixels).unwrap()).unwrap();
    let camera = PictureView::of(photograph.size()).camera();
    bencher.bench_local(|| {
        let mut painter =
            Painter::of_picture(black_box(&photograph), map(), &Settings::default()).unwrap();
        painter.paint(&camera, (1224, 817), 0.0).unwrap()
    });
}

/// One-time cost of a model of 20,000 triangles: directions, tones, matched offsets.
#[divan::bench(args = ["torus-knot", "still-life"], sample_count = 3)]
fn model(bencher: Bencher<'_, '_>, shape: &str) {
    let mesh = SampleModel::from_name(shape).unwrap().mesh(20_000);
    let map = map();
    bencher.bench_local(|| Painter::of_model(black_box(&mesh), map, &Settings::default()).unwrap());
}

fn main() {
    divan::main();
}
