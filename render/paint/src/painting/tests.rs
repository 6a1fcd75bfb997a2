//! Tests of a painting at work: masks, tools, threads, and the stack of dry layers.

use documents::hint::Explain;
use graphics::gpu::BackendChoice;
use graphics::tile::Rect;
use pigment::library::PigmentLibrary;

use crate::amount::{mm_from_quanta, quanta_from_mm};
use crate::brush::{HeadShape, StrokeTool};
use crate::document::{Canvas, Document, LayerId, Lighting, Medium};
use crate::engine::{BrushId, PaintEngine};
use crate::ground::GroundSpec;
use crate::layer::{Cell, Layer, LayerRef, SLOTS};
use crate::painting::{OpenStroke, Painting, PaintingError, TakenPaint};
use crate::pose::Sample;
use crate::strokes::{Action, MaskChange};

/// Width of a cell in mm.
const CELL_MM: f64 = 0.2;

/// Width and height of the canvas in mm.
const SIZE_MM: (f64, f64) = (40.0, 16.0);

/// Paint of the left half: two pigments and vehicle. The right half has another pigment.
const SHARES: [f64; 3] = [0.5, 0.2, 0.3];

fn document(ground: &str) -> Document {
    let library = PigmentLibrary::van_gogh_oils();
    let ground: GroundSpec = serde_json::from_str(ground).unwrap();
    let canvas = Canvas { width_mm: SIZE_MM.0, height_mm: SIZE_MM.1, cell_mm: CELL_MM, ground };
    let mut slots = [None; SLOTS];
    for (slot, name) in slots.iter_mut().zip(["Zinc White", "Prussian Blue", "Chrome Yellow"]) {
        *slot = Some(library.find(name).unwrap());
    }
    let ground = canvas.ground(&library).unwrap();
    let medium = Medium::of(&library);
    Document::bare("", CELL_MM, ground, library, medium, slots, Lighting::default())
}

/// A film of `mm` mm: the left half of white, blue and vehicle, the right half of slot 2.
fn film(painting: &Painting, mm: f64) -> Layer {
    let bounds = painting.bounds();
    let mut wet = Layer::empty(bounds.width, bounds.height);
    for index in 0..bounds.width * bounds.height {
        let mut cell = wet.cell(index);
        if index % bounds.width < bounds.width / 2 {
            let [white, blue, vehicle] = SHARES.map(|share| quanta_from_mm(mm * share, CELL_MM));
            (cell.pigments[0], cell.pigments[1], cell.vehicle) = (white, blue, vehicle);
        } else {
            cell.pigments[2] = quanta_from_mm(mm, CELL_MM);
        }
        wet.set_cell(index, cell);
    }
    wet
}

/// A painting on the processor over `ground` (JSON), with a film of `mm` mm.
fn on_cpu(ground: &str, mm: f64) -> Painting {
    let document = document(ground);
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    with_film(document, engine, mm)
}

/// Such a painting on a graphics device. `None` without one.
fn on_gpu(ground: &str, mm: f64) -> Option<Painting> {
    let document = document(ground);
    let opened = PaintEngine::open(BackendChoice::Gpu, &document.ground.height).ok()?;
    Some(with_film(document, opened.engine, mm))
}

fn with_film(document: Document, engine: PaintEngine, mm: f64) -> Painting {
    let mut painting = Painting::open(document, engine, 1 << 28).unwrap();
    let wet = film(&painting, mm);
    painting.engine.set_wet(&wet).unwrap();
    painting
}

/// A brush of `size_mm` mm with a load of the right half's pigment.
fn loaded(painting: &mut Painting, shape: HeadShape, size_mm: f64) -> BrushId {
    let brush = painting.add_brush(shape, size_mm).unwrap();
    let mut recipe = [0.0; SLOTS];
    recipe[2] = 1.0;
    painting.load(brush, &recipe, 0.1, 0.3).unwrap();
    brush
}

/// A stroke along x at `y_mm`, from `from_mm` to `to_mm`.
fn along(y_mm: f64, (from_mm, to_mm): (f64, f64), pressure: f64) -> Vec<Sample> {
    (0..=12)
        .map(|step: u32| {
            let share = f64::from(step) / 12.0;
            let x_mm = from_mm + (to_mm - from_mm) * share;
            Sample { twist_deg: 90.0, ..Sample::upright(share, x_mm, y_mm, pressure) }
        })
        .collect()
}

/// Height in mm of the paint in the cell at a place in mm.
fn height_mm(wet: &Layer, x_mm: f64, y_mm: f64) -> f64 {
    let x = (x_mm / CELL_MM) as usize;
    let y = (y_mm / CELL_MM) as usize;
    let quanta = wet.cell(y * wet.width() + x).volume();
    mm_from_quanta(quanta, CELL_MM)
}

