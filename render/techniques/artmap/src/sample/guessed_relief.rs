//! Relief guessed from the lightness of a photograph.
//!
//! Under light from all sides deep places see less of it: dark is deep (Langer and Zucker 1994,
//! "Shape-from-shading on a cloudy day"; Khan, Reinhard, Fleming and Buelthoff 2006, "Image-based
//! material editing", section 3). So the guess is the detail of lightness within a stroke. Strokes of
//! a lighter paint come out higher, and light from one side is taken for relief; nothing can be
//! measured from it. The strokes of the test below, each of its own shade, come out with a correlation
//! of 0.45 to their true relief.

use documents::hint::{Explain, Fault, Hint};
use graphics::blurred;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;

use super::passage::{Sample, SampleSet};

/// Deviation of the blur that takes away the grain of a photograph, in distances of strokes.
const GRAIN: f64 = 0.04;

/// Deviation of the blur whose result is the level of the paint, in distances of strokes.
const LEVEL: f64 = 0.35;

/// Deviations of the detail between the mean and the highest ridge.
const DEVIATIONS: f64 = 2.0;

/// Weight of texels of the passage around a texel below which its level is unknown.
const LEAST: f32 = 1e-4;

impl SampleSet {
    /// Greatest relief that can be asked for, in mm.
    pub const MOST_RELIEF_MM: f64 = 10.0;

    /// Gives samples without relief a guessed one: 0 to `relief_mm`, half of that at the mean. True
    /// relief stays. Guessed samples are marked.
    ///
    /// # Errors
    /// [`GuessError`] for a relief that is not above 0 and at most [`Self::MOST_RELIEF_MM`].
    pub fn with_guessed_relief(mut self, relief_mm: f64) -> Result<Self, GuessError> {
        if !(relief_mm > 0.0 && relief_mm <= Self::MOST_RELIEF_MM) {
            return Err(GuessError { found: relief_mm });
        }
        for sample in self.samples.iter_mut().filter(|sample| sample.height_mm.is_none()) {
            sample.height_mm = Some(guessed(sample, relief_mm));
            sample.guessed_relief = true;
        }
        Ok(self)
    }
}

/// Heights in mm; 0 beyond the passage.
fn guessed(sample: &Sample, relief_mm: f64) -> Field<f32> {
    let fine = lightness(sample, GRAIN * sample.spacing);
    let level = lightness(sample, LEVEL * sample.spacing);
    let detail: Vec<f32> = fine.iter().zip(&level).map(|(fine, level)| fine - level).collect();
    let inside = || detail.iter().zip(sample.mask.values()).filter(|(_, inside)| **inside);
    let count = inside().count().max(1) as f64;
    let mean = inside().map(|(detail, _)| f64::from(*detail)).sum::<f64>() / count;
    let squares = inside().map(|(detail, _)| (f64::from(*detail) - mean).powi(2));
    let deviation = (squares.sum::<f64>() / count).sqrt();
    let heights = detail
        .iter()
        .zip(sample.mask.values())
        .map(|(detail, &inside): (&f32, &bool)| {
            if !inside {
                return 0.0;
            }
            let off = if deviation > 0.0 { (f64::from(*detail) - mean) / deviation } else { 0.0 };
            (relief_mm * (0.5 + 0.5 * (off / DEVIATIONS).clamp(-1.0, 1.0))) as f32
        })
        .collect();
    Field::from_values(sample.mask.width(), sample.mask.height(), heights)
}

/// L* of a sample, blurred; only texels of the passage count.
fn lightness(sample: &Sample, sigma: f64) -> Vec<f32> {
    let lab = lab_from_linear(&sample.color);
    let weighed = lab
        .values()
        .iter()
        .zip(sample.mask.values())
        .map(|(lab, &inside): (&[f32; 3], &bool)| if inside { [lab[0], 1.0] } else { [0.0; 2] })
        .collect();
    let sums = blurred(&Field::from_values(lab.width(), lab.height(), weighed), sigma);
    sums.values()
        .iter()
        .map(|&[sum, weight]: &[f32; 2]| if weight > LEAST { sum / weight } else { 0.0 })
        .collect()
}

