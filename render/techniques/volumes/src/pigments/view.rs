//! Pictures of paintings of volumes at the speed of frames.

use graphics::field::Field;
use paint::composite::composite_row;
use paint::document::{Lighting, Slots};
use paint::ground::Ground;
use paint::layer::SLOTS;
use paint::light::Light;
use paint::optics::{Gloss, NODES, Scene};
use paint::scene::{Appearance, picture, scene};
use paint::shade::color_row;
use rayon::prelude::*;

use super::drawing::Drawing;
use super::materials::FilmPaintError;
use super::painter::{Coat, FilmPainter};

/// Cells whose coat is composited together, unless all are bare.
const RUN: usize = 16;

/// The paint of a painter under one light.
#[derive(Debug, Clone)]
pub struct FilmView {
    light: Light,
    lighting: Lighting,
    coats: Vec<Coat>,
    scene: Scene,
    /// Internal reflectance of the grisaille over the ground, by level of grey.
    greys: Vec<[f32; NODES]>,
}

impl FilmView {
    /// The paint of `painter` under the light of `lighting`. Takes a good part of a second, unless it
    /// is the light that the painter matches colours under.
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
            composite_row(&scene.dry[0], painter.greys(), &mut greys);
        }
        Ok(Self { light, lighting: lighting.clone(), coats, scene, greys })
    }

    /// Picture of the painting of `drawing` by the painter of this view, in linear sRGB with white
    /// at 1; the fourth value is 1. It is the picture of [`FilmPainter::document`] under this light.
    /// Without relief ([`Lighting::relief`] 0) it is made without that document, at the speed of
    /// frames.
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

    /// Internal reflectance of the cells of row `y`.
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
                // The films that are whole are there already.
                let cells = amounts.iter_mut().zip(painter.whole_greys(drawing, y));
                cells.filter(|(_, level)| level.is_some()).for_each(|(cell, _)| *cell = [0; SLOTS]);
            }
            for (amounts, internal) in amounts.chunks(RUN).zip(internal.chunks_mut(RUN)) {
                composite_row(optics, amounts, internal);
            }
        }
    }
}

#[cfg(test)]
mod tests;
