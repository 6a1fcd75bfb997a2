//! Strokes with relief: furrows of a loaded flat and whether they repeat, thick paint with lips and
//! ridges, paint that a brush takes up from a heap or from wet bands, and the knife that spreads,
//! scrapes and scratches.

use std::ops::Range;

use paint::ground::GroundKind;
use paint::layer::{Layer, SLOTS};
use paint::strokes::{Action, StrokeTool};
use paint::{BrushId, HeadShape};

use super::super::canvas::{BLUE_SLOT, BODY, Bench, Easel, YELLOW};
use super::super::hand::{Hand, PRESSURE, START_MM};
use super::super::heights::Heights;
use super::super::measure::{
    Mark, autocorrelation, correlation, deviation, mean, peak_wavelength_mm, quantile, rms, rough,
    second_differences_mm, without_parabola,
};
use super::super::report::{CaseReport, Figure, Panel};

const SIZE_MM: f64 = 10.0;
/// Length of a flat over its width.
const LENGTH: f64 = 1.5;
/// Longest wave in mm that counts as a furrow or as chatter.
const LONGEST_MM: f64 = 3.0;

/// Paints a stroke of a flat, washed and loaded with 1 mm, along x at `y_mm`.
fn stroke(easel: &mut Easel, brush: BrushId, y_mm: f64, length_mm: f64) {
    easel.load(brush, &BODY, 1.0);
    let points = [(START_MM, y_mm), (START_MM + length_mm, y_mm)];
    easel.stroke(brush, &Hand::across(PRESSURE).along(&points));
}

/// Furrows across the middle 60 % of the width about `y_mm`. Each profile is the mean over 1 mm
/// along the stroke from `x_mm.start` to `x_mm.end`, without waves longer than 3 mm. So this
/// ignores the shape of the whole mark, which all strokes of one brush share.
fn furrow_profiles(heights: &Heights, y_mm: f64, x_mm: Range<f64>) -> Vec<Vec<f64>> {
    let rows = heights.rows_in(y_mm - 0.3 * SIZE_MM..y_mm + 0.3 * SIZE_MM);
    let count = (x_mm.end - x_mm.start) as usize;
    (0..count)
        .map(|index: usize| {
            let from = x_mm.start + index as f64;
            let columns = heights.columns_in(from..from + 1.0);
            rough(&heights.across(columns)[rows.clone()], heights.cell_mm(), LONGEST_MM)
        })
        .collect()
}

/// Relief of one stroke across and along it.
pub(super) fn furrows(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((80.0, 20.0));
    let brush = easel.brush(HeadShape::Flat, SIZE_MM);
    stroke(&mut easel, brush, 10.0, 60.0);
    let heights = easel.heights();
    let cell_mm = heights.cell_mm();
    let mark = Mark::along_x(&heights);
    let [mut across, mut wavelength, mut along, mut chatter] = [f64::NAN; 4];
    if let Some(Mark { steady, middle, film_mm, .. }) = mark {
        let columns = steady.clone().map(|x| heights.across(x..x + 1)[middle.clone()].to_vec());
        let profiles: Vec<Vec<f64>> = columns.collect();
        across = 100.0
            * mean(
                &profiles
                    .iter()
                    .map(|profile: &Vec<f64>| rms(&without_parabola(profile)) / mean(profile))
                    .collect::<Vec<_>>(),
            );
        wavelength = peak_wavelength_mm(&profiles, cell_mm);
        let line = &heights.along(middle.clone())[steady.clone()];
        along = 100.0 * rms(&without_parabola(line)) / film_mm;
        let rows = middle
            .flat_map(|y| rough(&heights.along(y..y + 1)[steady.clone()], cell_mm, LONGEST_MM));
        chatter = 100.0 * rms(&rows.collect::<Vec<_>>()) / film_mm;
    }
    let figures = vec![
        Figure::new("RMS across over film", across, "%").at_least(10.0).at_most(30.0),
        Figure::new("wavelength of the peak across", wavelength, "mm").at_least(0.3).at_most(1.2),
        Figure::new("RMS of the cross-mean along over film", along, "%").at_most(5.0),
        Figure::new("RMS of rows along, below 3 mm, over film", chatter, "%").at_most(5.0),
    ];
    let panels = vec![
        easel.show("flat 10, load 1", 2.0..78.0, 2.0..18.0),
        easel.enlarge("its middle", 35.0..50.0, 6.0..14.0),
    ];
    let title = "Furrows of a loaded flat, 10 mm after its start to 5 mm before its end";
    CaseReport { name: "furrows", title, figures, panels }
}

