//! Finding the integration time in the details of a file.

use crate::instrument::MeasuredSpectrum;

/// The integration time in ms, from a detail such as `Integration Time (usec): 24000
/// (JAZA1479)` or `Integration time: 100.00 ms`. `None` if there is none, or none with a unit.
#[must_use]
pub fn integration_time_ms(record: &MeasuredSpectrum) -> Option<f64> {
    record.details.iter().find_map(|(key, value)| {
        let key = key.to_lowercase();
        let (_, after) = key.split_once("integration time")?;
        let value = value.trim().to_lowercase();
        let number = value.split_whitespace().next()?;
        // The unit follows the keyword or the number, or is attached to the number.
        let digits = number.trim_end_matches(|c: char| c.is_alphabetic() || c == '\u{b5}');
        let behind = value.split_whitespace().nth(1).unwrap_or_default();
        let units =
            [after.trim_matches(|c: char| !c.is_alphanumeric()), &number[digits.len()..], behind];
        let scale = units.into_iter().find_map(unit_ms)?;
        let time = digits.replace(',', ".").parse::<f64>().ok()? * scale;
        (time.is_finite() && time > 0.0).then_some(time)
    })
}

fn unit_ms(word: &str) -> Option<f64> {
    match word {
        "usec" | "us" | "\u{b5}s" | "\u{3bc}s" | "microseconds" => Some(1e-3),
        "msec" | "ms" | "milliseconds" => Some(1.0),
        "sec" | "s" | "seconds" => Some(1e3),
        _ => None,
    }
}

/// Whether two times agree to one part in a thousand.
pub(super) fn is_equal(a_ms: f64, b_ms: f64) -> bool {
    (a_ms - b_ms).abs() <= 1e-3 * a_ms.max(b_ms)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instrument::{MeasuredQuantity, Role, Unit};

    #[test]
    fn integration_times_of_several_makers_are_parsed() {
        for (key, value, ms) in [
            ("Integration Time (usec)", "24000 (JAZA1479)", Some(24.0)),
            ("Integration Time (sec)", "2.000000E-2", Some(20.0)),
            ("Integration time", "100.00 ms", Some(100.0)),
            ("Integration time", "8,5ms", Some(8.5)),
            ("Integration time [ms]", "7", Some(7.0)),
            ("Autoset integration time", "false", None),
            ("Integration time", "100", None),
            ("Integration Time (sec)", "-1", None),
            ("Scans", "20 ms", None),
        ] {
            let record = MeasuredSpectrum {
                name: "r".into(),
                quantity: MeasuredQuantity::Counts,
                role: Role::Main,
                unit: Unit::Unstated,
                wavelengths_nm: vec![400.0],
                values: vec![1.0],
                line: 1,
                details: vec![(key.to_owned(), value.to_owned())],
                remarks: Vec::new(),
            };
            assert_eq!(integration_time_ms(&record), ms, "{key}: {value}");
        }
    }
}
