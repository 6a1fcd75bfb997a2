//! Strokes of one colour over another: light over wet dark, a brush through four wet colours, the
//! rims of thin dark marks, and a glaze over furrows.

use calibrate::evaluate::Viewing;
use paint::HeadShape;
use paint::ground::GroundKind;
use paint::strokes::Action;
use spectra::color::Lab;

use super::super::canvas::{
    BLUE, BLUE_SLOT, Bench, Easel, PIGMENTS, RED_SLOT, WHITE, WHITE_SLOT, YELLOW_SLOT,
};
use super::super::hand::{Hand, PRESSURE, START_MM};
use super::super::measure::{Mark, correlation, deviation, mean};
use super::super::report::{CaseReport, Figure, Wanted};

const ROW_MM: f64 = 10.0;
const WIDTH_MM: f64 = 80.0;

/// A canvas under a wet film of red.
fn wet_red(bench: &Bench, film_mm: f64) -> Easel {
    Easel::new(bench, bench.cell_mm, (WIDTH_MM, 2.0 * ROW_MM), GroundKind::Panel, |_, _| {
        Some((RED_SLOT, film_mm))
    })
}

/// Mean L* of a mark along x at [`ROW_MM`], `wide_mm` wide, over the middle 60 % of its width, and the
/// deviation of L* across it. Both leave out 15 mm at each end.
fn lightness(easel: &mut Easel, wide_mm: f64) -> (f64, f64) {
    let heights = easel.heights();
    let colors = easel.colors();
    let columns = heights.columns_in(START_MM + 15.0..WIDTH_MM - START_MM - 15.0);
    let rows = heights.rows_in(ROW_MM - 0.3 * wide_mm..ROW_MM + 0.3 * wide_mm);
    let width = heights.columns();
    let profiles: Vec<Vec<f64>> =
        columns.map(|x| rows.clone().map(|y| colors[y * width + x].lightness).collect()).collect();
    let streaks: Vec<f64> = profiles.iter().map(|profile: &Vec<f64>| deviation(profile)).collect();
    (mean(&profiles.concat()), mean(&streaks))
}

/// White over wet red.
pub(super) fn alla_prima(bench: &Bench) -> CaseReport {
    const THERE: (f64, f64) = (START_MM, ROW_MM);
    const BACK: (f64, f64) = (WIDTH_MM - START_MM, ROW_MM);
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let filbert = (HeadShape::Filbert, 10.0);
    let knife = (HeadShape::Knife, 16.0);
    let cases = [
        ("filbert 10, pressure 0.2", filbert, 0.2, 0.8, 1, (Some(80.0), None)),
        ("filbert 10, pressure 0.35", filbert, 0.35, 0.8, 1, (Some(80.0), None)),
        ("filbert 10, pressure 0.35, 8 times", filbert, 0.35, 0.8, 8, (None, Some(60.0))),
        ("knife 16, pressure 0.3", knife, 0.3, 0.8, 1, (Some(85.0), None)),
        ("filbert 10, pressure 0.35, over 0.05 mm", filbert, 0.35, 0.05, 1, (Some(85.0), None)),
    ];
    for (name, (shape, size_mm), pressure, film_mm, times, (low, high)) in cases {
        let mut easel = wet_red(bench, film_mm);
        let brush = easel.brush(shape, size_mm);
        easel.load(brush, &WHITE, 2.0);
        let before = easel.quanta(&[brush]);
        for time in 0..times {
            let way = if time % 2 == 0 { [THERE, BACK] } else { [BACK, THERE] };
            easel.stroke(brush, &Hand::across(pressure).along(&way));
        }
        let lost = before.iter().zip(easel.quanta(&[brush])).filter(|(a, b)| **a != *b).count();
        let (lightness, streaks) = lightness(&mut easel, size_mm);
        let figure = Figure::new(format!("{name}: L*"), lightness, "");
        figures.push(Figure { wanted: Wanted { low, high }, ..figure });
        let streaks = Figure::new(format!("{name}: deviation of L* across"), streaks, "");
        figures.push(if shape == HeadShape::Filbert && times == 1 && film_mm > 0.1 {
            streaks.at_least(1.0)
        } else {
            streaks
        });
        figures.push(
            Figure::new(format!("{name}: amounts that changed"), lost as f64, "").at_most(0.0),
        );
        panels.push(easel.show(name, 2.0..78.0, 2.0..18.0).zoomed(1.3));
    }
    let title = "Alla prima: Lead White, load 2, over wet Vermilion of 0.8 mm";
    CaseReport { name: "alla-prima", title, figures, panels }
}

