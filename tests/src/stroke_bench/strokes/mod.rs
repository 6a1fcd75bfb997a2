//! The strokes of the bench: over and along the edge of the canvas, over the weave of a ground, a
//! wall covered in pulls, two heaps mixed on the palette, outlines and where a mark lies under the
//! pen, and films over load, pressure and cell size.

mod contrasts;
mod ends;
mod relief;

use std::f64::consts::TAU;

use spectra::color::Lab;

use super::canvas::{BLUE, BODY, Bench, Easel, YELLOW};
use super::hand::{Hand, PRESSURE, START_MM, turning};
use super::heights::Heights;
use super::measure::{
    Mark, color_spread, deviation, edge_deviations_mm, least_rise, mean, pits, slope,
    spread_over_mean,
};
use super::report::{CaseReport, Figure, Panel};
use paint::ground::{GroundKind, GroundKind as FilmGroundKind};
use paint::{HeadShape, HeadShape as FilmHeadShape};

/// A case: its name and the function that paints and measures it.
pub type Case = (&'static str, fn(&Bench) -> CaseReport);

/// All cases, in the order of the table.
pub const CASES: &[Case] = &[
    ("film", film),
    ("cell", cell),
    ("furrows", relief::furrows),
    ("stiffness", relief::stiffness),
    ("stamp", relief::stamp),
    ("lips", relief::lips),
    ("saw-tooth", relief::saw_tooth),
    ("pick-up", relief::pick_up),
    ("wet-in-wet", relief::wet_in_wet),
    ("palette", palette),
    ("knife", relief::knife),
    ("outline", outline),
    ("lag", lag),
    ("edge", edge),
    ("weave", weave),
    ("fill", fill),
    ("alla-prima", contrasts::alla_prima),
    ("bands", contrasts::bands),
    ("rims", contrasts::rims),
    ("glaze", contrasts::glaze),
    ("ends", ends::ends),
    ("ripples", ends::ripples),
    ("run-out", ends::run_out),
    ("fan", ends::fan),
];

/// Paint at the edge of the canvas: the highest cell near the edge relative to the film, and the
/// paint that left canvas and brush, relative to one load.
fn edge(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let width_mm = 60.0;
    let height_mm = 24.0;
    let strokes = [
        ("over the edge and back", 1, vec![(10.0, 12.0), (75.0, 12.0), (10.0, 12.0)]),
        ("8 pulls over the edge", 8, vec![(10.0, 12.0), (75.0, 12.0)]),
        ("along the edge", 1, vec![(10.0, height_mm), (50.0, height_mm)]),
    ];
    for (name, pulls, points) in strokes {
        let mut easel = bench.panel((width_mm, height_mm));
        let brush = easel.brush(HeadShape::Flat, 10.0);
        let mut gone = 0;
        let mut loaded = 0;
        for _ in 0..pulls {
            easel.load(brush, &BODY, 1.0);
            let before = easel.quanta(&[brush]).iter().sum::<i64>();
            easel.stroke(brush, &Hand::across(PRESSURE).along(&points));
            gone += before - easel.quanta(&[brush]).iter().sum::<i64>();
            loaded = before;
        }
        let heights = easel.heights();
        let along = points[0].1 == height_mm;
        // The film beside the edge: in the middle of the mark, away from the edge.
        let film = Mark::within(&heights, 0.0..50.0).map_or(f64::NAN, |mark| mark.film_mm);
        let (from_x, from_y) = if along { (0.0, height_mm - 1.0) } else { (width_mm - 1.0, 0.0) };
        let columns = heights.columns_in(from_x..width_mm);
        let near = heights.part(columns, heights.rows_in(from_y..height_mm));
        let over = near.iter().fold(0.0, |a: f64, &b| a.max(b)) / film;
        let figure = Figure::new(format!("{name}: highest near it over film"), over, "");
        figures.push(figure.at_most(3.0));
        let left = 100.0 * gone as f64 / loaded as f64;
        figures.push(Figure::new(format!("{name}: paint that left"), left, "%").at_least(0.0));
        panels.push(easel.show(name, 0.0..width_mm, 0.0..height_mm).zoomed(1.3));
    }
    let title = "Edge of the canvas (flat 10, load 1): no pile within 1 mm of it";
    CaseReport { name: "edge", title, figures, panels }
}

/// How much of a weave shows in the top of three coats of thick strokes.
fn weave(bench: &Bench) -> CaseReport {
    let mut easel = Easel::new(bench, bench.cell_mm, (80.0, 24.0), GroundKind::Linen, |_, _| None);
    let brush = easel.brush(HeadShape::Flat, 10.0);
    for _ in 0..3 {
        easel.load(brush, &BODY, 2.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, 12.0), (START_MM + 60.0, 12.0)]);
        easel.stroke(brush, &samples);
    }
    let paint = easel.heights();
    let ground = easel.ground();
    let sums = paint.values().iter().zip(ground.values()).map(|(paint, ground)| paint + ground);
    let top = Heights::new(ground.cell_mm(), ground.columns(), sums.collect());
    let columns = ground.columns_in(20.0..60.0);
    let rows = ground.rows_in(9.0..15.0);
    let part = |heights: &Heights| heights.part(columns.clone(), rows.clone());
    let shown = slope(&part(&ground), &part(&top));
    let film = mean(&part(&paint));
    let figures = vec![
        Figure::new("film of three coats", film, "mm"),
        Figure::new("share of the weave's relief that shows", 100.0 * shown, "%")
            .at_least(-10.0)
            .at_most(10.0),
    ];
    let panels = vec![
        easel.show("flat 10, load 2, three coats on linen", 2.0..78.0, 1.0..23.0),
        easel.enlarge("their middle", 35.0..50.0, 8.0..16.0),
    ];
    let title = "Weave: how much of it shows in the top of three thick coats";
    CaseReport { name: "weave", title, figures, panels }
}