/// Furrows of the same stroke in paint from stand oil to putty.
pub(super) fn stiffness(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    let mut softer = 0.0;
    for stiffness in [0.0, 0.35, 0.7, 1.0] {
        let mut easel = bench.panel((80.0, 20.0));
        easel.painting.apply(&Action::Stiffness { value: stiffness }).expect("a stiffness");
        let brush = easel.brush(HeadShape::Flat, SIZE_MM);
        stroke(&mut easel, brush, 10.0, 60.0);
        let heights = easel.heights();
        let across = Mark::along_x(&heights).map_or(f64::NAN, |Mark { steady, middle, .. }| {
            100.0
                * mean(
                    &steady
                        .map(|x: usize| {
                            let profile = &heights.across(x..x + 1)[middle.clone()];
                            rms(&without_parabola(profile)) / mean(profile)
                        })
                        .collect::<Vec<_>>(),
                )
        });
        let name = format!("stiffness {stiffness}: RMS across over film");
        let figure = Figure::new(name, across, "%").at_least(softer);
        figures.push(if stiffness == 0.0 { figure.at_most(5.0) } else { figure });
        panels.push(easel.show(format!("stiffness {stiffness}"), 2.0..78.0, 2.0..18.0));
        softer = across;
    }
    let title =
        "Levelling of the furrows of a flat 10, load 1: oily paint levels, stiff paint stays";
    CaseReport { name: "stiffness", title, figures, panels }
}

pub(super) fn stamp(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((80.0, 48.0));
    let brushes = [(); 2].map(|()| easel.brush(HeadShape::Flat, SIZE_MM));
    let rows_mm = [8.0, 24.0, 40.0];
    for (brush, y_mm) in [brushes[0], brushes[0], brushes[1]].into_iter().zip(rows_mm) {
        stroke(&mut easel, brush, y_mm, 60.0);
    }
    let heights = easel.heights();
    let start_mm = Mark::along_x(&heights).map_or(START_MM, |mark| mark.start_mm);
    let steady = start_mm + 10.0..start_mm + 55.0;
    fn compared(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
        mean(&a.iter().zip(b).map(|(a, b)| correlation(a, b)).collect::<Vec<_>>())
    }
    let [first, second, other] =
        rows_mm.map(|y_mm| furrow_profiles(&heights, y_mm, steady.clone()));
    let lag = (LENGTH * SIZE_MM * 1.5) as usize;
    let mut figures = vec![
        Figure::new("two brushes of one kind", compared(&first, &other), "").at_most(0.3),
        Figure::new("two strokes of one brush", compared(&first, &second), "").at_most(0.3),
        Figure::new(
            "one stroke, 1.5 lengths of the head later",
            compared(&first, &first[lag..]),
            "",
        )
        .at_most(0.3),
    ];
    let mut panels = vec![easel.show("brush A, brush A, brush B", 2.0..78.0, 1.0..47.0)];
    let count = if bench.small { 3 } else { 6 };
    let mut long = bench.panel((140.0, 16.0 * f64::from(count)));
    let brush = long.brush(HeadShape::Flat, SIZE_MM);
    for index in 0..count {
        stroke(&mut long, brush, 8.0 + 16.0 * f64::from(index), 120.0);
    }
    let heights = long.heights();
    let steady = Mark::along_x(&heights).map_or(0..0, |mark| mark.steady);
    let lines = (0..count).map(|index| {
        let middle = 8.0 + 16.0 * f64::from(index);
        let line = heights.along(heights.rows_in(middle - 3.0..middle + 3.0));
        rough(&line[steady.clone()], heights.cell_mm(), 40.0)
    });
    let lines: Vec<Vec<f64>> = lines.collect();
    let [from, to] = [3.0, 20.0].map(|mm: f64| (mm / heights.cell_mm()).round() as usize);
    let correlations = autocorrelation(&lines, from..to + 1);
    let (at, highest) =
        correlations.iter().enumerate().fold((0, f64::NEG_INFINITY), |best, (at, &value)| {
            if value > best.1 { (at, value) } else { best }
        });
    let lag_mm = 3.0 + at as f64 * heights.cell_mm();
    figures
        .push(Figure::new("along: highest autocorrelation, 3 to 20 mm", highest, "").at_most(0.1));
    figures.push(Figure::new("  its lag", lag_mm, "mm"));
    panels.push(long.show("strokes of 120 mm", 2.0..138.0, 0.0..32.0));
    let title = "No stamp: correlation of the furrows of several strokes (flat 10, load 1)";
    CaseReport { name: "stamp", title, figures, panels }
}

