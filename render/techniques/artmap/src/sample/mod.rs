//! Samples: passages of a painting, each with the brushwork of one tone. You can join samples from
//! several files, and guess relief from the lightness of a photograph.
//!
//! Under light from all sides deep places see less of it, so dark is deep (Langer and Zucker 1994,
//! "Shape-from-shading on a cloudy day"; Khan, Reinhard, Fleming and Buelthoff 2006, "Image-based
//! material editing", section 3). So we guess from the detail of lightness within a stroke.
//! Strokes of a lighter paint come out higher, and the guess takes light from one side for relief.
//! So you cannot measure anything from it. For example, the strokes of the test below, each of
//! another shade, come out with a correlation of 0.45 to their true relief.

#[cfg(test)]
mod made_up;
pub mod from_painting;
pub mod file;

use documents::hint::Explain;
use graphics::blurred;
use graphics::encoding::lab_from_linear;
use graphics::field::Field;
use graphics::picture::Picture;

pub use crate::texel_file::{PaintOfSamples, TexelPaint};
pub use from_painting::{FromPaintingError, WholePainting};
#[cfg(test)]
pub(crate) use made_up::strokes;

/// A passage of a painting.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Name that the painter gave this sample.
    pub name: String,
    /// Colour of each texel under a level surface, in linear sRGB with white at 1.
    pub color: Picture,
    /// Paint of each texel. `None` for pictures without pigments.
    pub paint: Option<Field<TexelPaint>>,
    /// Height of the surface above the ground in mm. `None` without relief.
    pub height_mm: Option<Field<f32>>,
    /// Whether each texel belongs to the passage. Other texels hold no information.
    pub mask: Field<bool>,
    /// Distance of neighbouring strokes in texels, across the strokes.
    pub spacing: f64,
    /// Side of a texel in mm, where it is known.
    pub mm_per_texel: Option<f64>,
    /// Whether the height was guessed from a photograph.
    pub guessed_relief: bool,
}

impl Sample {
    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.color.width(), self.color.height())
    }

    /// Number of texels inside [`Self::mask`], which belong to the passage of the painting.
    #[must_use]
    pub fn texels(&self) -> usize {
        self.mask.values().iter().filter(|inside| **inside).count()
    }

    /// Mean CIELAB lightness of the passage, 0 to 100. If it has no texels, this is 0.
    #[must_use]
    pub fn mean_lightness(&self) -> f64 {
        self.mean(&lab_from_linear(&self.color))[0]
    }

    /// Mean colour of the passage in linear sRGB with white at 1. If it has no texels, this is
    /// black.
    #[must_use]
    pub fn mean_color(&self) -> [f64; 3] {
        self.mean(&self.color)
    }

    fn mean(&self, values: &Field<[f32; 3]>) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let inside = values.values().iter().zip(self.mask.values()).filter(|(_, inside)| **inside);
        for (value, _) in inside {
            (0..3).for_each(|channel| sum[channel] += f64::from(value[channel]));
        }
        let texels = self.texels().max(1) as f64;
        sum.map(|sum| sum / texels)
    }
}

/// Samples of one painting, upright (strokes run along y) and of one spacing, dark to light.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleSet {
    /// The samples. All or none have paint.
    pub samples: Vec<Sample>,
    /// Pigments of their paint. `None` if no sample has paint.
    pub paint: Option<PaintOfSamples>,
    /// Where the samples come from, in words. The file states this.
    pub provenance: String,
}

/// Why sets cannot be joined.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
pub enum JoinError {
    /// Some sets have paint, others have colours only.
    #[error("`{with}` has paint of pigments, `{without}` has colours only")]
    #[hint("take all samples from paintings, or none")]
    PaintAndColor {
        /// Provenance of a set with paint.
        with: String,
        /// Provenance of a set without.
        without: String,
    },
    /// The sets are painted with different pigments, or with the same in another order.
    #[error("`{first}` and `{other}` are painted with different pigments")]
    #[hint("paint all samples with one library and one hue")]
    Pigments {
        /// Provenance of the first set.
        first: String,
        /// Provenance of the other set.
        other: String,
    },
}

