//! Films over load, pressure and cell.

use paint::HeadShape;
use paint::ground::GroundKind;

use super::super::canvas::{BODY, Bench, Easel};
use super::super::figure::{CaseReport, Figure, Panel};
use super::super::hand::{Hand, PRESSURE, START_MM};
use super::super::measure::mark::Mark;
use super::super::measure::series::{least_rise, spread_over_mean};

/// Loads in mm, with the film that is wanted of a flat.
const LOADS: [(f64, f64); 3] = [(0.3, 0.06), (1.0, 0.2), (2.0, 0.4)];
const PRESSURES: [f64; 3] = [0.3, PRESSURE, 0.8];
/// Share by which a film may differ from the wanted one.
const TOLERANCE: f64 = 0.3;
/// Smallest ratio that counts as a rise.
const RISES: f64 = 1.02;

const HEADS: [(HeadShape, f64); 8] = [
    (HeadShape::Flat, 10.0),
    (HeadShape::Round, 6.0),
    (HeadShape::Filbert, 8.0),
    (HeadShape::Mop, 15.0),
    (HeadShape::Knife, 20.0),
    (HeadShape::Rigger, 2.0),
    (HeadShape::Bright, 10.0),
    (HeadShape::Fan, 15.0),
];

/// A stroke of 60 mm along x: mean film over its first 50 mm, films at 10 to 50 mm, and its
/// picture.
struct Film {
    mean_mm: f64,
    at_mm: [f64; 5],
    panel: Panel,
}

fn paint(bench: &Bench, (shape, size_mm): (HeadShape, f64), pressure: f64, load_mm: f64) -> Film {
    let height_mm = size_mm + 14.0;
    let middle = 0.5 * height_mm;
    let mut easel = bench.panel((80.0, height_mm));
    let brush = easel.brush(shape, size_mm);
    easel.load(brush, &BODY, load_mm);
    let to = START_MM + 60.0;
    easel.stroke(brush, &Hand::across(pressure).along(&[(START_MM, middle), (to, middle)]));
    let heights = easel.heights();
    let mark = Mark::along_x(&heights);
    let film = |from: f64, to: f64| {
        mark.as_ref().map_or(f64::NAN, |mark| mark.film_in(&heights, from..to))
    };
    let caption = format!("{shape} {size_mm} mm, pressure {pressure}, load {load_mm} mm");
    let panel = easel.show(caption, 2.0..78.0, 2.0..height_mm - 2.0);
    let at_mm = [10.0, 20.0, 30.0, 40.0, 50.0].map(|at| film(at - 2.5, at + 2.5));
    Film { mean_mm: film(0.0, 50.0), at_mm, panel }
}

/// Films over loads and pressures of all heads.
pub(super) fn film(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let heads = if bench.small { &HEADS[..2] } else { &HEADS };
    for &(shape, size_mm) in heads {
        let flat = shape == HeadShape::Flat;
        let head = (shape, size_mm);
        let mut films = Vec::new();
        for (load_mm, wanted) in LOADS {
            let Film { mean_mm, at_mm, panel } = paint(bench, head, PRESSURE, load_mm);
            let figure = Figure::new(format!("{shape} {size_mm}, load {load_mm}"), mean_mm, "mm");
            let bounds = (wanted * (1.0 - TOLERANCE), wanted * (1.0 + TOLERANCE));
            figures.push(if flat { figure.at_least(bounds.0).at_most(bounds.1) } else { figure });
            if flat {
                for (at, mm) in at_mm.into_iter().enumerate() {
                    let name = format!("  at {} mm", 10 * (at + 1));
                    figures.push(Figure::new(format!("{name}, load {load_mm}"), mm, "mm"));
                }
                let falls = least_rise(&at_mm.map(|mm| 1.0 / mm));
                let name = format!("  falls by, load {load_mm}");
                figures.push(Figure::new(name, falls, "").at_least(1.0));
            }
            if flat || load_mm == 1.0 {
                panels.push(panel);
            }
            films.push(mean_mm);
        }
        let rise = least_rise(&films);
        figures.push(Figure::new(format!("{shape}, rise over load"), rise, "").at_least(RISES));
        let mut pressed = PRESSURES.map(|pressure| match pressure {
            PRESSURE => films[1],
            pressure => paint(bench, head, pressure, 1.0).mean_mm,
        });
        for (pressure, mm) in [(PRESSURES[0], pressed[0]), (PRESSURES[2], pressed[2])] {
            figures.push(Figure::new(format!("{shape}, pressure {pressure}"), mm, "mm"));
        }
        // A blade that is pressed harder leaves less.
        let change = if shape == HeadShape::Knife {
            pressed.reverse();
            "fall"
        } else {
            "rise"
        };
        let name = format!("{shape}, {change} over pressure");
        figures.push(Figure::new(name, least_rise(&pressed), "").at_least(RISES));
    }
    let title = "Film over load and pressure: strokes of 60 mm, mean of the first 50 mm";
    CaseReport { name: "film", title, figures, panels }
}

/// One stroke on cells of four sizes.
pub(super) fn cell(bench: &Bench) -> CaseReport {
    let sizes: &[f64] = if bench.small { &[0.1, 0.2, 0.4] } else { &[0.05, 0.1, 0.2, 0.4] };
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let mut volumes = Vec::new();
    for &cell_mm in sizes {
        let mut easel = Easel::new(bench, cell_mm, (70.0, 20.0), GroundKind::Panel, |_, _| None);
        let brush = easel.brush(HeadShape::Flat, 10.0);
        easel.load(brush, &BODY, 1.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, 10.0), (START_MM + 50.0, 10.0)]);
        easel.stroke(brush, &samples);
        let volume = easel.heights().volume_mm3();
        figures.push(Figure::new(format!("volume on cells of {cell_mm} mm"), volume, "mm3"));
        panels.push(easel.show(format!("cells of {cell_mm} mm"), 2.0..68.0, 2.0..18.0));
        volumes.push(volume);
    }
    let spread = 100.0 * spread_over_mean(&volumes);
    figures.push(Figure::new("spread over the mean", spread, "%").at_most(10.0));
    let title = "One stroke on cells of four sizes: flat 10, load 1, 50 mm";
    CaseReport { name: "cell", title, figures, panels }
}
