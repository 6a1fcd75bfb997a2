//! Watercolor of calibrated pigments: each colour a glaze over measured paper.
//!
//! Each pixel has the glaze that comes nearest to its colour after all effects (Kubelka and
//! Munk), so that granulation, dark edges and the dry brush stay. The result is a painting that
//! can be lit again. The first wash chooses the pigments.

use documents::hint::Explain;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::picture::Picture;
use paint::amount::quanta_from_mm;
use paint::document::{Document, Lighting, Medium, Slots};
use paint::ground::{ColorPrimer, Ground, GroundError, Primer};
use paint::layer::{Layer, SLOTS};
use paint::light::Light;
use paint::optics::Gloss;
use paint::separation::{
    FilmMaterials, PaintFilm, Separation, SeparationError, SeparationSettings, choose_palette,
};
use pigment::library::PigmentLibrary;
use rayon::prelude::*;
use spectra::color::Rgb;

use crate::pipeline::{FrameTextures, Wash, paint_layer};
use crate::settings::Settings;
use crate::textures::{PaperTexture, Textures};

/// Paints washes with glazes of a library's pigments.
#[derive(Debug, Clone)]
pub struct GlazePainter {
    library: PigmentLibrary,
    palette: Option<Slots>,
    paper: Vec<f64>,
    light: Light,
    lighting: Lighting,
    glazes: Option<Glazes>,
}

impl GlazePainter {
    /// Makes a painter for paper with the measured reflectance `paper` on the library's grid. We
    /// match colours under `light`. Paintings store `lighting`, which should name this light.
    #[must_use]
    pub fn new(library: PigmentLibrary, paper: Vec<f64>, light: Light, lighting: Lighting) -> Self {
        Self { library, palette: None, paper, light, lighting, glazes: None }
    }

    /// Paints with these pigments. If you do not set them, we choose up to eight pigments that come
    /// closest to the colours of the first wash.
    #[must_use]
    pub fn with_palette(self, palette: Slots) -> Self {
        Self { palette: Some(palette), glazes: None, ..self }
    }

    /// The smoothest reflectance, on the library's grid, of the paper colour in `settings`.
    ///
    /// # Errors
    /// [`GroundError`] if no surface has that colour.
    pub fn paper_of_settings(
        settings: &Settings,
        library: &PigmentLibrary,
    ) -> Result<Vec<f64>, GroundError> {
        let rgb = settings.paper.color.clone();
        Primer::Color(ColorPrimer { rgb }).reflectance(library)
    }

    /// Chooses the pigments by this wash and finds the recipes of their glazes, unless both are
    /// known. This takes seconds the first time.
    ///
    /// # Errors
    /// [`GlazeError`] if the library has no pigment to use, or the palette is empty.
    pub fn choose(&mut self, wash: &Wash) -> Result<&Glazes, GlazeError> {
        let Self { library, palette, paper, light, glazes, .. } = self;
        let found = match glazes.take() {
            Some(found) => found,
            None => {
                let slots = match palette {
                    Some(slots) => *slots,
                    None => Glazes::palette(wash, library, paper, light)?,
                };
                Glazes::new(library, &slots, paper.clone(), light)?
            }
        };
        Ok(glazes.insert(found))
    }

    /// Paints `wash` with glazes. The result is a painting of one dry layer over the paper. You
    /// pass the `textures` and `settings` for the size of the wash. The first wash chooses the
    /// pigments ([`Self::choose`]).
    ///
    /// # Errors
    /// [`GlazeError`] if the library has no pigment to use, or the palette is empty.
    ///
    /// # Panics
    /// If sizes differ.
    pub fn paint(
        &mut self,
        title: &str,
        wash: &Wash,
        textures: &Textures,
        settings: &Settings,
    ) -> Result<Document, GlazeError> {
        let lighting = self.lighting.clone();
        Ok(self.choose(wash)?.paint(title, wash, textures, settings, lighting))
    }

    /// The light that colours are matched under.
    #[must_use]
    pub fn light(&self) -> &Light {
        &self.light
    }

    /// Names of the pigments in use. This is empty before you choose them.
    #[must_use]
    pub fn pigments(&self) -> Vec<&str> {
        let slots = self.glazes.as_ref().map(|glazes| *glazes.slots()).unwrap_or_default();
        slots.iter().flatten().map(|&pigment| self.library[pigment].name.as_str()).collect()
    }
}

/// Heights of dry glazes in mm, from the lightest tint to a heavy wash.
const HEIGHTS: SeparationSettings = SeparationSettings {
    lattice: 25,
    least_mm: 0.0002,
    most_mm: 0.1,
    hides: false,
    // A wash has few colours, and effects change them by more than this table errs.
    refined: false,
};

/// Gloss of watercolor, which does not shine.
const MATT: Gloss = Gloss { strength: 0.0, exponent: 10.0 };

/// The binder of watercolor: the default medium without gloss.
fn medium() -> Medium {
    // A wash is even however thin it is.
    Medium { films_break: false, wet: MATT, dry: MATT, ..Medium::default() }
}

/// The recipes of glazes for all colours, over one paper.
#[derive(Debug, Clone)]
pub struct Glazes {
    library: PigmentLibrary,
    slots: Slots,
    paper: Vec<f64>,
    separation: Separation,
    white: [f32; 3],
    /// Linear value of the darkest grey that the glazes reach.
    black: f32,
}

