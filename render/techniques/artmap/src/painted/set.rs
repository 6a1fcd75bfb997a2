//! A set of swatches in one style: the tones of a hue, from dark to light.

use std::sync::Arc;

use documents::hint::Explain;
use documents::{Cancelled, Task};
use paint::ground::{Ground, GroundError};
use paint::light::{Light, PaintLightError};
use paint::painting::PaintingError;
use paint::technique::Technique;
use pigment::{PigmentLibrary, Viewing};
use rayon::prelude::*;

use super::plan::{Style, StyleError, StylePreset};
use super::swatch::{Workplace, ground, spread, strokes};
use super::tones::{ToneLadder, TonesError};
use crate::sample::{PaintOfSamples, Sample, SampleSet};

/// Colours of a set of swatches.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedSettings {
    /// Library of the paints.
    pub library: Arc<PigmentLibrary>,
    /// Hue as `#rrggbb` or `L,a,b`.
    pub hue: String,
    /// Number of tones, 2 to 12.
    pub tones: usize,
    /// Seed of the strokes, `None` for the style's seed.
    pub seed: Option<u64>,
}

impl Default for PaintedSettings {
    /// Seven tones of yellow ochre in the oils that ship.
    fn default() -> Self {
        Self {
            library: Arc::new(PigmentLibrary::van_gogh_oils()),
            hue: "#c9a227".to_owned(),
            tones: 7,
            seed: None,
        }
    }
}

/// Paints the swatches of a style with the paint engine on the processor.
///
/// If you pass equal input, you get equal bytes on any number of threads. The samples are upright,
/// have the style's spacing, go from dark to light, and are named `tone 1` and up.
///
/// # Errors
/// [`PaintedError`] for a style with numbers out of range, a hue that cannot be mixed, and a brush
/// that does not suit the cells.
pub fn painted_samples(
    style: &Style,
    settings: &PaintedSettings,
) -> Result<SampleSet, PaintedError> {
    let task = Task::default();
    SwatchPainter::prepare(settings, style, &task)?.paint((), &task)
}

/// Paints the tones of one hue in a style: the technique of samples for art maps.
#[derive(Debug)]
pub struct SwatchPainter {
    style: Style,
    colors: PaintedSettings,
    ladder: ToneLadder,
    ground: Ground,
    light: Arc<Light>,
}

impl Technique for SwatchPainter {
    const NAME: &'static str = "samples";
    const EXAMPLES: &'static [&'static str] = &["strokes.coats=2", "brush.shape=filbert"];

    type Settings = Style;
    type Preset = StylePreset;
    type Subject<'a> = &'a PaintedSettings;
    type View<'a> = ();
    type Picture = SampleSet;
    type Error = PaintedError;

    fn prepare(colors: &PaintedSettings, style: &Style, task: &Task) -> Result<Self, PaintedError> {
        style.check()?;
        task.stage("painting samples");
        task.check()?;
        let library = Arc::clone(&colors.library);
        let ladder = ToneLadder::new(library, &colors.hue, colors.tones, spread(style))?;
        let ground = ground(style, &ladder)?;
        let light = Arc::new(Light::new(&colors.library, &Viewing::default())?);
        Ok(Self { style: style.clone(), colors: colors.clone(), ladder, ground, light })
    }

    fn paint(&mut self, _: (), task: &Task) -> Result<SampleSet, PaintedError> {
        let Self { style, colors, ladder, ground, light } = &*self;
        let PaintedSettings { library, hue, tones, seed } = colors;
        let seed = seed.unwrap_or(style.seed);
        let ground = ground.clone();
        let workplace = Workplace { style, ladder, ground, light: Arc::clone(light) };
        let nested = strokes(style, seed);
        let samples = (0..*tones).into_par_iter().map(|at| -> Result<Sample, PaintedError> {
            task.check()?;
            let sample = match style.strokes.nested {
                true => workplace.swatch(at, &nested),
                false => workplace.swatch(at, &strokes(style, seed.wrapping_add(at as u64))),
            };
            Ok(sample?)
        });
        let samples = samples.collect::<Result<Vec<_>, PaintedError>>()?;
        let Style { name, .. } = style;
        let provenance =
            format!("painted by impasto: style {name}, hue {hue}, {tones} tones, seed {seed}");
        let paint = PaintOfSamples { library: Arc::clone(library), slots: *ladder.slots() };
        Ok(SampleSet { samples, paint: Some(paint), provenance })
    }
}

