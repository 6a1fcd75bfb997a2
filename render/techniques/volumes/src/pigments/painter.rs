//! Paintings of a scene with its volumes: ground, grisaille or own colours, hatching, and the film
//! of the volumes. These are dry layers of whole quanta.

use graphics::field::Field;
use paint::amount::QUANTA_PER_CELL;
use paint::document::{Document, Slots};
use paint::layer::{Layer, SLOTS};
use paint::separation::SeparationSettings;
use rayon::prelude::*;

use super::drawing::{Drawing, InsidePaint, UnderPainting};
use super::film::FilmHeights;
use super::grisaille::{Grisaille, OwnColors, Pencil, level, step};
use super::materials::{FilmMaterial, FilmPaintError, toner, within_one};

/// How a scene and its volumes become layers of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmPainterSettings {
    /// The layer under the films.
    pub under: UnderPainting,
    /// The look of the inside of volumes.
    pub inside: InsidePaint,
    /// Whether to add a third paint to the grisaille, which makes its greys neutral ([`toner`]).
    pub neutral: bool,
    /// Full ink darkens the ground to this encoded grey, 0..1.
    pub pencil: f32,
    /// Width of a cell of the painting in mm.
    pub cell_mm: f64,
    /// Heights of the films of grisaille and own colours.
    pub films: SeparationSettings,
}

impl Default for FilmPainterSettings {
    /// Volumes are glazes over a grisaille of white and black. The pencil darkens the ground to a
    /// grey of 0.15, and cells are 0.2 mm wide. Films of grisaille are 0.03 to 0.3 mm high and hide
    /// the ground.
    fn default() -> Self {
        let films = SeparationSettings { lattice: 17, refined: false, ..Default::default() };
        let under = UnderPainting::default();
        let inside = InsidePaint::default();
        Self { under, inside, neutral: false, pencil: 0.15, cell_mm: 0.2, films }
    }
}

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
    slots: Slots,
    grisaille: Grisaille,
    own_colors: Option<OwnColors>,
    greys: Vec<[u32; SLOTS]>,
    inks: Vec<u32>,
}

impl FilmPainter {
    /// A painter for volumes with the pigments `slots`. If you show the colours of the scene, pass
    /// their pigments as `own_colors`. By default, these are the pigments of the volumes. This
    /// takes seconds.
    ///
    /// # Errors
    /// [`FilmPaintError`] for a library without white and black, an empty palette for the colours
    /// of the scene, and heights out of range.
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
        let toner = if settings.neutral { toner(&material, pigments) } else { None };
        let grisaille = Grisaille::new(&material, (pigments, toner), &settings.films)?;
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

    /// Materials of its films.
    #[must_use]
    pub fn material(&self) -> &FilmMaterial {
        &self.material
    }

    /// How this painter paints.
    #[must_use]
    pub fn settings(&self) -> &FilmPainterSettings {
        &self.settings
    }

    /// Pigments of the volumes by slot.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// Puts other pigments into the slots of the volumes. Everything else stays.
    #[must_use]
    pub fn with_slots(self, slots: Slots) -> Self {
        Self { slots, ..self }
    }

