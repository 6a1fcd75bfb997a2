//! Blending, scraping and erasing wet paint.

use super::bench::{CELL_MM, SIZE_MM, along, height_mm, loaded, on_cpu, on_gpu};
use crate::amount::mm_from_quanta;
use crate::brush::{HeadShape, StrokeTool};
use crate::layer::SLOTS;
use crate::painting::{OpenStroke, Painting, TakenPaint};

const PANEL: &str = r#"{"kind": "panel"}"#;
const LINEN: &str = r#"{"kind": "linen", "relief_mm": 0.2, "threads_per_cm": 8}"#;

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

/// Works along the middle of the canvas, and returns what was taken.
fn work(painting: &mut Painting, tool: StrokeTool, shape: HeadShape, pressure: f64) -> TakenPaint {
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
    for ground in [PANEL, LINEN] {
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
        let Some(mut device) = on_gpu(LINEN, 0.2) else { return };
        let mut processor = on_cpu(LINEN, 0.2);
        let samples = along(8.0, (12.0, 22.0), 0.6);
        let work = |painting: &mut Painting| {
            let brush = loaded(painting, shape, 4.0);
            painting.stroke_as(tool, brush, &samples).unwrap().taken
        };
        let taken = work(&mut processor);
        assert_eq!(work(&mut device), taken, "{tool:?}, {shape}");
        assert!(device.wet().unwrap() == processor.wet().unwrap(), "{tool:?}, {shape}");
    }
}

#[test]
fn an_undo_brings_the_paint_back_and_a_redo_takes_it_again() {
    for (tool, shape) in TOOLS {
        let mut painting = on_cpu(LINEN, 0.2);
        let before = painting.wet().unwrap();
        work(&mut painting, tool, shape, 0.6);
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
        let mut whole = on_cpu(LINEN, 0.4);
        let mut pieces = on_cpu(LINEN, 0.4);
        let brush = loaded(&mut whole, shape, 6.0);
        let report = whole.stroke_as(tool, brush, &samples).unwrap();
        let brush = loaded(&mut pieces, shape, 6.0);
        let mut stroke: OpenStroke = pieces.begin_stroke_as(tool, brush).unwrap();
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
    let taken = |strength: f64, pressure: f64, passes: usize| {
        let mut painting = on_cpu(PANEL, 0.1);
        let brush = loaded(&mut painting, HeadShape::Flat, 6.0);
        let samples = along(8.0, (5.0, 35.0), pressure);
        let tool = StrokeTool::Erase { strength };
        let sum = (0..passes)
            .map(|_| painting.stroke_as(tool, brush, &samples).unwrap().taken.volume_mm3(CELL_MM));
        let sum: f64 = sum.sum();
        (sum, height_mm(&painting.wet().unwrap(), 20.0, 8.0))
    };
    let (little, left) = taken(0.3, 0.4, 1);
    for (more, less_left) in [taken(0.3, 0.8, 1), taken(0.9, 0.4, 1), taken(0.3, 0.4, 3)] {
        assert!(
            more > 1.1 * little && less_left < 0.8 * left,
            "{more} {less_left}: {little} {left}"
        );
    }
    let (_, left) = taken(1.0, 1.0, 3);
    assert!(left < 1e-4, "{left} mm stay after rubbing hard");
    let mut dry = on_cpu(PANEL, 0.1);
    dry.dry(1.0).unwrap();
    let layer = dry.dry_in(0, dry.bounds()).unwrap();
    assert_eq!(work(&mut dry, ERASE, HeadShape::Flat, 1.0), TakenPaint::default());
    assert!(dry.dry_in(0, dry.bounds()).unwrap() == layer, "dry paint came off");
}

#[test]
fn the_mark_of_a_rag_has_soft_edges() {
    let mut painting = on_cpu(PANEL, 0.1);
    work(&mut painting, ERASE, HeadShape::Round, 0.8);
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
        work(&mut painting, tool, HeadShape::Knife, pressure);
        let found = height_mm(&painting.wet().unwrap(), 20.0, 8.0);
        assert!((found - wanted).abs() < 2e-3, "{height_mm_set} {pressure}: {found}");
    }
    // A blade above the paint takes nothing.
    let mut painting = on_cpu(PANEL, 0.1);
    let high = StrokeTool::Scrape { height_mm: 0.5 };
    assert_eq!(work(&mut painting, high, HeadShape::Knife, 0.3), TakenPaint::default());
}

#[test]
fn scraping_leaves_paint_in_the_valleys_of_linen_and_frees_its_crests() {
    let mut painting = on_cpu(LINEN, 0.1);
    work(&mut painting, SCRAPE, HeadShape::Knife, 0.8);
    let wet = painting.wet().unwrap();
    let floor = painting.engine.floor().unwrap();
    let width = wet.width();
    let rows = 36..44;
    let cells = rows.flat_map(|y| (70..130).map(move |x| y * width + x));
    let mut found: Vec<(i32, f64)> = cells
        .map(|at| (floor.values()[at], mm_from_quanta(wet.cell(at).volume(), CELL_MM)))
        .collect();
    found.sort_by_key(|(floor, _)| *floor);
    let mean = |part: &[(i32, f64)]| part.iter().map(|(_, mm)| mm).sum::<f64>() / part.len() as f64;
    let tenth = found.len() / 10;
    let valleys = mean(&found[..tenth]);
    let crests = mean(&found[found.len() - tenth..]);
    assert!(valleys > 0.05 && crests < 0.005, "valleys {valleys} mm, crests {crests} mm");
}

#[test]
fn a_mop_softens_an_edge_and_takes_little() {
    let share = |painting: &mut Painting, x_mm: f64| {
        let wet = painting.wet().unwrap();
        let x = (x_mm / CELL_MM) as usize;
        let y = (8.0 / CELL_MM) as usize;
        let cell = wet.cell(y * wet.width() + x);
        f64::from(cell.pigments[2]) / f64::from(cell.volume().max(1))
    };
    let mut painting = on_cpu(PANEL, 0.2);
    assert!(share(&mut painting, 20.5) > 0.99 && share(&mut painting, 19.5) < 0.01);
    let before = painting.wet().unwrap().totals().iter().sum::<u64>() as f64;
    // The brush is loaded with the right half's pigment, which must not reach the left.
    let brush = loaded(&mut painting, HeadShape::Mop, 6.0);
    let taken = painting.stroke_as(BLEND, brush, &along(8.0, (12.0, 28.0), 0.5)).unwrap().taken;
    let left = share(&mut painting, 15.0);
    let near = share(&mut painting, 20.5);
    let far = share(&mut painting, 24.0);
    assert!(left < 0.01, "{left}: the load of the brush went onto the canvas");
    assert!((0.05..0.9).contains(&near), "{near} beside the edge");
    assert!(far > near, "{near} at the edge, {far} beyond it");
    let lost = taken.quanta.iter().sum::<u64>() as f64 / before;
    assert!(lost < 0.04, "{lost} of all paint");
    let height = height_mm(&painting.wet().unwrap(), 20.0, 8.0);
    assert!((0.12..0.3).contains(&height), "{height} mm of 0.2 under the mop");
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