/// Lips at the sides and at the end of thick strokes.
pub(super) fn lips(bench: &Bench) -> CaseReport {
    let mut figures = Vec::new();
    let mut panels = Vec::new();
    for (shape, size_mm) in [(HeadShape::Flat, 10.0), (HeadShape::Filbert, 8.0)] {
        let mut easel = bench.panel((80.0, 20.0));
        let brush = easel.brush(shape, size_mm);
        easel.load(brush, &BODY, 2.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, 10.0), (START_MM + 60.0, 10.0)]);
        easel.stroke(brush, &samples);
        let heights = easel.heights();
        let mark = Mark::along_x(&heights);
        let none = ([f64::NAN; 2], f64::NAN);
        let (sides, end) =
            mark.map_or(none, |mark| (mark.side_lips(&heights), mark.end_lip(&heights)));
        let places = ["upper side", "lower side", "end"];
        for (place, value) in places.into_iter().zip([sides[0], sides[1], end]) {
            let name = format!("{shape} {size_mm}: lip of the {place} over film");
            figures.push(Figure::new(name, value, "").at_least(1.3).at_most(2.5));
        }
        let caption = format!("{shape} {size_mm}, load 2");
        panels.push(easel.show(caption, 2.0..78.0, 2.0..18.0).zoomed(1.6));
    }
    let title = "Lips of thick strokes: highest of the mean profiles near the edges";
    CaseReport { name: "lips", title, figures, panels }
}

/// Pulls over one another, and strokes beside a ridge.
pub(super) fn saw_tooth(bench: &Bench) -> CaseReport {
    let mut easel = bench.panel((80.0, 24.0));
    let brush = easel.brush(HeadShape::Flat, 10.0);
    for _ in 0..8 {
        easel.load(brush, &BODY, 1.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, 12.0), (START_MM + 60.0, 12.0)]);
        easel.stroke(brush, &samples);
    }
    let heights = easel.heights();
    let mark = Mark::along_x(&heights);
    let [mut film, mut along, mut across] = [f64::NAN; 3];
    if let Some(Mark { steady, middle, film_mm, .. }) = mark {
        film = film_mm;
        [along, across] =
            second_differences_mm(&heights, steady, middle).map(|mm| 100.0 * mm / film_mm);
    }
    let mut figures = vec![
        Figure::new("film after 8 pulls", film, "mm"),
        Figure::new("RMS of second differences along it over film", along, "%").at_most(3.0),
        // Furrows of 10 % at 1 mm alone give 4 % across it.
        Figure::new("  across it, furrows included", across, "%"),
        Figure::new("highest cell", heights.highest_mm(), "mm"),
    ];
    let mut panels = vec![
        easel.show("flat 10, load 1, 8 pulls", 2.0..78.0, 1.0..23.0),
        easel.enlarge("their middle", 35.0..50.0, 8.0..16.0),
    ];
    let (kept, mut beside) = ridge(bench);
    figures.push(Figure::new("ridge of 1 mm: height kept", 100.0 * kept, "%").at_least(90.0));
    let caption = "ridge of 1 mm, a stroke 3 mm beside it, another";
    panels.push(beside.show(caption, 2.0..78.0, 1.0..47.0));
    let title = "Thick paint: 8 pulls over one another; a ridge beside strokes";
    CaseReport { name: "saw-tooth", title, figures, panels }
}

