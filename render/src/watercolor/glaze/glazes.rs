//! Recipes of glazes, and the painting that they make.

use pigment::library::PigmentLibrary;
use rayon::prelude::*;
use spectra::color::Rgb;
use spectra::hint::Explain;

use super::thickness::thickness;
use crate::watercolor::textures::PaperTexture;
use crate::watercolor::{Settings, Textures, Wash, Wobble};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::image::OnCpu;
use graphics::picture::Picture;
use paint::amount::quanta_from_mm;
use paint::document::{Document, DryLayer, Lighting, Medium, Slots};
use paint::ground::Ground;
use paint::layer::{Layer, SLOTS};
use paint::light::Light;
use paint::optics::Gloss;
use paint::separation::{
    FilmMaterials, PaintFilm, Separation, SeparationError, SeparationSettings, choose_palette,
};

/// Glazes run from next to nothing, which is the lightest, to what a heavy wash
/// leaves when dry.
const HEIGHTS: SeparationSettings = SeparationSettings {
    lattice: 25,
    least_mm: 0.0002,
    most_mm: 0.1,
    hides: false,
    // A wash has few colours, and its effects are larger than what a table is off.
    refined: false,
};

/// Watercolor has no shine.
const MATT: Gloss = Gloss { strength: 0.0, exponent: 10.0 };

/// The binder of watercolor: heights as of the library, and no shine.
fn medium() -> Medium {
    Medium { wet: MATT, dry: MATT, ..Medium::default() }
}

/// Recipes of glazes over one paper.
#[derive(Debug, Clone)]
pub struct Glazes {
    library: PigmentLibrary,
    slots: Slots,
    paper: Vec<f64>,
    separation: Separation,
    /// Linear sRGB of the bare paper.
    white: [f32; 3],
    black: f32,
}

impl Glazes {
    /// Those of `slots` of `library` over paper that measures `paper`, a reflectance on
    /// the library's grid, under `light`. Takes seconds.
    ///
    /// # Errors
    /// [`GlazeError`] for an empty palette.
    ///
    /// # Panics
    /// If the paper does not stand on the library's grid, or a slot names no pigment of
    /// it.
    pub fn new(
        library: &PigmentLibrary,
        slots: &Slots,
        paper: Vec<f64>,
        light: &Light,
    ) -> Result<Self, GlazeError> {
        let film = film(library, slots, &paper, light);
        let white = film.rgb(&[0.0; SLOTS]);
        let separation = Separation::new(film, &HEIGHTS)?;
        let black = separation.black();
        Ok(Self { library: library.clone(), slots: *slots, paper, separation, white, black })
    }

    /// Up to eight pigments that come nearest to the colours of `wash` as glazes.
    ///
    /// # Errors
    /// [`GlazeError`] if the library has no pigment to use.
    ///
    /// # Panics
    /// As [`Glazes::new`].
    pub fn palette(
        wash: &Wash,
        library: &PigmentLibrary,
        paper: &[f64],
        light: &Light,
    ) -> Result<Slots, GlazeError> {
        let none = Slots::default();
        let white = film(library, &none, paper, light).rgb(&[0.0; SLOTS]);
        let black = library.saunderson.floor() as f32;
        let values = wash.color.values().iter().filter(|color| color[3] > 0.0);
        let values: Vec<_> = values.map(|color| wanted(*color, white, black)).collect();
        let colors = Picture::from_values(values.len(), 1, values);
        let ground = paper;
        let scattering_per_mm = medium().scattering_per_mm;
        let materials = FilmMaterials { library, slots: &none, ground, scattering_per_mm };
        let film = |materials: FilmMaterials<'_>| PaintFilm::at_nodes(materials, &light.quadrature);
        Ok(choose_palette(&colors, materials, film, &HEIGHTS)?.slots)
    }

    /// Its pigments.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// The colours of its films.
    #[must_use]
    pub fn film(&self) -> &PaintFilm {
        self.separation.film()
    }

    /// Heights in mm by slot of the glaze for an encoded sRGB colour, which is seen
    /// relative to the paper: white is next to no paint.
    #[must_use]
    pub fn heights_mm(&self, color: [f32; 4]) -> [f32; SLOTS] {
        self.separation.heights_mm(wanted(color, self.white, self.black))
    }

    /// Paints `wash` as [`crate::watercolor::paint`] does, but with glazes: a painting
    /// of one dry layer over the paper. Settings are those for its size.
    ///
    /// # Errors
    /// Never with the processor.
    ///
    /// # Panics
    /// If sizes differ.
    pub fn painted(
        &self,
        title: &str,
        wash: &Wash,
        textures: &Textures,
        settings: &Settings,
        lighting: Lighting,
    ) -> Result<Document, DeviceError> {
        let heights = &textures.paper.heights;
        let displaced = textures.paper.per_slope(settings.wobble.amount_px);
        let color = OnCpu.wobbled(wash.color.clone(), heights, displaced)?;
        let thickness = thickness(&color, &wash.controls, textures, settings)?;
        Ok(self.document(title, &color, &thickness, &textures.paper, lighting))
    }

    /// The painting of `color`, the glaze of each pixel `thickness` times as high as its
    /// recipe wants.
    ///
    /// # Panics
    /// If sizes differ.
    #[must_use]
    pub fn document(
        &self,
        title: &str,
        color: &Field<[f32; 4]>,
        thickness: &Field<f32>,
        paper: &PaperTexture,
        lighting: Lighting,
    ) -> Document {
        let (width, height) = (color.width(), color.height());
        assert_eq!((thickness.width(), thickness.height()), (width, height), "a thickness each");
        let cell_mm = paper.px_mm;
        let quanta = color.values().par_iter().zip(thickness.values()).with_min_len(1024);
        let quanta = quanta.map(|(&color, &times)| {
            if times <= 0.0 {
                return [0; SLOTS];
            }
            let height = |mm: f32| quanta_from_mm(f64::from(mm) * f64::from(times), cell_mm);
            self.heights_mm(color).map(height)
        });
        let mut layer = Layer::empty(width, height);
        layer.pigments = Field::from_values(width, height, quanta.collect());
        let ground = Ground {
            name: "watercolour paper".to_owned(),
            height: paper.quanta(),
            reflectance: self.paper.clone(),
            gloss: MATT,
        };
        let library = self.library.clone();
        let slots = self.slots;
        let mut document =
            Document::bare(title, cell_mm, ground, library, medium(), slots, lighting);
        document.dry.push(DryLayer { slots, opacity: 1.0, paint: layer });
        document
    }
}

fn film(library: &PigmentLibrary, slots: &Slots, paper: &[f64], light: &Light) -> PaintFilm {
    let scattering_per_mm = medium().scattering_per_mm;
    let materials = FilmMaterials { library, slots, ground: paper, scattering_per_mm };
    PaintFilm::at_nodes(materials, &light.quadrature)
}

/// Linear sRGB that a colour has on this paper, its black raised to what paint
/// reaches.
fn wanted([r, g, b, _]: [f32; 4], white: [f32; 3], black: f32) -> [f32; 3] {
    let linear = Rgb([r, g, b].map(f64::from)).linear().0;
    std::array::from_fn(|i| black + (1.0 - black) * linear[i] as f32 * white[i])
}

/// Why there are no glazes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GlazeError {
    /// No palette.
    #[error(transparent)]
    Separation(#[from] SeparationError),
}

impl GlazeError {
    /// What to try.
    #[must_use]
    pub fn hint(&self) -> String {
        let Self::Separation(error) = self;
        error.hint().map(|hint| hint.to_string()).unwrap_or_default()
    }
}
