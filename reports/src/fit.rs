//! Sections on the fit: measured and fitted reflectance, colour errors, mixtures left out, residuals, and K
//! and S.

use calibrate::StrengthChange;
use calibrate::comparison::{ComparedFilm, Comparison};
use calibrate::evaluate::{Summary, percentile};
use calibrate::library::SampleEvidence;

use crate::figure::{Cell, Column, Drawing, Figure, Table, Words};
use crate::panel::{Axis, Chart, KeySymbol, Mark, Panel, Point, Scale};
use crate::style::{CURVE, Color, DOT, FAINT, HAIR, INK, SERIES};
use crate::subject::{Section, Subject};

pub(crate) fn errors_section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Colour errors");
    if subject.comparison.is_none() {
        return section;
    }
    section.with_figure(histogram(subject)).with_table("Every sample, worst first", table(subject))
}

struct Errors {
    /// Name of the counted samples, e.g. `samples, fitted`.
    items: &'static str,
    errors: Vec<f64>,
    summary: Summary,
    color: Color,
}

fn histogram(subject: &Subject<'_>) -> Figure {
    let mut rows = Vec::new();
    if let Some(comparison) = &subject.comparison {
        let errors = comparison.sure().map(|film| film.delta_e).collect();
        let summary = comparison.delta_e;
        rows.push(Errors { items: "samples, fitted", errors, summary, color: SERIES[0] });
    }
    if let Some(validation) = &subject.validation {
        let errors = validation.per_sample.iter().map(|sample| sample.delta_e).collect();
        let summary = validation.delta_e;
        rows.push(Errors { items: "mixtures, left out", errors, summary, color: SERIES[1] });
    }
    let largest = rows.iter().map(|row| row.summary.max).fold(0.5, f64::max);
    let x = Axis::around("Colour error", "CIEDE2000", 0.0, largest, 10);
    let step = match largest {
        l if l <= 8.0 => 0.25,
        l if l <= 30.0 => 0.5,
        l => (l / 60.0).ceil(),
    };
    let bins = (x.high / step).ceil() as usize;
    let panels = rows.into_iter().map(|row| {
        let Errors { items, errors, summary, color } = row;
        let mut counts = vec![0_u32; bins];
        for error in &errors {
            counts[((error / step) as usize).min(bins - 1)] += 1;
        }
        let mut marks = Vec::new();
        for (bin, count) in counts.iter().enumerate() {
            let from = bin as f64 * step;
            let to = (bin + 1) as f64 * step;
            if *count > 0 {
                let gap = 0.08 * step;
                let top = (to - gap, f64::from(*count));
                marks.push(Mark::Bar { from: (from + gap, 0.0), to: top, color });
            }
        }
        let highest = f64::from(counts.iter().copied().max().unwrap_or(1));
        let y = Axis::around("Number of samples", "count", 0.0, highest.max(2.0), 4);
        for error in [summary.mean, summary.p90] {
            marks.push(Mark::Dashes { points: vec![(error, 0.0), (error, y.high)], color: INK });
        }
        let Summary { mean, median, p90, max } = summary;
        let panel = Panel::new(x.clone(), y, marks)
            .with_title(format!("{} {items}: median {median:.2}, largest {max:.2}", errors.len()))
            .with_key(KeySymbol::Dashes, INK, format!("mean {mean:.2}, 90 % below {p90:.2}"));
        (panel, 150.0)
    });
    let panels = panels.collect();
    let words = Words {
        name: "errors",
        title: "Colour errors",
        caption: &format!(
            "How many samples have which error, {}. The error of mixtures left out is that to expect of a mixture nobody measured. Samples with a pigment whose K and S were not measured are not counted.",
            subject.light()
        ),
        alt: "Histograms of colour errors, with mean and ninetieth percentile.",
    };
    subject.figure(words, Drawing::Chart(Chart::stacked(panels)), table(subject))
}

fn table(subject: &Subject<'_>) -> Table {
    let mut table = Table::new([
        Column::text("Sample"),
        Column::text("Recipe"),
        Column::text("Measured"),
        Column::text("Fitted"),
        Column::quantity("Fitted", "CIEDE2000", 2),
        Column::quantity("Left out", "CIEDE2000", 2),
        Column::quantity("Residual", "rms of reflectance", 4),
        Column::text("Remarks"),
    ]);
    let validation = subject.validation.as_ref();
    for film in subject.comparison.iter().flat_map(worst_first) {
        let squares = film.predicted.iter().zip(&film.measured).map(|(p, m)| (p - m).powi(2));
        let rms = (squares.sum::<f64>() / film.measured.len() as f64).sqrt();
        let mut remarks = Vec::new();
        remarks.extend(film.unsure.then_some("a pigment's K and S are not measured"));
        remarks.extend(film.excluded.then_some("excluded from the fit"));
        let is_needed = validation.is_some_and(|v| v.needed.contains(&film.sample));
        remarks.extend(is_needed.then_some("cannot be left out"));
        let left_out = validation.and_then(|validation| {
            let mut samples = validation.per_sample.iter();
            samples.find(|other: &&SampleEvidence| other.sample == film.sample)
        });
        table.push([
            Cell::from(subject.sample(film)),
            subject.recipe(&film.recipe).into(),
            subject.color(&film.measured).into(),
            subject.color(&film.predicted).into(),
            film.delta_e.into(),
            left_out.map(|sample| sample.delta_e).into(),
            rms.into(),
            remarks.join("; ").into(),
        ]);
    }
    table
}

