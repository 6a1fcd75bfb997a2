//! Section on light, observer and the quadrature of a few wavelengths, after figure 9 of Baxter,
//! Wendt and Lin (2004).

use calibrate::quadrature::{QuadratureMethod, QuadratureTrial};

use crate::figure::{Cell, Column, Drawing, Figure, Table, Words};
use crate::panel::{Axis, Chart, KeySymbol, Mark, Panel, Point};
use crate::style::{CURVE, Color, DOT, FAINT, HAIR, INK, SERIES};
use crate::subject::{Section, Subject};

/// Number of wavelengths of the quadrature that we show, as is usual in `calibrate::quadrature`.
const NODES: usize = 8;
const CHANNELS: [(&str, Color); 3] = [("X", SERIES[1]), ("Y", SERIES[2]), ("Z", SERIES[0])];

pub(crate) fn section(subject: &Subject<'_>) -> Section {
    let section = Section::new("Light and wavelengths");
    let chosen = subject.quadratures.iter().find(|trial| {
        trial.method == QuadratureMethod::Library && trial.rule.nodes_nm.len() == NODES
    });
    let section = match chosen {
        Some(chosen) => section
            .with_figure(light(subject, chosen))
            .with_table("Eight wavelengths for this library and light", nodes(chosen)),
        None => section,
    };
    if subject.quadratures.is_empty() { section } else { section.with_figure(errors(subject)) }
}

fn light(subject: &Subject<'_>, chosen: &QuadratureTrial) -> Figure {
    let x = Axis::wavelength(subject.library.grid, 50);
    let power = subject.viewing.illuminant.power();
    let inside = |nm: &f64| *nm >= x.low && *nm <= x.high;
    let wavelengths: Vec<f64> = power.grid().wavelengths_nm().filter(inside).collect();
    let on_line = |values: &[f64]| -> Vec<Point> {
        let all = power.grid().wavelengths_nm().zip(values.iter().copied());
        all.filter(|(nm, _)| inside(nm)).collect()
    };
    let strongest = on_line(power.values()).iter().map(|p| p.1).fold(f64::MIN_POSITIVE, f64::max);
    let relative: Vec<f64> = power.values().iter().map(|v| v / strongest).collect();
    let relative = on_line(&relative);
    let functions = subject.viewing.observer.functions();
    let functions = [0, 1, 2].map(|channel: usize| on_line(functions[channel].values()));

    let mut data = Table::new([
        Column::quantity("wavelength", "nm", 0),
        Column::quantity("relative power", "largest = 1", 4),
        Column::quantity("x-bar", "1", 4),
        Column::quantity("y-bar", "1", 4),
        Column::quantity("z-bar", "1", 4),
        Column::quantity("weight of X", "white Y = 100", 4),
        Column::quantity("weight of Y", "white Y = 100", 4),
        Column::quantity("weight of Z", "white Y = 100", 4),
    ]);
    for (index, nm) in wavelengths.iter().enumerate() {
        let mut row: Vec<Cell> = vec![(*nm).into(), relative[index].1.into()];
        row.extend(functions.iter().map(|function| Cell::from(function[index].1)));
        row.extend([Cell::Empty, Cell::Empty, Cell::Empty]);
        data.push(row);
    }
    for (nm, weights) in chosen.rule.nodes_nm.iter().zip(&chosen.rule.weights) {
        let mut row = vec![Cell::from(*nm), Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty];
        row.extend(weights.map(Cell::from));
        data.push(row);
    }

    let strong = Axis::linear("Power", "largest = 1", 0.0, 1.0, 4);
    let line = Mark::Line { points: relative, color: INK, width: CURVE };
    let illuminant = format!("Illuminant {}", subject.viewing.illuminant.name());
    let lamp = Panel::new(x.clone(), strong, vec![line]).with_title(illuminant);

    let highest = functions.iter().flatten().map(|p| p.1).fold(0.0, f64::max);
    let response = Axis::around("Response", "peak of y = 1", 0.0, highest, 4);
    let mut observer = Panel::new(x.clone(), response, Vec::new())
        .with_title(format!("Observer {}", subject.viewing.observer));
    for (points, (name, color)) in functions.into_iter().zip(CHANNELS) {
        observer.marks.push(Mark::Line { points, color, width: CURVE });
        observer = observer.with_key(KeySymbol::Line, color, name.to_lowercase());
    }

    let values = chosen.rule.weights.iter().flatten().copied();
    let low = values.clone().fold(0.0, f64::min);
    let high = values.fold(0.0, f64::max);
    let weight = Axis::linear("Weight", "white Y = 100", 1.2 * low, 1.05 * high, 4);
    let zero = vec![(x.low, 0.0), (x.high, 0.0)];
    let mut marks = vec![Mark::Line { points: zero, color: FAINT, width: HAIR }];
    for (nm, weights) in chosen.rule.nodes_nm.iter().zip(&chosen.rule.weights) {
        for (channel, (weight, (_, color))) in weights.iter().zip(CHANNELS).enumerate() {
            let at = nm + 2.6 * (channel as f64 - 1.0);
            let from = (at - 1.2, 0.0);
            let to = (at + 1.2, *weight);
            marks.push(Mark::Bar { from, to, color });
        }
    }
    let mut stems = Panel::new(x, weight, marks).with_title("Eight chosen wavelengths");
    for (name, color) in CHANNELS {
        stems = stems.with_key(KeySymbol::Patch, color, name);
    }

    let words = Words {
        name: "light",
        title: "Light, observer, and eight wavelengths that stand for both",
        caption: "The wavelengths and weights (method library) keep the colour of what this library can mix; reflectance at each of them, times its three weights, sums to X, Y and Z. Bars of one wavelength stand side by side around it.",
        alt: "Three charts over wavelength: power of the light, the observer's functions, and bars of weights at eight wavelengths.",
    };
    let chart = Chart::stacked(vec![(lamp, 110.0), (observer, 140.0), (stems, 150.0)]);
    subject.figure(words, Drawing::Chart(chart), data)
}

