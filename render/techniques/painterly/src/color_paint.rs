//! Pigments for the colours of a painted picture: each pixel a film of the mixture that shows its
//! colour, as high as the brushwork of the map stands there.

use std::sync::Arc;

use artmap::map::ArtMap;
use documents::hint::{Explain, Fault, Hint};
use graphics::field::Field;
use graphics::picture::Picture;
use paint::document::{Lighting, Medium, Slots};
use paint::ground::{GroundError, GroundSpec};
use paint::layer::SLOTS;
use paint::light::{Light, PaintLightError};
use paint::separation::{
    FilmMaterials, PaintFilm, SeparationByHeight, SeparationError, SeparationSettings,
    choose_palette,
};
use pigment::PigmentLibrary;
use rayon::prelude::*;
use spectra::color::Rgb;

use super::paint_tones::Amounts;
use super::passes::PaintedPicture;

/// Height of a film without relief in mm (as the strokes of a painted photograph).
const PLAIN_MM: f32 = 0.12;

/// Steps of the table that decodes encoded values.
const STEPS: usize = 4096;

/// Pixels that share the work of one thread at least.
const PIXELS: usize = 1024;

/// How colours become films.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorPaintSettings {
    /// Films of at least `least_mm`, also in the furrows of the brushwork. Above `most_mm` the
    /// mixture no longer changes. Films hide what lies below them, or may let it show.
    pub films: SeparationSettings,
    /// Whether the black of the picture is raised to a tone that the pigments reach, so that
    /// differences in shadows survive.
    pub raised_black: bool,
}

impl Default for ColorPaintSettings {
    /// Films of 0.03 mm and more that hide the ground, with black raised.
    fn default() -> Self {
        let films = SeparationSettings { most_mm: 0.48, refined: false, ..Default::default() };
        Self { films, raised_black: true }
    }
}

/// Heights of films by the height of the brushwork.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmHeight {
    /// Height of the film in mm where the brushwork has its mean height.
    pub mean_mm: f32,
    /// Mean height of the brushwork in mm.
    pub brushwork_mm: f32,
}

impl FilmHeight {
    /// Films as high as the brushwork of a map; 0.12 mm for maps without relief.
    #[must_use]
    pub fn of(map: &ArtMap) -> Self {
        let heights = map.keys.iter().filter_map(|key| key.tile.height_mm.as_ref());
        let texels: Vec<&Field<f32>> = heights.collect();
        let count: usize = texels.iter().map(|heights| heights.values().len()).sum();
        if count == 0 {
            return Self { mean_mm: PLAIN_MM, brushwork_mm: 0.0 };
        }
        let all = texels.iter().flat_map(|heights| heights.values());
        let mean = (all.map(|mm| f64::from(*mm)).sum::<f64>() / count as f64) as f32;
        Self { mean_mm: mean, brushwork_mm: mean }
    }

    /// Films of another mean height; the relief stays.
    #[must_use]
    pub fn with_mean(self, mean_mm: f32) -> Self {
        Self { mean_mm, ..self }
    }
}

/// A palette that paints the colours of pictures.
#[derive(Debug, Clone)]
pub struct ColorPaint {
    library: Arc<PigmentLibrary>,
    slots: Slots,
    films: SeparationByHeight,
    least_mm: f32,
    /// Linear value of the darkest tone of the paintings.
    black: f32,
    /// Linear values of encoded ones in even steps.
    linear: Vec<f32>,
}

impl ColorPaint {
    /// Finds the mixtures of the pigments `slots` of `library` for all colours, over `ground` under
    /// the light of `lighting`. Takes seconds.
    ///
    /// # Errors
    /// [`ColorPaintError`] for a light or a ground that cannot be used with the library, an empty
    /// palette, and settings out of range.
    ///
    /// # Panics
    /// If a slot refers to a pigment that the library lacks.
    pub fn new(
        library: Arc<PigmentLibrary>,
        slots: Slots,
        (ground, lighting): (&GroundSpec, &Lighting),
        settings: &ColorPaintSettings,
    ) -> Result<Self, ColorPaintError> {
        let light = Light::named(&library, &lighting.illuminant, &lighting.observer)?;
        let ground = ground.reflectance(&library)?;
        let scattering_per_mm = Medium::of(&library).scattering_per_mm;
        let materials =
            FilmMaterials { library: &library, slots: &slots, ground: &ground, scattering_per_mm };
        let film = PaintFilm::at_nodes(materials, &light.quadrature);
        let films = SeparationByHeight::new(film, &settings.films)?;
        let black = if settings.raised_black { films.black() } else { 0.0 };
        let least_mm = settings.films.least_mm as f32;
        Ok(Self { library, slots, films, least_mm, black, linear: linear_values() })
    }