impl SampleSet {
    /// Puts all samples of `sets` into one set, from dark to light. If a name is taken, the sample
    /// gets a number.
    ///
    /// # Errors
    /// [`JoinError`] if the sets do not have the same pigments.
    pub fn joined(sets: Vec<Self>) -> Result<Self, JoinError> {
        let mut sets = sets.into_iter();
        let Some(mut joined) = sets.next() else {
            return Ok(Self { samples: Vec::new(), paint: None, provenance: String::new() });
        };
        let first = joined.provenance.clone();
        for set in sets {
            match (&joined.paint, &set.paint) {
                (None, None) => {}
                (Some(a), Some(b)) if a == b => {}
                (Some(_), Some(_)) => {
                    return Err(JoinError::Pigments { first, other: set.provenance });
                }
                (Some(_), None) => {
                    return Err(JoinError::PaintAndColor { with: first, without: set.provenance });
                }
                (None, Some(_)) => {
                    return Err(JoinError::PaintAndColor { with: set.provenance, without: first });
                }
            }
            for mut sample in set.samples {
                let plain = sample.name.clone();
                let mut number = 2;
                while joined.samples.iter().any(|other| other.name == sample.name) {
                    sample.name = format!("{plain} ({number})");
                    number += 1;
                }
                joined.samples.push(sample);
            }
            joined.provenance = format!("{}; {}", joined.provenance, set.provenance);
        }
        joined.samples.sort_by(|a, b| a.mean_lightness().total_cmp(&b.mean_lightness()));
        Ok(joined)
    }
}

/// We blur away the grain of a photograph by this deviation, in distances of strokes.
const GRAIN: f64 = 0.04;

/// We blur by this deviation, in distances of strokes, to get the level of the paint.
const LEVEL: f64 = 0.35;

/// The highest ridge is this many deviations of the detail above the mean.
const DEVIATIONS: f64 = 2.0;

/// If the texels around a texel weigh less than this, its level is unknown.
const LEAST: f32 = 1e-4;

impl SampleSet {
    /// You can ask for a relief up to this, in mm.
    pub const MOST_RELIEF_MM: f64 = 10.0;