/// A relief that cannot be guessed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "a guessed relief is above 0 and at most {} mm, found `{found}`",
    SampleSet::MOST_RELIEF_MM
)]
pub struct GuessError {
    /// The relief asked for, in mm.
    pub found: f64,
}

impl Explain for GuessError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("[guess_relief=0.2] is usual for oil"))
    }

    fn fault(&self) -> Fault {
        Fault::Setting
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_up::strokes;
    use super::*;

    fn set(samples: Vec<Sample>) -> SampleSet {
        SampleSet { samples, paint: None, provenance: String::new() }
    }

    /// Strokes with a true relief, whose ridges are lighter than their furrows.
    fn known() -> (Sample, Field<f32>) {
        let mut sample = strokes("a", 120, 10, 0.2, 3);
        let height = sample.height_mm.take().unwrap();
        (sample, height)
    }

    fn correlation(one: &Field<f32>, other: &Field<f32>) -> f64 {
        let mean = |field: &Field<f32>| {
            field.values().iter().map(|mm| f64::from(*mm)).sum::<f64>()
                / field.values().len() as f64
        };
        let mean_one = mean(one);
        let mean_other = mean(other);
        let mut sums = [0.0; 3];
        for (a, b) in one.values().iter().zip(other.values()) {
            let a = f64::from(*a) - mean_one;
            let b = f64::from(*b) - mean_other;
            sums = [sums[0] + a * a, sums[1] + b * b, sums[2] + a * b];
        }
        sums[2] / (sums[0] * sums[1]).sqrt()
    }

    #[test]
    fn ridges_that_are_lighter_come_out_higher() {
        let (sample, wanted) = known();
        let found = set(vec![sample]).with_guessed_relief(0.3).unwrap();
        let sample = &found.samples[0];
        let height = sample.height_mm.as_ref().unwrap();
        assert!(sample.guessed_relief);
        let likeness = correlation(height, &wanted);
        assert!(likeness > 0.42, "{likeness}");
        let values = height.values();
        assert!(values.iter().all(|mm| (0.0..=0.3 + 1e-6).contains(mm)));
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        assert!((mean - 0.15).abs() < 0.02, "{mean}");
        assert!(values.iter().any(|mm| *mm > 0.27) && values.iter().any(|mm| *mm < 0.03));
    }

    #[test]
    fn the_tone_of_a_passage_and_what_lies_beyond_it_change_nothing() {
        let (sample, _) = known();
        let mut mask = sample.mask.clone();
        for (x, y) in (0..120).flat_map(|y| (0..30).map(move |x| (x, y))) {
            mask[(x, y)] = false;
        }
        let masked = Sample { mask, ..sample };
        let mut other = masked.clone();
        for (x, y) in (0..120).flat_map(|y| (0..30).map(move |x| (x, y))) {
            other.color[(x, y)] = [9.0; 3];
        }
        let found = set(vec![masked, other]).with_guessed_relief(0.2).unwrap().samples;
        assert_eq!(found[0].height_mm, found[1].height_mm);
        assert_eq!(found[0].height_mm.as_ref().unwrap()[(10, 10)], 0.0);
    }

    #[test]
    fn true_relief_stays_flat_colour_is_level_and_ranges_are_checked() {
        let with_relief = strokes("a", 64, 8, 0.2, 1);
        let mut flat = Sample { height_mm: None, ..with_relief.clone() };
        flat.color = Field::filled(64, 64, [0.3; 3]);
        let found = set(vec![with_relief.clone(), flat]).with_guessed_relief(0.2).unwrap();
        assert_eq!(found.samples[0], with_relief);
        let level = found.samples[1].height_mm.as_ref().unwrap();
        assert!(level.values().iter().all(|mm| (mm - 0.1).abs() < 1e-6));
        for wrong in [0.0, -1.0, 11.0, f64::NAN] {
            let error = set(Vec::new()).with_guessed_relief(wrong).unwrap_err();
            assert!(error.to_string().contains("at most 10 mm"), "{error}");
        }
    }
}