const COLUMNS: usize = 5;

pub(crate) fn curves_section(subject: &Subject<'_>) -> Section {
    Section::new("Absorption and scattering")
        .with_figure(absorption(subject))
        .with_figure(scattering(subject))
}

fn absorption(subject: &Subject<'_>) -> Figure {
    figure(
        subject,
        &Curves {
            words: Words {
                name: "absorption",
                title: "Absorption K of every pigment",
                caption: "Each curve has the colour of its pigment; the band is one standard deviation either way. The axis is logarithmic; what lies below it stands at its foot.",
                alt: "Small charts of absorption over wavelength, one for each pigment.",
            },
            quantity: "absorption K",
            of: |pigment| (&pigment.absorption, &pigment.absorption_sd),
            axis: |unit, low, high| Axis::log("Absorption K", unit, low, high, 7),
        },
    )
}

fn scattering(subject: &Subject<'_>) -> Figure {
    figure(
        subject,
        &Curves {
            words: Words {
                name: "scattering",
                title: "Scattering S of every pigment",
                caption: "Each curve has the colour of its pigment; the band is one standard deviation either way. The axis is logarithmic; what lies below it stands at its foot. Where S is unknown, the line at 1 stands in for it.",
                alt: "Small charts of scattering over wavelength, one for each pigment.",
            },
            quantity: "scattering S",
            of: |pigment| (&pigment.scattering, &pigment.scattering_sd),
            axis: |unit, low, high| Axis::log("Scattering S", unit, low, high, 6),
        },
    )
}

struct Curves<'a> {
    words: Words<'a>,
    quantity: &'a str,
    of: fn(&calibrate::library::Pigment) -> (&Vec<f64>, &Vec<f64>),
    axis: fn(&str, f64, f64) -> Axis,
}

fn figure(subject: &Subject<'_>, curves: &Curves<'_>) -> Figure {
    let library = subject.library;
    let unit = subject.unit();
    let all = library.pigments.iter().flat_map(|pigment| (curves.of)(pigment).0.iter().copied());
    let high = all.clone().fold(0.0, f64::max);
    let low = all.filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min);
    let y = (curves.axis)(&unit, low, high);
    debug_assert_eq!(y.scale, Scale::Log, "bands are cut at the foot of a log axis");
    let x = Axis::wavelength(library.grid, 100);
    let mut data = Table::new([
        Column::text("pigment"),
        Column::quantity("wavelength", "nm", 0),
        Column::quantity(curves.quantity, &unit, 4),
        Column::quantity("standard deviation", &unit, 4),
    ]);
    let panels = library.ids().map(|id| {
        let (values, deviations) = (curves.of)(&library[id]);
        let name = subject.label(id);
        let mut edges = Vec::new();
        for (at, nm) in library.grid.wavelengths_nm().enumerate() {
            let value = values[at];
            let sd = deviations.get(at).copied();
            data.push([name.as_str().into(), nm.into(), value.into(), Cell::from(sd)]);
            edges.extend(sd.map(|sd| (nm, value - sd, value + sd)));
        }
        let color = subject.masstone(id);
        let points = library.grid.wavelengths_nm().zip(values.iter().copied()).collect();
        let mut marks = Vec::new();
        if !edges.is_empty() {
            marks.push(Mark::band(&edges, color.for_line()));
        }
        let color = color.for_line();
        marks.push(if subject.mark(id).is_none() {
            Mark::Line { points, color, width: CURVE }
        } else {
            Mark::Dashes { points, color }
        });
        if let Some(mark) = subject.mark(id) {
            let corner = (x.low, 0.3 * y.high);
            let names = vec![(corner, mark.to_owned())];
            marks.push(Mark::Names { names, around: Vec::new(), color: FAINT });
        }
        let patch = [subject.masstone(id)];
        let pigment = &library[id];
        Panel::new(x.clone(), y.clone(), marks)
            .with_title(pigment.name.as_str())
            .with_patches(patch)
    });
    let panels: Vec<Panel> = panels.collect();
    let chart = Chart::small_multiples(panels, COLUMNS, 110.0);
    subject.figure(curves.words, Drawing::Chart(chart), data)
}