    /// Gives samples without relief a guessed one. It goes from 0 to `relief_mm`, with half of
    /// this at the mean. This keeps true relief, and marks guessed samples.
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

/// Heights in mm. They are 0 beyond the passage.
fn guessed(sample: &Sample, relief_mm: f64) -> Field<f32> {
    let fine = lightness(sample, GRAIN * sample.spacing);
    let level = lightness(sample, LEVEL * sample.spacing);
    let detail: Vec<f32> = fine.iter().zip(&level).map(|(fine, level)| fine - level).collect();
    let inside = detail.iter().zip(sample.mask.values()).filter(|(_, inside)| **inside);
    let inside: Vec<f64> = inside.map(|(detail, _)| f64::from(*detail)).collect();
    let count = inside.len().max(1) as f64;
    let mean = inside.iter().sum::<f64>() / count;
    let squares = inside.iter().map(|detail| (detail - mean).powi(2));
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

/// L* of a sample, blurred. Only texels of the passage count.
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
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[error(
    "a guessed relief is above 0 and at most {} mm, found `{found}`",
    SampleSet::MOST_RELIEF_MM
)]
#[hint("[guess_relief=0.2] is usual for oil")]
#[fault(Setting)]
pub struct GuessError {
    /// The relief asked for, in mm.
    pub found: f64,
}

#[cfg(test)]
mod guessed_relief_tests {
    use super::made_up::strokes;
    use super::*;

    fn set(samples: Vec<Sample>) -> SampleSet {
        SampleSet { samples, paint: None, provenance: String::new() }
    }

    /// Strokes with a true relief. Their ridges are lighter than their furrows.
    fn known() -> (Sample, Field<f32>) {
        let mut sample = strokes("a", 120, 10, 0.2, 3);
        let height = sample.height_mm.take().unwrap();
        (sample, height)
    }

    fn correlation(one: &Field<f32>, other: &Field<f32>) -> f64 {
        fn mean(field: &Field<f32>) -> f64 {
            field.values().iter().map(|mm| f64::from(*mm)).sum::<f64>()
                / field.values().len() as f64
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{PaintOfSamples, strokes};
    use paint::layer::Slots;
    use pigment::{PigmentId, PigmentLibrary};
    use std::sync::Arc;

    #[test]
    fn means_are_those_of_the_passage_alone() {
        let mut mask = Field::filled(4, 2, true);
        mask[(3, 1)] = false;
        let mut color = Field::filled(4, 2, [0.2, 0.1, 0.3]);
        color[(3, 1)] = [f32::NAN; 3];
        color[(0, 0)] = [0.9, 0.8, 1.0];
        let mut sample = Sample {
            name: "a".to_owned(),
            color,
            paint: None,
            height_mm: None,
            mask,
            spacing: 1.0,
            mm_per_texel: None,
            guessed_relief: false,
        };
        assert_eq!(sample.texels(), 7);
        for (mean, wanted) in sample.mean_color().into_iter().zip([0.3, 0.2, 0.4]) {
            assert!((mean - wanted).abs() < 1e-6, "{mean}, not {wanted}");
        }
        sample.color = Field::filled(4, 2, [0.184_186_5; 3]);
        assert!((sample.mean_lightness() - 50.0).abs() < 1e-3, "{}", sample.mean_lightness());
        sample.mask = Field::filled(4, 2, false);
        assert_eq!((sample.mean_color(), sample.mean_lightness()), ([0.0; 3], 0.0));
    }

    fn set(tones: &[f32], provenance: &str) -> SampleSet {
        let samples = tones
            .iter()
            .map(|tone: &f32| strokes(&format!("tone {tone}"), 24, 8, *tone, 1))
            .collect();
        SampleSet { samples, paint: None, provenance: provenance.to_owned() }
    }

    fn painted(set: SampleSet, pigment: usize) -> SampleSet {
        let mut slots = Slots::default();
        slots[0] = Some(PigmentId(pigment));
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        SampleSet { paint: Some(PaintOfSamples { library, slots }), ..set }
    }

    #[test]
    fn samples_of_all_sets_go_from_dark_to_light_under_their_own_names() {
        let joined = SampleSet::joined(vec![set(&[0.5, 0.1], "a"), set(&[0.2, 0.1], "b")]).unwrap();
        let names: Vec<&str> = joined.samples.iter().map(|sample| sample.name.as_str()).collect();
        assert_eq!(names, ["tone 0.1", "tone 0.1 (2)", "tone 0.2", "tone 0.5"]);
        assert_eq!(joined.provenance, "a; b");
        assert!(SampleSet::joined(Vec::new()).unwrap().samples.is_empty());
    }

    #[test]
    fn sets_of_other_pigments_are_refused() {
        fn refused(sets: Vec<SampleSet>) -> String {
            SampleSet::joined(sets).unwrap_err().to_string()
        }
        let [a, b] = [|| painted(set(&[0.1], "a"), 0), || painted(set(&[0.2], "b"), 1)];
        assert!(refused(vec![a(), b()]).contains("`a` and `b`"));
        assert!(refused(vec![a(), set(&[0.2], "c")]).contains("`c` has colours only"));
        assert!(refused(vec![set(&[0.2], "c"), a()]).contains("`c` has colours only"));
        assert!(SampleSet::joined(vec![a(), a()]).is_ok());
    }
}