impl Glazes {
    /// Finds the recipes with the pigments `slots` of `library` over paper that measures `paper`, a
    /// reflectance on the library's grid, under `light`. This takes seconds.
    ///
    /// # Errors
    /// [`GlazeError`] for an empty palette.
    ///
    /// # Panics
    /// If the paper is not on the library's grid, or a slot names no pigment of the library.
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

    /// Chooses up to eight pigments that come closest to the colours of `wash` as glazes.
    ///
    /// # Errors
    /// [`GlazeError`] if the library has no pigment to use.
    ///
    /// # Panics
    /// If the paper is not on the library's grid.
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
        let values: Vec<_> = values.map(|color| target_color(*color, white, black)).collect();
        let colors = Picture::from_values(values.len(), 1, values);
        let ground = paper;
        let scattering_per_mm = medium().scattering_per_mm;
        let materials = FilmMaterials { library, slots: &none, ground, scattering_per_mm };
        Ok(choose_palette(
            &colors,
            materials,
            |materials: FilmMaterials<'_>| PaintFilm::at_nodes(materials, &light.quadrature),
            &HEIGHTS,
        )?
        .slots)
    }

    /// The pigments in use.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// The model of the glazes' colours.
    #[must_use]
    pub fn film(&self) -> &PaintFilm {
        self.separation.film()
    }

    /// Height in mm of each slot in the glaze for an encoded sRGB colour. Colours are relative to
    /// the paper, e.g. white needs almost no paint.
    #[must_use]
    pub fn heights_mm(&self, color: [f32; 4]) -> [f32; SLOTS] {
        self.separation.heights_mm(target_color(color, self.white, self.black))
    }

    /// Paints `wash` as [`crate::paint`] does, but with glazes. The result is a painting of one dry
    /// layer over the paper. Each pixel has the recipe for its colour after all effects, over white
    /// where the brush left the paper bare. We multiply the relief of `lighting` so that it shades
    /// the paper as the settings do. You pass the `textures` and `settings` for the size of the
    /// wash.
    ///
    /// # Panics
    /// If sizes differ.
    #[must_use]
    pub fn paint(
        &self,
        title: &str,
        wash: &Wash,
        textures: &Textures,
        settings: &Settings,
        lighting: Lighting,
    ) -> Document {
        let layer = layer_on_cpu(wash, textures, settings);
        let mut color = layer.expect("the processor has no device that fails");
        color.values_mut().par_iter_mut().for_each(|color| {
            let covered = color[3];
            *color = color.map(|value| 1.0 - covered * (1.0 - value));
            color[3] = if covered > 0.0 { 1.0 } else { 0.0 };
        });
        let covered = color.values().iter().map(|color| color[3]).collect();
        let thickness = Field::from_values(color.width(), color.height(), covered);
        let Lighting { elevation_deg, ambient, relief, .. } = lighting;
        let paper = &textures.paper;
        let shaded = paper.lit_relief(settings.paper.relief, elevation_deg, ambient);
        let lighting = Lighting { relief: (relief * shaded).min(10.0), ..lighting };
        self.document(title, &color, &thickness, paper, lighting)
    }

    /// The painting of `color` in which each pixel's glaze is `thickness` times as high as in
    /// its recipe.
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
        let width = color.width();
        let height = color.height();
        assert_eq!(
            (thickness.width(), thickness.height()),
            (width, height),
            "thickness must have the size of the picture"
        );
        let cell_mm = paper.px_mm;
        let quanta = color.values().par_iter().zip(thickness.values()).with_min_len(1024);
        let quanta = quanta.map(|(&color, &times)| {
            if times <= 0.0 {
                return [0; SLOTS];
            }
            self.heights_mm(color)
                .map(|mm: f32| quanta_from_mm(f64::from(mm) * f64::from(times), cell_mm))
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
        document.push_dry(slots, layer);
        document
    }
}

/// The layer of paint of `wash` with its coverage, computed on the processor.
fn layer_on_cpu(
    wash: &Wash,
    textures: &Textures,
    settings: &Settings,
) -> Result<Field<[f32; 4]>, DeviceError> {
    let mut cpu = Compute::cpu();
    let images = wash.upload(&mut cpu)?;
    let textures = textures.clone().upload(&mut cpu)?;
    let textures = FrameTextures::from(&textures);
    let color = paint_layer(&mut cpu, images, textures, settings, &mut None)?;
    cpu.take(color)
}

fn film(library: &PigmentLibrary, slots: &Slots, paper: &[f64], light: &Light) -> PaintFilm {
    let scattering_per_mm = medium().scattering_per_mm;
    let materials = FilmMaterials { library, slots, ground: paper, scattering_per_mm };
    PaintFilm::at_nodes(materials, &light.quadrature)
}

/// Linear sRGB of an encoded colour on this paper, with black raised to what paint reaches.
fn target_color([r, g, b, _]: [f32; 4], white: [f32; 3], black: f32) -> [f32; 3] {
    let linear = Rgb([r, g, b].map(f64::from)).linear().0;
    std::array::from_fn(|i| black + (1.0 - black) * linear[i] as f32 * white[i])
}

/// Why no glazes can be found.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum GlazeError {
    /// The palette is empty, or no pigment can be used.
    #[error(transparent)]
    Separation(#[from] SeparationError),
}
