//! Section on validation: the error of each mixture when predicted without its own measurement,
//! against its error in the fit.

use calibrate::comparison::ComparedFilm;

use crate::axis::Axis;
use crate::figure::{Drawing, Figure, Words};
use crate::panel::{Chart, KeySymbol, Mark, Panel};
use crate::style::{FAINT, HAIR, INK};
use crate::subject::{Section, Subject};
use crate::table::{Cell, Column, Table};

/// Number of the largest errors that are labelled with sample and recipe.
const NAMED: usize = 6;
/// Number of the next largest errors that are labelled with the sample only.
const NAMED_SHORTLY: usize = 14;

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Mixtures left out");
    let (Some(comparison), Some(validation)) = (&subject.comparison, &subject.validation) else {
        return section;
    };
    let mut pairs: Vec<(&ComparedFilm, f64)> = Vec::new();
    for evidence in &validation.per_sample {
        let film = comparison.films.iter().find(|film| film.sample == evidence.sample);
        pairs.extend(film.map(|film| (film, evidence.delta_e)));
    }
    if pairs.is_empty() {
        return section;
    }
    pairs.sort_by(|a, b| b.1.total_cmp(&a.1));
    let section = if validation.needed.is_empty() {
        section
    } else {
        let films = &comparison.films;
        let needed = validation.needed.iter().map(|sample| {
            let film = films.iter().find(|film| film.sample == *sample);
            let recipe = film.map(|film| format!(" ({})", subject.recipe(&film.recipe)));
            format!("{sample}{}", recipe.unwrap_or_default())
        });
        let needed = needed.collect::<Vec<_>>().join(", ");
        section.with_paragraph(format!(
            "Not left out, since a pigment would not be identified without them: {needed}."
        ))
    };
    section.with_figure(figure(subject, &pairs))
}

/// Draws films with their error when left out; `pairs` is sorted by that error, largest first.
fn figure(subject: &Subject<'_>, pairs: &[(&ComparedFilm, f64)]) -> Figure {
    let errors = || pairs.iter().flat_map(|(film, left_out)| [film.delta_e, *left_out]);
    let low = errors().fold(f64::INFINITY, f64::min);
    let high = errors().fold(0.0, f64::max);
    let axis = |what: &str| Axis::log_close(what, "CIEDE2000", low.max(0.05), high);
    let x = axis("Colour error in the fit");
    let y = axis("Colour error when left out");
    let mut data = Table::new([
        Column::text("sample"),
        Column::text("recipe"),
        Column::quantity("fitted", "CIEDE2000", 2),
        Column::quantity("left out", "CIEDE2000", 2),
    ]);
    let ends = vec![(x.low, y.low), (x.high, y.high)];
    let mut marks = vec![Mark::Line { points: ends, color: FAINT, width: HAIR }];
    for (film, left_out) in pairs {
        let recipe = subject.recipe(&film.recipe);
        data.push([
            Cell::from(subject.sample(film)),
            recipe.into(),
            film.delta_e.into(),
            (*left_out).into(),
        ]);
        let color = subject.color(&film.measured).for_line();
        marks.push(Mark::Dots { points: vec![(film.delta_e, *left_out)], color, radius: 3.6 });
    }
    let named = pairs.iter().take(NAMED + NAMED_SHORTLY).enumerate();
    let names = named.map(|(place, (film, left_out))| {
        let sample = subject.sample(film);
        let recipe = subject.recipe(&film.recipe);
        let name = if place < NAMED { format!("{sample}: {recipe}") } else { sample };
        ((film.delta_e, *left_out), name)
    });
    let dots = pairs.iter().map(|(film, left_out)| (film.delta_e, *left_out));
    let along = (0..=100).map(|i| x.low * (x.high / x.low).powf(f64::from(i) / 100.0));
    let dots = dots.chain(along.map(|error| (error, error)));
    marks.push(Mark::Names { names: names.collect(), around: dots.collect(), color: INK });
    let panel = Panel::new(x, y, marks).with_key(KeySymbol::Line, FAINT, "both alike");
    let words = Words {
        name: "left-out",
        title: "Error of mixtures left out, against their error in the fit",
        caption: &format!(
            "Each dot is a mixture, in its measured colour; upwards, its colour error when the other samples alone predict it ({}). Those far above the line are known from little else than themselves; the largest are named.",
            subject.light()
        ),
        alt: "A scatter chart of colour errors, most dots above the diagonal.",
    };
    subject.figure(words, Drawing::Chart(Chart::single(panel, 460.0)), data)
}