/// Swatches cannot be painted.
#[derive(Debug, thiserror::Error, Explain)]
pub enum PaintedError {
    /// A number of the style is out of range.
    #[error(transparent)]
    Style(#[from] StyleError),
    /// The tones cannot be mixed.
    #[error(transparent)]
    Tones(#[from] TonesError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The library has no wavelengths in common with daylight.
    #[error(transparent)]
    Light(#[from] PaintLightError),
    /// The engine refuses a brush or a stroke.
    #[error(transparent)]
    Painting(#[from] PaintingError),
    /// The task was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

#[cfg(test)]
mod tests {
    use graphics::field::Field;
    use graphics::orientation::OrientationField;
    use paint::amount::mm_from_quanta;
    use paint::document::Document;
    use paint::layer::SLOTS;
    use rayon::ThreadPoolBuilder;

    use super::super::plan::ToneSource;
    use documents::hint::Fault;

    use super::*;

    fn small(name: &str, side_cells: usize) -> Style {
        let mut style = Style::named(name).unwrap();
        style.canvas.side_cells = side_cells;
        // We take larger cells, for the same strokes in less time.
        style.canvas.cell_mm *= 1.25;
        style
    }

    fn settings(tones: usize) -> PaintedSettings {
        PaintedSettings { tones, ..PaintedSettings::default() }
    }

    fn lightness(rgb: [f32; 3]) -> f32 {
        let luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        116.0 * luminance.max(0.0).cbrt() - 16.0
    }

    fn mean(values: impl Iterator<Item = f64>) -> f64 {
        let (sum, count) =
            values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
        sum / count
    }

    fn mean_lightness(sample: &Sample) -> f64 {
        mean(sample.color.values().iter().map(|rgb| f64::from(lightness(*rgb))))
    }

    fn heights(sample: &Sample) -> Vec<f64> {
        let heights = sample.height_mm.as_ref().unwrap();
        heights.values().iter().map(|height| f64::from(*height)).collect()
    }

    fn correlation(a: &[f64], b: &[f64]) -> f64 {
        let [mean_a, mean_b] = [a, b].map(|values| mean(values.iter().copied()));
        let product = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
            a.iter().zip(b).map(|(a, b)| f(a - mean_a, b - mean_b)).sum()
        };
        product(&|a, b| a * b) / (product(&|a, _| a * a) * product(&|_, b| b * b)).sqrt()
    }

    #[test]
    fn every_style_paints_upright_strokes_in_tones_that_rise() {
        for name in Style::ALL {
            let style = small(name, 56);
            let set = painted_samples(&style, &settings(2)).unwrap();
            let tones: Vec<f64> = set.samples.iter().map(mean_lightness).collect();
            assert!(tones[1] - tones[0] > 10.0, "{name}: {tones:?}");
            let covers = !["hatching", "dry-brush"].contains(&name);
            for (at, sample) in set.samples.iter().enumerate() {
                assert_eq!(sample.name, format!("tone {}", at + 1));
                assert_eq!(sample.size(), (56, 56));
                assert_eq!(sample.spacing, style.spacing_cells());
                let heights = heights(sample);
                let bare = heights.iter().filter(|height| **height < 0.002).count();
                let bare = bare as f64 / heights.len() as f64;
                let wanted = if covers { 0.0..0.004 } else { 0.1..0.9 };
                assert!(wanted.contains(&bare), "{name}, tone {at}: {bare} of the ground is bare");
                let upright = uprightness(sample);
                let least = if name == "dabs" { 0.4 } else { 0.8 };
                assert!(upright > least, "{name}, tone {at}: {upright}");
            }
        }
    }

    #[test]
    fn a_cancelled_task_paints_no_samples() {
        let task = Task::default();
        let colors = settings(2);
        let mut painter = SwatchPainter::prepare(&colors, &small("dabs", 32), &task).unwrap();
        task.cancel();
        let cancelled = |error| matches!(error, PaintedError::Cancelled(_));
        assert!(painter.paint((), &task).is_err_and(cancelled));
        assert!(SwatchPainter::prepare(&colors, &small("dabs", 32), &task).is_err_and(cancelled));
    }

    #[test]
    fn tones_of_a_mixture_each_rise_in_even_steps() {
        let set = painted_samples(&small("dabs", 60), &settings(5)).unwrap();
        let tones: Vec<f64> = set.samples.iter().map(mean_lightness).collect();
        let steps: Vec<f64> = tones.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mean = mean(steps.iter().copied());
        assert!(mean > 5.0, "{tones:?}");
        assert!(steps.iter().all(|step| (step / mean - 1.0).abs() < 0.12), "{steps:?}");
    }

    /// Mean cosine of twice the angle between the strokes and y. This is 1 for upright strokes, 0
    /// for strokes in all directions, -1 for strokes across.
    fn uprightness(sample: &Sample) -> f64 {
        let heights = sample.height_mm.as_ref().unwrap();
        let pairs = sample.color.values().iter().zip(heights.values());
        let planes = pairs.map(|(rgb, height)| [lightness(*rgb), 50.0 * height, 0.0]).collect();
        let field = Field::from_values(heights.width(), heights.height(), planes);
        let flow = OrientationField::from_lab(&field, 12.0);
        let cells = (0..heights.height()).flat_map(|y| (0..heights.width()).map(move |x| (x, y)));
        mean(cells.map(|(x, y)| {
            let [across, along] = flow.direction(x, y);
            along * along - across * across
        }))
    }

    #[test]
    fn nested_tones_have_the_same_strokes_and_others_do_not() {
        let mut style = small("oil-flat", 64);
        fn related(style: &Style) -> f64 {
            let set = painted_samples(style, &settings(2)).unwrap();
            correlation(&heights(&set.samples[0]), &heights(&set.samples[1]))
        }
        let nested = related(&style);
        style.strokes.nested = false;
        let single = related(&style);
        assert!(nested > 0.95 && single.abs() < 0.4, "{nested} nested, {single} of a seed each");
    }

    #[test]
    fn light_tones_of_hatching_are_parts_of_dark_ones() {
        let style = small("hatching", 90);
        assert_eq!(style.paint.tones, ToneSource::Density);
        let set = painted_samples(&style, &settings(3)).unwrap();
        let covers: Vec<Vec<bool>> = set
            .samples
            .iter()
            .map(|sample: &Sample| heights(sample).iter().map(|h| *h > 0.005).collect::<Vec<_>>())
            .collect();
        fn cells(cover: &[bool]) -> usize {
            cover.iter().filter(|drawn| **drawn).count()
        }
        for pair in covers.windows(2) {
            assert!(cells(&pair[0]) > cells(&pair[1]), "a darker tone has more lines");
            let lost =
                pair[1].iter().zip(&pair[0]).filter(|(light, dark)| **light && !**dark).count();
            assert!(lost * 50 < cells(&pair[1]), "{lost} cells of light lines are missing");
        }
        assert!(cells(&covers[2]) > 0, "the lightest tone has lines");
    }

    #[test]
    fn gaps_between_strokes_show_the_underpainting_and_not_the_ground() {
        fn darkest(underpainting_mm: f64) -> (f64, f64, f64) {
            let mut style = small("oil-flat", 48);
            (style.strokes.coats, style.strokes.spacing_mm) = (1, 9.0);
            style.paint.underpainting_mm = underpainting_mm;
            let sample = painted_samples(&style, &settings(2)).unwrap().samples.pop().unwrap();
            let least = heights(&sample).into_iter().fold(f64::INFINITY, f64::min);
            let tones = sample.color.values().iter().map(|rgb| lightness(*rgb));
            (mean_lightness(&sample), f64::from(tones.fold(f32::INFINITY, f32::min)), least)
        }
        let (_, bare, no_paint) = darkest(0.0);
        let (mean, covered, least) = darkest(0.05);
        assert!(no_paint < 1e-6 && (least - 0.05).abs() < 1e-4, "{no_paint} {least}");
        assert!(covered > mean - 16.0 && bare < mean - 20.0, "{mean}: {covered} {bare}");
    }

    /// Paints a whole canvas with the margins that a swatch does not have, and the swatch.
    fn painted(style: &Style) -> (Document, Sample) {
        let ladder =
            ToneLadder::new(Arc::new(PigmentLibrary::van_gogh_oils()), "#c9a227", 2, spread(style))
                .unwrap();
        let light = Light::new(ladder.library(), &Viewing::default()).unwrap();
        let ground = ground(style, &ladder).unwrap();
        let workplace = Workplace { style, ladder: &ladder, ground, light: Arc::new(light) };
        let strokes = strokes(style, style.seed);
        let document = workplace.painted(0, &strokes).unwrap();
        (document, workplace.swatch(0, &strokes).unwrap())
    }

    #[test]
    fn pigments_of_a_swatch_are_those_of_the_middle_of_its_canvas() {
        let style = small("oil-flat", 64);
        let (document, sample) = painted(&style);
        assert!(!document.dry.is_empty() || style.paint.wet_in_wet == 1.0, "coats dry");
        let (across, along) = style.margins();
        let mut exact = [0.0; SLOTS + 1];
        let layers = document.dry.iter().map(|layer| &layer.paint).chain([&document.wet]);
        for layer in layers {
            for (x, y) in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
                let cell = layer.cell((y + along) * layer.width() + x + across);
                let slots = cell.pigments.iter().chain([&cell.vehicle]);
                for (sum, amount) in exact.iter_mut().zip(slots) {
                    *sum += mm_from_quanta(*amount, document.cell_mm);
                }
            }
        }
        let mut found = [0.0; SLOTS + 1];
        for texel in sample.paint.as_ref().unwrap().values() {
            let slots = texel.pigments_mm.iter().chain([&texel.vehicle_mm]);
            for (sum, amount) in found.iter_mut().zip(slots) {
                *sum += f64::from(*amount);
            }
        }
        assert!(exact.iter().filter(|sum| **sum > 0.0).count() >= 3, "{exact:?}");
        for (found, exact) in found.iter().zip(exact) {
            assert!((found - exact).abs() <= 1e-6 * exact, "{found}, not {exact}");
        }
        let volume: f64 = heights(&sample).iter().sum();
        let sum: f64 = exact.iter().sum();
        assert!((volume - sum).abs() < 1e-6 * sum, "{volume} high, not {sum}");
    }

    #[test]
    fn swatches_do_not_depend_on_threads() {
        let style = small("dabs", 48);
        let on = |threads| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| painted_samples(&style, &settings(2)).unwrap())
        };
        let one = on(1);
        assert!(one == on(2), "one and two threads");
        assert!(one == on(1), "twice");
        let seed = PaintedSettings { seed: Some(77), ..settings(2) };
        let other = painted_samples(&style, &seed).unwrap();
        assert!(one.samples != other.samples, "another seed");
    }

    #[test]
    fn errors_say_what_to_change() {
        let mut style = small("knife", 48);
        style.brush.size_mm = 500.0;
        let error = painted_samples(&style, &settings(3)).unwrap_err();
        assert!(error.to_string().contains("brush.size_mm is 0.2 to 100, found `500`"), "{error}");
        let style = small("knife", 48);
        let hue = PaintedSettings { hue: "mud".to_owned(), ..settings(3) };
        let error = painted_samples(&style, &hue).unwrap_err();
        assert!(error.to_string().contains("found `mud`"), "{error}");
        assert_eq!(error.fault(), Fault::Setting);
        assert!(error.hint().is_some());
    }
}
