//! Outcomes of requests for samples of brushwork and art maps: figures to print, or to write as JSON.

use artmap::{
    map::{ArtMap, MapFault, MapFigures},
    passages::{Mark, MarkedArea, PassageReport, SpacingSource, StrokesSeen},
    sample::{PaintOfSamples, Sample, SampleSet},
    synthesis::SynthesisSettings,
};
use serde::{Serialize, Serializer};
use spectra::color::Rgb;

use crate::exports::Written;

/// Samples that were taken, painted or read. The JSON leaves out `style` and `written`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SamplesOutcome {
    /// Where the samples come from, in words.
    pub provenance: String,
    /// Distance between neighbouring strokes in texels. `None` if there are no samples.
    pub spacing: Option<f64>,
    /// Names of the pigments of their paint. Empty if the samples have only colours.
    pub pigments: Vec<String>,
    /// The samples from dark to light.
    pub samples: Vec<SampleFigures>,
    /// Name of the style, if the samples were painted for this request.
    #[serde(skip)]
    pub style: Option<String>,
    /// Files that were written, and remarks.
    #[serde(skip)]
    pub written: Written,
}

/// Figures of one sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SampleFigures {
    /// Name of the sample.
    pub name: String,
    /// Width and height in texels.
    pub size: (usize, usize),
    /// Number of texels of the passage.
    pub texels: usize,
    /// Mean CIELAB lightness, 0 to 100. For a sample from a picture we measure it before the sample is turned.
    pub lightness: f64,
    /// Mean colour as `#rrggbb`.
    pub colour: String,
    /// Side of a texel in mm, where it is known.
    pub mm_per_texel: Option<f64>,
    /// Height of the paint. `None` if the sample has no relief.
    pub height_mm: Option<HeightFigures>,
    /// Whether the height was guessed.
    pub guessed_relief: bool,
    /// How the sample was taken from its picture. `None` for painted samples, and for samples of a file.
    #[serde(flatten)]
    pub passage: Option<PassageFigures>,
}

/// Height of the paint of a sample in mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HeightFigures {
    /// Mean height over the passage.
    pub mean: f64,
    /// Greatest height in the passage.
    pub greatest: f64,
}

/// How one sample was taken from its picture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PassageFigures {
    /// Number of pixels of the passage.
    pub pixels: usize,
    /// Column and row of the upper left corner of the passage, its width and height, in pixels.
    pub bounds: [usize; 4],
    /// Number of regions under the scribble. For a rectangle, this is 0.
    pub regions_under: usize,
    /// Direction of the strokes.
    pub direction: DirectionFigures,
    /// Distance between neighbouring strokes in pixels of the picture.
    pub spacing_px: f64,
    /// Where this distance comes from: `marked`, `set` or `estimated`.
    pub spacing_source: &'static str,
    /// How clear an estimated distance is, 0.1 to 2. `None` if the distance is not estimated.
    pub sharpness: Option<f64>,
    /// Where we saw the strokes, if their distance is estimated.
    pub spacing_seen_in: Option<StrokesSeen>,
    /// Texels of the sample per pixel of the picture, across and along the strokes.
    pub scale: [f64; 2],
}

/// Direction of the strokes of a passage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DirectionFigures {
    /// Angle in degrees, 0 to 180: 0 along x, 90 along y, growing from x (right) to y (down).
    pub degrees: f64,
    /// Share of the strong gradients that agree in direction, 0 to 1.
    pub coherence: f64,
    /// Whether the passage was turned until its strokes run along y.
    pub turned: bool,
    /// Where we saw the strokes.
    pub seen_in: StrokesSeen,
}

impl SamplesOutcome {
    /// The figures of samples that were taken from a picture. There is one report for each sample.
    pub(crate) fn of_passages(set: &SampleSet, reports: &[PassageReport]) -> Self {
        let mut outcome = Self::from(set);
        for (sample, report) in outcome.samples.iter_mut().zip(reports) {
            sample.lightness = report.lightness;
            sample.passage = Some(report.into());
        }
        outcome
    }
}

impl From<&SampleSet> for SamplesOutcome {
    fn from(set: &SampleSet) -> Self {
        Self {
            provenance: set.provenance.clone(),
            spacing: set.samples.first().map(|sample| sample.spacing),
            pigments: names_of(set.paint.as_ref()),
            samples: set.samples.iter().map(Into::into).collect(),
            style: None,
            written: Written::default(),
        }
    }
}

impl From<&Sample> for SampleFigures {
    fn from(sample: &Sample) -> Self {
        let color = sample.mean_color().map(|value| value.clamp(0.0, 1.0));
        Self {
            name: sample.name.clone(),
            size: sample.size(),
            texels: sample.texels(),
            lightness: sample.mean_lightness(),
            colour: Rgb(color).encoded().to_hex(),
            mm_per_texel: sample.mm_per_texel,
            height_mm: HeightFigures::of(sample),
            guessed_relief: sample.guessed_relief,
            passage: None,
        }
    }
}

impl HeightFigures {
    /// The heights of the texels of a sample, if it has relief.
    fn of(sample: &Sample) -> Option<Self> {
        let heights = sample.height_mm.as_ref()?.values().iter().zip(sample.mask.values());
        let inside = heights.filter(|(_, inside)| **inside).map(|(height, _)| f64::from(*height));
        let (sum, greatest) = inside
            .fold((0.0, 0.0), |(sum, most): (f64, f64), height| (sum + height, most.max(height)));
        Some(Self { mean: sum / sample.texels().max(1) as f64, greatest })
    }
}

