//! Pictures of paintings of volumes, fast enough for the frames of an animation.

use graphics::field::Field;
use paint::composite::composite_row;
use paint::document::{Lighting, Slots};
use paint::ground::Ground;
use paint::layer::{FilmRow, SLOTS};
use paint::light::Light;
use paint::optics::{Gloss, NODES, Scene};
use paint::scene::{Appearance, picture, scene};
use paint::shade::color_row;
use rayon::prelude::*;

use super::drawing::Drawing;
use super::materials::FilmPaintError;
use super::painter::{Coat, FilmPainter};

/// We composite this many neighbouring cells of a coat together, unless all of them are bare.
const RUN: usize = 16;

/// The paint of a painter under one light.
#[derive(Debug, Clone)]
pub struct FilmView {
    light: Light,
    lighting: Lighting,
    coats: Vec<Coat>,
    scene: Scene,
    greys: Vec<[f32; NODES]>,
}

impl FilmView {
    /// The paint of `painter` under the light of `lighting`. This takes a good part of a second,
    /// unless the painter matches colours under the same light.
    ///
    /// # Errors
    /// [`FilmPaintError::Light`] for a light that cannot be used with the library.
    pub fn new(painter: &FilmPainter, lighting: &Lighting) -> Result<Self, FilmPaintError> {
        let material = painter.material();
        let library = &material.library;
        let Lighting { illuminant, observer, .. } = lighting;
        let own = &material.lighting;
        let light = match (illuminant, observer) == (&own.illuminant, &own.observer) {
            true => material.light().clone(),
            false => Light::named(library, illuminant, observer)?,
        };
        let coats = painter.coats();
        let dry: Vec<(Slots, f64)> =
            coats.iter().map(|&coat| (painter.slots_of(coat), 1.0)).collect();
        // Only reflectance and gloss of the ground matter to the light.
        let ground = Ground {
            name: String::new(),
            height: Field::filled(0, 0, 0),
            reflectance: material.reflectance.clone(),
            gloss: material.ground.gloss.unwrap_or(Gloss { strength: 0.0, exponent: 10.0 }),
        };
        let appearance = Appearance {
            library,
            medium: &material.medium,
            ground: &ground,
            cell_mm: painter.settings().cell_mm,
            dry: &dry,
            slots: painter.slots(),
            lighting,
        };
        let scene = appearance.scene(&light);
        let mut greys = vec![scene.ground; painter.greys().len()];
        if coats.first() == Some(&Coat::Grisaille) {
            composite_row(&scene.dry[0], even(painter.greys()), None, &mut greys);
        }
        Ok(Self { light, lighting: lighting.clone(), coats, scene, greys })
    }

    /// The painting of `drawing` as a picture in linear sRGB with white at 1 and the fourth value
    /// at 1. The painter of this view paints it. You get the same picture as from
    /// [`FilmPainter::document`] under this light. Without relief ([`Lighting::relief`] 0) we do
    /// not need this document, so the picture is fast enough for an animation.
    ///
    /// # Errors
    /// [`FilmPaintError::Ground`] if relief is shown and the ground cannot be made at this size.
    ///
    /// # Panics
    /// If the fields of `drawing` differ in size.
    pub fn picture(
        &self,
        painter: &FilmPainter,
        drawing: &Drawing<'_>,
    ) -> Result<Field<[f32; 4]>, FilmPaintError> {
        if self.lighting.relief != 0.0 {
            let mut document = painter.document("", drawing)?;
            document.lighting = self.lighting.clone();
            return Ok(picture(&document, &scene(&document, &self.light)));
        }
        let (width, height) = drawing.size();
        let mut out = Field::filled(width, height, [0.0; 4]);
        if width > 0 {
            let rows = out.values_mut().par_chunks_mut(width).enumerate();
            rows.for_each_init(
                || (vec![[0.0; NODES]; width], vec![[0; SLOTS]; width]),
                |(internal, amounts), (y, out)| {
                    self.lay_row(painter, drawing, y, (internal, amounts));
                    color_row(&self.scene, internal, out);
                },
            );
        }
        Ok(out)
    }

