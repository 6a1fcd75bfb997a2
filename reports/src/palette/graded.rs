//! Section on graded mixtures from one paint to another, computed in several ways.

use calibrate::PigmentId;
use calibrate::palette::{
    GradedMixture, MeasuredSample, MixingRow, PainterRules, Palette, default_pairs, graded,
};
use calibrate::quadrature::{QuadratureMethod, QuadratureTrial};

use super::cells::{columns, row};
use super::context::{NOTCH, films, measured, palette};
use super::patch::rimmed;
use crate::figure::{Drawing, Figure, Words};
use crate::style::{FAINT, INK, SMALL_TEXT, TEXT, WIDTH};
use crate::subject::{Section, Subject};
use crate::svg::{Anchor, Canvas};
use crate::table::{Cell, Column, Table};

/// Width for the names, in px.
const NAME: f64 = 112.0;
/// Width for the mean errors, in px.
const MEAN: f64 = 84.0;
/// Height of a patch, in px.
const PATCH: f64 = 40.0;
/// Height of a row, in px.
const ROW: f64 = 60.0;
/// Height above the first row, in px.
const HEAD: f64 = 40.0;

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Graded mixtures");
    let Some(palette) = palette(subject) else { return section };
    let measured = measured(subject, &palette);
    let pairs = match subject.pair {
        Some(pair) => vec![pair],
        None => default_pairs(&palette, &measured),
    };
    if let Some(left_out) =
        pairs.iter().flat_map(|(a, b)| [*a, *b]).find(|p: &PigmentId| !palette.paints().contains(p))
    {
        return section.with_paragraph(format!(
            "{} takes no part in mixtures: its scattering is not known.",
            subject.label(left_out)
        ));
    }
    if pairs.is_empty() {
        return section;
    }
    let rules = rules(subject, &palette);
    pairs.into_iter().enumerate().fold(section, |section, (index, pair)| {
        section.with_figure(figure(subject, &palette, (index + 1, pair), &measured, &rules))
    })
}

/// Quadratures of three and eight wavelengths: those of the report if it has both, else newly
/// computed ones.
fn rules(subject: &Subject<'_>, palette: &Palette<'_>) -> PainterRules {
    let tried = |count: usize| {
        let mut trials = subject.quadratures.iter();
        trials
            .find(|trial: &&QuadratureTrial| {
                trial.method == QuadratureMethod::Library && trial.rule.nodes_nm.len() == count
            })
            .map(|trial| trial.rule.clone())
    };
    match (tried(8), tried(3)) {
        (Some(eight), Some(three)) => PainterRules { eight, three },
        _ => PainterRules::of(palette).expect("three and eight wavelengths are allowed"),
    }
}