    /// Up to eight pigments of `library` that come nearest to the colours of a painted picture.
    /// Takes seconds.
    ///
    /// # Errors
    /// Those of [`Self::new`]; [`SeparationError::NoPigment`] if the library has no pigment to use.
    pub fn palette(
        painted: &PaintedPicture,
        library: &PigmentLibrary,
        (ground, lighting): (&GroundSpec, &Lighting),
        settings: &ColorPaintSettings,
    ) -> Result<Slots, ColorPaintError> {
        let light = Light::named(library, &lighting.illuminant, &lighting.observer)?;
        let ground = ground.reflectance(library)?;
        let black = if settings.raised_black { library.saunderson.floor() as f32 } else { 0.0 };
        let table = linear_values();
        let covered = painted.color.values().iter().filter(|color| color[3] > 0.0);
        let colors: Vec<_> = covered.map(|color| target(&table, black, *color)).collect();
        let colors = Picture::from_values(colors.len(), 1, colors);
        let materials = FilmMaterials {
            library,
            slots: &Slots::default(),
            ground: &ground,
            scattering_per_mm: Medium::of(library).scattering_per_mm,
        };
        Ok(choose_palette(
            &colors,
            materials,
            |materials: FilmMaterials<'_>| PaintFilm::at_nodes(materials, &light.quadrature),
            &settings.films,
        )?
        .slots)
    }

    /// Library of the pigments.
    #[must_use]
    pub fn library(&self) -> &Arc<PigmentLibrary> {
        &self.library
    }

    /// Pigments of the paint by slot.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// The mixtures by colour and height.
    #[must_use]
    pub fn films(&self) -> &SeparationByHeight {
        &self.films
    }

    /// Linear sRGB that is painted for an encoded colour: the colour itself, or with black raised.
    #[must_use]
    pub fn target(&self, color: [f32; 4]) -> [f32; 3] {
        target(&self.linear, self.black, color)
    }

    /// Paint of each pixel: the mixture of its colour, as high as the film of its brushwork. Where
    /// strokes cover a pixel in part, its paint is thinner by as much.
    ///
    /// # Panics
    /// If the colours and heights of `painted` differ in size.
    #[must_use]
    pub fn amounts(&self, painted: &PaintedPicture, film: FilmHeight) -> Field<Amounts> {
        let PaintedPicture { color, height_mm } = painted;
        assert_eq!(color.bounds(), height_mm.bounds(), "colours and heights differ in size");
        let pixels = color.values().par_iter().zip(height_mm.values()).with_min_len(PIXELS);
        let paint = |(&color, &height_mm): (&[f32; 4], &f32)| {
            let cover = color[3];
            let mut amounts = [0.0; SLOTS + 1];
            if cover > 0.0 {
                // Heights of pixels that are covered in part are lower by as much.
                let brushwork_mm = height_mm / cover;
                let film_mm = film.mean_mm + brushwork_mm - film.brushwork_mm;
                let film_mm = film_mm.max(self.least_mm);
                let heights = self.films.heights_mm(self.target(color), film_mm);
                amounts.iter_mut().zip(heights).for_each(|(own, mm)| *own = cover * mm);
            }
            amounts
        };
        Field::from_values(color.width(), color.height(), pixels.map(paint).collect())
    }
}

/// Linear values of encoded ones from 0 to 1, and one more.
fn linear_values() -> Vec<f32> {
    (0..=STEPS + 1)
        .map(|step: usize| {
            let value = step.min(STEPS) as f64 / STEPS as f64;
            Rgb([value; 3]).linear().0[0] as f32
        })
        .collect()
}

/// Linear sRGB of an encoded colour, black raised to `black`.
fn target(table: &[f32], black: f32, [r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b].map(|value| {
        let place = value.clamp(0.0, 1.0) * STEPS as f32;
        let step = place as usize;
        let rest = place.fract();
        let linear = table[step] + rest * (table[step + 1] - table[step]);
        black + (1.0 - black) * linear
    })
}

/// The colours of a picture cannot be painted.
#[derive(Debug, thiserror::Error)]
pub enum ColorPaintError {
    /// The light cannot be used with the library.
    #[error(transparent)]
    Light(#[from] PaintLightError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The pigments give no mixtures.
    #[error(transparent)]
    Separation(#[from] SeparationError),
}

impl ColorPaintError {
    fn cause(&self) -> &dyn Explain {
        match self {
            Self::Light(error) => error,
            Self::Ground(error) => error,
            Self::Separation(error) => error,
        }
    }
}

impl Explain for ColorPaintError {
    fn hint(&self) -> Option<Hint> {
        self.cause().hint()
    }

    fn fault(&self) -> Fault {
        self.cause().fault()
    }
}

#[cfg(test)]
mod tests;