const LINEN: &str = r#"{"kind": "linen"}"#;

/// A triangle over the middle of the canvas.
fn triangle() -> MaskChange {
    MaskChange::PolygonMm(vec![[8.0, 1.0], [33.0, 7.0], [14.0, 15.0]])
}

/// Paints, blends and scrapes over the border of the mask.
fn work(painting: &mut Painting) {
    let brush = loaded(painting, HeadShape::Flat, 5.0);
    painting.stroke(brush, &along(6.0, (3.0, 37.0), 0.7)).unwrap();
    for (tool, y_mm) in [
        (StrokeTool::Blend { strength: 1.0 }, 8.0),
        (StrokeTool::Scrape { height_mm: 0.05 }, 10.0),
        (StrokeTool::Erase { strength: 0.7 }, 11.0),
    ] {
        painting.stroke_as(tool, brush, &along(y_mm, (37.0, 3.0), 0.7)).unwrap();
    }
}

/// Number of covered and of open cells whose paint differs.
fn changed(painting: &Painting, before: &Layer, after: &Layer) -> (usize, usize) {
    let mask = painting.mask().expect("a mask is set");
    let cells = 0..before.vehicle.values().len();
    let (covered, open): (Vec<usize>, Vec<usize>) = cells
        .filter(|&cell| before.cell(cell) != after.cell(cell))
        .partition(|&cell| mask.covers(cell));
    (covered.len(), open.len())
}

#[test]
fn strokes_change_no_covered_cell_and_undo_and_redo_move_the_mask_too() {
    let mut painting = on_cpu(LINEN, 0.3);
    let before = painting.wet().unwrap();
    assert!(painting.change_mask(&triangle()).unwrap());
    work(&mut painting);
    let after = painting.wet().unwrap();
    let (covered, open) = changed(&painting, &before, &after);
    assert!(covered == 0 && open > 1000, "{covered} covered and {open} open cells changed");
    assert!(painting.change_mask(&MaskChange::Inverse(true)).unwrap());
    work(&mut painting);
    let both = painting.wet().unwrap();
    let (covered, open) = changed(&painting, &after, &both);
    assert!(covered == 0 && open > 1000, "{covered} covered and {open} open cells changed");
    for _ in 0..9 {
        painting.undo().unwrap();
    }
    let triangular = painting.mask().expect("the first mask is set").clone();
    assert!(painting.wet().unwrap() == before, "all strokes are undone");
    painting.undo().unwrap();
    assert!(painting.mask().is_none(), "the mask is undone");
    while painting.redo().unwrap() {}
    assert!(painting.wet().unwrap() == both, "all is done again");
    assert_eq!(**painting.mask().unwrap(), triangular.inverse());
}

#[test]
fn both_backends_keep_off_the_mask_to_the_same_bits() {
    let Some(mut device) = on_gpu(LINEN, 0.3) else { return };
    let mut processor = on_cpu(LINEN, 0.3);
    for painting in [&mut device, &mut processor] {
        // Fluid paint levels after a stroke, also beside the head.
        painting.apply(&Action::Stiffness { value: 0.3 }).unwrap();
        painting.change_mask(&triangle()).unwrap();
        let brush = loaded(painting, HeadShape::Flat, 4.0);
        painting.stroke(brush, &along(6.0, (5.0, 15.0), 0.7)).unwrap();
        let erase = StrokeTool::Erase { strength: 0.7 };
        painting.stroke_as(erase, brush, &along(8.0, (12.0, 6.0), 0.7)).unwrap();
        painting.change_mask(&MaskChange::Clear {}).unwrap();
        painting.stroke(brush, &along(5.0, (5.0, 12.0), 0.5)).unwrap();
    }
    assert!(device.wet().unwrap() == processor.wet().unwrap(), "the backends differ");
}

#[test]
fn paint_that_levels_stays_on_its_side_of_the_border() {
    let mut painting = on_cpu(LINEN, 0.3);
    painting.apply(&Action::Stiffness { value: 0.0 }).unwrap();
    painting.change_mask(&triangle()).unwrap();
    let before = painting.wet().unwrap();
    let brush = loaded(&mut painting, HeadShape::Flat, 5.0);
    painting.stroke(brush, &along(6.0, (3.0, 37.0), 0.7)).unwrap();
    let after = painting.wet().unwrap();
    assert_eq!(changed(&painting, &before, &after).0, 0, "covered cells changed");
}

