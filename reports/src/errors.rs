//! Section on colour errors: their histogram, and the table of all samples.

use calibrate::evaluate::Summary;
use calibrate::library::SampleEvidence;

use crate::axis::Axis;
use crate::figure::{Drawing, Figure, Words};
use crate::panel::{Chart, KeySymbol, Mark, Panel};
use crate::samples::worst_first;
use crate::style::{Color, INK, SERIES};
use crate::subject::{Section, Subject};
use crate::table::{Cell, Column, Table};

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Colour errors");
    if subject.comparison.is_none() {
        return section;
    }
    section.with_figure(histogram(subject)).with_table("Every sample, worst first", table(subject))
}

/// The data of one histogram.
struct Errors {
    /// Name of the counted samples, such as `samples, fitted`.
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
            "How many samples have which error, {}. The error of mixtures left out is that to expect of a mixture nobody measured. Samples with a pigment whose K and S are no measurement are not counted.",
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
    let left_out = |sample: &str| -> Option<f64> {
        let validation = subject.validation.as_ref()?;
        validation
            .per_sample
            .iter()
            .find(|other: &&SampleEvidence| other.sample == sample)
            .map(|s| s.delta_e)
    };
    let needed =
        |sample: &String| subject.validation.as_ref().is_some_and(|v| v.needed.contains(sample));
    for film in subject.comparison.iter().flat_map(worst_first) {
        let squares = film.predicted.iter().zip(&film.measured).map(|(p, m)| (p - m).powi(2));
        let rms = (squares.sum::<f64>() / film.measured.len() as f64).sqrt();
        let mut remarks = Vec::new();
        remarks.extend(film.unsure.then_some("a pigment's K and S are no measurement"));
        remarks.extend(film.excluded.then_some("excluded from the fit"));
        remarks.extend(needed(&film.sample).then_some("cannot be left out"));
        table.push([
            Cell::from(subject.sample(film)),
            subject.recipe(&film.recipe).into(),
            subject.color(&film.measured).into(),
            subject.color(&film.predicted).into(),
            film.delta_e.into(),
            left_out(&film.sample).into(),
            rms.into(),
            remarks.join("; ").into(),
        ]);
    }
    table
}
