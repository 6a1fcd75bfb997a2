//! Paintings with pigments: a dry layer for each layer of strokes.

use artmap::sample::PaintOfSamples;
use graphics::camera::Camera;
use graphics::field::Field;
use paint::document::{Document, Lighting, Medium};
use paint::ground::GroundSpec;

use super::amounts::amounts;
use super::built_ground::BuiltGround;
use super::color_paint::{ColorPaint, ColorPaintSettings};
use super::composed::over;
use super::error::PainterError;
use super::paint_layer::paint_layer;
use super::paint_tones::Amounts;
use super::painter::Painter;

/// Amounts of all layers, and what they are amounts of.
struct Mixed {
    of: PaintOfSamples,
    layers: Vec<Field<Amounts>>,
}

impl Painter {
    /// Paints the subject as [`Self::paint`] does, with pigments: a painting with a dry layer for each
    /// layer of strokes, a cell for each pixel.
    ///
    /// Where colours are the maps', amounts are the weighted means of the amounts that strokes show,
    /// so strokes that overlap do not pile up within a layer. Where they are the subject's, each cell
    /// is a film of the mixture that shows its colour, as high as the brushwork: of up to eight
    /// pigments of the library ([`Self::set_pigments`]) that suit the picture.
    ///
    /// Cells are as wide as the first map's strokes demand: `strokes.width_px` of them to the
    /// distance of its strokes in mm (3 mm where the map does not tell).
    ///
    /// # Errors
    /// Those of [`Self::paint`]; [`PainterError::NoPaint`] for the colours of maps without pigments,
    /// [`PainterError::Maps`] for those of maps whose pigments do not go together,
    /// [`PainterError::Colors`] for a library that cannot paint colours,
    /// [`PainterError::Ground`] for a ground that cannot be made.
    pub fn painting(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
        (title, ground): (&str, &GroundSpec),
    ) -> Result<Document, PainterError> {
        let mixed = match self.of_subject() {
            false => self.mixed_as_maps(camera, size, seconds)?,
            true => self.mixed_as_subject(camera, size, seconds, ground)?,
        };
        let Mixed { of: PaintOfSamples { library, slots }, layers } = mixed;
        let cell_mm = self.cell_mm(size);
        let ground = BuiltGround::kept(&mut self.ground, ground, (size, cell_mm), &library)?;
        let medium = Medium::of(&library);
        let library = library.as_ref().clone();
        let lighting = Lighting::default();
        let mut document = Document::bare(title, cell_mm, ground, library, medium, slots, lighting);
        for amounts in &layers {
            document.push_dry(slots, paint_layer(amounts, cell_mm));
        }
        Ok(document)
    }

    /// The paint that strokes of the maps show.
    fn mixed_as_maps(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
    ) -> Result<Mixed, PainterError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        let Some(paint) = self.paint_tones()? else { return Err(PainterError::NoPaint) };
        let overlap = &self.settings().overlap;
        let layers = layers.iter().enumerate();
        let layers = layers
            .map(|(layer, splats)| amounts(&depth, splats, &self.divide(layer), paint, overlap));
        Ok(Mixed { layers: layers.collect(), of: paint.of.clone() })
    }

    /// Mixtures for the colours of the subject.
    fn mixed_as_subject(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
        ground: &GroundSpec,
    ) -> Result<Mixed, PainterError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        let depth = depth.into();
        let layers = layers.iter().enumerate();
        let layers = layers.map(|(layer, splats)| self.painted(&depth, splats, layer));
        let layers = layers.collect::<Result<Vec<_>, _>>()?;
        let whole = layers[1..].iter().fold(layers[0].clone(), over);
        let (library, palette) = self.pigments();
        let lighting = Lighting::default();
        let under = (ground, &lighting);
        let settings = ColorPaintSettings::default();
        let slots = match palette {
            Some(slots) => slots,
            None => ColorPaint::palette(&whole, &library, under, &settings)?,
        };
        let paint = ColorPaint::new(library.clone(), slots, under, &settings)?;
        let layers = layers.iter().map(|layer| paint.amounts(layer, self.film())).collect();
        Ok(Mixed { of: PaintOfSamples { library, slots }, layers })
    }
}