/// Left edges in mm of four wet bands, with their slots.
const BANDS: [(f64, usize); 4] =
    [(12.0, BLUE_SLOT), (24.0, WHITE_SLOT), (36.0, RED_SLOT), (48.0, YELLOW_SLOT)];
const BAND_MM: f64 = 8.0;

/// Spread of a* and b* about their mean: the root of the sum of their variances.
fn chroma_spread(colors: &[Lab]) -> f64 {
    let parts: [fn(&Lab) -> f64; 2] = [|lab| lab.a, |lab| lab.b];
    let [a, b] = parts.map(|part| deviation(&colors.iter().map(part).collect::<Vec<_>>()));
    a.hypot(b)
}

/// A clean filbert through four wet bands, then two strokes beside them.
pub(super) fn bands(bench: &Bench) -> CaseReport {
    let size = (90.0, 52.0);
    let mut easel = Easel::new(bench, bench.cell_mm, size, GroundKind::Panel, |x, y| {
        let band = BANDS.iter().find(|(left, _)| (*left..left + BAND_MM).contains(&x));
        band.filter(|_| y < 20.0).map(|&(_, slot)| (slot, 0.4))
    });
    let brush = easel.brush(HeadShape::Filbert, 10.0);
    let rows_mm = [10.0, 28.0, 43.0];
    let before = easel.quanta(&[brush]);
    for (y_mm, from_mm) in rows_mm.into_iter().zip([6.0, 20.0, 20.0]) {
        easel.stroke(brush, &Hand::across(PRESSURE).along(&[(from_mm, y_mm), (80.0, y_mm)]));
    }
    let lost = before.iter().zip(easel.quanta(&[brush])).filter(|(a, b)| **a != *b).count();
    let heights = easel.heights();
    let colors = easel.colors();
    let width = heights.columns();
    let across = |y_mm: f64, x: usize| -> Vec<Lab> {
        let rows = heights.rows_in(y_mm - 3.0..y_mm + 3.0);
        rows.map(|y| colors[y * width + x]).collect()
    };
    // Behind the last band, where all four colours are on the brush.
    let behind = heights.columns_in(58.0..74.0);
    let spreads: Vec<f64> = behind.map(|x| chroma_spread(&across(rows_mm[0], x))).collect();
    let row = heights.rows_in(rows_mm[0]..rows_mm[0] + 1.0).start;
    let along: Vec<Lab> = heights.columns_in(12.0..56.0).map(|x| colors[row * width + x]).collect();
    // Mean a* and b* of each row of the two strokes beside the bands.
    let [first, second] = [1, 2].map(|stroke: usize| {
        let columns: Vec<Vec<Lab>> =
            heights.columns_in(32.0..60.0).map(|x| across(rows_mm[stroke], x)).collect();
        let parts: [fn(&Lab) -> f64; 2] = [|lab| lab.a, |lab| lab.b];
        parts.map(|part| -> Vec<f64> {
            let rows = 0..columns[0].len();
            rows.map(|y| mean(&columns.iter().map(|c| part(&c[y])).collect::<Vec<_>>())).collect()
        })
    });
    let alike = mean(&[correlation(&first[0], &second[0]), correlation(&first[1], &second[1])]);
    let figures = vec![
        Figure::new("spread of a*, b* across, behind the bands", mean(&spreads), "")
            .at_least(5.0)
            .at_most(12.0),
        Figure::new("spread of a*, b* along, through the bands", chroma_spread(&along), ""),
        Figure::new("streaks of the next stroke like those of the one after it", alike, "")
            .at_least(0.5),
        Figure::new("  deviation of a* across the next stroke", deviation(&first[0]), ""),
        Figure::new("amounts that changed", lost as f64, "").at_most(0.0),
    ];
    let panels = vec![
        easel.show("clean filbert 10, then two strokes beside", 2.0..88.0, 1.0..51.0).zoomed(1.6),
    ];
    let title = "Bands: a clean filbert through wet blue, white, red and yellow of 0.4 mm";
    CaseReport { name: "bands", title, figures, panels }
}

/// Chroma by lightness of tints of the blue with white, from the ground to the masstone. Pairs of
/// (L*, C*), darkest first.
fn tints(bench: &Bench) -> Vec<(f64, f64)> {
    (0..=60)
        .map(|step| {
            let blue = 10f64.powf(-3.0 * f64::from(step) / 60.0);
            let parts = [(PIGMENTS[BLUE_SLOT], blue), (PIGMENTS[WHITE_SLOT], 1.0 - blue)];
            let color = bench.library.color(parts, &Viewing::default()).expect("a tint");
            (color.lab.lightness, color.lab.a.hypot(color.lab.b))
        })
        .collect()
}