/// A wall covered in overlapping pulls with a reload before each.
fn fill(bench: &Bench) -> CaseReport {
    const PULLS: usize = 5;
    const APART_MM: f64 = 8.5;
    let mut easel = bench.panel((80.0, 56.0));
    let brush = easel.brush(HeadShape::Flat, 12.0);
    for pull in 0..PULLS {
        easel.load(brush, &BODY, 1.0);
        let y_mm = 11.0 + APART_MM * pull as f64;
        let (from, to) = if pull % 2 == 0 { (10.0, 70.0) } else { (70.0, 10.0) };
        easel.stroke(brush, &Hand::across(PRESSURE).along(&[(from, y_mm), (to, y_mm)]));
    }
    let heights = easel.heights();
    // Leave out a rim of 3 mm.
    let columns = heights.columns_in(13.0..67.0);
    let rows = heights.rows_in(11.0..45.0);
    let wall = heights.part(columns.clone(), rows.clone());
    let bare = wall.iter().filter(|&&mm| mm < 0.002).count() as f64 / wall.len() as f64;
    let lines = &heights.across(columns)[rows];
    let figures = vec![
        Figure::new("film", mean(&wall), "mm"),
        Figure::new("bare cells", 100.0 * bare, "%"),
        Figure::new("RMS of the film", 100.0 * deviation(&wall) / mean(&wall), "%"),
        Figure::new("seams: RMS of the rows' means", 100.0 * deviation(lines) / mean(lines), "%"),
        Figure::new("seams: highest less lowest row over mean", spread_over_mean(lines), ""),
        Figure::new("highest cell", heights.highest_mm(), "mm"),
    ];
    let caption = "flat 12, load 1 before each of 5 pulls";
    let panels = vec![easel.show(caption, 2.0..78.0, 2.0..54.0).zoomed(2.0)];
    let title = "Fill: a wall of 60 x 40 mm covered by a flat 12";
    CaseReport { name: "fill", title, figures, panels }
}

const MIDDLE_MM: (f64, f64) = (25.0, 25.0);
const RADIUS_MM: f64 = 8.0;
/// Height in mm from which a cell counts as covered. Thinner paint shows the ground.
const COVERED_MM: f64 = 0.05;

/// Path of `count` circles about the middle. Their centres move by 2 mm.
fn circles(count: usize) -> Vec<(f64, f64)> {
    (0..count)
        .flat_map(|index: usize| {
            let (sin, cos) = (index as f64 / count as f64 * TAU).sin_cos();
            let centre = (MIDDLE_MM.0 + 2.0 * cos, MIDDLE_MM.1 + 2.0 * sin);
            (0..48).map(move |step| {
                let (sin, cos) = (f64::from(step) / 48.0 * TAU).sin_cos();
                (centre.0 + RADIUS_MM * cos, centre.1 + RADIUS_MM * sin)
            })
        })
        .collect()
}