    fn lay_row(
        &self,
        painter: &FilmPainter,
        drawing: &Drawing<'_>,
        y: usize,
        (internal, amounts): (&mut [[f32; NODES]], &mut [[u32; SLOTS]]),
    ) {
        internal.fill(self.scene.ground);
        for (&coat, optics) in self.coats.iter().zip(&self.scene.dry) {
            let mut all_whole = coat == Coat::Grisaille;
            if coat == Coat::Grisaille {
                let cells = internal.iter_mut().zip(painter.whole_greys(drawing, y));
                for (internal, level) in cells {
                    match level {
                        Some(level) => *internal = self.greys[level],
                        None => all_whole = false,
                    }
                }
            }
            if all_whole {
                continue;
            }
            painter.row(coat, drawing, y, amounts);
            if coat == Coat::Grisaille {
                // The whole films are there already.
                let cells = amounts.iter_mut().zip(painter.whole_greys(drawing, y));
                cells.filter(|(_, level)| level.is_some()).for_each(|(cell, _)| *cell = [0; SLOTS]);
            }
            for (amounts, internal) in amounts.chunks(RUN).zip(internal.chunks_mut(RUN)) {
                composite_row(optics, even(amounts), None, internal);
            }
        }
    }
}

/// A row of films without vehicle.
fn even(pigments: &[[u32; SLOTS]]) -> FilmRow<'_> {
    FilmRow { pigments, vehicle: &[] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pigments::{
        FilmHeights, FilmMaterial, FilmPainterSettings, InsidePaint, UnderPainting,
    };
    use documents::hint::Explain;
    use paint::amount::{mm_from_quanta, quanta_from_mm};
    use paint::document::{Document, palette_slots};
    use paint::engine::PaintEngine;
    use paint::ground::GroundKind;
    use paint::layer::LayerRef;
    use paint::painting::Painting;
    use paint::scene::SpectralDocument;
    use paint::separation::SeparationSettings;
    use pigment::{Backing, FilmOver, PigmentLibrary};
    use spectra::color::{Lab, Rgb, RgbSpace, delta_e_ciede2000};
    use spectra::{Reflectance, Spectrum};
    use std::sync::{Arc, LazyLock};

    const SIZE: (usize, usize) = (75, 40);

    const PIGMENTS: [&str; 5] =
        ["Ultramarine", "Chrome Yellow", "Vermilion", "Lead White", "Viridian"];

    fn level_light() -> Lighting {
        Lighting { relief: 0.0, ..Lighting::default() }
    }

    fn slots(names: [&str; 5]) -> Slots {
        palette_slots(&names.map(str::to_owned), &PigmentLibrary::van_gogh_oils()).unwrap()
    }

    fn painter(under: UnderPainting, inside: InsidePaint) -> FilmPainter {
        static MATERIAL: LazyLock<FilmMaterial> = LazyLock::new(|| {
            let library = Arc::new(PigmentLibrary::van_gogh_oils());
            FilmMaterial::new(library, GroundKind::Panel.spec(1), level_light()).unwrap()
        });
        let mut settings = FilmPainterSettings { under, inside, ..Default::default() };
        settings.films.lattice = 9;
        FilmPainter::new(MATERIAL.clone(), slots(PIGMENTS), None, settings).unwrap()
    }

    static GLAZES: LazyLock<FilmPainter> =
        LazyLock::new(|| painter(UnderPainting::Grisaille, InsidePaint::Glaze));

    static BOTH: LazyLock<FilmPainter> =
        LazyLock::new(|| painter(UnderPainting::Grisaille, InsidePaint::Both));

    struct Made {
        color: Field<[f32; 4]>,
        cover: Field<f32>,
        ink: Field<f32>,
        tint: Field<f32>,
        films: Field<FilmHeights>,
    }

    impl Made {
        fn new() -> Self {
            let (width, height) = SIZE;
            let field = |value: &dyn Fn(f32, f32) -> f32| {
                let values = (0..width * height).map(|at| {
                    value((at % width) as f32 / width as f32, (at / width) as f32 / height as f32)
                });
                Field::from_values(width, height, values.collect())
            };
            let grey = field(&|u, v| (u * 1.1 - 0.05) * (0.7 + 0.3 * v));
            let color =
                grey.values().iter().map(|&g| [g, 0.6 * g + 0.1, 0.9 - 0.8 * g, g]).collect();
            let cover = field(&|u, v| (8.0 * u * (1.0 - u) + v).min(1.0));
            let ink = field(&|u, v| if (40.0 * (u + v)).sin() > 0.3 { 0.8 * v } else { 0.0 });
            let tint = field(&|u, v| (1.5 - 4.0 * (u - 0.5).hypot(v - 0.5)).clamp(0.0, 1.0));
            let films = tint.values().iter().enumerate().map(|(at, &tint)| {
                let parts = [0.02, 0.011, 0.004]
                    .map(|mm: f32| quanta_from_mm(f64::from(mm * tint), 0.2) as i32);
                let mut heights = FilmHeights::default();
                heights.0[at % 5] = parts[0];
                heights.0[(at / 7) % 5] += parts[1];
                heights.0[8] = parts[2];
                heights
            });
            let films = Field::from_values(width, height, films.collect());
            Self { color: Field::from_values(width, height, color), cover, ink, tint, films }
        }

        fn drawing(&self) -> Drawing<'_> {
            let Self { color, cover, ink, tint, films } = self;
            let cover = Some(cover);
            let ink = Some(ink);
            let tint = Some(tint);
            let films = Some(films);
            Drawing { color, cover, ink, tint, films }
        }
    }

    fn shown(document: &Document) -> Field<[f32; 4]> {
        let Lighting { illuminant, observer, .. } = &document.lighting;
        if (illuminant.as_str(), observer.as_str()) == ("D65", "1931-2") {
            return picture(document, &scene(document, GLAZES.material().light()));
        }
        let light = Light::named(&document.library, illuminant, observer).unwrap();
        picture(document, &scene(document, &light))
    }

    fn most_apart(a: &Field<[f32; 4]>, b: &Field<[f32; 4]>) -> f32 {
        assert_eq!(a.bounds(), b.bounds());
        let pairs = a.values().iter().flatten().zip(b.values().iter().flatten());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    }

    fn lab(rgb: [f32; 4]) -> Lab {
        let xyz = RgbSpace::Srgb.xyz_from_linear().apply([rgb[0], rgb[1], rgb[2]].map(f64::from));
        Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white())
    }

    #[test]
    fn pictures_are_those_of_the_painting_also_after_its_file() {
        let made = Made::new();
        for painter in [&*GLAZES, &*BOTH] {
            let view = FilmView::new(painter, &level_light()).unwrap();
            let frame = view.picture(painter, &made.drawing()).unwrap();
            let document = painter.document("Test", &made.drawing()).unwrap();
            assert_eq!(most_apart(&frame, &shown(&document)), 0.0);
            let bytes = paint::file::write(&document).unwrap();
            let read = paint::file::read("test.exr", &bytes).unwrap();
            assert!(most_apart(&frame, &shown(&read)) <= 0.0002);
            let differs = frame.values().windows(2).filter(|pair| pair[0] != pair[1]).count();
            assert!(differs > 1000, "{differs}");
        }
    }

    #[test]
    fn a_painting_relit_is_the_picture_under_that_light() {
        let made = Made::new();
        let lamp = Lighting { illuminant: "A".to_owned(), adaptation: 0.5, ..level_light() };
        let bytes = paint::file::write(&GLAZES.document("", &made.drawing()).unwrap()).unwrap();
        let mut read = paint::file::read("test.exr", &bytes).unwrap();
        let by_day = shown(&read);
        read.lighting = lamp.clone();
        let relit = shown(&read);
        let view = FilmView::new(&GLAZES, &lamp).unwrap();
        let rendered = view.picture(&GLAZES, &made.drawing()).unwrap();
        assert!(most_apart(&relit, &rendered) <= 0.0002);
        assert!(most_apart(&relit, &by_day) > 0.1);
    }

    #[test]
    fn a_swapped_pigment_is_the_picture_poured_with_the_other() {
        let made = Made::new();
        let document = GLAZES.document("", &made.drawing()).unwrap();
        let [blue, other] =
            ["Ultramarine", "Prussian Blue"].map(|name| document.library.find(name).unwrap());
        let films = document.dry.len() - 1;
        let engine = PaintEngine::on_cpu(document.ground.height.clone());
        let mut painting = Painting::open(document, engine, 1 << 20).unwrap();
        let before = painting.picture().unwrap();
        painting.swap_pigment(LayerRef::Dry(films), blue, other).unwrap();
        let swapped = painting.picture().unwrap();
        let poured = GLAZES.clone().with_slots(slots([
            "Prussian Blue",
            "Chrome Yellow",
            "Vermilion",
            "Lead White",
            "Viridian",
        ]));
        let view = FilmView::new(&poured, &level_light()).unwrap();
        let poured = view.picture(&poured, &made.drawing()).unwrap();
        assert!(most_apart(&swapped, &poured) <= 1e-6, "{}", most_apart(&swapped, &poured));
        assert!(most_apart(&swapped, &before) > 0.02);
    }

    /// The films of two volumes on one cell: equal amounts of the first two pigments of a painter.
    fn laid_by_two(half_mm: f64) -> Field<FilmHeights> {
        let mut sum = FilmHeights::default();
        for slot in [0, 1] {
            let mut one = FilmHeights::default();
            one.0[slot] = quanta_from_mm(half_mm, 0.2) as i32;
            sum.add(&one, 1);
        }
        Field::filled(1, 1, sum)
    }

    #[test]
    fn blue_and_yellow_that_overlap_have_the_colour_of_their_mixture() {
        let bare = painter(UnderPainting::None, InsidePaint::Glaze);
        let FilmMaterial { library, reflectance, medium, .. } = bare.material();
        let viewing = &bare.material().light().viewing;
        let color = Field::filled(1, 1, [0.5; 4]);
        let none = Drawing { color: &color, cover: None, ink: None, tint: None, films: None };
        // We compute pictures at eight wavelengths. Their error differs from mixture to mixture.
        for (blue, in_picture) in
            [("Prussian Blue", 0.2), ("Ultramarine", 0.2), ("Cobalt Blue", 0.85)]
        {
            let names = [blue, "Chrome Yellow"].map(str::to_owned);
            let painter = bare.clone().with_slots(palette_slots(&names, library).unwrap());
            let view = FilmView::new(&painter, &level_light()).unwrap();
            for half_mm in [0.001, 0.004, 0.02] {
                let films = laid_by_two(half_mm);
                let drawing = Drawing { films: Some(&films), ..none };
                let laid_mm = mm_from_quanta(films.values()[0].0[0] as u32, 0.2);
                let ground =
                    Spectrum::<Reflectance>::new(library.grid, reflectance.clone()).unwrap();
                let film = FilmOver {
                    thickness: 2.0 * laid_mm * medium.scattering_per_mm,
                    ground: Backing::Measured(ground),
                };
                let parts = [(blue, 1.0), ("Chrome Yellow", 1.0)];
                let mixed = library.film_color(parts, &film, viewing).unwrap();
                let document = painter.document("", &drawing).unwrap();
                let spectrum = SpectralDocument::full(&document).measured_reflectance(0, 0);
                let weights = viewing.weights(library.grid).unwrap();
                let of_spectrum = Lab::from_xyz(weights.xyz(&spectrum), weights.white());
                let off = delta_e_ciede2000(of_spectrum, mixed.lab);
                assert!(off <= 0.001, "{blue}, {half_mm} mm: {off}");
                let linear = mixed.srgb.linear().0.map(|value| value as f32);
                let wanted = lab([linear[0], linear[1], linear[2], 1.0]);
                let seen = view.picture(&painter, &drawing).unwrap();
                let off = delta_e_ciede2000(lab(seen.values()[0]), wanted);
                assert!(off <= in_picture, "{blue}, {half_mm} mm: {off}");
                // Neither of the two lies over the other.
                let alone = view.picture(&painter, &none).unwrap();
                assert!(delta_e_ciede2000(lab(alone.values()[0]), wanted) > 5.0);
            }
        }
    }

    fn greys(painter: &FilmPainter) -> Vec<Lab> {
        let view = FilmView::new(painter, &level_light()).unwrap();
        let greys = (0..=100).map(|step| [0.0, 0.0, 0.0, step as f32 / 100.0]).collect();
        let color = Field::from_values(101, 1, greys);
        let drawing = Drawing { color: &color, cover: None, ink: None, tint: None, films: None };
        let seen = view.picture(painter, &drawing).unwrap();
        seen.values().iter().map(|&rgb| lab(rgb)).collect()
    }

    #[test]
    fn the_grisaille_has_the_greys_of_the_drawing() {
        let labs = greys(&GLAZES);
        for (step, pair) in labs.windows(2).enumerate() {
            assert!(pair[1].lightness > pair[0].lightness - 0.01, "{step}: {pair:?}");
            assert!(pair[0].a.hypot(pair[0].b) < 8.0, "{step}: {pair:?}");
        }
        assert!(labs[0].lightness < 25.0 && labs[100].lightness > 92.0, "{labs:?}");
        let grey = Rgb([0.5; 3]).linear().0[0] as f32;
        let middle = lab([grey, grey, grey, 1.0]).lightness;
        assert!((labs[50].lightness - middle).abs() < 4.0, "{:?} for {middle}", labs[50]);
    }

    #[test]
    fn a_third_paint_makes_the_greys_neutral() {
        let settings = FilmPainterSettings { neutral: true, ..GLAZES.settings().clone() };
        let material = GLAZES.material().clone();
        let painter = FilmPainter::new(material, *GLAZES.slots(), None, settings).unwrap();
        fn mean(labs: &[Lab]) -> f64 {
            labs.iter().map(|lab| lab.a.hypot(lab.b)).sum::<f64>() / 101.0
        }
        let [two, three] = [&*GLAZES, &painter].map(|painter| mean(&greys(painter)));
        assert!(three < 1.5 && three < 0.5 * two, "{two} {three}");
        let slots = painter.document("", &Made::new().drawing()).unwrap().dry[0].slots;
        assert_eq!(slots.iter().flatten().count(), 3);
    }

    #[test]
    fn ink_darkens_evenly_to_the_grey_of_the_pencil() {
        let painter = painter(UnderPainting::None, InsidePaint::Glaze);
        let view = FilmView::new(&painter, &level_light()).unwrap();
        let color = Field::filled(101, 1, [0.5; 4]);
        let ink = Field::from_values(101, 1, (0..=100).map(|step| step as f32 / 100.0).collect());
        let none = Drawing { color: &color, cover: None, ink: None, tint: None, films: None };
        let seen = view.picture(&painter, &Drawing { ink: Some(&ink), ..none }).unwrap();
        let luminances: Vec<f32> = seen
            .values()
            .iter()
            .map(|&[r, g, b, _]: &[f32; 4]| 0.2126 * r + 0.7152 * g + 0.0722 * b)
            .collect();
        for (at, luminance) in luminances.iter().enumerate() {
            let value = f64::from(luminance / luminances[0]);
            let encoded = Rgb([value; 3]).encoded().0[0] as f32;
            let wanted = 1.0 - 0.85 * at as f32 / 100.0;
            // Black paint does not reach the darkest tones.
            if wanted > 0.3 {
                assert!((encoded - wanted).abs() < 0.012, "{at}: {encoded}");
            }
            assert!(at < 100 || encoded < 0.28, "{encoded}");
        }
    }

    #[test]
    fn volumes_show_own_colours_glazes_or_both() {
        let made = Made::new();
        let at = SIZE.0 * 20 + 37;
        let of = |painter: &FilmPainter| painter.document("", &made.drawing()).unwrap();
        let glazes = of(&GLAZES);
        let both = of(&BOTH);
        let own = of(&painter(UnderPainting::Grisaille, InsidePaint::OwnColors));
        let counts = [&glazes, &both, &own].map(|document| document.dry.len());
        assert_eq!(counts, [3, 4, 3]);
        let volume =
            |document: &Document, layer: usize, at| document.dry[layer].paint.cell(at).volume();
        // Wholly inside, own colours replace the grisaille.
        assert!(made.tint.values()[at] == 1.0 && made.cover.values()[at] == 1.0);
        assert_eq!([volume(&both, 0, at), volume(&own, 0, at)], [0, 0]);
        assert!(volume(&glazes, 0, at) > 0 && volume(&both, 1, at) > 0);
        assert_eq!(both.dry[1].paint.cell(at), own.dry[1].paint.cell(at));
        // Outside nothing changes.
        assert_eq!(made.tint.values()[0], 0.0);
        assert_eq!(volume(&both, 1, 0), 0);
        assert_eq!(both.dry[0].paint.cell(0), glazes.dry[0].paint.cell(0));
        // The film is the paint of the volumes to the quantum.
        let wanted = FilmHeights::layer(&made.films);
        assert_eq!(glazes.dry[2].paint, wanted);
        assert_eq!(both.dry[3].paint, wanted);
        assert!(wanted.totals()[8] > 0);
        assert_eq!(glazes.dry[2].slots, slots(PIGMENTS));
    }

    #[test]
    fn own_colours_under_everything_are_near_those_of_the_scene() {
        let made = Made::new();
        let painter = painter(UnderPainting::OwnColors, InsidePaint::Glaze);
        let view = FilmView::new(&painter, &level_light()).unwrap();
        let plain = Drawing { color: &made.color, cover: None, ink: None, tint: None, films: None };
        let seen = view.picture(&painter, &plain).unwrap();
        let document = painter.document("", &plain).unwrap();
        assert_eq!(most_apart(&seen, &shown(&document)), 0.0);
        let pairs = seen.values().iter().zip(made.color.values());
        let off = pairs.map(|(&seen, color)| {
            let linear = Rgb([color[0], color[1], color[2]].map(f64::from)).linear().0;
            let [r, g, b] = linear.map(|value| value.clamp(0.0, 1.0) as f32);
            delta_e_ciede2000(lab(seen), lab([r, g, b, 1.0]))
        });
        let mean = off.sum::<f64>() / seen.values().len() as f64;
        // The palette has no black, and the table of this test is coarse.
        assert!(mean < 8.0, "{mean}");
    }

    #[test]
    fn relief_is_that_of_the_painting() {
        let made = Made::new();
        let raised = Lighting { relief: 1.0, ..level_light() };
        let view = FilmView::new(&GLAZES, &raised).unwrap();
        let seen = view.picture(&GLAZES, &made.drawing()).unwrap();
        let mut document = GLAZES.document("", &made.drawing()).unwrap();
        document.lighting = raised;
        assert_eq!(most_apart(&seen, &shown(&document)), 0.0);
        let flat = FilmView::new(&GLAZES, &level_light()).unwrap();
        assert!(most_apart(&seen, &flat.picture(&GLAZES, &made.drawing()).unwrap()) > 0.001);
    }

    #[test]
    fn libraries_and_palettes_that_cannot_paint_are_refused() {
        let material = GLAZES.material();
        let settings =
            FilmPainterSettings { under: UnderPainting::OwnColors, ..Default::default() };
        let none = Slots::default();
        let error = FilmPainter::new(material.clone(), none, None, settings.clone()).unwrap_err();
        assert!(error.hint().is_some() && error.to_string().contains("at least one pigment"));
        let wrong = FilmPainterSettings {
            films: SeparationSettings { least_mm: -1.0, ..settings.films },
            ..settings
        };
        let error = FilmPainter::new(material.clone(), *GLAZES.slots(), None, wrong).unwrap_err();
        assert!(matches!(error, FilmPaintError::Separation(_)), "{error}");
        let mut one = PigmentLibrary::van_gogh_oils();
        one.pigments.truncate(1);
        one.reference = None;
        let ground = material.ground.clone();
        let made = FilmMaterial::new(Arc::new(one), ground.clone(), level_light());
        let error = made.unwrap().white_and_black().unwrap_err();
        assert!(matches!(error, FilmPaintError::NoWhite) && error.hint().is_some(), "{error}");
        let lamp = Lighting { illuminant: "candle".to_owned(), ..level_light() };
        let library = material.library.clone();
        let error = FilmMaterial::new(library, ground, lamp).unwrap_err();
        assert!(matches!(error, FilmPaintError::Light(_)), "{error}");
    }

    #[test]
    fn edges_and_hostile_values_are_painted() {
        let view = FilmView::new(&BOTH, &level_light()).unwrap();
        for (width, height) in [(0, 0), (1, 1), (8, 8), (67, 33)] {
            let color = Field::filled(width, height, [f32::NAN, 2.0, -1.0, f32::NAN]);
            let odd = Field::filled(width, height, f32::NAN);
            let films =
                Field::filled(width, height, FilmHeights([i32::MAX, -1, 0, 0, 0, 0, 0, 0, 3]));
            let cover = None;
            let ink = Some(&odd);
            let tint = Some(&odd);
            let films = Some(&films);
            let drawing = Drawing { color: &color, cover, ink, tint, films };
            let seen = view.picture(&BOTH, &drawing).unwrap();
            assert_eq!((seen.width(), seen.height()), (width, height));
            assert!(seen.values().iter().flatten().all(|value| value.is_finite()));
        }
    }
}