/// Share of its height that a ridge along x keeps while strokes pass 3 mm beside it and elsewhere.
fn ridge(bench: &Bench) -> (f64, Easel) {
    const AT_MM: f64 = 10.0;
    const BASE_MM: f64 = 1.5;
    fn profile(y: f64) -> f64 {
        (1.0 - (2.0 * (y - AT_MM) / BASE_MM).powi(2)).max(0.0)
    }
    let mut easel =
        Easel::new(bench, bench.cell_mm, (80.0, 48.0), GroundKind::Panel, |x: f64, y: f64| {
            ((15.0..65.0).contains(&x) && profile(y) > 0.0).then(|| (BLUE_SLOT, profile(y)))
        });
    fn crest(heights: &Heights) -> f64 {
        let columns = heights.columns_in(20.0..60.0);
        let rows = heights.rows_in(AT_MM - 1.0..AT_MM + 1.0);
        columns
            .clone()
            .map(|x: usize| rows.clone().map(|y| heights.at(x, y)).fold(0.0, f64::max))
            .sum::<f64>()
            / columns.len() as f64
    }
    let before = crest(&easel.heights());
    let brush = easel.brush(HeadShape::Flat, 10.0);
    for y_mm in [AT_MM + 3.0 + 5.0, 38.0] {
        easel.load(brush, &BODY, 1.0);
        let samples = Hand::across(PRESSURE).along(&[(START_MM, y_mm), (START_MM + 60.0, y_mm)]);
        easel.stroke(brush, &samples);
    }
    (crest(&easel.heights()) / before, easel)
}

/// Paint that a clean flat takes up when it passes through a heap once.
pub(super) fn pick_up(bench: &Bench) -> CaseReport {
    let mut easel =
        Easel::new(bench, bench.cell_mm, (60.0, 24.0), GroundKind::Panel, |x: f64, y: f64| {
            let mm = 1.0 - ((x - 25.0).powi(2) + (y - 12.0).powi(2)) / 7.5f64.powi(2);
            (mm > 0.0).then_some((BLUE_SLOT, mm))
        });
    let brush = easel.brush(HeadShape::Flat, 5.0);
    easel.stroke(brush, &Hand::across(PRESSURE).along(&[(12.0, 12.0), (45.0, 12.0)]));
    let load = easel.load_mm(brush);
    let figures = vec![Figure::new("mean on the head", load, "mm").at_least(0.14).at_most(0.26)];
    let panels = vec![easel.show("flat 5, clean", 2.0..58.0, 2.0..22.0).zoomed(2.0)];
    let title = "Pick-up: a clean flat 5 once through a heap 1 mm high and 15 mm wide";
    CaseReport { name: "pick-up", title, figures, panels }
}

/// Left edges of the blue bands in mm.
const BANDS_MM: [f64; 3] = [20.0, 38.0, 56.0];
const BAND_MM: f64 = 8.0;

/// Share of blue in all paint of a layer.
fn share_of_blue(cells: impl Iterator<Item = [u32; SLOTS]>) -> f64 {
    let mut blue = 0.0;
    let mut all = 0.0;
    for pigments in cells {
        blue += f64::from(pigments[BLUE_SLOT]);
        all += pigments.iter().map(|&amount| f64::from(amount)).sum::<f64>();
    }
    blue / all
}