#[test]
fn a_mask_by_paint_locks_the_bare_canvas() {
    let mut painting = on_cpu(LINEN, 0.0);
    let brush = loaded(&mut painting, HeadShape::Flat, 4.0);
    painting.stroke(brush, &along(5.0, (4.0, 20.0), 0.6)).unwrap();
    painting.dry(1.0).unwrap();
    painting.stroke(brush, &along(11.0, (4.0, 20.0), 0.6)).unwrap();
    let dry = painting.dry_in(0, painting.bounds()).unwrap();
    let wet = painting.wet().unwrap();
    for (change, open) in [
        (MaskChange::Layer(LayerRef::Dry(0)), (true, false)),
        (MaskChange::Layer(LayerRef::Wet), (false, true)),
        (MaskChange::Painted {}, (true, true)),
    ] {
        painting.change_mask(&change).unwrap();
        let mask = painting.mask().unwrap();
        for cell in 0..wet.vehicle.values().len() {
            let wanted = open.0 && has_paint(&dry, cell) || open.1 && has_paint(&wet, cell);
            assert_eq!(mask.covers(cell), !wanted, "{change:?}, cell {cell}");
        }
    }
    let error = painting.change_mask(&MaskChange::Layer(LayerRef::Dry(1))).unwrap_err();
    assert!(matches!(error, PaintingError::NoLayer { index: 1, count: 1 }), "{error}");
}

fn has_paint(layer: &Layer, cell: usize) -> bool {
    layer.cell(cell).volume() > 0
}

#[test]
fn heaps_and_scraping_spare_covered_cells() {
    let mut painting = on_cpu(LINEN, 0.1);
    painting.change_mask(&triangle()).unwrap();
    let before = film(&painting, 0.1);
    let mut recipe = [0.0; SLOTS];
    recipe[0] = 1.0;
    painting.squeeze(&recipe, 0.0, 9.0, 4.0, 30.0).unwrap();
    let heap = painting.wet().unwrap();
    let (covered, open) = changed(&painting, &before, &heap);
    assert!(covered == 0 && open > 20, "{covered} and {open}");
    assert!(painting.scrape().unwrap());
    let scraped = painting.wet().unwrap();
    assert_eq!(changed(&painting, &heap, &scraped).0, 0);
    let mask = painting.mask().unwrap();
    let cells = scraped.vehicle.values().len();
    assert!(
        (0..cells).all(|cell| (scraped.cell(cell).volume() > 0) == mask.covers(cell)),
        "{CELL_MM} mm cells"
    );
}

#[test]
fn without_a_mask_there_is_none_to_invert_or_take_off() {
    let mut painting = on_cpu(LINEN, 0.1);
    assert!(!painting.change_mask(&MaskChange::Inverse(true)).unwrap());
    assert!(!painting.change_mask(&MaskChange::Clear {}).unwrap());
    assert_eq!(painting.undo_count(), 0);
}

const PANEL: &str = r#"{"kind": "panel"}"#;
const COARSE_LINEN: &str = r#"{"kind": "linen", "relief_mm": 0.2, "threads_per_cm": 8}"#;

const ERASE: StrokeTool = StrokeTool::Erase { strength: 0.5 };
const SCRAPE: StrokeTool = StrokeTool::Scrape { height_mm: 0.0 };
const BLEND: StrokeTool = StrokeTool::Blend { strength: 0.5 };

const TOOLS: [(StrokeTool, HeadShape); 5] = [
    (ERASE, HeadShape::Flat),
    (SCRAPE, HeadShape::Knife),
    (SCRAPE, HeadShape::Flat),
    (BLEND, HeadShape::Mop),
    (BLEND, HeadShape::Knife),
];

/// Moves `tool` with a head of `shape` along the middle of the canvas. Returns the paint that it
/// took off the canvas.
fn work_along(
    painting: &mut Painting,
    tool: StrokeTool,
    shape: HeadShape,
    pressure: f64,
) -> TakenPaint {
    let brush = loaded(painting, shape, 6.0);
    let samples = along(0.5 * SIZE_MM.1, (5.0, SIZE_MM.0 - 5.0), pressure);
    painting.stroke_as(tool, brush, &samples).unwrap().taken
}

fn with_taken(painting: &mut Painting, taken: TakenPaint) -> [u64; SLOTS + 1] {
    let totals = painting.wet().unwrap().totals();
    std::array::from_fn(|slot| totals[slot] + taken.quanta[slot])
}

#[test]
fn what_a_tool_takes_is_what_the_surface_loses_to_the_quantum_and_its_brush_keeps_its_paint() {
    for ground in [PANEL, COARSE_LINEN] {
        for (tool, shape) in TOOLS {
            let mut painting = on_cpu(ground, 0.2);
            let before = painting.wet().unwrap().totals();
            let brush = loaded(&mut painting, shape, 6.0);
            let load = painting.brush_paint(brush).unwrap();
            let samples = along(8.0, (5.0, 35.0), 0.6);
            let taken = painting.stroke_as(tool, brush, &samples).unwrap().taken;
            assert!(taken.volume_mm3(CELL_MM) > 0.01, "{tool:?}: {taken:?}");
            assert_eq!(with_taken(&mut painting, taken), before, "{tool:?}, {shape}");
            assert!(painting.brush_paint(brush).unwrap() == load, "{tool:?}: the brush changed");
        }
    }
}

