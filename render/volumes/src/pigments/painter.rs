//! Paintings of a scene with its volumes: ground, grisaille or own colours, hatching, and the film
//! of the volumes, as dry layers of whole quanta.

use graphics::field::Field;
use paint::amount::quanta_from_mm;
use paint::document::{Document, DryLayer, Slots};
use paint::layer::{Layer, SLOTS};
use paint::separation::SeparationSettings;
use rayon::prelude::*;

use super::drawing::{Drawing, InsidePaint, UnderPainting};
use super::grisaille::{Grisaille, level};
use super::materials::{FilmMaterial, FilmPaintError};
use super::own_colors::OwnColors;
use super::pencil::{Pencil, step};
use super::tones::within_one;

/// How a scene and its volumes become layers of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmPainterSettings {
    /// What lies under the films.
    pub under: UnderPainting,
    /// What volumes show.
    pub inside: InsidePaint,
    /// Encoded grey that full ink darkens the ground to, 0..1.
    pub pencil: f32,
    /// Width of a cell of the painting in mm.
    pub cell_mm: f64,
    /// Heights of the films of grisaille and own colours.
    pub films: SeparationSettings,
}

impl Default for FilmPainterSettings {
    /// A glaze over grisaille with a pencil of 0.15 on cells of 0.2 mm; films of 0.03 to 0.3 mm
    /// that hide the ground.
    fn default() -> Self {
        let films = SeparationSettings { lattice: 17, refined: false, ..Default::default() };
        let (under, inside) = (UnderPainting::default(), InsidePaint::default());
        Self { under, inside, pencil: 0.15, cell_mm: 0.2, films }
    }
}

/// The layers of a painting, lowest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coat {
    Grisaille,
    OwnColors,
    Hatching,
    Films,
}

/// Paints scenes with their volumes in measured pigments.
#[derive(Debug, Clone)]
pub struct FilmPainter {
    material: FilmMaterial,
    settings: FilmPainterSettings,
    /// Pigments of the volumes.
    slots: Slots,
    grisaille: Grisaille,
    own_colors: Option<OwnColors>,
    /// Quanta of the grisaille by level of grey.
    greys: Vec<[u32; SLOTS]>,
    /// Quanta of black by step of ink.
    inks: Vec<u32>,
}

impl FilmPainter {
    /// A painter for volumes with the pigments `slots`. `own_colors` are the pigments for the
    /// colours of the scene, which are needed where these are shown; by default those of the
    /// volumes. Takes seconds.
    ///
    /// # Errors
    /// [`FilmPaintError`] for a library without white and black, an empty palette for the colours of
    /// the scene, and heights out of range.
    ///
    /// # Panics
    /// If a slot refers to a pigment that the library lacks.
    pub fn new(
        material: FilmMaterial,
        slots: Slots,
        own_colors: Option<Slots>,
        settings: FilmPainterSettings,
    ) -> Result<Self, FilmPaintError> {
        let pigments = material.white_and_black()?;
        let grisaille = Grisaille::new(&material, pigments, &settings.films)?;
        let pencil = Pencil::new(&grisaille, settings.pencil);
        let shown = settings.under == UnderPainting::OwnColors || settings.inside.has_own_colors();
        let own_colors = match shown {
            true => {
                let palette = own_colors.unwrap_or(slots);
                Some(OwnColors::new(&material, palette, &settings.films)?)
            }
            false => None,
        };
        let greys = grisaille.quanta(settings.cell_mm);
        let inks = pencil.quanta(settings.cell_mm);
        Ok(Self { material, settings, slots, grisaille, own_colors, greys, inks })
    }

    /// What its films are made of.
    #[must_use]
    pub fn material(&self) -> &FilmMaterial {
        &self.material
    }

    /// How it paints.
    #[must_use]
    pub fn settings(&self) -> &FilmPainterSettings {
        &self.settings
    }

    /// Pigments of the volumes by slot.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// Volumes with other pigments in their slots; all else stays.
    #[must_use]
    pub fn with_slots(self, slots: Slots) -> Self {
        Self { slots, ..self }
    }

    /// The painting of `drawing`, with one dry layer for each coat that it may have.
    ///
    /// # Errors
    /// [`FilmPaintError::Ground`] if the ground cannot be made at this size.
    ///
    /// # Panics
    /// If the fields of `drawing` differ in size.
    pub fn document(&self, title: &str, drawing: &Drawing<'_>) -> Result<Document, FilmPaintError> {
        let (width, height) = drawing.size();
        let FilmMaterial { library, ground, lighting, medium, .. } = &self.material;
        let cell_mm = self.settings.cell_mm;
        let ground = ground.build(width, height, cell_mm, library)?;
        let (library, lighting) = (library.as_ref().clone(), lighting.clone());
        let medium = medium.clone();
        let mut document =
            Document::bare(title, cell_mm, ground, library, medium, self.slots, lighting);
        for coat in self.coats() {
            let paint = self.layer(coat, drawing, (width, height));
            document.dry.push(DryLayer { slots: self.slots_of(coat), opacity: 1.0, paint });
        }
        Ok(document)
    }