/// A yellow brush across three wet blue bands.
pub(super) fn wet_in_wet(bench: &Bench) -> CaseReport {
    let mut easel =
        Easel::new(bench, bench.cell_mm, (90.0, 24.0), GroundKind::Panel, |x: f64, _: f64| {
            let inside = BANDS_MM.iter().any(|&left| (left..left + BAND_MM).contains(&x));
            inside.then_some((BLUE_SLOT, 0.2))
        });
    let brush = easel.brush(HeadShape::Flat, 10.0);
    easel.load(brush, &YELLOW, 1.0);
    let before = easel.quanta(&[brush]);
    let samples = Hand::across(PRESSURE).along(&[(8.0, 12.0), (82.0, 12.0)]);
    let mut stroke = easel.painting.begin_stroke(StrokeTool::Paint, brush).expect("a stroke");
    let mut on_brush = Vec::new();
    let mut rest = samples.as_slice();
    for end_mm in BANDS_MM.map(|left| left + BAND_MM + 4.0) {
        let count = rest.partition_point(|sample| sample.x_mm <= end_mm);
        stroke.extend(&rest[..count]).expect("samples of a pen");
        rest = &rest[count..];
        stroke.advance(&mut easel.painting, usize::MAX).expect("painted");
        on_brush.push(share_of_blue(easel.on_brush(brush).pigments.values().iter().copied()));
    }
    stroke.extend(rest).expect("samples of a pen");
    stroke.finish(&mut easel.painting).expect("painted");
    on_brush.push(share_of_blue(easel.on_brush(brush).pigments.values().iter().copied()));
    let wet: Layer = easel.wet();
    let heights = easel.heights();
    let across = heights.columns();
    // All blue between the bands was brought or pushed there by the brush.
    let laid = BANDS_MM.map(|left| {
        let columns = heights.columns_in(left + BAND_MM + 3.0..left + BAND_MM + 9.0);
        let rows = heights.rows_in(9.0..15.0);
        let cells = rows.flat_map(|y| columns.clone().map(move |x| y * across + x));
        share_of_blue(cells.map(|index| wet.cell(index).pigments))
    });
    let after = easel.quanta(&[brush]);
    let lost: i64 = before.iter().zip(after).map(|(before, after)| (before - after).abs()).sum();
    let mut figures = Vec::new();
    let places = ["after band 1", "after band 2", "after band 3", "at the end"];
    for (place, share) in places.into_iter().zip(&on_brush) {
        figures.push(Figure::new(format!("blue on the brush {place}"), 100.0 * share, "%"));
    }
    let grows = 100.0 * (on_brush[1] - on_brush[0]).min(on_brush[2] - on_brush[1]);
    figures.push(
        Figure::new("  least growth on the brush from band to band", grows, "%").at_least(0.01),
    );
    for (band, share) in laid.into_iter().enumerate() {
        figures.push(Figure::new(format!("blue laid after band {}", band + 1), 100.0 * share, "%"));
    }
    let grows = 100.0 * (laid[1] - laid[0]).min(laid[2] - laid[1]);
    figures.push(Figure::new("  least growth laid from band to band", grows, "%").at_least(0.01));
    figures.push(Figure::new("quanta lost or gained", lost as f64, "").at_most(0.0));
    let panels = vec![easel.show("flat 10, load 1 of yellow", 2.0..88.0, 2.0..22.0).zoomed(2.0)];
    let title = "Wet in wet: yellow across three blue bands, 0.2 mm thick and 8 mm wide";
    CaseReport { name: "wet-in-wet", title, figures, panels }
}

type Part = (Vec<Figure>, Vec<Panel>);

/// Spreads a heap over 40 mm.
fn spread(bench: &Bench) -> Part {
    let mut easel = bench.panel((80.0, 36.0));
    easel.squeeze(&BODY, 100.0, (16.0, 18.0));
    let knife = easel.brush(HeadShape::Knife, 20.0);
    easel.stroke(knife, &Hand::across(0.3).along(&[(10.0, 18.0), (60.0, 18.0)]));
    let heights = easel.heights();
    // Beyond the heap.
    let mark = Mark::within(&heights, 24.0..80.0);
    let [mut film, mut uneven, mut upper, mut lower] = [f64::NAN; 4];
    if let Some(mark) = mark {
        let part = heights.part(mark.steady.clone(), mark.middle.clone());
        (film, uneven) = (mean(&part), 100.0 * deviation(&part) / mean(&part));
        [upper, lower] = mark.side_lips(&heights);
    }
    let figures = vec![
        Figure::new("spread film", film, "mm"),
        Figure::new("RMS of the spread film", uneven, "%").at_most(10.0),
        Figure::new("lip of the upper side over film", upper, "").at_least(1.3).at_most(2.5),
        Figure::new("lip of the lower side over film", lower, "").at_least(1.3).at_most(2.5),
    ];
    let panel = easel.show("knife 20, pressure 0.3, heap of 100 mm3", 2.0..78.0, 4.0..32.0);
    (figures, vec![panel])
}