#[test]
fn both_backends_work_to_the_same_bits() {
    for (tool, shape) in [TOOLS[0], TOOLS[1], TOOLS[3]] {
        let Some(mut device) = on_gpu(COARSE_LINEN, 0.2) else { return };
        let mut processor = on_cpu(COARSE_LINEN, 0.2);
        let samples = along(8.0, (12.0, 22.0), 0.6);
        let [taken, on_device] = [&mut processor, &mut device].map(|painting: &mut Painting| {
            let brush = loaded(painting, shape, 4.0);
            painting.stroke_as(tool, brush, &samples).unwrap().taken
        });
        assert_eq!(on_device, taken, "{tool:?}, {shape}");
        assert!(device.wet().unwrap() == processor.wet().unwrap(), "{tool:?}, {shape}");
    }
}

#[test]
fn an_undo_brings_the_paint_back_and_a_redo_takes_it_again() {
    for (tool, shape) in TOOLS {
        let mut painting = on_cpu(COARSE_LINEN, 0.2);
        let before = painting.wet().unwrap();
        work_along(&mut painting, tool, shape, 0.6);
        let after = painting.wet().unwrap();
        assert!(after != before, "{tool:?} did nothing");
        painting.undo().unwrap();
        assert!(painting.wet().unwrap() == before, "{tool:?}, undone");
        painting.redo().unwrap();
        assert!(painting.wet().unwrap() == after, "{tool:?}, done again");
    }
}

#[test]
fn portions_of_any_size_take_the_same() {
    let samples = along(8.0, (3.0, 37.0), 0.7);
    for (tool, shape) in TOOLS {
        let mut whole = on_cpu(COARSE_LINEN, 0.4);
        let mut pieces = on_cpu(COARSE_LINEN, 0.4);
        let brush = loaded(&mut whole, shape, 6.0);
        let report = whole.stroke_as(tool, brush, &samples).unwrap();
        let brush = loaded(&mut pieces, shape, 6.0);
        let mut stroke: OpenStroke = pieces.begin_stroke(tool, brush).unwrap();
        for (index, sample) in samples.iter().enumerate() {
            stroke.extend(&[*sample]).unwrap();
            stroke.advance(&mut pieces, 1 + 13 * index).unwrap();
        }
        assert_eq!(stroke.finish(&mut pieces).unwrap(), report, "{tool:?}");
        assert!(pieces.wet().unwrap() == whole.wet().unwrap(), "{tool:?}");
    }
}

#[test]
fn a_rag_takes_more_with_pressure_strength_and_passes_and_never_from_below() {
    let (little, left) = rubbed(0.3, 0.4, 1);
    for (more, less_left) in [rubbed(0.3, 0.8, 1), rubbed(0.9, 0.4, 1), rubbed(0.3, 0.4, 3)] {
        assert!(
            more > 1.1 * little && less_left < 0.8 * left,
            "{more} {less_left}: {little} {left}"
        );
    }
    let (_, left) = rubbed(1.0, 1.0, 3);
    assert!(left < 1e-4, "{left} mm stay after rubbing hard");
    let mut dry = on_cpu(PANEL, 0.1);
    dry.dry(1.0).unwrap();
    let layer = dry.dry_in(0, dry.bounds()).unwrap();
    assert_eq!(work_along(&mut dry, ERASE, HeadShape::Flat, 1.0), TakenPaint::default());
    assert!(dry.dry_in(0, dry.bounds()).unwrap() == layer, "dry paint came off");
}

/// Paint in mm3 that a rag takes, and the height in mm that stays on its way.
fn rubbed(strength: f64, pressure: f64, passes: usize) -> (f64, f64) {
    let mut painting = on_cpu(PANEL, 0.1);
    let brush = loaded(&mut painting, HeadShape::Flat, 6.0);
    let samples = along(8.0, (5.0, 35.0), pressure);
    let tool = StrokeTool::Erase { strength };
    let sum = (0..passes)
        .map(|_| painting.stroke_as(tool, brush, &samples).unwrap().taken.volume_mm3(CELL_MM));
    let sum: f64 = sum.sum();
    (sum, height_mm(&painting.wet().unwrap(), 20.0, 8.0))
}

#[test]
fn the_mark_of_a_rag_has_soft_edges() {
    let mut painting = on_cpu(PANEL, 0.1);
    work_along(&mut painting, ERASE, HeadShape::Round, 0.8);
    let wet = painting.wet().unwrap();
    let across: Vec<f64> =
        (0..80).map(|row| height_mm(&wet, 20.0, (f64::from(row) + 0.5) * CELL_MM)).collect();
    let between = across.iter().filter(|mm| (0.02..0.09).contains(*mm)).count();
    assert!(across.iter().any(|&mm| mm < 0.02), "{across:?}");
    assert!(between >= 4, "{between} cells between bare and untouched: {across:?}");
}