fn mix(bench: &Bench, shape: HeadShape, size_mm: f64) -> (Vec<Figure>, Vec<Panel>) {
    let mut easel = bench.panel((50.0, 50.0));
    for (recipe, x_mm) in [(BLUE, MIDDLE_MM.0 - 4.0), (YELLOW, MIDDLE_MM.0 + 4.0)] {
        easel.squeeze(&recipe, 60.0, (x_mm, MIDDLE_MM.1));
    }
    let heaps = easel.show("two heaps of 60 mm3", 5.0..45.0, 5.0..45.0).zoomed(2.0);
    let brush = easel.brush(shape, size_mm);
    easel.stroke(brush, &turning(Hand::across(PRESSURE).along(&circles(12))));
    let heights = easel.heights();
    let inside = |x: usize, y: usize| {
        let [x, y] = [x, y].map(|cell| (cell as f64 + 0.5) * heights.cell_mm());
        (x - MIDDLE_MM.0).hypot(y - MIDDLE_MM.1) < RADIUS_MM + 2.0
    };
    let columns = heights.columns();
    let patch: Vec<usize> =
        (0..heights.values().len()).filter(|at| inside(at % columns, at / columns)).collect();
    let colors = easel.colors();
    let covered = patch.iter().filter(|&&at| heights.values()[at] >= COVERED_MM);
    let covered: Vec<Lab> = covered.map(|&at| colors[at]).collect();
    let film: Vec<f64> = patch.iter().map(|&at| heights.values()[at]).collect();
    let highest = film.iter().fold(0.0, |a: f64, &b| a.max(b));
    let tool = format!("{shape} {size_mm}");
    let bare = 100.0 * (1.0 - covered.len() as f64 / patch.len() as f64);
    let figures = vec![
        Figure::new(format!("{tool}: mean CIEDE2000 from the mean"), color_spread(&covered), "")
            .at_most(3.0),
        Figure::new(
            format!("{tool}: cells below a fifth of their median"),
            100.0 * pits(&heights, inside),
            "%",
        )
        .at_most(0.1),
        Figure::new(format!("{tool}: cells thinner than 0.05 mm"), bare, "%"),
        Figure::new(format!("{tool}: mean height"), mean(&film), "mm"),
        Figure::new(format!("{tool}: highest over mean"), highest / mean(&film), ""),
    ];
    let mixed = easel.show(format!("{tool}, 12 circles"), 5.0..45.0, 5.0..45.0).zoomed(2.0);
    (figures, vec![heaps, mixed])
}

fn palette(bench: &Bench) -> CaseReport {
    let (mut figures, mut panels) = mix(bench, HeadShape::Knife, 20.0);
    let (more, brushed) = mix(bench, HeadShape::Flat, 10.0);
    figures.extend(more);
    panels.extend(brushed.into_iter().skip(1));
    let title = "Palette: a blue and a yellow heap 8 mm apart, 12 circles of radius 8 mm";
    CaseReport { name: "palette", title, figures, panels }
}

/// Paints one stroke of a brush loaded with 1 mm on a panel.
fn painted(
    bench: &Bench,
    (shape, size_mm): (HeadShape, f64),
    hand: Hand,
    size: (f64, f64),
    points: &[(f64, f64)],
) -> Easel {
    let mut easel = bench.panel(size);
    let brush = easel.brush(shape, size_mm);
    easel.load(brush, &BODY, 1.0);
    easel.stroke(brush, &hand.along(points));
    easel
}

/// Deviations in mm of both edges of the only mark. They are NaN if it has gaps.
fn edge_deviations(heights: &Heights) -> [f64; 2] {
    let mark = Mark::along_x(heights);
    let found = mark.and_then(|mark| edge_deviations_mm(heights, mark.steady));
    found.unwrap_or([f64::NAN; 2])
}

/// Edges of a wide stroke, and of strokes at 10 degrees.
fn outline(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let wide = (HeadShape::Flat, 25.0);
    let points = [(25.0, 20.0), (85.0, 20.0)];
    let mut easel = painted(bench, wide, Hand::across(PRESSURE), (100.0, 40.0), &points);
    let heights = easel.heights();
    let edges = edge_deviations(&heights);
    for (side, mm) in ["upper", "lower"].into_iter().zip(edges) {
        let name = format!("flat 25: RMS of the {side} edge over width");
        figures.push(Figure::new(name, 100.0 * mm / 25.0, "%").at_most(2.0));
    }
    panels.push(easel.show("flat 25, load 1", 2.0..98.0, 2.0..38.0));
    let rise = 60.0 * 10f64.to_radians().tan();
    let points = [(START_MM, 10.0), (START_MM + 60.0, 10.0 + rise)];
    for (shape, size_mm) in [(HeadShape::Round, 4.0), (HeadShape::Flat, 10.0)] {
        let hand = Hand { twist_deg: 100.0, ..Hand::across(PRESSURE) };
        let mut easel = painted(bench, (shape, size_mm), hand, (80.0, 32.0), &points);
        let heights = easel.heights();
        let edges = edge_deviations(&heights);
        for (side, mm) in ["upper", "lower"].into_iter().zip(edges) {
            let name = format!("{shape} {size_mm} at 10 degrees: RMS of the {side} edge");
            figures.push(Figure::new(name, mm / heights.cell_mm(), "cell").at_most(0.25));
        }
        let caption = format!("{shape} {size_mm} at 10 degrees");
        panels.push(easel.show(caption, 2.0..78.0, 1.0..31.0));
        panels.push(easel.enlarge("its edges", 32.0..47.0, 10.0..22.0));
    }
    let title = "Outlines at even pressure: deviation of the edges from straight lines";
    CaseReport { name: "outline", title, figures, panels }
}

