//! Detecting saturation of the detector.

/// Largest counts of converters of 12, 14 and 16 bits.
const FULL_SCALES: [f64; 3] = [4095.0, 16383.0, 65535.0];

/// Number of neighbouring pixels at exactly the maximum that count as saturation rather than as
/// a peak (chosen by eye).
const PLATEAU: usize = 4;

/// The count from which on the detector is saturated: the full scale if it is given and
/// reached. Otherwise the maximum, if it is that of a converter or several neighbours have it.
/// `None` if nothing is saturated.
pub(super) fn ceiling(counts: &[f64], full_scale: Option<f64>) -> Option<f64> {
    let most = counts.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if let Some(full) = full_scale {
        return (most >= full).then_some(full);
    }
    let flat = counts.chunk_by(|a, b| a == b).any(|run| run[0] == most && run.len() >= PLATEAU);
    // A reading of zeros is flat, but not saturated.
    (most > 0.0 && (flat || FULL_SCALES.contains(&most))).then_some(most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_converters_maximum_a_plateau_and_a_given_scale_saturate() {
        assert_eq!(ceiling(&[1.0, 65535.0, 2.0], None), Some(65535.0));
        assert_eq!(ceiling(&[1.0, 900.0, 900.0, 900.0, 900.0, 2.0], None), Some(900.0));
        assert_eq!(ceiling(&[1.0, 950.0, 900.0, 960.0], Some(940.0)), Some(940.0));
    }

    #[test]
    fn a_peak_does_not_saturate() {
        assert_eq!(ceiling(&[1.0, 900.0, 900.0, 900.0, 2.0], None), None);
        assert_eq!(ceiling(&[5.0, 5.0, 5.0, 5.0, 9.0], None), None);
        assert_eq!(ceiling(&[0.0; 9], None), None);
        assert_eq!(ceiling(&[1.0, 4095.0, 4094.0], Some(65535.0)), None);
    }
}