#[test]
fn a_blade_leaves_its_height_and_pressure_lowers_it() {
    for (height_mm_set, pressure, wanted) in
        [(0.0, 0.5, 0.0), (0.1, 0.5, 0.05), (0.08, 0.2, 0.064), (0.1, 1.0, 0.0)]
    {
        let mut painting = on_cpu(PANEL, 0.3);
        let tool = StrokeTool::Scrape { height_mm: height_mm_set };
        work_along(&mut painting, tool, HeadShape::Knife, pressure);
        let found = height_mm(&painting.wet().unwrap(), 20.0, 8.0);
        assert!((found - wanted).abs() < 2e-3, "{height_mm_set} {pressure}: {found}");
    }
    // A blade above the paint takes nothing.
    let mut painting = on_cpu(PANEL, 0.1);
    let high = StrokeTool::Scrape { height_mm: 0.5 };
    assert_eq!(work_along(&mut painting, high, HeadShape::Knife, 0.3), TakenPaint::default());
}

#[test]
fn scraping_leaves_paint_in_the_valleys_of_linen_and_frees_its_crests() {
    let mut painting = on_cpu(COARSE_LINEN, 0.1);
    work_along(&mut painting, SCRAPE, HeadShape::Knife, 0.8);
    let wet = painting.wet().unwrap();
    let floor = painting.engine.floor().unwrap();
    let width = wet.width();
    let rows = 36..44;
    let cells = rows.flat_map(|y| (70..130).map(move |x| y * width + x));
    let mut found: Vec<(i32, f64)> = cells
        .map(|at| (floor.values()[at], mm_from_quanta(wet.cell(at).volume(), CELL_MM)))
        .collect();
    found.sort_by_key(|(floor, _)| *floor);
    let tenth = found.len() / 10;
    let valleys = mean(&found[..tenth]);
    let crests = mean(&found[found.len() - tenth..]);
    assert!(valleys > 0.05 && crests < 0.005, "valleys {valleys} mm, crests {crests} mm");
}

fn mean(part: &[(i32, f64)]) -> f64 {
    part.iter().map(|(_, mm)| mm).sum::<f64>() / part.len() as f64
}

#[test]
fn a_mop_softens_an_edge_and_takes_little() {
    let mut painting = on_cpu(PANEL, 0.2);
    assert!(white_share(&mut painting, 20.5) > 0.99 && white_share(&mut painting, 19.5) < 0.01);
    let before = painting.wet().unwrap().totals().iter().sum::<u64>() as f64;
    // The brush is loaded with the right half's pigment, which must not reach the left.
    let brush = loaded(&mut painting, HeadShape::Mop, 6.0);
    let taken = painting.stroke_as(BLEND, brush, &along(8.0, (12.0, 28.0), 0.5)).unwrap().taken;
    let left = white_share(&mut painting, 15.0);
    let near = white_share(&mut painting, 20.5);
    let far = white_share(&mut painting, 24.0);
    assert!(left < 0.01, "{left}: the load of the brush went onto the canvas");
    assert!((0.05..0.9).contains(&near), "{near} beside the edge");
    assert!(far > near, "{near} at the edge, {far} beyond it");
    let lost = taken.quanta.iter().sum::<u64>() as f64 / before;
    assert!(lost < 0.04, "{lost} of all paint");
    let height = height_mm(&painting.wet().unwrap(), 20.0, 8.0);
    assert!((0.12..0.3).contains(&height), "{height} mm of 0.2 under the mop");
}

fn white_share(painting: &mut Painting, x_mm: f64) -> f64 {
    let wet = painting.wet().unwrap();
    let x = (x_mm / CELL_MM) as usize;
    let y = (8.0 / CELL_MM) as usize;
    let cell = wet.cell(y * wet.width() + x);
    f64::from(cell.pigments[2]) / f64::from(cell.volume().max(1))
}

#[test]
fn a_mop_softens_an_edge_along_its_way_too() {
    let mut painting = on_cpu(PANEL, 0.2);
    let brush = painting.add_brush(HeadShape::Mop, 6.0).unwrap();
    let mut samples = along(8.0, (0.0, 0.0), 0.5);
    for (sample, step) in samples.iter_mut().zip(0_u8..) {
        (sample.x_mm, sample.y_mm, sample.twist_deg) = (20.0, 2.0 + f64::from(step), 0.0);
    }
    painting.stroke_as(StrokeTool::Blend { strength: 1.0 }, brush, &samples).unwrap();
    let wet = painting.wet().unwrap();
    let share = |x_mm: f64| {
        let cell = wet.cell((8.0 / CELL_MM) as usize * wet.width() + (x_mm / CELL_MM) as usize);
        f64::from(cell.pigments[2]) / f64::from(cell.volume().max(1))
    };
    let left = share(19.7);
    let right = share(20.3);
    assert!(left > 0.05 && right < 0.95 && left < right, "{left} and {right} beside the edge");
    assert!(share(15.0) < 0.01 && share(25.0) > 0.99, "beyond the head");
}