/// Where marks begin and end under the pen, upright and leaning.
fn lag(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let heads = [
        (HeadShape::Flat, 10.0),
        (HeadShape::Round, 6.0),
        (HeadShape::Filbert, 8.0),
        (HeadShape::Knife, 20.0),
    ];
    let leans = [("upright", (0.0, 0.0)), ("back 35", (-35.0, 0.0)), ("aside 35", (0.0, 35.0))];
    for (shape, size_mm) in heads {
        let leans = if bench.small { &leans[..1] } else { &leans };
        let mut upright_mm = f64::NAN;
        for &(lean, tilt_deg) in leans {
            let hand = Hand { tilt_deg, ..Hand::across(PRESSURE) };
            let points = [(20.0, 18.0), (70.0, 18.0)];
            let mut easel = painted(bench, (shape, size_mm), hand, (90.0, 36.0), &points);
            let heights = easel.heights();
            let mark = Mark::along_x(&heights);
            let none = (f64::NAN, f64::NAN);
            let (top, bottom) = mark.as_ref().map_or(none, |mark| mark.edges_mm);
            let ends = mark.and_then(|mark| mark.ends_mm(&heights));
            let (start, end) = ends.unwrap_or(none);
            let name = format!("{shape} {size_mm} {lean}");
            let figure = |what: &str, mm: f64| Figure::new(format!("{name}: {what}"), mm, "mm");
            figures.push(figure("start after the pen's", start - 20.0));
            figures.push(figure("end after the pen's", end - 70.0));
            // Both ends lie half a contact beyond the pen's.
            let behind = 0.5 * (start + end) - 45.0;
            figures.push(figure("middle after the pen's", behind).at_least(-1.0).at_most(1.0));
            if tilt_deg == (0.0, 0.0) {
                upright_mm = bottom - top;
            } else {
                let wide = 100.0 * (bottom - top) / upright_mm;
                let width = Figure::new(format!("{name}: width over upright"), wide, "%");
                figures.push(width.at_least(85.0).at_most(115.0));
            }
            let aside = 0.5 * (top + bottom) - 18.0;
            figures.push(figure("middle beside the pen's", aside).at_least(-1.0).at_most(1.0));
            panels.push(easel.show(name, 10.0..80.0, 4.0..32.0));
        }
    }
    let title = "Lag: the mark's ends and middle against a pen from 20 to 70 mm";
    CaseReport { name: "lag", title, figures, panels }
}

/// Loads in mm, with the film that a flat should leave.
const LOADS: [(f64, f64); 3] = [(0.3, 0.06), (1.0, 0.2), (2.0, 0.4)];
const PRESSURES: [f64; 3] = [0.3, PRESSURE, 0.8];
/// Share by which a film may differ from the wanted one.
const TOLERANCE: f64 = 0.3;
/// Smallest ratio that counts as a rise.
const RISES: f64 = 1.02;

const HEADS: [(FilmHeadShape, f64); 8] = [
    (FilmHeadShape::Flat, 10.0),
    (FilmHeadShape::Round, 6.0),
    (FilmHeadShape::Filbert, 8.0),
    (FilmHeadShape::Mop, 15.0),
    (FilmHeadShape::Knife, 20.0),
    (FilmHeadShape::Rigger, 2.0),
    (FilmHeadShape::Bright, 10.0),
    (FilmHeadShape::Fan, 15.0),
];

/// A stroke of 60 mm along x: mean film over its first 50 mm, films at 10 to 50 mm, and its
/// picture.
struct Film {
    mean_mm: f64,
    at_mm: [f64; 5],
    panel: Panel,
}

fn paint(
    bench: &Bench,
    (shape, size_mm): (FilmHeadShape, f64),
    pressure: f64,
    load_mm: f64,
) -> Film {
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
fn film(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let heads = if bench.small { &HEADS[..2] } else { &HEADS };
    for &(shape, size_mm) in heads {
        let flat = shape == FilmHeadShape::Flat;
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
        // If you press a blade harder, it leaves less.
        let change = if shape == FilmHeadShape::Knife {
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
fn cell(bench: &Bench) -> CaseReport {
    let sizes: &[f64] = if bench.small { &[0.1, 0.2, 0.4] } else { &[0.05, 0.1, 0.2, 0.4] };
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let mut volumes = Vec::new();
    for &cell_mm in sizes {
        let mut easel =
            Easel::new(bench, cell_mm, (70.0, 20.0), FilmGroundKind::Panel, |_, _| None);
        let brush = easel.brush(FilmHeadShape::Flat, 10.0);
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
