//! Section with mixing chart, tints and drawdowns.

use calibrate::palette::{CHART_TINT, Palette, TINTS, mixing_chart, tint_ladders};

use super::card;
use super::cells::{columns, row};
use super::context::{NOTCH, films, palette, thinner};
use super::patch::{patch, rim, rimmed};
use crate::figure::{Drawing, Figure, Words};
use crate::lettering::estimated_width;
use crate::style::{FAINT, INK, SMALL_TEXT, TEXT, WIDTH};
use crate::subject::{Section, Subject};
use crate::svg::{Anchor, Canvas};
use crate::table::{Column, Table};

/// Width for the names, in px.
const NAME: f64 = 170.0;

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("What the paints mix");
    let Some(palette) = palette(subject) else { return section };
    let left_out: Vec<String> = palette.left_out().into_iter().map(|p| subject.label(p)).collect();
    let section = if left_out.is_empty() {
        section
    } else {
        section.with_paragraph(format!(
            "Left out of all mixtures, since their scattering is not known: {}.",
            left_out.join(", ")
        ))
    };
    section
        .with_figure(chart(subject, &palette))
        .with_figure(tints(subject, &palette))
        .with_figure(card::figure(subject, &palette))
}

fn chart(subject: &Subject<'_>, palette: &Palette<'_>) -> Figure {
    let chart = mixing_chart(palette);
    let count = chart.paints.len();
    let names: Vec<String> = chart.paints.iter().map(|&p| subject.label(p)).collect();
    let own = [
        Column::text("first"),
        Column::text("second"),
        Column::quantity("parts of white or water to one", "1", 0),
    ];
    let mut data = Table::new(columns(own));
    for (i, first) in names.iter().enumerate() {
        for (j, second) in names.iter().enumerate().skip(i) {
            for (parts, looks) in [(0.0, &chart.colors), (CHART_TINT, &chart.tinted)] {
                let own = [first.as_str().into(), second.as_str().into(), parts.into()];
                data.push(row(own, &looks[i][j]));
            }
        }
    }
    let cell = ((f64::from(WIDTH) - NAME - 10.0) / count as f64).min(48.0);
    let longest = names.iter().map(|name| estimated_width(name, TEXT)).fold(0.0, f64::max);
    let head = longest.min(NAME) + 12.0;
    let side = cell * count as f64;
    let mut canvas = Canvas::new(WIDTH, (head + side + 8.0).ceil() as u32);
    rim(&mut canvas, (NAME, head), (side, side));
    for (i, name) in names.iter().enumerate() {
        let middle = (i as f64 + 0.5) * cell;
        let beside = (NAME - 8.0, head + middle);
        let above = (NAME + middle, head - 6.0);
        canvas.name(beside, (NAME - 12.0, cell), TEXT, Anchor::End, INK, name);
        canvas.name_upwards(above, (head - 8.0, cell), TEXT, INK, name);
        for j in 0..count {
            let at = (NAME + j as f64 * cell, head + i as f64 * cell);
            if i == j {
                patch(&mut canvas, at, (cell, cell), &chart.colors[i][i]);
            } else {
                let looks = if j < i { &chart.colors } else { &chart.tinted };
                let at = (at.0 + 1.0, at.1 + 1.0);
                patch(&mut canvas, at, (cell - 2.0, cell - 2.0), &looks[i][j]);
            }
        }
    }
    let thinner = thinner(palette);
    let caption = format!(
        "Below the diagonal every two pigments one part to one; above it the same with {CHART_TINT} parts of {thinner} to one of the mixture; on it each by itself. {} {NOTCH}",
        films(palette)
    );
    let words = Words {
        name: "mixing-chart",
        title: "Mixing chart",
        caption: &caption,
        alt: "A square of patches, each the mixture of the pigment of its row with that of its column.",
    };
    subject.figure(words, Drawing::Canvas(canvas), data)
}

fn tints(subject: &Subject<'_>, palette: &Palette<'_>) -> Figure {
    const ROW: f64 = 30.0;
    const HEAD: f64 = 22.0;
    let ladders = tint_ladders(palette);
    let own = [Column::text("pigment"), Column::quantity("parts of white or water to one", "1", 0)];
    let mut data = Table::new(columns(own));
    let blocks = if ladders.len() > 6 { 2 } else { 1 };
    let rows = ladders.len().div_ceil(blocks);
    let block = f64::from(WIDTH) / blocks as f64;
    let step = (block - NAME - 12.0) / TINTS.len() as f64;
    let mut canvas = Canvas::new(WIDTH, (HEAD + ROW * rows as f64 + 4.0).ceil() as u32);
    for index in 0..blocks {
        for (place, parts) in TINTS.iter().enumerate() {
            let label = if *parts == 0.0 { "masstone".to_owned() } else { format!("1 : {parts}") };
            let x = index as f64 * block + NAME + (place as f64 + 0.5) * step;
            canvas.text((x, HEAD - 10.0), SMALL_TEXT, Anchor::Middle, FAINT, &label);
        }
    }
    for (index, ladder) in ladders.iter().enumerate() {
        let x = (index / rows) as f64 * block + NAME;
        let y = HEAD + (index % rows) as f64 * ROW;
        let name = subject.label(ladder.paint);
        let space = (NAME - 12.0, ROW);
        canvas.name((x - 8.0, y + ROW / 2.0), space, TEXT, Anchor::End, INK, &name);
        for (place, (parts, look)) in TINTS.iter().zip(&ladder.colors).enumerate() {
            let at = (x + place as f64 * step, y + 2.0);
            rimmed(&mut canvas, at, (step, ROW - 5.0), look);
            data.push(row([name.as_str().into(), (*parts).into()], look));
        }
    }
    let thinner = thinner(palette);
    let caption = format!(
        "Each pigment by itself, then one part of it to 1, 3, 9 and 27 parts of {thinner}. {} {NOTCH}",
        films(palette)
    );
    let words = Words {
        name: "tints",
        title: "Tints of every pigment",
        caption: &caption,
        alt: "For each pigment a row of patches from the masstone to a pale tint.",
    };
    subject.figure(words, Drawing::Canvas(canvas), data)
}
