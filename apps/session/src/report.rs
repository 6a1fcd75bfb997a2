//! State of the painting besides its pixels, for the front end.
//!
//! Colours of opaque films of paint.

use std::collections::BTreeMap;
use std::sync::Arc;

use paint::amount::mm_from_quanta;
use paint::document::Slots;
use paint::layer::SLOTS;
use paint::light::Light;
use paint::painting::TipLoad;
use paint::session::{PaintingSession, SessionError};
use paint::strokes::{BrushSpec, SurfaceId};
use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use pigment::palette::Appearance;
use spectra::TristimulusWeights;

use super::layers::{FilmSetting, Layers, Masks};
use super::prepare::PreparedPainting;
use super::srgb::SrgbBytes;
use super::state::{BrushState, HistoryShots, PaintingState};

/// Makes the reports, and caches what is slow to compute.
#[derive(Debug)]
pub(super) struct Reporter {
    colors: Colors,
    pub(super) layers: Layers,
    masks: Masks,
    /// Paint on brushes, by name. Entries that may have changed are removed.
    brushes: BTreeMap<String, BrushLoad>,
    /// Whether brushes had the pigment of each slot before their strokes, by name.
    clean: BTreeMap<String, [bool; SLOTS]>,
}

/// Paint on a brush: mean heights in mm of each slot and, last, of the vehicle, on its whole head
/// and at its tip, and the largest load that it can take besides.
#[derive(Debug, Clone, Copy)]
struct BrushLoad {
    head: [f64; SLOTS + 1],
    tip: [f64; SLOTS + 1],
    most_load_mm: f64,
}

/// Share of the pigment at the tip, picked up from a surface, from which a brush is dirty: less
/// does not change its colour much.
const DIRTY: f64 = 0.05;

/// State that the worker adds to each report.
#[derive(Debug, Clone)]
pub(super) struct WorkerStatus {
    /// Counter of changes of the painting.
    pub(super) revision: u64,
    /// Whether a stroke is open.
    pub(super) stroke_open: bool,
    /// Pictures of the history.
    pub(super) history_shots: HistoryShots,
}

impl Reporter {
    pub(super) fn new(prepared: &PreparedPainting) -> Self {
        let light = Arc::clone(prepared.session.canvas().light());
        let colors = Colors::new(Arc::clone(&prepared.library), light);
        let brushes = BTreeMap::new();
        let clean = BTreeMap::new();
        Self { colors, layers: Layers::default(), masks: Masks::default(), brushes, clean }
    }

    /// Forgets a brush, which was loaded, wiped or washed.
    pub(super) fn brush_changed(&mut self, name: &str) {
        self.brushes.remove(name);
        self.clean.remove(name);
    }

    /// Forgets the load of a brush whose head was clean for a tool while states were made.
    pub(super) fn tool_ended(&mut self, name: &str) {
        self.brushes.remove(name);
    }

    /// Forgets all brushes.
    pub(super) fn brushes_changed(&mut self) {
        self.brushes.clear();
        self.clean.clear();
    }

