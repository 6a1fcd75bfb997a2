//! Section with measured and fitted reflectance of each sample, after figure 8 of Baxter, Wendt
//! and Lin (2004).

use calibrate::comparison::{ComparedFilm, Comparison};

use crate::axis::Axis;
use crate::figure::{Drawing, Figure, Words};
use crate::panel::{Chart, Mark, Panel, Point};
use crate::style::{CURVE, DOT};
use crate::subject::{Section, Subject};
use crate::table::{Column, Table};

const COLUMNS: usize = 6;
/// Rows of panels that fit on a printed page.
const ROWS: usize = 10;

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Measured and fitted reflectance");
    let Some(comparison) = &subject.comparison else { return section };
    let worst_first = worst_first(comparison);
    let pages: Vec<&[&ComparedFilm]> = worst_first.chunks(COLUMNS * ROWS).collect();
    let numbered = |index| (pages.len() > 1).then_some((index + 1, pages.len()));
    let figures = pages.iter().enumerate();
    let figures = figures.map(|(index, films)| figure(subject, films, numbered(index)));
    figures.fold(section, Section::with_figure)
}

/// The films sorted by colour error, largest first.
pub(crate) fn worst_first(comparison: &Comparison) -> Vec<&ComparedFilm> {
    let mut films: Vec<&ComparedFilm> = comparison.films.iter().collect();
    films.sort_by(|a, b| b.delta_e.total_cmp(&a.delta_e));
    films
}

fn figure(
    subject: &Subject<'_>,
    films: &[&ComparedFilm],
    number: Option<(usize, usize)>,
) -> Figure {
    let grid = subject.library.grid;
    let x = Axis::wavelength(grid, 100);
    let values = films.iter().flat_map(|film| film.measured.iter().chain(&film.predicted));
    let y = Axis::reflectance(values.copied().fold(0.0, f64::max), 2);
    let mut data = Table::new([
        Column::text("sample"),
        Column::quantity("wavelength", "nm", 0),
        Column::quantity("measured reflectance", "1", 4),
        Column::quantity("fitted reflectance", "1", 4),
    ]);
    let mut panels = Vec::new();
    for film in films {
        let points = |values: &[f64]| -> Vec<Point> {
            grid.wavelengths_nm().zip(values.iter().copied()).collect()
        };
        for ((nm, measured), fitted) in points(&film.measured).into_iter().zip(&film.predicted) {
            data.push([subject.sample(film).into(), nm.into(), measured.into(), (*fitted).into()]);
        }
        let patches = [subject.color(&film.measured), subject.color(&film.predicted)];
        let color = patches[0].for_line();
        let marks = vec![
            Mark::Line { points: points(&film.predicted), color, width: CURVE },
            Mark::Dots { points: points(&film.measured), color: color.contrasting(), radius: DOT },
        ];
        let panel = Panel::new(x.clone(), y.clone(), marks)
            .with_title(subject.sample(film))
            .with_subtitle(subject.recipe(&film.recipe))
            .with_note(format!("{:.2}", film.delta_e))
            .with_patches(patches);
        panels.push(panel);
    }
    let (name, part) = match number {
        Some((1, of)) => ("samples".to_owned(), format!(", part 1 of {of}")),
        Some((index, of)) => (format!("samples-{index}"), format!(", part {index} of {of}")),
        None => ("samples".to_owned(), String::new()),
    };
    let words = Words {
        name: &name,
        title: &format!("Measured and fitted reflectance of every sample{part}"),
        caption: &format!(
            "Dots are measured, lines fitted; worst sample first, its recipe below its name. The number is the colour error in CIEDE2000 ({}); the patches show the measured and the fitted colour. A star marks a recipe with a pigment whose K and S are no measurement.",
            subject.light()
        ),
        alt: &format!(
            "{} small charts of reflectance over wavelength, from the sample with the largest error to that with the smallest.",
            films.len()
        ),
    };
    let chart = Chart::small_multiples(panels, COLUMNS, 76.0);
    subject.figure(words, Drawing::Chart(chart), data)
}