fn scrape(bench: &Bench) -> Part {
    let mut easel =
        Easel::new(bench, bench.cell_mm, (60.0, 30.0), GroundKind::Linen, |_: f64, _: f64| {
            Some((BLUE_SLOT, 0.2))
        });
    let knife = easel.brush(HeadShape::Knife, 20.0);
    easel.stroke(knife, &Hand::across(0.9).along(&[(8.0, 15.0), (52.0, 15.0)]));
    let heights = easel.heights();
    let ground = easel.ground();
    let columns = heights.columns_in(20.0..42.0);
    let rows = heights.rows_in(9.0..21.0);
    let left = heights.part(columns.clone(), rows.clone());
    let threads = ground.part(columns, rows);
    let [low, high] = [0.25, 0.75].map(|share| quantile(&threads, share));
    let of = |chosen: &dyn Fn(f64) -> bool| {
        let cells = left.iter().zip(&threads).filter(|(_, ground)| chosen(**ground));
        mean(&cells.map(|(paint, _)| *paint).collect::<Vec<_>>())
    };
    let crests = of(&|ground| ground > high);
    let valleys = of(&|ground| ground < low);
    let figures = vec![
        Figure::new("scraped linen: paint left on crests", crests, "mm"),
        Figure::new("scraped linen: paint left in valleys", valleys, "mm"),
        Figure::new("scraped linen: valleys less crests", valleys - crests, "mm").at_least(0.005),
    ];
    let panel = easel.show("knife 20, pressure 0.9, 0.2 mm on linen", 2.0..58.0, 2.0..28.0);
    (figures, vec![panel])
}

fn scratch(bench: &Bench) -> Part {
    const FILM_MM: f64 = 0.3;
    let mut easel =
        Easel::new(bench, bench.cell_mm, (60.0, 24.0), GroundKind::Panel, |_: f64, _: f64| {
            Some((BLUE_SLOT, FILM_MM))
        });
    let edge_on = Hand { twist_deg: 0.0, ..Hand::across(0.6) };
    let tools = [
        ("knife 5 edge-on", HeadShape::Knife, 5.0, edge_on, 7.0),
        ("round 2", HeadShape::Round, 2.0, Hand::across(0.8), 17.0),
    ];
    let mut figures = Vec::new();
    for (name, shape, size_mm, hand, y_mm) in tools {
        let brush = easel.brush(shape, size_mm);
        easel.stroke(brush, &hand.along(&[(10.0, y_mm), (50.0, y_mm)]));
        let heights = easel.heights();
        let profile = heights.across(heights.columns_in(20.0..45.0));
        let line = &profile[heights.rows_in(y_mm - 2.0..y_mm + 2.0)];
        let lowest = line.iter().fold(f64::INFINITY, |a, &b| a.min(b));
        let highest = line.iter().fold(0.0, |a: f64, &b| a.max(b));
        figures.push(Figure::new(format!("{name}: depth of its line"), FILM_MM - lowest, "mm"));
        figures.push(Figure::new(format!("{name}: lip beside it"), highest - FILM_MM, "mm"));
    }
    let panel = easel.show("through 0.3 mm: knife 5 edge-on, round 2", 2.0..58.0, 1.0..23.0);
    (figures, vec![panel])
}

pub(super) fn knife(bench: &Bench) -> CaseReport {
    let parts = [spread(bench), scrape(bench), scratch(bench)];
    let (figures, panels): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
    let title = "Knife: a heap spread over 40 mm, a film scraped off linen, lines scratched";
    CaseReport { name: "knife", title, figures: figures.concat(), panels: panels.concat() }
}