impl From<&PassageReport> for PassageFigures {
    fn from(report: &PassageReport) -> Self {
        let (spacing_source, sharpness, spacing_seen_in) = match report.spacing_source {
            SpacingSource::Marked => ("marked", None, None),
            SpacingSource::Set => ("set", None, None),
            SpacingSource::Estimated { sharpness, seen } => {
                ("estimated", Some(sharpness), Some(seen))
            }
        };
        Self {
            pixels: report.pixels(),
            bounds: report.bounds(),
            regions_under: report.regions_under,
            direction: DirectionFigures {
                degrees: report.direction.degrees,
                coherence: report.direction.coherence,
                turned: report.direction.turned,
                seen_in: report.direction_seen,
            },
            spacing_px: report.spacing_px,
            spacing_source,
            sharpness,
            spacing_seen_in,
            scale: report.scale,
        }
    }
}

/// Names of the pigments of samples or of a map. Empty if they have no paint.
fn names_of(paint: Option<&PaintOfSamples>) -> Vec<String> {
    paint.map(PaintOfSamples::pigment_names).unwrap_or_default()
}

/// Marks that were proposed for a picture. The JSON leaves out `written`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarksOutcome {
    /// Name of the file of the picture.
    pub painting: String,
    /// The marks. The best passage is first.
    pub samples: Vec<MarkFigures>,
    /// Names of the samples for which you have to mark the distance between strokes, because it cannot be
    /// estimated.
    pub without_spacing: Vec<String>,
    /// Files that were written, and remarks.
    #[serde(skip)]
    pub written: Written,
}

/// A mark that was proposed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarkFigures {
    /// Name of the sample.
    pub name: String,
    /// Points of a line over the passage, in pixels. Empty if the mark is not a line.
    pub scribble: Vec<[f64; 2]>,
}

impl From<&Mark> for MarkFigures {
    fn from(mark: &Mark) -> Self {
        let scribble = match &mark.area {
            MarkedArea::Scribble(points) => points.clone(),
            MarkedArea::Pixels(_) | MarkedArea::Rectangle { .. } => Vec::new(),
        };
        Self { name: mark.name.clone(), scribble }
    }
}

/// A map that was made or read. The JSON leaves out `written`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ArtMapOutcome {
    /// Where its samples come from, in words.
    pub provenance: String,
    /// Width and height of the tiles in texels.
    pub size: usize,
    /// Distance between neighbouring strokes in texels.
    pub spacing: f64,
    /// Side of a texel in mm, where it is known.
    pub mm_per_texel: Option<f64>,
    /// Whether heights are a guess.
    pub guessed_relief: bool,
    /// Names of the pigments of its paint. Empty if the map has only colours.
    pub pigments: Vec<String>,
    /// Name of the tile that was made first.
    pub first: String,
    /// Width and height of a patch of the synthesis, in texels.
    pub patch: usize,
    /// Number of levels of the synthesis.
    pub levels: usize,
    /// Settings of the synthesis.
    pub settings: SynthesisSettings,
    /// The tiles from dark to light.
    pub tiles: Vec<TileFigures>,
    /// Faults of the map. Empty for a good map. The JSON holds them as sentences.
    #[serde(serialize_with = "sentences")]
    pub faults: Vec<MapFault>,
    /// Files that were written, and remarks.
    #[serde(skip)]
    pub written: Written,
}

/// Figures of a tile of a map.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TileFigures {
    /// Name of the sample.
    pub name: String,
    /// Mean CIELAB lightness.
    pub lightness: f64,
    /// Standard deviation of the lightness.
    pub contrast: f64,
    /// Length of the strokes in texels.
    pub stroke_length: f64,
    /// Correlation of its strokes with the strokes of the first tile, -1 to 1.
    pub coherence: f64,
    /// Correlation of its strokes with the neighbouring tile on the side of the first tile, -1 to 1.
    pub neighbour_coherence: f64,
    /// Steps of lightness where copies of the tile meet, divided by the steps inside the tile. At 1 you see no
    /// seam.
    pub border: f64,
    /// Whether this tile was made first. The others follow it.
    #[serde(skip)]
    pub is_first: bool,
}

impl From<&ArtMap> for ArtMapOutcome {
    fn from(map: &ArtMap) -> Self {
        let figures = MapFigures::of(map);
        let tiles = figures.keys.iter().enumerate().map(|(index, key)| TileFigures {
            name: key.name.clone(),
            lightness: key.tone,
            contrast: key.contrast,
            stroke_length: key.stroke_length,
            coherence: key.coherence,
            neighbour_coherence: key.neighbour_coherence,
            border: key.wrap_ratio,
            is_first: index == figures.first,
        });
        Self {
            provenance: map.provenance.clone(),
            size: map.size(),
            spacing: map.spacing,
            mm_per_texel: map.mm_per_texel,
            guessed_relief: map.guessed_relief,
            pigments: names_of(map.paint.as_ref()),
            first: map.keys[map.first].name.clone(),
            patch: map.patch,
            levels: map.levels,
            settings: map.settings.clone(),
            tiles: tiles.collect(),
            faults: figures.faults(),
            written: Written::default(),
        }
    }
}

fn sentences<S: Serializer>(faults: &[MapFault], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(faults.iter().map(ToString::to_string))
}

/// Content of a file of brushwork: samples or a map.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum BrushworkOutcome {
    /// The file holds samples.
    Samples(SamplesOutcome),
    /// The file holds a map.
    Map(ArtMapOutcome),
}