/// Highest chroma of a tint within 2 of a lightness.
fn tint_chroma(tints: &[(f64, f64)], lightness: f64) -> f64 {
    let near = tints
        .windows(2)
        .filter(|pair| pair[0].0 - 2.0 <= lightness && lightness <= pair[1].0 + 2.0);
    near.flatten().fold(0.0, |most: f64, tint| most.max(tint.1))
}

/// Chroma of the cells at the rim of a dark blue mark, against tints of the same lightness.
pub(super) fn rims(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((60.0, 24.0));
    let brush = easel.brush(HeadShape::Round, 6.0);
    easel.load(brush, &BLUE, 1.0);
    easel.stroke(brush, &Hand::across(PRESSURE).along(&[(START_MM, 12.0), (50.0, 12.0)]));
    let heights = easel.heights();
    let colors = easel.colors();
    let tints = tints(bench);
    let mut outside = 0_usize;
    let mut rim = 0_usize;
    let mut most = 0.0_f64;
    let width = heights.columns();
    for y in 1..heights.rows() - 1 {
        for x in 1..width - 1 {
            let near = (y - 1..y + 2).flat_map(|y| (x - 1..x + 2).map(move |x| (x, y)));
            let painted = near.filter(|&(x, y)| heights.at(x, y) > 0.0).count();
            if (1..9).contains(&painted) {
                let lab = colors[y * width + x];
                let beyond = lab.a.hypot(lab.b) - tint_chroma(&tints, lab.lightness);
                rim += 1;
                outside += usize::from(beyond > 3.0);
                most = most.max(beyond);
            }
        }
    }
    let share = 100.0 * outside as f64 / rim as f64;
    let figures = vec![
        Figure::new("cells at the rim with more chroma than tints", share, "%").at_most(0.0),
        Figure::new("  most chroma beyond a tint of its lightness", most, ""),
        Figure::new("  cells at the rim", rim as f64, ""),
    ];
    let panels = vec![
        easel.show("round 6, Ultramarine, load 1", 4.0..56.0, 4.0..20.0).zoomed(1.6),
        easel.enlarge("its end", 44.0..56.0, 7.0..17.0),
    ];
    let title = "Rims: colours within one cell of the edge of a dark blue mark";
    CaseReport { name: "rims", title, figures, panels }
}

/// A glaze rich in vehicle over dry furrows.
pub(super) fn glaze(bench: &Bench) -> CaseReport {
    const FURROW_MM: f64 = 1.0;
    const DEPTH_MM: f64 = 0.3;
    let size = (90.0, 40.0);
    let mut easel = Easel::new(bench, bench.cell_mm, size, GroundKind::Panel, |_, y| {
        let wave = (y / FURROW_MM * std::f64::consts::TAU).cos();
        Some((WHITE_SLOT, 0.1 + DEPTH_MM * (0.5 + 0.5 * wave)))
    });
    easel.painting.apply(&Action::Dry { fraction: 1.0 }).expect("dry paint");
    let brush = easel.brush(HeadShape::Mop, 20.0);
    easel.load_thinned(brush, &BLUE, 0.9, 0.3);
    easel.stroke(brush, &Hand::across(PRESSURE).along(&[(20.0, 20.0), (70.0, 20.0)]));
    let heights = easel.heights();
    let columns = heights.columns_in(35.0..60.0);
    let film = |low: f64, high: f64| {
        let rows = heights.rows_in(14.0..26.0).filter(|&y| {
            let at = (y as f64 + 0.5) * heights.cell_mm() / FURROW_MM;
            (low..high).contains(&(at - at.floor()))
        });
        let cells = rows.flat_map(|y| heights.part(columns.clone(), y..y + 1));
        mean(&cells.collect::<Vec<_>>())
    };
    let valleys = film(0.4, 0.6);
    let crests = 0.5 * (film(0.0, 0.1) + film(0.9, 1.0));
    let mark = Mark::along_x(&heights);
    let figures = vec![
        Figure::new("film in valleys over film on crests", valleys / crests, "").at_least(1.5),
        Figure::new("film", mark.map_or(f64::NAN, |mark| mark.film_mm), "mm"),
    ];
    let panels = vec![easel.show("mop 20, load 0.3, vehicle 0.9", 5.0..85.0, 4.0..36.0)];
    let title = "Glaze over dry furrows of 0.3 mm, 1 mm apart";
    CaseReport { name: "glaze", title, figures, panels }
}