fn nodes(chosen: &QuadratureTrial) -> Table {
    let mut table = Table::new([
        Column::quantity("Wavelength", "nm", 2),
        Column::quantity("X", "weight", 4),
        Column::quantity("Y", "weight", 4),
        Column::quantity("Z", "weight", 4),
    ]);
    for (nm, [x, y, z]) in chosen.rule.nodes_nm.iter().zip(&chosen.rule.weights) {
        table.push([*nm, *x, *y, *z].map(Cell::from));
    }
    table
}

fn errors(subject: &Subject<'_>) -> Figure {
    let mut data = Table::new([
        Column::text("method"),
        Column::quantity("wavelengths", "1", 0),
        Column::quantity("mean", "CIEDE2000", 3),
        Column::quantity("95 % below", "CIEDE2000", 3),
        Column::quantity("largest", "CIEDE2000", 3),
    ]);
    for QuadratureTrial { method, rule, error } in &subject.quadratures {
        let count = rule.nodes_nm.len() as f64;
        let numbers = [count, error.mean, error.p95, error.max].map(Cell::from);
        let row: Vec<Cell> = std::iter::once(method.name().into()).chain(numbers).collect();
        data.push(row);
    }
    let counts = subject.quadratures.iter().map(|trial| trial.rule.nodes_nm.len() as f64);
    let fewest = counts.clone().fold(f64::INFINITY, f64::min);
    let most = counts.fold(0.0, f64::max);
    let mut x = Axis::linear("Number of wavelengths", "count", fewest - 0.5, most + 0.5, 16);
    x.ticks.retain(|(count, _)| *count >= fewest && *count <= most);
    let errors = subject.quadratures.iter().map(|trial| trial.error);
    let low = errors.clone().map(|error| error.mean).fold(f64::INFINITY, f64::min);
    let high = errors.map(|error| error.p95).fold(0.0, f64::max);
    let y = Axis::log("Colour error", "CIEDE2000", low, high, 4);
    let mut panel = Panel::new(x, y, Vec::new());
    for (method, color) in QuadratureMethod::ALL.into_iter().zip([SERIES[1], SERIES[2], SERIES[0]])
    {
        let trials = subject.quadratures.iter().filter(|trial| trial.method == method);
        let points = trials.map(|trial: &QuadratureTrial| {
            let count = trial.rule.nodes_nm.len() as f64;
            ((count, trial.error.mean), (count, trial.error.p95))
        });
        let (mean, p95): (Vec<Point>, Vec<Point>) = points.unzip();
        panel.marks.push(Mark::Dashes { points: p95, color });
        panel.marks.push(Mark::Dots { points: mean.clone(), color, radius: 2.0 * DOT });
        panel.marks.push(Mark::Line { points: mean, color, width: CURVE });
        panel = panel.with_key(KeySymbol::Line, color, format!("{}, mean", method.name()));
    }
    let panel = panel.with_key(KeySymbol::Dashes, INK, "95 % below");
    let words = Words {
        name: "wavelengths",
        title: "What few wavelengths cost in colour",
        caption: &format!(
            "Colour error of each method against full integration, over 1000 random mixtures of this library that no method was fitted to ({}).",
            subject.light()
        ),
        alt: "Curves of colour error falling with the number of wavelengths, one for each method.",
    };
    subject.figure(words, Drawing::Chart(Chart::single(panel, 300.0)), data)
}