const SAMPLES_COLUMNS: usize = 6;
/// Rows of panels that fit on a printed page.
const ROWS: usize = 10;

pub(crate) fn samples_section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Measured and fitted reflectance");
    let Some(comparison) = &subject.comparison else { return section };
    let worst_first = worst_first(comparison);
    let pages: Vec<&[&ComparedFilm]> = worst_first.chunks(SAMPLES_COLUMNS * ROWS).collect();
    let figures = pages.iter().enumerate().map(|(index, films)| {
        let number = (pages.len() > 1).then_some((index + 1, pages.len()));
        samples_figure(subject, films, number)
    });
    figures.fold(section, Section::with_figure)
}

/// The films sorted by colour error, largest first.
pub(crate) fn worst_first(comparison: &Comparison) -> Vec<&ComparedFilm> {
    let mut films: Vec<&ComparedFilm> = comparison.films.iter().collect();
    films.sort_by(|a, b| b.delta_e.total_cmp(&a.delta_e));
    films
}

fn samples_figure(
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
            "Dots are measured, lines fitted; worst sample first, its recipe below its name. The number is the colour error in CIEDE2000 ({}); the patches show the measured and the fitted colour. A star marks a recipe with a pigment whose K and S were not measured.",
            subject.light()
        ),
        alt: &format!(
            "{} small charts of reflectance over wavelength, from the sample with the largest error to that with the smallest.",
            films.len()
        ),
    };
    let chart = Chart::small_multiples(panels, SAMPLES_COLUMNS, 76.0);
    subject.figure(words, Drawing::Chart(chart), data)
}

/// Percentiles of the residuals. We draw one band between the outer pair and one between the inner
/// pair.
const PERCENTS: [f64; 5] = [5.0, 25.0, 50.0, 75.0, 95.0];

pub(crate) fn residuals_section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Residuals");
    match &subject.comparison {
        Some(comparison) => section.with_figure(residuals_figure(subject, &comparison.films)),
        None => section,
    }
}

fn residuals_figure(subject: &Subject<'_>, films: &[ComparedFilm]) -> Figure {
    let grid = subject.library.grid;
    let residuals: Vec<Vec<f64>> = films.iter().map(residual).collect();

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

    let percentiles: Vec<[f64; 5]> = (0..grid.count())
        .map(|w| {
            let values: Vec<f64> = residuals.iter().map(|r| r[w]).collect();
            PERCENTS.map(|percent| percentile(&values, percent))
        })
        .collect();
    for (index, percent) in PERCENTS.iter().enumerate() {
        for (nm, values) in grid.wavelengths_nm().zip(&percentiles) {
            data.push([Cell::from(format!("{percent} %")), nm.into(), values[index].into()]);
        }
    }
    let [outer, inner] = [(0, 4), (1, 3)].map(|(low, high): (usize, usize)| {
        let edges = grid.wavelengths_nm().zip(&percentiles);
        let edges: Vec<_> = edges.map(|(nm, p)| (nm, p[low], p[high])).collect();
        Mark::band(&edges, SERIES[0])
    });
    let median = grid.wavelengths_nm().zip(percentiles.iter().map(|p| p[2])).collect();
    let marks = vec![zero, outer, inner, Mark::Line { points: median, color: INK, width: CURVE }];
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

fn bounds(values: &mut dyn Iterator<Item = f64>) -> Axis {
    let largest = values.map(f64::abs).fold(1e-3, f64::max);
    Axis::around("Fitted - measured", "white = 1", -largest, largest, 6)
}

fn residual(film: &ComparedFilm) -> Vec<f64> {
    film.predicted.iter().zip(&film.measured).map(|(p, m)| p - m).collect()
}

/// We label this many of the largest errors with sample and recipe.
const NAMED: usize = 6;
/// We label this many of the next largest errors with the sample only.
const NAMED_SHORTLY: usize = 14;

pub(crate) fn left_out_section(subject: &Subject<'_>) -> Section {
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
    let section = validation.strengths.iter().fold(section, |section, change: &StrengthChange| {
        section.with_paragraph(format!("Strength: {change}."))
    });
    section.with_figure(left_out_figure(subject, &pairs))
}

/// Draws films with their error when left out. `pairs` is sorted by that error, largest first.
fn left_out_figure(subject: &Subject<'_>, pairs: &[(&ComparedFilm, f64)]) -> Figure {
    let errors = pairs.iter().flat_map(|(film, left_out)| [film.delta_e, *left_out]);
    let low = errors.clone().fold(f64::INFINITY, f64::min);
    let high = errors.fold(0.0, f64::max);
    let [x, y] = ["Colour error in the fit", "Colour error when left out"]
        .map(|what| Axis::log_close(what, "CIEDE2000", low.max(0.05), high));
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
