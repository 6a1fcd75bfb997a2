//! Section on the residuals of the fit by wavelength.

use calibrate::comparison::ComparedFilm;
use calibrate::evaluate::percentile;

use crate::axis::Axis;
use crate::figure::{Drawing, Figure, Words};
use crate::panel::{Chart, KeySymbol, Mark, Panel, Point};
use crate::style::{CURVE, FAINT, HAIR, INK, SERIES};
use crate::subject::{Section, Subject};
use crate::table::{Cell, Column, Table};

/// Percentiles of the residuals; bands join the outer and the inner pair.
const PERCENTS: [f64; 5] = [5.0, 25.0, 50.0, 75.0, 95.0];

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Residuals");
    match &subject.comparison {
        Some(comparison) => section.with_figure(figure(subject, &comparison.films)),
        None => section,
    }
}

fn figure(subject: &Subject<'_>, films: &[ComparedFilm]) -> Figure {
    let grid = subject.library.grid;
    let residual = |film: &ComparedFilm| -> Vec<f64> {
        film.predicted.iter().zip(&film.measured).map(|(p, m)| p - m).collect()
    };
    let residuals: Vec<Vec<f64>> = films.iter().map(residual).collect();
    let bounds = |values: &mut dyn Iterator<Item = f64>| {
        let largest = values.map(f64::abs).fold(1e-3, f64::max);
        Axis::around("Fitted - measured", "white = 1", -largest, largest, 6)
    };

    let x = Axis::wavelength(grid, 50);
    let zero = Mark::Line { points: vec![(x.low, 0.0), (x.high, 0.0)], color: FAINT, width: HAIR };
    let mut columns =
        vec![Column::text("sample or percentile"), Column::quantity("wavelength", "nm", 0)];
    columns.push(Column::quantity("fitted - measured reflectance", "1", 4));
    let mut data = Table::new(columns);
    let mut marks = vec![zero.clone()];
    for (film, residual) in films.iter().zip(&residuals) {
        let points: Vec<Point> = grid.wavelengths_nm().zip(residual.iter().copied()).collect();
        for (nm, value) in &points {
            data.push([Cell::from(subject.sample(film)), (*nm).into(), (*value).into()]);
        }
        let color = subject.color(&film.measured).for_line();
        marks.push(Mark::Line { points, color, width: 0.8 });
    }
    let all = bounds(&mut residuals.iter().flatten().copied());
    let curves =
        Panel::new(x.clone(), all, marks).with_title("Every sample, in its measured colour");

    let at = |wavelength: usize| -> Vec<f64> { residuals.iter().map(|r| r[wavelength]).collect() };
    let percentiles: Vec<[f64; 5]> =
        (0..grid.count()).map(|w| PERCENTS.map(|percent| percentile(&at(w), percent))).collect();
    for (index, percent) in PERCENTS.iter().enumerate() {
        for (nm, values) in grid.wavelengths_nm().zip(&percentiles) {
            data.push([Cell::from(format!("{percent} %")), nm.into(), values[index].into()]);
        }
    }
    let band = |low: usize, high: usize| {
        let edges = grid.wavelengths_nm().zip(&percentiles);
        let edges: Vec<_> = edges.map(|(nm, p)| (nm, p[low], p[high])).collect();
        Mark::band(&edges, SERIES[0])
    };
    let median = grid.wavelengths_nm().zip(percentiles.iter().map(|p| p[2])).collect();
    let marks =
        vec![zero, band(0, 4), band(1, 3), Mark::Line { points: median, color: INK, width: CURVE }];
    let y = bounds(&mut percentiles.iter().flatten().copied());
    let spread = Panel::new(x, y, marks)
        .with_key(KeySymbol::Line, INK, "median")
        .with_key(KeySymbol::Bands(2), SERIES[0], "half of the samples")
        .with_key(KeySymbol::Bands(1), SERIES[0], "nine tenths of the samples");

    let words = Words {
        name: "residuals",
        title: "Residuals over wavelength",
        caption: "Fitted less measured reflectance: above, of every sample; below, its median and the ranges that hold a half and nine tenths of the samples.",
        alt: "Two charts of residuals over wavelength: one curve for each sample, and percentile bands around the median.",
    };
    let chart = Chart::stacked(vec![(curves, 210.0), (spread, 170.0)]);
    subject.figure(words, Drawing::Chart(chart), data)
}