#[test]
fn a_tool_out_of_range_is_refused_before_anything_changes() {
    let mut painting = on_cpu(PANEL, 0.1);
    let brush = loaded(&mut painting, HeadShape::Flat, 6.0);
    for tool in [
        StrokeTool::Erase { strength: 0.0 },
        StrokeTool::Blend { strength: 1.01 },
        StrokeTool::Blend { strength: f64::NAN },
        StrokeTool::Scrape { height_mm: -0.1 },
        StrokeTool::Scrape { height_mm: f64::INFINITY },
    ] {
        let error = painting.stroke_as(tool, brush, &along(8.0, (5.0, 9.0), 0.5)).unwrap_err();
        assert!(error.to_string().contains(tool.name()), "{error}");
        assert_eq!(painting.undo_count(), 0);
    }
}

/// Paint of the canvas and the brush after a stroke of a flat that covers most of the canvas.
fn painted(threads: usize) -> (Layer, Layer) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut painting = on_cpu(r#"{"kind": "linen"}"#, 0.1);
        let brush = loaded(&mut painting, HeadShape::Flat, 28.0);
        let report = painting.stroke(brush, &along(8.0, (15.0, 25.0), 0.9)).unwrap();
        assert!(report.cells / report.substeps > 6_000, "{report:?}");
        (painting.wet().unwrap().clone(), painting.brush_paint(brush).unwrap())
    })
}

#[test]
fn a_wide_stroke_is_the_same_on_one_thread_and_on_eight() {
    let alone = painted(1);
    for threads in [2, 5, 8] {
        assert!(painted(threads) == alone, "on {threads} threads");
    }
}

const WIDTH: usize = 90;
const HEIGHT: usize = 70;

fn id(number: u32) -> LayerRef {
    LayerRef::Id(LayerId(number))
}

fn named(layer: LayerRef, name: &str) -> Action {
    Action::Name { layer, name: name.to_owned() }
}

/// An even film of the pigment in `slot`, `amount` quanta high, over `rect`.
fn slot_film(slot: usize, amount: u32, rect: Rect) -> Layer {
    let mut layer = Layer::empty(WIDTH, HEIGHT);
    for y in rect.y..rect.y + rect.height {
        for x in rect.x..rect.x + rect.width {
            let mut cell = Cell::default();
            cell.pigments[slot] = amount;
            layer.set_cell(y * WIDTH + x, cell);
        }
    }
    layer
}

const fn rect(x: usize, width: usize) -> Rect {
    Rect { x, y: 10, width, height: 40 }
}

/// A painting with these dry layers, lowest first: slot, quanta and place of each film.
fn painting(films: &[(usize, u32, Rect)]) -> Painting {
    let library = PigmentLibrary::van_gogh_oils();
    let ground = GroundSpec::default().build(WIDTH, HEIGHT, 0.1, &library).unwrap();
    let [white, blue] = ["Lead White", "Prussian Blue"].map(|name| library.find(name).unwrap());
    let mut others = library.ids().filter(|&other| other != white && other != blue);
    let slots = std::array::from_fn(|slot| match slot {
        0 => Some(white),
        3 => Some(blue),
        _ => others.next(),
    });
    let medium = Medium::default();
    let lighting = Lighting::default();
    let mut document = Document::bare("", 0.1, ground, library, medium, slots, lighting);
    for &(slot, amount, rect) in films {
        document.push_dry(slots, slot_film(slot, amount, rect));
    }
    opened(document)
}

fn opened(document: Document) -> Painting {
    let engine = PaintEngine::on_cpu(document.ground.height.clone());
    Painting::open(document, engine, 1 << 26).unwrap()
}

/// Asserts that picture and relief equal the picture and relief of the painting opened anew.
fn assert_as_new(painting: &mut Painting, after: &str) {
    let mut new = opened(painting.document().unwrap());
    assert!(painting.picture().unwrap() == new.picture().unwrap(), "picture after {after}");
    assert!(painting.engine.floor().unwrap() == new.engine.floor().unwrap(), "floor after {after}");
}

fn ids(painting: &Painting) -> Vec<u32> {
    painting.state().dry.iter().map(|layer| layer.id.0).collect()
}

const THICK: u32 = 1 << 20;

