//! Samples taken from a painting or photograph by marks.
//!
//! ```text
//! picture -> over-segmentation (jseg) -> traits -> joining <- marks (scribbles, rectangles)
//!                                                    |
//!                        SampleSet <- upright <- spacing <- direction of each passage
//! ```
//!
//! This follows Yan, Chi, Lee and Lin (2008, section 4.1). You draw one line over each passage. We
//! join regions to passages. Then we turn each passage until its strokes run along y, and resize
//! it until all have one spacing of strokes.

mod marks;
mod settings;
mod regions;
mod jseg;
mod over_segmentation;
mod joining;
mod upright;
mod report;
mod taking;

#[cfg(test)]
mod made_up;

pub use marks::{Mark, MarkFault, MarkedArea, Marks, MarksError};
pub use over_segmentation::over_segmented;
pub use regions::Regions;
pub use report::{
    PassageReport, SpacingSource, StrokesSeen, color_of_mark, drawn_in, marked_picture,
};
pub use settings::{Density, OverSegmentation, PassageError, PassageSettings, SourcePicture};
pub use taking::{propose_marks, samples_of_picture};
pub use upright::StrokeDirection;

#[cfg(test)]
mod tests {
    //! Samples of paintings made by code: masks, directions, spacings, channels, and bad inputs.

    use documents::hint::Explain;
    use graphics::field::Field;
    use pigment::library::PigmentLibrary;

    use super::made_up::{Brush, HEIGHT, Painting, Texture, WIDTH, textured};
    use super::*;
    use crate::sample::{PaintOfSamples, Sample, TexelPaint};

    /// Intersection over union of each sample with its texture.
    fn overlaps(painting: &Painting, over: OverSegmentation) -> Vec<f64> {
        let picture = SourcePicture::of_colors(painting.picture(), painting.name);
        let settings = PassageSettings { over, ..PassageSettings::default() };
        let (_, reports) = samples_of_picture(&picture, &painting.marks(), &settings).unwrap();
        reports
            .iter()
            .map(|report: &PassageReport| {
                let texture: usize = report.name.parse().unwrap();
                let mut both = 0;
                let mut either = 0;
                for y in 0..HEIGHT {
                    for x in 0..WIDTH {
                        let pair = (report.mask[(x, y)], painting.texture_at(x, y) == texture);
                        both += usize::from(pair == (true, true));
                        either += usize::from(pair != (false, false));
                    }
                }
                f64::from(both as u32) / f64::from(either as u32)
            })
            .collect()
    }

    fn mean(values: &[f64]) -> f64 {
        values.iter().sum::<f64>() / values.len() as f64
    }

    #[test]
    fn scribbles_find_the_textures_of_six_paintings() {
        let mut all = Vec::new();
        for painting in Painting::all() {
            let found = overlaps(&painting, OverSegmentation::Jseg);
            let [own, other] = [&found, &overlaps(&painting, OverSegmentation::MeanShift)]
                .map(|found| mean(found));
            assert!(own > other - 0.05, "{}: {own:.3}, by mean shift {other:.3}", painting.name);
            assert!(found.iter().all(|&overlap| overlap >= 0.80), "{}: {found:.3?}", painting.name);
            all.extend(found);
        }
        assert!(mean(&all) >= 0.90, "{:.3} in the mean", mean(&all));
    }

    fn rectangle(name: &str, [x, y, width, height]: [u32; 4], spacing: Option<f64>) -> Mark {
        Mark {
            name: name.to_owned(),
            area: MarkedArea::Rectangle { x, y, width, height },
            spacing: spacing.map(|spacing| [[1.0, 1.0], [1.0, 1.0 + spacing]]),
        }
    }

    fn marks(samples: Vec<Mark>) -> Marks {
        Marks { file: "m.toml".to_owned(), painting: None, samples }
    }

