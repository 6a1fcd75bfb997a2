//! The points of a spectrum in order of wavelength.

use super::measured::InstrumentError;

/// How we treat a wavelength that occurs more than once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Duplicates {
    /// An error. Use this for tables of few wavelengths, which list each once.
    Refuse,
    /// The mean, with a remark. Use this for dense exports, which round the wavelengths of
    /// neighbouring pixels to the same number.
    Average,
    /// The mean, with a remark, if the values differ by at most this number. Otherwise an error.
    AverageWithin(f64),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    /// Line number in the file, from 1.
    pub(super) line: usize,
    pub(super) nm: f64,
    pub(super) value: f64,
}

/// Strictly rising wavelengths with one value each, and remarks on corrections.
#[derive(Debug, Default)]
pub(super) struct Ordered {
    pub(super) wavelengths_nm: Vec<f64>,
    pub(super) values: Vec<f64>,
    /// Line of each value, the first where several were averaged.
    pub(super) lines: Vec<usize>,
    pub(super) remarks: Vec<String>,
}

/// Brings points to rising order of wavelength. This reverses falling points.
///
/// # Errors
/// [`InstrumentError`] for a wavelength that is not above 0, for wavelengths that neither rise nor
/// fall throughout, and for repeated wavelengths where `duplicates` refuses them.
pub(super) fn ordered(
    file: &str,
    mut points: Vec<Point>,
    duplicates: Duplicates,
) -> Result<Ordered, InstrumentError> {
    let wrong = points.iter().find(|point| !(point.nm.is_finite() && point.nm > 0.0));
    if let Some(point) = wrong {
        let text = point.nm.to_string();
        return Err(InstrumentError::line(file, point.line, "a wavelength above 0", &text));
    }
    let direction = points.windows(2).map(|pair| pair[1].nm - pair[0].nm).find(|d| *d != 0.0);
    let falls = direction.is_some_and(|d| d < 0.0);
    if let Some(pair) =
        points.windows(2).find(|pair| (pair[1].nm - pair[0].nm) * direction.unwrap_or(1.0) < 0.0)
    {
        let file = file.to_owned();
        let line = pair[1].line;
        let nm = pair[1].nm;
        return Err(InstrumentError::Order { file, line, nm });
    }
    if falls {
        points.reverse();
    }
    let mut ordered = Ordered::default();
    let mut repeated = 0;
    for group in points.chunk_by(|a, b| a.nm == b.nm) {
        let first = group[0];
        let last = group[group.len() - 1];
        if group.len() > 1 && duplicates == Duplicates::Refuse {
            let line = first.line.max(last.line);
            let before = first.line.min(last.line);
            let file = file.to_owned();
            return Err(InstrumentError::Duplicate { file, line, nm: first.nm, first: before });
        }
        let least = group.iter().map(|point| point.value).fold(first.value, f64::min);
        let most = group.iter().map(|point| point.value).fold(first.value, f64::max);
        if let Duplicates::AverageWithin(apart) = duplicates
            && most - least > apart
        {
            let file = file.to_owned();
            let line = first.line.max(last.line);
            let nm = first.nm;
            return Err(InstrumentError::Unlike { file, line, nm, least, most });
        }
        repeated += usize::from(group.len() > 1);
        ordered.wavelengths_nm.push(first.nm);
        ordered.lines.push(first.line);
        // Each value is scaled before summing, because a sum of finite values may overflow.
        let share = 1.0 / group.len() as f64;
        ordered.values.push(group.iter().map(|point| point.value).map(|value| value * share).sum());
    }
    if repeated > 0 {
        let repeated = documents::counted_as(repeated, "wavelength occurs", "wavelengths occur");
        let what = format!("{repeated} more than once; the values were averaged");
        ordered.remarks.push(what);
    }
    Ok(ordered)
}

/// Sorts points of formats that give every value its own wavelength. This keeps repeated equal
/// points once, and keeps different values at one wavelength. You also get a remark if the order
/// changed.
pub(super) fn sorted(mut points: Vec<Point>) -> (Vec<Point>, Option<String>) {
    let rising = points.is_sorted_by(|a, b| a.nm <= b.nm);
    points.sort_by(|a, b| a.nm.total_cmp(&b.nm));
    points.dedup_by(|a, b| a.nm == b.nm && a.value == b.value);
    (points, (!rising).then(|| "its wavelengths were in no order and were sorted".to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(pairs: &[(f64, f64)]) -> Vec<Point> {
        let lines = pairs.iter().zip(3..);
        lines.map(|(&(nm, value), line)| Point { line, nm, value }).collect()
    }

    #[test]
    fn falling_wavelengths_are_reversed() {
        let found = ordered("f", points(&[(500.0, 2.0), (400.0, 1.0)]), Duplicates::Refuse);
        let found = found.unwrap();
        assert_eq!((found.wavelengths_nm, found.values), (vec![400.0, 500.0], vec![1.0, 2.0]));
    }

    #[test]
    fn duplicates_are_refused_or_averaged_with_a_remark() {
        let twice = points(&[(500.0, 2.0), (400.0, 1.0), (400.0, 2.0)]);
        assert_eq!(
            ordered("f", twice.clone(), Duplicates::Refuse).unwrap_err(),
            InstrumentError::Duplicate { file: "f".into(), line: 5, nm: 400.0, first: 4 }
        );
        for averaged in [Duplicates::Average, Duplicates::AverageWithin(1.0)] {
            let found = ordered("f", twice.clone(), averaged).unwrap();
            assert_eq!((found.values, found.remarks.len()), (vec![1.5, 2.0], 1), "{averaged:?}");
        }
        assert_eq!(
            ordered("f", twice, Duplicates::AverageWithin(0.9)).unwrap_err().to_string(),
            "f, line 5: 400 nm occurs more than once, with different values from 1 to `2`"
        );
    }

    #[test]
    fn wavelengths_that_go_back_and_forth_are_refused_with_their_line() {
        let found =
            ordered("f", points(&[(400.0, 1.0), (500.0, 1.0), (450.0, 1.0)]), Duplicates::Average);
        assert!(matches!(found, Err(InstrumentError::Order { line: 5, .. })), "{found:?}");
        let found = ordered("f", points(&[(-400.0, 1.0)]), Duplicates::Average);
        assert!(matches!(found, Err(InstrumentError::Line { line: 3, .. })), "{found:?}");
    }

    #[test]
    fn unordered_points_are_sorted_and_equal_points_kept_once() {
        let (found, remark) =
            sorted(points(&[(500.0, 2.0), (400.0, 1.0), (500.0, 2.0), (450.0, 3.0)]));
        let nm: Vec<f64> = found.iter().map(|point| point.nm).collect();
        assert_eq!((nm, remark.is_some()), (vec![400.0, 450.0, 500.0], true));
        let (found, remark) = sorted(points(&[(400.0, 2.0), (400.0, 1.0)]));
        assert_eq!((found.len(), remark), (2, None));
    }
}
