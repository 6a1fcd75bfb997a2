//! The knife: spreading, scraping, and scratching through wet paint.

use paint::HeadShape;
use paint::ground::GroundKind;

use super::super::canvas::{BLUE_SLOT, BODY, Bench, Easel};
use super::super::figure::{CaseReport, Figure, Panel};
use super::super::hand::Hand;
use super::super::measure::mark::Mark;
use super::super::measure::series::{deviation, mean, quantile};

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

/// Scrapes a film off linen.
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

/// Scratches lines through a film.
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

/// Spreading, scraping and sgraffito.
pub(super) fn knife(bench: &Bench) -> CaseReport {
    let parts = [spread(bench), scrape(bench), scratch(bench)];
    let (figures, panels): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
    let title = "Knife: a heap spread over 40 mm, a film scraped off linen, lines scratched";
    CaseReport { name: "knife", title, figures: figures.concat(), panels: panels.concat() }
}