    fn layer(&self, coat: Coat, drawing: &Drawing<'_>, (width, height): (usize, usize)) -> Layer {
        let mut layer = Layer::empty(width, height);
        if width == 0 {
            return layer;
        }
        let rows = layer.pigments.values_mut().par_chunks_mut(width).enumerate();
        rows.for_each(|(y, row)| self.row(coat, drawing, y, row));
        if let (Coat::Films, Some(films)) = (coat, drawing.films) {
            let vehicle = films.values().par_iter().map(|heights| heights.cell().vehicle);
            layer.vehicle = Field::from_values(width, height, vehicle.collect());
        }
        layer
    }

    /// The coats of its paintings, lowest first.
    pub(super) fn coats(&self) -> Vec<Coat> {
        let grisaille = self.settings.under == UnderPainting::Grisaille;
        let has = [grisaille, self.own_colors.is_some(), true, self.settings.inside.has_films()];
        let coats = [Coat::Grisaille, Coat::OwnColors, Coat::Hatching, Coat::Films];
        coats.into_iter().zip(has).filter(|(_, has)| *has).map(|(coat, _)| coat).collect()
    }

    /// Pigments of a coat by slot.
    pub(super) fn slots_of(&self, coat: Coat) -> Slots {
        match coat {
            Coat::Grisaille | Coat::Hatching => *self.grisaille.slots(),
            Coat::OwnColors => self.own_colors.as_ref().map_or(self.slots, |own| *own.slots()),
            Coat::Films => self.slots,
        }
    }

    /// Films of the grisaille in quanta by level of grey.
    pub(super) fn greys(&self) -> &[[u32; SLOTS]] {
        &self.greys
    }

    /// The level of grey of a cell that has a whole film of grisaille.
    #[inline]
    pub(super) fn whole_grey(&self, drawing: &Drawing<'_>, index: usize) -> Option<usize> {
        let whole = self.settings.under == UnderPainting::Grisaille
            && self.share(Coat::Grisaille, drawing, index) == 1.0;
        whole.then(|| level(drawing.color.values()[index][3]))
    }

    /// Quanta of a coat in row `y`.
    pub(super) fn row(
        &self,
        coat: Coat,
        drawing: &Drawing<'_>,
        y: usize,
        out: &mut [[u32; SLOTS]],
    ) {
        let first = y * drawing.color.width();
        for (amounts, index) in out.iter_mut().zip(first..) {
            *amounts = self.cell(coat, drawing, index);
        }
    }

    /// Quanta of a coat in a cell.
    pub(super) fn cell(&self, coat: Coat, drawing: &Drawing<'_>, index: usize) -> [u32; SLOTS] {
        let color = drawing.color.values()[index];
        let share = self.share(coat, drawing, index);
        if share <= 0.0 {
            return [0; SLOTS];
        }
        let part = |quanta: u32| (f64::from(quanta) * f64::from(share)).round() as u32;
        match coat {
            Coat::Grisaille if share == 1.0 => self.greys[level(color[3])],
            Coat::Grisaille => self.greys[level(color[3])].map(part),
            Coat::OwnColors => self.own_colors.as_ref().map_or([0; SLOTS], |own| {
                let heights = own.heights_mm([color[0], color[1], color[2]]);
                let cell_mm = self.settings.cell_mm;
                heights.map(|mm| quanta_from_mm(f64::from(mm * share), cell_mm))
            }),
            Coat::Hatching => {
                let ink = drawing.ink.map_or(0.0, |ink| ink.values()[index]);
                let mut amounts = [0; SLOTS];
                amounts[1] = part(self.inks[step(ink)]);
                amounts
            }
            Coat::Films => {
                drawing.films.map_or([0; SLOTS], |films| films.values()[index].cell().pigments)
            }
        }
    }

    /// The part of a cell, 0 to 1, that has a coat.
    #[inline]
    fn share(&self, coat: Coat, drawing: &Drawing<'_>, index: usize) -> f32 {
        let at = |field: Option<&Field<f32>>, none: f32| {
            field.map_or(none, |field| within_one(field.values()[index]))
        };
        let cover = at(drawing.cover, 1.0);
        let everywhere = self.settings.under == UnderPainting::OwnColors;
        let own = match self.own_colors {
            Some(_) if everywhere => 1.0,
            Some(_) => at(drawing.tint, 0.0),
            None => 0.0,
        };
        match coat {
            Coat::Grisaille => cover * (1.0 - own),
            Coat::OwnColors => cover * own,
            Coat::Hatching => cover,
            Coat::Films => 1.0,
        }
    }
}