    /// Remembers the pigments of a brush that begins its first stroke since it was loaded.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn stroke_begins(
        &mut self,
        session: &mut PaintingSession,
        name: &str,
    ) -> Result<(), SessionError> {
        if !self.clean.contains_key(name) {
            let head = self.load(session, name)?.head;
            self.clean.insert(name.to_owned(), std::array::from_fn(|slot| head[slot] > 0.0));
        }
        Ok(())
    }

    /// Whether a brush that ends a stroke has picked up other pigments than it began with.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn is_dirty_after_stroke(
        &mut self,
        session: &mut PaintingSession,
        name: &str,
    ) -> Result<bool, SessionError> {
        self.brushes.remove(name);
        let Some(had) = self.clean.get(name).copied() else { return Ok(false) };
        let tip = self.load(session, name)?.tip;
        let pigment: f64 = tip[..SLOTS].iter().sum();
        let foreign: f64 = (0..SLOTS).filter(|&slot| !had[slot]).map(|slot| tip[slot]).sum();
        Ok(foreign > DIRTY * pigment)
    }

    /// Paint on a brush, from the cache if it has not changed.
    fn load(
        &mut self,
        session: &mut PaintingSession,
        name: &str,
    ) -> Result<BrushLoad, SessionError> {
        if let Some(load) = self.brushes.get(name) {
            return Ok(*load);
        }
        let load = brush_load(session, name)?;
        self.brushes.insert(name.to_owned(), load);
        Ok(load)
    }

    /// The whole state as it is now.
    ///
    /// # Errors
    /// [`SessionError`] if the device was lost.
    pub(super) fn state(
        &mut self,
        prepared: &mut PreparedPainting,
        status: &WorkerStatus,
        bytes: &SrgbBytes,
    ) -> Result<PaintingState, SessionError> {
        let PreparedPainting { session, library, ground, .. } = prepared;
        let light: Arc<Light> = Arc::clone(session.canvas().light());
        if !self.colors.is_for(library, &light) {
            self.colors = Colors::new(Arc::clone(library), Arc::clone(&light));
        }
        let scattering_per_mm = session.canvas().medium().scattering_per_mm;
        let films = FilmSetting { ground: Arc::clone(ground), scattering_per_mm };
        let brushes = self.brush_states(session, &films)?;
        let palette = session.painting(SurfaceId::Palette).map(|palette| palette.bounds());
        let (history, done) = session.history();
        let history = history.into_iter().map(str::to_owned).collect();
        let undo_bytes = session.undo_bytes();
        let canvas = session.canvas();
        let slots = canvas.state().slots;
        let bounds = canvas.bounds();
        Ok(PaintingState {
            title: canvas.title().to_owned(),
            canvas_cells: (bounds.width, bounds.height),
            palette_cells: palette.map_or((0, 0), |bounds| (bounds.width, bounds.height)),
            cell_mm: canvas.cell_mm(),
            library: Arc::clone(library),
            slots,
            masstones: self.colors.masstones(&slots),
            tints: self.colors.tints(&slots),
            layers: self.layers.states(canvas, bytes),
            lighting: canvas.state().lighting.clone(),
            light,
            second_lighting: canvas.second_light().cloned(),
            medium: canvas.medium().clone(),
            ground_reflectance: Arc::clone(ground),
            history,
            history_done: done,
            history_shots: status.history_shots.clone(),
            undo_bytes,
            brushes,
            mask: self.masks.state(canvas.mask()),
            backend: canvas.backend(),
            revision: status.revision,
            stroke_open: status.stroke_open,
        })
    }

    /// States of all brushes, in the order of their names.
    fn brush_states(
        &mut self,
        session: &mut PaintingSession,
        films: &FilmSetting,
    ) -> Result<Vec<BrushState>, SessionError> {
        let slots = session.canvas().state().slots;
        let specs: Vec<(String, BrushSpec)> =
            session.brushes().map(|(name, spec)| (name.to_owned(), spec.clone())).collect();
        let mut states = Vec::with_capacity(specs.len());
        for (name, spec) in specs {
            let BrushLoad { head, tip, most_load_mm } = self.load(session, &name)?;
            let amount_mm: f64 = head.iter().sum();
            let share = |whole: f64, part: f64| if whole > 0.0 { part / whole } else { 0.0 };
            let parts_of = |heights: &[f64; SLOTS + 1]| -> [f64; SLOTS] {
                let pigments: f64 = heights[..SLOTS].iter().sum();
                std::array::from_fn(|slot| share(pigments, heights[slot]))
            };
            let parts = parts_of(&head);
            let of_tip = self.colors.of_slots(&slots, &parts_of(&tip));
            let of_tip_film = self.colors.swatch(&slots, &tip, films);
            let swatch = of_tip_film.or_else(|| self.colors.swatch(&slots, &head, films));
            states.push(BrushState {
                color: of_tip.or_else(|| self.colors.of_slots(&slots, &parts)),
                swatch: swatch.map(Box::new),
                tip_mm: tip.iter().sum(),
                vehicle: share(amount_mm, head[SLOTS]),
                most_load_mm,
                name,
                spec,
                amount_mm,
                parts,
            });
        }
        Ok(states)
    }
}

/// Paint on a brush.
fn brush_load(session: &mut PaintingSession, name: &str) -> Result<BrushLoad, SessionError> {
    let clean =
        BrushLoad { head: [0.0; SLOTS + 1], tip: [0.0; SLOTS + 1], most_load_mm: f64::INFINITY };
    let Some(paint) = session.brush_paint(name)? else { return Ok(clean) };
    // The head is the same on both surfaces.
    let used = [SurfaceId::Canvas, SurfaceId::Palette].into_iter().find_map(|surface| {
        Some((session.painting(surface)?, session.brush_id_on(name, surface)?))
    });
    let Some((painting, brush)) = used else { return Ok(clean) };
    let head = painting.head(brush);
    let cell_mm = painting.cell_mm();
    let rows = head.rows_with_paint().len();
    let cell_area = head.paint_cell_area();
    let area = (paint.width() * rows).max(1) as f64 * cell_area;
    Ok(BrushLoad {
        head: paint.totals().map(|total| total as f64 / area * mm_from_quanta(1, cell_mm)),
        tip: TipLoad::of(&paint, rows, cell_mm, cell_area).amounts_mm,
        most_load_mm: painting.most_load_mm(brush, &paint),
    })
}

/// Parts of white to one part of pigment in a tint.
const TINT: f64 = 9.0;

/// Colours of the paint of tubes and brushes under one light.
#[derive(Debug, Clone)]
pub(super) struct Colors {
    pub(super) library: Arc<PigmentLibrary>,
    light: Arc<Light>,
    pub(super) weights: TristimulusWeights,
    /// Pigment used to lighten.
    white: Option<PigmentId>,
}