fn figure(
    subject: &Subject<'_>,
    palette: &Palette<'_>,
    (number, pair): (usize, (PigmentId, PigmentId)),
    measured: &[MeasuredSample],
    rules: &PainterRules,
) -> Figure {
    let mixture = graded(palette, pair, measured, rules);
    let first = subject.label(pair.0);
    let second = subject.label(pair.1);
    let own = [
        Column::quantity(&format!("share of {second}"), "%", 2),
        Column::text("way"),
        Column::text("sample"),
        Column::quantity("CIEDE2000", "1", 2),
        Column::text("from"),
    ];
    let mut data = Table::new(columns(own));
    for step in &mixture.steps {
        let from = if step.sample.is_some() { MixingRow::Measured } else { MixingRow::Spectrum };
        for way in MixingRow::ALL {
            let Some(look) = step.colors[way as usize] else { continue };
            let error = step.errors[way as usize];
            let own: [Cell; 5] = [
                (100.0 * step.share).into(),
                way.name().into(),
                step.sample
                    .clone()
                    .filter(|_| way == MixingRow::Measured)
                    .map_or(Cell::Empty, Cell::from),
                Cell::from(error),
                error.map_or(Cell::Empty, |_| from.name().into()),
            ];
            data.push(row(own, &look));
        }
    }
    let name = format!("graded-mixture-{number}");
    let title = format!("{first} to {second}");
    let nodes = |nodes: &[f64]| {
        let whole: Vec<String> = nodes.iter().map(|nm| format!("{nm:.0}")).collect();
        whole.join(", ")
    };
    let caption = format!(
        "After Baxter, Wendt and Lin 2004, figure 10: measured swatches where there are any, Kubelka-Munk mixing at every wavelength, at 8 ({} nm) and at 3 ({} nm) fitted to the library, and straight lines in linear RGB between the two ends. Below each: CIEDE2000 from the measured swatch; grey, where there is none, from the full spectrum. On the right the means over the mixtures, ends left out. {} {}. {NOTCH}",
        nodes(&rules.eight.nodes_nm),
        nodes(&rules.three.nodes_nm),
        films(palette),
        subject.light()
    );
    let alt = format!("Rows of patches from {first} to {second}, one row for each way to mix.");
    let words = Words { name: &name, title: &title, caption: &caption, alt: &alt };
    subject.figure(words, Drawing::Canvas(rows(&mixture, [&first, &second])), data)
}

fn rows(mixture: &GradedMixture, ends: [&str; 2]) -> Canvas {
    let shown =
        |way: &MixingRow| mixture.steps.iter().any(|step| step.colors[*way as usize].is_some());
    let ways: Vec<MixingRow> = MixingRow::ALL.into_iter().filter(shown).collect();
    let step_width = (f64::from(WIDTH) - NAME - MEAN) / mixture.steps.len() as f64;
    let mut canvas = Canvas::new(WIDTH, (HEAD + ROW * ways.len() as f64).ceil() as u32);
    let right = f64::from(WIDTH) - MEAN;
    let space = (NAME - 10.0, HEAD - 4.0);
    canvas.name((NAME - 8.0, HEAD / 2.0 - 2.0), space, SMALL_TEXT, Anchor::End, INK, ends[1]);
    canvas.text((right + 8.0, 12.0), SMALL_TEXT, Anchor::Start, INK, "mean");
    for (at, step) in mixture.steps.iter().enumerate() {
        let middle = NAME + (at as f64 + 0.5) * step_width;
        let share = format!("{} %", (1000.0 * step.share).round() / 10.0);
        canvas.text((middle, 12.0), SMALL_TEXT, Anchor::Middle, INK, &share);
        if let Some(sample) = &step.sample {
            let space = (step_width - 2.0, 16.0);
            canvas.name((middle, 27.0), space, SMALL_TEXT, Anchor::Middle, FAINT, sample);
        }
    }
    for (line, way) in ways.into_iter().enumerate() {
        let y = HEAD + line as f64 * ROW;
        canvas.text((NAME - 8.0, y + PATCH / 2.0), TEXT, Anchor::End, INK, way.name());
        for (at, step) in mixture.steps.iter().enumerate() {
            let x = NAME + at as f64 * step_width;
            if let Some(look) = &step.colors[way as usize] {
                rimmed(&mut canvas, (x + 1.0, y), (step_width - 2.0, PATCH), look);
            }
            if let Some(error) = step.errors[way as usize] {
                let color = if step.sample.is_some() { INK } else { FAINT };
                let at = (x + step_width / 2.0, y + PATCH + 9.0);
                canvas.text(at, SMALL_TEXT, Anchor::Middle, color, &format!("{error:.1}"));
            }
        }
        for (measured, dy, color) in [(true, 12.0, INK), (false, 28.0, FAINT)] {
            let Some((mean, count)) = mixture.mean_error(way, measured) else { continue };
            let label = format!("{mean:.2} of {count}");
            canvas.text((right + 8.0, y + dy), SMALL_TEXT, Anchor::Start, color, &label);
        }
    }
    canvas
}