    /// Paints `drawing`. You get one dry layer for each coat that the settings can lay: grisaille,
    /// own colours, hatching, films.
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
        let library = library.as_ref().clone();
        let lighting = lighting.clone();
        let medium = medium.clone();
        let mut document =
            Document::bare(title, cell_mm, ground, library, medium, self.slots, lighting);
        for coat in self.coats() {
            let paint = self.layer(coat, drawing, (width, height));
            document.push_dry(self.slots_of(coat), paint);
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

    pub(super) fn coats(&self) -> Vec<Coat> {
        let grisaille = self.settings.under == UnderPainting::Grisaille;
        let has = [grisaille, self.own_colors.is_some(), true, self.settings.inside.has_films()];
        let coats = [Coat::Grisaille, Coat::OwnColors, Coat::Hatching, Coat::Films];
        coats.into_iter().zip(has).filter(|(_, has)| *has).map(|(coat, _)| coat).collect()
    }

    pub(super) fn slots_of(&self, coat: Coat) -> Slots {
        match coat {
            Coat::Grisaille | Coat::Hatching => *self.grisaille.slots(),
            Coat::OwnColors => self.own_colors.as_ref().map_or(self.slots, |own| *own.slots()),
            Coat::Films => self.slots,
        }
    }

    pub(super) fn greys(&self) -> &[[u32; SLOTS]] {
        &self.greys
    }

    /// For each cell of row `y`, the level of grey if grisaille covers the whole cell. `None` for
    /// other cells.
    pub(super) fn whole_greys<'a>(
        &self,
        drawing: &'a Drawing<'_>,
        y: usize,
    ) -> impl Iterator<Item = Option<usize>> + use<'a> {
        let row = Row::of(drawing, y);
        let everywhere = self.settings.under == UnderPainting::OwnColors;
        let tinted = self.own_colors.is_some();
        row.color.iter().enumerate().map(move |(x, color)| {
            let own = if tinted { row.tint_at(x) } else { 0.0 };
            let whole = !everywhere && own <= 0.0 && row.cover_at(x) >= 1.0;
            whole.then(|| level(color[3]))
        })
    }

    pub(super) fn row(
        &self,
        coat: Coat,
        drawing: &Drawing<'_>,
        y: usize,
        out: &mut [[u32; SLOTS]],
    ) {
        let row = Row::of(drawing, y);
        match coat {
            Coat::Grisaille => {
                for (x, (amounts, color)) in out.iter_mut().zip(row.color).enumerate() {
                    let share = row.cover_at(x) * (1.0 - self.own_share(&row, x));
                    *amounts = self.greys[level(color[3])].map(|quanta| part(quanta, share));
                }
            }
            Coat::OwnColors => {
                for (x, (amounts, &color)) in out.iter_mut().zip(row.color).enumerate() {
                    *amounts =
                        self.own_color_amounts(color, row.cover_at(x) * self.own_share(&row, x));
                }
            }
            Coat::Hatching => {
                out.fill([0; SLOTS]);
                for (x, (amounts, &ink)) in out.iter_mut().zip(row.ink).enumerate() {
                    amounts[1] = part(self.inks[step(ink)], row.cover_at(x));
                }
            }
            Coat::Films => {
                out.fill([0; SLOTS]);
                for (amounts, heights) in out.iter_mut().zip(row.films) {
                    *amounts = heights.cell().pigments;
                }
            }
        }
    }

    /// The share of a cell's surface that we paint in its own colours, 0 to 1.
    fn own_share(&self, row: &Row<'_>, x: usize) -> f32 {
        match self.own_colors {
            Some(_) if self.settings.under == UnderPainting::OwnColors => 1.0,
            Some(_) => row.tint_at(x),
            None => 0.0,
        }
    }

    fn own_color_amounts(&self, [r, g, b, _]: [f32; 4], share: f32) -> [u32; SLOTS] {
        let Some(own) = self.own_colors.as_ref().filter(|_| share > 0.0) else {
            return [0; SLOTS];
        };
        let quanta_per_mm = f64::from(QUANTA_PER_CELL) / self.settings.cell_mm;
        own.heights_mm([r, g, b])
            .map(|mm: f32| (f64::from(mm * share) * quanta_per_mm + 0.5) as u32)
    }
}

#[inline]
fn part(quanta: u32, share: f32) -> u32 {
    if share >= 1.0 { quanta } else { (f64::from(quanta) * f64::from(share) + 0.5) as u32 }
}

/// One row of a drawing. If the drawing leaves out a part, it is empty.
struct Row<'a> {
    color: &'a [[f32; 4]],
    cover: &'a [f32],
    ink: &'a [f32],
    tint: &'a [f32],
    films: &'a [FilmHeights],
}

impl<'a> Row<'a> {
    fn of(drawing: &'a Drawing<'_>, y: usize) -> Self {
        let width = drawing.color.width();
        let [cover, ink, tint] = [drawing.cover, drawing.ink, drawing.tint]
            .map(|field| field.map_or(&[][..], |one| one.row(y, 0, width)));
        Self {
            color: drawing.color.row(y, 0, width),
            cover,
            ink,
            tint,
            films: drawing.films.map_or(&[][..], |films| films.row(y, 0, width)),
        }
    }

    #[inline]
    fn cover_at(&self, x: usize) -> f32 {
        self.cover.get(x).map_or(1.0, |&cover| within_one(cover))
    }

    #[inline]
    fn tint_at(&self, x: usize) -> f32 {
        self.tint.get(x).map_or(0.0, |&tint| within_one(tint))
    }
}