impl Colors {
    /// Colours of the paint of `library` under `light`.
    pub(super) fn new(library: Arc<PigmentLibrary>, light: Arc<Light>) -> Self {
        let weights = light.viewing.weights(library.grid);
        let weights = weights.expect("the light was made for this library");
        let mut colors = Self { library, light, weights, white: None };
        colors.white = colors.lightener();
        colors
    }

    /// Whether these are the colours of this library and light.
    pub(super) fn is_for(&self, library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.library, library) && Arc::ptr_eq(&self.light, light)
    }

    /// The reference white, or else the lightest pigment whose scattering is known.
    fn lightener(&self) -> Option<PigmentId> {
        let mixed = || self.library.ids().filter(|id| self.library[*id].identified);
        let reference = self.library.reference_id();
        mixed().find(|&id| Some(id) == reference).or_else(|| {
            let luminance = |&id: &PigmentId| {
                let film = self.film(&[(id, 1.0)]);
                film.map_or(0.0, |reflectance| self.weights.xyz(&reflectance).y)
            };
            mixed().max_by(|a, b| luminance(a).total_cmp(&luminance(b)))
        })
    }

    fn film(&self, recipe: &[(PigmentId, f64)]) -> Option<Vec<f64>> {
        let mixture = self.library.mix(recipe).ok()?;
        Some(mixture.hiding(self.library.saunderson))
    }

    /// sRGB of a recipe, adapted from the light to the screen; `None` for a recipe without
    /// parts.
    pub(super) fn of(&self, recipe: &[(PigmentId, f64)]) -> Option<[u8; 3]> {
        let xyz = self.weights.xyz(&self.film(recipe)?);
        let srgb = Appearance::of(xyz, self.weights.white()).srgb;
        Some(srgb.linear().mapped_into_gamut().encoded().to_bytes())
    }

    /// sRGB of a mixture with these parts by slot.
    pub(super) fn of_slots(&self, slots: &Slots, parts: &[f64; SLOTS]) -> Option<[u8; 3]> {
        let filled = slots.iter().zip(parts).filter(|(_, part)| **part > 0.0);
        let recipe: Vec<_> = filled.filter_map(|(slot, &part)| Some(((*slot)?, part))).collect();
        self.of(&recipe)
    }

    /// sRGB of the pigment of each slot alone.
    pub(super) fn masstones(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| self.of(&[(slot?, 1.0)]))
    }

    /// sRGB of one part of the pigment of each slot in nine parts of white; `None` for a
    /// pigment whose scattering is unknown.
    pub(super) fn tints(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| {
            let pigment = slot?;
            let white = self.white?;
            let identified = self.library[pigment].identified;
            identified.then(|| self.of(&[(pigment, 1.0), (white, TINT)]))?
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pigment::library::PigmentLibrary;
    use pigment::palette::{Cards, Palette, Recipe};

    #[test]
    fn masstones_and_tints_are_those_of_the_library() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "A", "1931-2").unwrap());
        let colors = Colors::new(Arc::clone(&library), Arc::clone(&light));
        let blue = library.find("Prussian Blue").unwrap();
        let unknown = library.ids().find(|&pigment| !library[pigment].identified).unwrap();
        let mut slots = [None; SLOTS];
        (slots[2], slots[5]) = (Some(blue), Some(unknown));
        let cards = Cards::standard(library.grid);
        let palette = Palette::new(&library, &light.viewing, cards).unwrap();
        let masstones = colors.masstones(&slots);
        assert_eq!(masstones[2], Some(palette.color(&Recipe::single(blue)).srgb.to_bytes()));
        assert!(masstones[5].is_some(), "a masstone is known without the scattering");
        let tints = colors.tints(&slots);
        assert_eq!(tints[2], Some(palette.color(&palette.tint(blue, TINT)).srgb.to_bytes()));
        assert_eq!((tints[0], tints[5]), (None, None), "an empty slot; no known scattering");
        let green = |color: Option<[u8; 3]>| color.map(|color| color[1]);
        assert!(green(tints[2]) > green(masstones[2]), "white lightens");
    }

    #[test]
    fn a_mixture_by_slots_counts_only_what_has_parts() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "D65", "1931-2").unwrap());
        let colors = Colors::new(library, light);
        let slots = std::array::from_fn(|slot| Some(PigmentId(slot)));
        let mut parts = [0.0; SLOTS];
        assert_eq!(colors.of_slots(&slots, &parts), None, "no paint has no colour");
        (parts[1], parts[4]) = (3.0, 1.0);
        assert_eq!(
            colors.of_slots(&slots, &parts),
            colors.of(&[(PigmentId(1), 0.75), (PigmentId(4), 0.25)])
        );
    }
}
