//! The table of figures as text and as JSON.

use std::fmt::Write;

use serde_json::{Value, json};

use super::canvas::Bench;
use super::figure::{CaseReport, Figure, Wanted};

/// A number with four significant digits, or `-` if it is none.
#[must_use]
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let digits = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    let decimals = (3.0 - digits).clamp(0.0, 5.0) as usize;
    format!("{value:.decimals$}")
}

/// Bounds of a figure in words; empty without bounds.
#[must_use]
pub fn bounds(wanted: Wanted) -> String {
    let plain = |value: f64| format!("{}", (value * 1e6).round() / 1e6);
    match (wanted.low, wanted.high) {
        (Some(low), Some(high)) => format!("{} to {}", plain(low), plain(high)),
        (Some(low), None) => format!(">= {}", plain(low)),
        (None, Some(high)) => format!("<= {}", plain(high)),
        (None, None) => String::new(),
    }
}

/// Mark beside a figure: `ok`, `--`, or nothing without bounds.
#[must_use]
pub fn verdict(figure: &Figure) -> &'static str {
    match figure.is_met() {
        Some(true) => "ok",
        Some(false) => "--",
        None => "",
    }
}

/// All figures as lines of text, and how many of those with bounds are met.
#[must_use]
pub fn table(reports: &[CaseReport]) -> String {
    let mut text = String::new();
    let mut met = 0;
    let mut bounded = 0;
    for CaseReport { name, title, figures, .. } in reports {
        let _ = writeln!(text, "{name}: {title}");
        for figure in figures {
            let value = number(figure.value);
            let wanted = bounds(figure.wanted);
            let line = format!(
                "  {:<46} {value:>10} {:<5} {wanted:<16} {}",
                figure.name,
                figure.unit,
                verdict(figure)
            );
            let _ = writeln!(text, "{}", line.trim_end());
            bounded += usize::from(figure.is_met().is_some());
            met += usize::from(figure.is_met() == Some(true));
        }
        text.push('\n');
    }
    let _ = writeln!(text, "{met} of {bounded} figures with bounds are within them");
    text
}

/// All figures as JSON. A value that is not a number is null.
#[must_use]
pub fn json(bench: &Bench, reports: &[CaseReport]) -> Value {
    let figures: Vec<Value> = reports
        .iter()
        .flat_map(|report| report.figures.iter().map(move |figure| (report.name, figure)))
        .map(|(case, figure)| {
            json!({
                "case": case,
                "name": figure.name.trim(),
                "value": figure.value,
                "unit": figure.unit,
                "low": figure.wanted.low,
                "high": figure.wanted.high,
                "ok": figure.is_met(),
            })
        })
        .collect();
    json!({
        "format": "impasto-stroke-bench",
        "cell_mm": bench.cell_mm,
        "small": bench.small,
        "figures": figures,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_bounds_read_well() {
        assert_eq!(
            [0.0, 0.009_123, 12.345, 1234.5].map(number),
            ["0.000", "0.00912", "12.35", "1234"]
        );
        assert_eq!(number(f64::NAN), "-");
        let figure = Figure::new("film", 0.2, "mm").at_least(0.14).at_most(0.26);
        assert_eq!(bounds(figure.wanted), "0.14 to 0.26");
        assert_eq!(bounds(Wanted { low: None, high: Some(5.0) }), "<= 5");
    }

    #[test]
    fn the_table_counts_what_is_met_and_json_tells_every_figure() {
        let figures = vec![
            Figure::new("film", 0.2, "mm").at_least(0.14).at_most(0.26),
            Figure::new("lip", f64::NAN, "").at_least(1.3),
            Figure::new("volume", 3.0, "mm3"),
        ];
        let report = CaseReport { name: "one", title: "One stroke", figures, panels: Vec::new() };
        let text = table(std::slice::from_ref(&report));
        assert!(text.contains("1 of 2 figures"), "{text}");
        let json = json(&Bench::new(true), &[report]);
        let told = |at: usize| json["figures"][at]["ok"].clone();
        assert_eq!([told(0), told(1), told(2)], [json!(true), json!(false), Value::Null]);
        assert_eq!(json["figures"][1]["value"], Value::Null);
    }
}