#[test]
fn a_moved_layer_covers_what_it_lies_over_and_the_relief_stays() {
    let mut painting =
        painting(&[(0, THICK, rect(5, 40)), (3, THICK, rect(25, 40)), (5, THICK, rect(10, 70))]);
    let before = painting.picture().unwrap();
    let whole = painting.document().unwrap();
    let floor = painting.engine.floor().unwrap();
    assert!(painting.apply(&Action::Order { layer: id(1), to: 2 }).unwrap(), "it lay below");
    assert_eq!(ids(&painting), [2, 3, 1]);
    assert!(painting.engine.floor().unwrap() == floor, "heights add up in any order");
    let after = painting.picture().unwrap();
    assert!(after[(30, 30)] != before[(30, 30)], "the first is on top now");
    assert_as_new(&mut painting, "a move");
    assert!(
        !painting.apply(&Action::Order { layer: id(1), to: 2 }).unwrap(),
        "it is there already"
    );
    assert!(painting.undo().unwrap() && painting.document().unwrap() == whole, "undo");
    assert!(painting.picture().unwrap() == before, "the picture after undo");
    assert!(painting.redo().unwrap() && ids(&painting) == [2, 3, 1], "redo");
    assert!(painting.picture().unwrap() == after, "the picture after redo");
    let error = painting.apply(&Action::Order { layer: id(1), to: 3 }).unwrap_err();
    assert!(matches!(error, PaintingError::NoLayer { index: 3, count: 3 }), "{error}");
    assert_eq!(painting.undo_bytes().0, 0, "an order takes no memory");
}

#[test]
fn a_hidden_layer_keeps_opacity_and_relief() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (3, THICK, rect(25, 40))]);
    painting.set_opacity(id(2), 0.7).unwrap();
    let shown = painting.picture().unwrap();
    let floor = painting.engine.floor().unwrap();
    painting.apply(&Action::Visible { layer: id(2), value: false }).unwrap();
    assert!(painting.picture().unwrap() != shown, "nothing was hidden");
    assert_as_new(&mut painting, "hiding");
    let layer = painting.state().dry[1].clone();
    assert_eq!((layer.opacity, layer.shown_opacity()), (0.7, 0.0));
    assert!(painting.engine.floor().unwrap() == floor, "its height stays");
    painting.apply(&Action::Visible { layer: id(2), value: true }).unwrap();
    assert!(painting.picture().unwrap() == shown, "not as before");
    painting.undo().unwrap();
    assert!(!painting.state().dry[1].visible, "undone");
}

#[test]
fn names_are_undone_and_checked() {
    let mut painting = painting(&[(0, THICK, rect(5, 40))]);
    painting.apply(&named(LayerRef::Dry(0), "sky")).unwrap();
    assert_eq!(painting.state().dry[0].label(), "sky");
    assert!(painting.undo().unwrap() && painting.state().dry[0].label() == "Layer 1");
    assert!(painting.redo().unwrap() && painting.state().dry[0].label() == "sky");
    let error = painting.apply(&named(id(1), "a\nb")).unwrap_err();
    assert!(error.to_string().starts_with("name: a name on one line"), "{error}");
    let error = painting.apply(&named(LayerRef::Wet, "wet")).unwrap_err();
    assert!(matches!(error, PaintingError::WetLayer(..)), "{error}");
    let error = painting.apply(&named(id(7), "x")).unwrap_err().to_string();
    assert_eq!(error, "there is no layer 7; the painting has 1");
}

#[test]
fn an_identity_is_not_given_again_after_a_merge() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (0, THICK, rect(25, 40))]);
    painting.merge(id(2), id(1)).unwrap();
    assert_eq!(ids(&painting), [1]);
    let mut again = opened(painting.document().unwrap());
    again.squeeze(&[1.0; 8], 0.0, 4.0, 3.0, 1.0).unwrap();
    again.dry(1.0).unwrap();
    assert_eq!(ids(&again), [1, 3], "2 was the merged one");
}

#[test]
fn layers_apart_merge_past_films_that_they_do_not_touch() {
    let left = rect(5, 20);
    let right = rect(30, 20);
    let mut painting = painting(&[(0, THICK, left), (3, THICK, right), (5, THICK, rect(70, 10))]);
    painting.apply(&named(id(3), "edge")).unwrap();
    let picture = painting.picture().unwrap();
    let whole = painting.document().unwrap();
    painting.merge(id(1), id(3)).unwrap();
    assert_eq!(ids(&painting), [1, 2]);
    assert_eq!(painting.state().dry[0].name, "edge", "the lower had no name");
    assert!(painting.picture().unwrap() == picture, "it shows");
    assert_as_new(&mut painting, "a merge");
    assert!(painting.undo().unwrap() && painting.document().unwrap() == whole, "undo");
    assert!(painting.redo().unwrap() && ids(&painting) == [1, 2], "redo");
    assert_as_new(&mut painting, "redo");
}