    fn pair() -> SourcePicture {
        let textures = [
            Texture { degrees: 30.0, spacing: 8.0, color: [0.7, 0.65, 0.6], ..Texture::default() },
            Texture { degrees: 110.0, spacing: 12.0, color: [0.3; 3], ..Texture::default() },
        ];
        let color = textured(240, 120, 3, &textures, |x, _| usize::from(x >= 120));
        let height = color.values().iter().map(|color| color[1]).collect();
        let height = Field::from_values(240, 120, height);
        let paint = height.values().iter().map(|&h| TexelPaint {
            pigments_mm: [h, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            vehicle_mm: 0.5 * h,
        });
        let paint = Field::from_values(240, 120, paint.collect());
        let library = PigmentLibrary::van_gogh_oils().into();
        SourcePicture {
            paint: Some((paint, PaintOfSamples { library, slots: Default::default() })),
            height_mm: Some(height),
            mm_per_pixel: Some(0.2),
            ..SourcePicture::of_colors(color, "a pair")
        }
    }

    fn both_rectangles(spacings: [Option<f64>; 2]) -> Marks {
        marks(vec![
            rectangle("light", [0, 0, 120, 120], spacings[0]),
            rectangle("dark", [120, 0, 120, 120], spacings[1]),
        ])
    }

    /// Direction of the strokes of a finished sample. We measure it in its own pixels.
    fn direction_of(sample: &Sample) -> f64 {
        let picture = SourcePicture::of_colors(sample.color.clone(), "sample");
        let (width, height) = sample.size();
        let inner = [width / 4, height / 4, width / 2, height / 2].map(|side| side as u32);
        let marks = marks(vec![rectangle("inner", inner, Some(5.0))]);
        let (_, reports) =
            samples_of_picture(&picture, &marks, &PassageSettings::default()).unwrap();
        reports[0].direction.degrees
    }

    #[test]
    fn samples_are_upright_of_one_spacing_and_dark_to_light() {
        let settings = PassageSettings::default();
        let (set, reports) =
            samples_of_picture(&pair(), &both_rectangles([None; 2]), &settings).unwrap();
        let names: Vec<&str> = set.samples.iter().map(|sample| sample.name.as_str()).collect();
        assert_eq!(names, ["dark", "light"]);
        for ((sample, report), (degrees, spacing)) in
            set.samples.iter().zip(&reports).zip([(110.0, 12.0), (30.0, 8.0)])
        {
            assert!((report.direction.degrees - degrees).abs() < 2.0, "{:?}", report.direction);
            assert!((report.spacing_px / spacing - 1.0).abs() < 0.08, "{}", report.spacing_px);
            assert!(matches!(report.spacing_source, SpacingSource::Estimated { .. }), "{report:?}");
            assert!((direction_of(sample) - 90.0).abs() < 2.0, "{}", direction_of(sample));
            // The smaller spacing of the two is the reference.
            assert_eq!(sample.spacing, reports[1].spacing_px);
            let scale = reports[1].spacing_px / report.spacing_px;
            assert_eq!(report.scale, [scale; 2]);
            assert!((sample.mm_per_texel.unwrap() - 0.2 / scale).abs() < 1e-12, "{sample:?}");
        }
        assert_eq!(set.samples[1].mm_per_texel, Some(0.2), "the reference keeps its size");
        assert_eq!((set.provenance.as_str(), set.paint.is_some()), ("a pair", true));
    }

    #[test]
    fn all_channels_of_a_texel_come_from_the_same_place() {
        let marks = both_rectangles([Some(8.0), Some(12.0)]);
        let (set, _) = samples_of_picture(&pair(), &marks, &PassageSettings::default()).unwrap();
        for sample in &set.samples {
            let paint = sample.paint.as_ref().unwrap();
            let height = sample.height_mm.as_ref().unwrap();
            for (texel, color) in sample.color.values().iter().enumerate() {
                // Height and paint were made equal to the green of the picture.
                assert_eq!(height.values()[texel], color[1]);
                assert_eq!(paint.values()[texel].pigments_mm[0], color[1]);
                assert!(
                    (paint.values()[texel].vehicle_mm - 0.5 * color[1]).abs() < 1e-6,
                    "vehicle"
                );
            }
        }
    }

    #[test]
    fn width_alone_is_resized_on_request() {
        let marks = both_rectangles([Some(8.0), Some(12.0)]);
        let settings = PassageSettings { density: Density::Width, ..PassageSettings::default() };
        let (set, reports) = samples_of_picture(&pair(), &marks, &settings).unwrap();
        assert_eq!(reports[0].scale, [8.0 / 12.0, 1.0]);
        let (uniform, _) =
            samples_of_picture(&pair(), &marks, &PassageSettings::default()).unwrap();
        let [wide, even] = [&set, &uniform].map(|set| set.samples[0].size());
        assert_eq!(wide.0, even.0);
        let ratio = wide.1 as f64 / even.1 as f64;
        assert!((ratio - 1.5).abs() < 0.03, "{ratio}");
        let mm = set.samples[0].mm_per_texel.unwrap();
        assert!((mm - 0.2 * 1.5f64.sqrt()).abs() < 1e-12, "{mm}");
    }

    #[test]
    fn samples_do_not_depend_on_threads() {
        let painting = Painting::quarters();
        let picture = SourcePicture::of_colors(painting.picture(), "quarters");
        let [one, three] = [1, 3].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let settings = PassageSettings::default();
            pool.install(|| samples_of_picture(&picture, &painting.marks(), &settings).unwrap())
        });
        assert!(one == three);
    }

    #[test]
    fn bad_inputs_are_named_with_a_way_out() {
        let flat = SourcePicture::of_colors(Field::filled(60, 60, [0.3; 3]), "flat");
        let [mut odd, mut broken, empty] =
            [pair(), pair(), SourcePicture::of_colors(Field::filled(0, 0, [0.0; 3]), "empty")];
        odd.height_mm = Some(Field::filled(3, 3, 0.0));
        broken.color[(7, 5)][0] = f32::INFINITY;
        let whole = |spacing| marks(vec![rectangle("a", [0, 0, 60, 60], spacing)]);
        let cases = [
            (&flat, whole(None), "the distance between strokes cannot be seen in a"),
            (
                &flat,
                whole(Some(20.0)),
                "sample `a` is 60 px wide across its strokes, less than four",
            ),
            (
                &pair(),
                both_rectangles([Some(2.0), Some(20.0)]),
                "the strokes of sample `dark` are 20.0 px",
            ),
            (&odd, whole(None), "height has 3 x 3 pixels, the colours have 240 x 120"),
            (&broken, whole(None), "the picture has no colour at [7, 5]"),
            (&empty, whole(None), "m.toml, sample `a`, rectangle: [0, 0] lies off the picture"),
            (&flat, marks(Vec::new()), "m.toml: there are no samples"),
        ];
        for (picture, marks, message) in cases {
            let error =
                samples_of_picture(picture, &marks, &PassageSettings::default()).unwrap_err();
            assert!(error.to_string().starts_with(message), "{error}, wanted {message}");
            assert!(error.hint().is_some(), "{message}");
        }
    }

    #[test]
    fn one_flat_sample_with_a_marked_spacing_is_allowed_and_not_turned() {
        let flat = SourcePicture::of_colors(Field::filled(60, 50, [0.3; 3]), "flat");
        let scribble = MarkedArea::Scribble(vec![[10.0, 10.0], [40.0, 30.0]]);
        let mark =
            Mark { name: "a".to_owned(), area: scribble, spacing: Some([[1.0, 1.0], [1.0, 9.0]]) };
        let marks = marks(vec![mark]);
        let (set, reports) =
            samples_of_picture(&flat, &marks, &PassageSettings::default()).unwrap();
        assert!(!reports[0].direction.turned, "{:?}", reports[0].direction);
        assert_eq!(reports[0].spacing_source, SpacingSource::Marked);
        assert_eq!((set.samples[0].size(), set.samples[0].spacing), ((60, 50), 8.0));
        assert_eq!(set.samples[0].color, flat.color, "pixels as they are");
    }

    #[test]
    fn specks_have_no_spacing_unless_marked() {
        let specks = Texture { brush: Brush::Specks, ..Texture::default() };
        let picture = SourcePicture::of_colors(textured(100, 80, 2, &[specks], |_, _| 0), "specks");
        let [unmarked, marked] = [None, Some(10.0)].map(|spacing| {
            let marks = marks(vec![rectangle("a", [0, 0, 100, 80], spacing)]);
            samples_of_picture(&picture, &marks, &PassageSettings::default())
        });
        let error = unmarked.unwrap_err();
        assert!(matches!(error, PassageError::NoSpacing(..)), "{error}");
        assert!(marked.is_ok());
    }

    #[test]
    fn a_set_spacing_counts_where_the_marks_give_none() {
        let settings = PassageSettings { spacing: Some(10.0), ..PassageSettings::default() };
        let marks = both_rectangles([Some(8.0), None]);
        let (_, reports) = samples_of_picture(&pair(), &marks, &settings).unwrap();
        let found: Vec<_> = reports.iter().map(|r| (r.spacing_px, r.spacing_source)).collect();
        assert_eq!(found, [(10.0, SpacingSource::Set), (8.0, SpacingSource::Marked)]);
        for spacing in [0.0, -3.0, f64::NAN, 1001.0] {
            let settings = PassageSettings { spacing: Some(spacing), ..settings };
            let error = samples_of_picture(&pair(), &marks, &settings).unwrap_err();
            assert!(error.to_string().starts_with("spacing takes 1 to 1000, found"), "{error}");
            assert_eq!(error.fault(), documents::hint::Fault::Setting);
        }
    }

    #[test]
    fn strokes_are_seen_in_the_relief_of_paint_of_one_color() {
        let ridges = Texture { degrees: 40.0, spacing: 9.0, ..Texture::default() };
        let ridges = textured(160, 120, 4, &[ridges], |_, _| 0);
        let height = ridges.values().iter().map(|color| 0.1 * color[1]).collect();
        let mut picture = SourcePicture {
            height_mm: Some(Field::from_values(160, 120, height)),
            ..SourcePicture::of_colors(Field::filled(160, 120, [0.2, 0.3, 0.4]), "ridges")
        };
        let marks = Marks::of_whole("ridges", (160, 120));
        let settings = PassageSettings::default();
        let (_, reports) = samples_of_picture(&picture, &marks, &settings).unwrap();
        let PassageReport { direction, direction_seen, spacing_px, spacing_source, .. } =
            &reports[0];
        assert!((direction.degrees - 40.0).abs() < 2.0 && direction.turned, "{direction:?}");
        assert!((spacing_px / 9.0 - 1.0).abs() < 0.08, "{spacing_px}");
        assert_eq!(*direction_seen, StrokesSeen::Relief);
        let SpacingSource::Estimated { seen, .. } = spacing_source else {
            panic!("{spacing_source:?}")
        };
        assert_eq!(*seen, StrokesSeen::Relief);
        // A guess from the colours adds nothing to them.
        picture.guessed_relief = true;
        let error = samples_of_picture(&picture, &marks, &settings).unwrap_err();
        assert!(matches!(error, PassageError::NoSpacing(..)), "{error}");
    }

    #[test]
    fn reports_tell_where_the_passage_lies() {
        let marks = marks(vec![rectangle("light", [30, 20, 60, 50], Some(8.0))]);
        let (_, reports) =
            samples_of_picture(&pair(), &marks, &PassageSettings::default()).unwrap();
        assert_eq!((reports[0].bounds(), reports[0].pixels()), ([30, 20, 60, 50], 3000));
    }

    #[test]
    fn the_whole_picture_is_one_sample_without_marks() {
        let whole = Marks::of_whole("all", (240, 120));
        let settings = PassageSettings { spacing: Some(8.0), ..PassageSettings::default() };
        let (set, reports) = samples_of_picture(&pair(), &whole, &settings).unwrap();
        assert_eq!((set.samples.len(), set.samples[0].name.as_str()), (1, "all"));
        assert_eq!(reports[0].pixels(), 240 * 120);
    }
}