#[test]
fn the_lower_layer_rises_if_only_it_is_free() {
    let mut painting =
        painting(&[(0, THICK, rect(5, 20)), (3, THICK, rect(40, 20)), (0, THICK, rect(30, 20))]);
    painting.merge(id(3), id(1)).unwrap();
    assert_eq!(ids(&painting), [2, 1], "it lies where the upper was");
    assert_as_new(&mut painting, "a merge");
}

#[test]
fn a_film_between_that_touches_both_forbids_a_merge_and_is_named() {
    let mut painting =
        painting(&[(0, THICK, rect(5, 30)), (3, THICK, rect(25, 30)), (0, THICK, rect(40, 30))]);
    painting.apply(&named(id(2), "water")).unwrap();
    let whole = painting.document().unwrap();
    let error = painting.merge(id(1), id(3)).unwrap_err();
    assert_eq!(error.to_string(), "`water` lies between the two layers and overlaps both");
    assert!(error.hint().is_some_and(|hint| hint.to_string().contains("move that layer")));
    assert!(painting.document().unwrap() == whole, "something changed");
    painting.apply(&Action::Order { layer: id(2), to: 2 }).unwrap();
    painting.merge(id(1), id(3)).unwrap();
    assert_eq!(ids(&painting), [1, 2]);
}

#[test]
fn opacities_become_part_of_the_merged_paint() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (0, THICK, rect(30, 40))]);
    painting.set_opacity(id(1), 0.25).unwrap();
    painting.set_opacity(id(2), 0.5).unwrap();
    let picture = painting.picture().unwrap();
    let floor = painting.engine.floor().unwrap();
    painting.merge(id(1), id(2)).unwrap();
    let layer = &painting.document().unwrap().dry[0];
    let cell = |x: usize| layer.paint.cell(30 * WIDTH + x);
    assert_eq!((layer.opacity, cell(10).pigments[0]), (0.5, THICK / 2), "a quarter of it shows");
    assert_eq!((cell(10).vehicle, cell(60).vehicle), (THICK / 2, 0));
    assert_eq!(cell(35).pigments[0], THICK + THICK / 2, "both in one cell");
    assert!(painting.engine.floor().unwrap() == floor, "heights stay");
    let merged = painting.picture().unwrap();
    let moved = picture
        .values()
        .iter()
        .zip(merged.values())
        .filter(|(a, b)| (0..3).any(|i| (a[i] - b[i]).abs() > 1e-4))
        .count();
    assert_eq!(moved, 0, "cells that changed colour");
    painting.undo().unwrap();
    painting.apply(&Action::Visible { layer: id(2), value: false }).unwrap();
    let error = painting.merge(id(1), id(2)).unwrap_err();
    assert!(matches!(error, PaintingError::UnlikeVisibility), "{error}");
}

#[test]
fn hidden_layers_merge_only_if_it_would_not_show() {
    let mut painting = painting(&[(0, THICK, rect(5, 40)), (3, THICK, rect(30, 40))]);
    for layer in [id(1), id(2)] {
        painting.apply(&Action::Visible { layer, value: false }).unwrap();
    }
    let error = painting.merge(id(1), id(2)).unwrap_err();
    assert!(matches!(error, PaintingError::MergeShows { .. }), "{error}");
    assert!(!painting.state().dry[0].visible, "it is shown after the trial");
    assert_as_new(&mut painting, "a refused merge");
}

#[test]
fn more_pigments_than_a_layer_holds_are_named() {
    let mut document = painting(&[]).document().unwrap();
    let mut eight = Layer::empty(WIDTH, HEIGHT);
    for slot in 0..8 {
        let mut cell = eight.cell(slot);
        cell.pigments[slot] = 100;
        eight.set_cell(slot, cell);
    }
    let slots = document.slots;
    document.push_dry(slots, eight);
    let mut others = slots;
    let library = document.library.clone();
    let mut more = library.ids().filter(|&more| !slots.contains(&Some(more)));
    (others[0], others[1]) = (more.next(), more.next());
    document.push_dry(others, slot_film(0, 100, Rect { x: 40, y: 3, width: 8, height: 8 }));
    let mut painting = opened(document);
    let error = painting.merge(id(2), id(1)).unwrap_err();
    let PaintingError::MergedPigments(pigments) = &error else { panic!("{error}") };
    let ninth = library[others[0].unwrap()].name.clone();
    // The tenth is on the palette of the second layer, but not in its paint.
    assert_eq!((pigments.len(), pigments.last()), (9, Some(&ninth)));
    assert!(error.to_string().contains(&ninth) && error.hint().is_some(), "{error}");
    let error = painting.merge(id(2), id(2)).unwrap_err();
    assert!(matches!(error, PaintingError::SameLayer), "{error}");
}
