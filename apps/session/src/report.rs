//! Reports everything about the painting except its pixels to the front end: colours of opaque
//! films, summaries of the dry layers (computed while the worker is idle), the mask of the canvas,
//! and films of the paint on a brush (how it covers, and what it would lay now).

use std::collections::BTreeMap;
use std::sync::Arc;

use paint::amount::mm_from_quanta;
use paint::document::{LayerId, Slots};
use paint::layer::{DryLayerState, SLOTS};
use paint::light::Light;
use paint::mask::Mask;
use paint::painting::{Painting, PaintingError, TipLoad};
use paint::session::PaintingSession;
use paint::strokes::{BrushSpec, SurfaceId};
use pigment::PigmentId;
use pigment::curves::Curves;
use pigment::library::PigmentLibrary;
use pigment::palette::{Appearance, Cards};
use spectra::TristimulusWeights;

use super::miniature::LayerSummary;
use super::prepare::PreparedPainting;
use super::srgb::SrgbBytes;
use super::state::{
    BrushState, BrushSwatch, FilmColor, HistoryShots, LayerState, MaskState, PaintingState,
    Thumbnail,
};

/// Makes the reports, and caches what is slow to compute.
#[derive(Debug)]
pub(super) struct Reporter {
    colors: Colors,
    pub(super) layers: Layers,
    masks: Masks,
    /// Paint on brushes, by name. We remove entries that may have changed.
    brushes: BTreeMap<String, BrushLoad>,
    /// For each brush, whether it held the pigment of each slot before its strokes.
    clean: BTreeMap<String, [bool; SLOTS]>,
}

/// Paint on a brush, as mean heights in mm of each slot and then of the vehicle: on its whole head
/// and at its tip. Also the largest load that it can still take.
#[derive(Debug, Clone, Copy)]
struct BrushLoad {
    head: [f64; SLOTS + 1],
    tip: [f64; SLOTS + 1],
    most_load_mm: f64,
}

/// A brush is dirty if this share of the pigment at its tip came from a surface. Less does not
/// change its colour much.
const DIRTY: f64 = 0.05;

/// State that the worker adds to each report.
#[derive(Debug, Clone)]
pub(super) struct WorkerStatus {
    pub(super) revision: u64,
    pub(super) stroke_open: bool,
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

    /// Forgets a brush that was loaded, wiped or washed.
    pub(super) fn brush_changed(&mut self, name: &str) {
        self.brushes.remove(name);
        self.clean.remove(name);
    }

    /// Forgets the load of a brush that was used as a tool, because its head was clean during this
    /// stroke.
    pub(super) fn tool_ended(&mut self, name: &str) {
        self.brushes.remove(name);
    }

    pub(super) fn brushes_changed(&mut self) {
        self.brushes.clear();
        self.clean.clear();
    }

    /// Remembers the pigments of a brush that begins its first stroke since it was loaded.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub(super) fn stroke_begins(
        &mut self,
        session: &mut PaintingSession,
        name: &str,
    ) -> Result<(), PaintingError> {
        if !self.clean.contains_key(name) {
            let head = self.load(session, name)?.head;
            self.clean.insert(name.to_owned(), std::array::from_fn(|slot| head[slot] > 0.0));
        }
        Ok(())
    }

    /// Whether a brush that ends a stroke has picked up other pigments than it began with.
    ///
    /// # Errors
    /// [`PaintingError`] if the device was lost.
    pub(super) fn is_dirty_after_stroke(
        &mut self,
        session: &mut PaintingSession,
        name: &str,
    ) -> Result<bool, PaintingError> {
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
    ) -> Result<BrushLoad, PaintingError> {
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
    /// [`PaintingError`] if the device was lost.
    pub(super) fn state(
        &mut self,
        prepared: &mut PreparedPainting,
        status: &WorkerStatus,
        bytes: &SrgbBytes,
    ) -> Result<PaintingState, PaintingError> {
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

    /// States of all brushes, sorted by name.
    fn brush_states(
        &mut self,
        session: &mut PaintingSession,
        films: &FilmSetting,
    ) -> Result<Vec<BrushState>, PaintingError> {
        let slots = session.canvas().state().slots;
        let specs: Vec<(String, BrushSpec)> =
            session.brushes().map(|(name, spec)| (name.to_owned(), spec.clone())).collect();
        let mut states = Vec::with_capacity(specs.len());
        for (name, spec) in specs {
            let BrushLoad { head, tip, most_load_mm } = self.load(session, &name)?;
            let amount_mm: f64 = head.iter().sum();
            fn share(whole: f64, part: f64) -> f64 {
                if whole > 0.0 { part / whole } else { 0.0 }
            }
            fn parts_of(heights: &[f64; SLOTS + 1]) -> [f64; SLOTS] {
                let pigments: f64 = heights[..SLOTS].iter().sum();
                std::array::from_fn(|slot| share(pigments, heights[slot]))
            }
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
fn brush_load(session: &mut PaintingSession, name: &str) -> Result<BrushLoad, PaintingError> {
    let clean =
        BrushLoad { head: [0.0; SLOTS + 1], tip: [0.0; SLOTS + 1], most_load_mm: f64::INFINITY };
    let Some(paint) = session.brush_paint(name)? else { return Ok(clean) };
    // Both surfaces have the same head.
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

/// A tint has this many parts of white to one part of pigment.
const TINT: f64 = 9.0;

/// Colours of the paint of tubes and brushes under one light.
#[derive(Debug, Clone)]
pub(super) struct Colors {
    pub(super) library: Arc<PigmentLibrary>,
    light: Arc<Light>,
    pub(super) weights: TristimulusWeights,
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

    /// The reference white, or else the lightest pigment with known scattering.
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

    /// sRGB of a recipe, adapted from the light to the screen. A recipe without parts has no
    /// colour.
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

    pub(super) fn masstones(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| self.of(&[(slot?, 1.0)]))
    }

    /// sRGB of one part of the pigment of each slot in nine parts of white. A pigment with unknown
    /// scattering has no tint.
    pub(super) fn tints(&self, slots: &Slots) -> [Option<[u8; 3]>; SLOTS] {
        slots.map(|slot| {
            let pigment = slot?;
            let white = self.white?;
            let identified = self.library[pigment].identified;
            identified.then(|| self.of(&[(pigment, 1.0), (white, TINT)]))?
        })
    }
}

#[derive(Debug)]
struct LayerEntry {
    id: LayerId,
    /// Whether the summary still describes the dry paint.
    current: bool,
    summary: Option<LayerSummary>,
    /// The state that we sent last, and the light of its thumbnail.
    sent: Option<(LayerState, Arc<Light>)>,
}

#[derive(Debug, Default)]
pub(super) struct Layers {
    changes: u64,
    entries: Vec<LayerEntry>,
}

impl Layers {
    /// Marks all summaries as outdated if dry paint of `painting` changed. You still get outdated
    /// summaries until [`Self::summarize_next`] replaces them. Each stays with its layer, even if
    /// the layer moves.
    pub(super) fn update(&mut self, painting: &Painting) {
        let dry = &painting.state().dry;
        let same = dry.iter().map(|layer| layer.id).eq(self.entries.iter().map(|entry| entry.id));
        if painting.dry_changes() == self.changes && same {
            return;
        }
        self.changes = painting.dry_changes();
        let mut former = std::mem::take(&mut self.entries);
        self.entries = dry
            .iter()
            .map(|layer: &DryLayerState| {
                let known = former.iter().position(|entry| entry.id == layer.id);
                let known = known.map(|index| former.swap_remove(index));
                LayerEntry {
                    current: false,
                    ..known.unwrap_or(LayerEntry {
                        id: layer.id,
                        current: false,
                        summary: None,
                        sent: None,
                    })
                }
            })
            .collect();
    }

    pub(super) fn is_behind(&self) -> bool {
        self.entries.iter().any(|entry| !entry.current)
    }

    /// Computes the first summary that is outdated. We send states less often than paint changes,
    /// so layers may have come or gone since the last update.
    pub(super) fn summarize_next(&mut self, painting: &mut Painting) -> Result<(), PaintingError> {
        self.update(painting);
        let outdated = self.entries.iter().position(|entry| !entry.current);
        let Some(index) = outdated else { return Ok(()) };
        let bounds = painting.bounds();
        let cell_mm = painting.cell_mm();
        let summary = LayerSummary::new(bounds, cell_mm, |rect| painting.dry_in(index, rect))?;
        let entry = &mut self.entries[index];
        (entry.current, entry.summary, entry.sent) = (true, Some(summary), None);
        Ok(())
    }

    /// States of all layers. A layer without a summary has zeros and an empty thumbnail.
    pub(super) fn states(&mut self, painting: &Painting, bytes: &SrgbBytes) -> Vec<LayerState> {
        self.update(painting);
        let light = painting.light();
        let layers = self.entries.iter_mut().zip(&painting.state().dry);
        let states = layers.map(|(entry, dry)| {
            let Some(summary) = &entry.summary else { return blank(dry) };
            if let Some((sent, under)) = &mut entry.sent
                && (sent.slots, sent.opacity) == (dry.slots, dry.opacity)
                && Arc::ptr_eq(under, light)
            {
                dry.name.clone_into(&mut sent.name);
                sent.visible = dry.visible;
                return sent.clone();
            }
            let state = summary.state(dry, painting, bytes);
            entry.sent = Some((state.clone(), Arc::clone(light)));
            state
        });
        states.collect()
    }
}

/// State of a layer that was not summarized yet.
fn blank(dry: &DryLayerState) -> LayerState {
    LayerState {
        id: dry.id,
        name: dry.name.clone(),
        visible: dry.visible,
        slots: dry.slots,
        opacity: dry.opacity,
        mean_mm: 0.0,
        max_mm: 0.0,
        coverage: 0.0,
        thumbnail: Arc::new(Thumbnail { width: 1, height: 1, pixels: vec![[0; 4]] }),
    }
}

/// Most lines of an outline: more would be slow to draw.
const MOST_LINES: usize = 20_000;

/// The state of the mask. We make it again only when the mask changes.
#[derive(Debug, Default)]
pub(super) struct Masks {
    made: Option<(Arc<Mask>, Arc<MaskState>)>,
}

impl Masks {
    /// State of `mask`.
    pub(super) fn state(&mut self, mask: Option<&Arc<Mask>>) -> Option<Arc<MaskState>> {
        let mask = mask?;
        if let Some((of, state)) = &self.made
            && Arc::ptr_eq(of, mask)
        {
            return Some(Arc::clone(state));
        }
        let state = Arc::new(state_of(mask));
        self.made = Some((Arc::clone(mask), Arc::clone(&state)));
        Some(state)
    }
}

fn state_of(mask: &Mask) -> MaskState {
    let bounds = mask.bounds();
    let cells = (bounds.width * bounds.height).max(1);
    let mut step = 1;
    let mut outline = mask.outline(step);
    while outline.len() > MOST_LINES {
        step *= 2;
        outline = mask.outline(step);
    }
    MaskState { outline, covered: mask.covered() as f64 / cells as f64 }
}

/// Ground and reference white for films of a painting.
#[derive(Debug, Clone)]
pub(super) struct FilmSetting {
    /// Measured reflectance of the ground at the wavelengths of the library.
    pub(super) ground: Arc<Vec<f64>>,
    /// S of the reference white per mm.
    pub(super) scattering_per_mm: f64,
}

impl Colors {
    /// Films of paint with these heights in mm, by slot and then for the vehicle. Returns `None`
    /// without pigment.
    pub(super) fn swatch(
        &self,
        slots: &Slots,
        heights_mm: &[f64; SLOTS + 1],
        setting: &FilmSetting,
    ) -> Option<BrushSwatch> {
        let filled = slots.iter().zip(heights_mm).filter(|(_, mm)| **mm > 0.0);
        let recipe: Vec<(PigmentId, f64)> =
            filled.filter_map(|(slot, &mm)| Some(((*slot)?, mm))).collect();
        let pigment_mm: f64 = recipe.iter().map(|(_, mm)| mm).sum();
        let shares: Vec<_> = recipe.iter().map(|&(id, mm)| (id, mm / pigment_mm)).collect();
        let mixture: Curves = self.library.mix(&shares).ok()?;
        let cards = Cards::standard(self.library.grid);
        let thickness = pigment_mm * setting.scattering_per_mm;
        let over = |backing: &[f64]| mixture.film(thickness, backing, self.library.film());
        let [black, white] = [over(&cards.black), over(&cards.white)];
        let [dark, light] = [&black, &white].map(|film| self.weights.xyz(film).y);
        Some(BrushSwatch {
            opaque: self.film_color(&mixture.hiding(self.library.saunderson)),
            ground: self.film_color(&setting.ground),
            over_ground: self.film_color(&over(&setting.ground)),
            cards: [&cards.black, &cards.white].map(|card| self.film_color(card)),
            contrast: dark / light.max(f64::MIN_POSITIVE),
            over_cards: [black, white].map(|film| self.film_color(&film)),
            thickness_mm: heights_mm.iter().sum(),
        })
    }

    fn film_color(&self, reflectance: &[f64]) -> FilmColor {
        let Appearance { lab, srgb, .. } =
            Appearance::of(self.weights.xyz(reflectance), self.weights.white());
        FilmColor { lab, srgb: srgb.linear().mapped_into_gamut().encoded().to_bytes() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::backend::Backend;
    use super::super::prepare::{blank_canvas, prepare};
    use super::*;
    use graphics::field::Field;
    use graphics::gpu::BackendChoice;
    use graphics::tile::Rect;
    use paint::amount::{mm_from_quanta, quanta_from_mm};
    use paint::document::{Document, Lighting, Medium};
    use paint::ground::Ground;
    use paint::light::Light;
    use paint::scene::SpectralDocument;
    use paint::strokes::{Action, Squeeze, SurfaceId};
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
        let [tint, masstone] = [&tints, &masstones].map(|colors| colors[2].map(|color| color[1]));
        assert!(tint > masstone, "white lightens");
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

    #[test]
    fn a_layer_that_is_undone_before_its_summary_is_not_asked_for() {
        let origin = blank_canvas(PigmentLibrary::van_gogh_oils(), 4.0, 3.0, 0.1);
        let backend = &mut Backend::new(BackendChoice::Cpu);
        let mut session = prepare(origin, backend, 1 << 24).unwrap().session;
        let heap = Squeeze {
            on: SurfaceId::Canvas,
            recipe: [("Vermilion".to_owned(), 1.0)].into(),
            vehicle: 0.0,
            x_mm: 2.0,
            y_mm: 1.5,
            volume_mm3: 0.5,
        };
        session.apply(&Action::Squeeze(heap)).unwrap();
        session.apply(&Action::Dry { fraction: 1.0 }).unwrap();
        let mut layers = Layers::default();
        layers.update(session.canvas());
        assert!(layers.is_behind());
        session.apply(&Action::Undo {}).unwrap();
        layers.summarize_next(session.canvas_mut()).unwrap();
        assert!(!layers.is_behind() && layers.entries.is_empty());
    }

    #[test]
    fn the_outline_of_a_speckled_mask_stays_short() {
        let bounds = Rect { x: 0, y: 0, width: 401, height: 300 };
        let mask = Arc::new(Mask::with_open(bounds, |cell| (cell * 7919) % 5 == 0));
        assert!(mask.outline(1).len() > MOST_LINES);
        let mut masks = Masks::default();
        let state = masks.state(Some(&mask)).unwrap();
        assert!((1..=MOST_LINES).contains(&state.outline.len()), "{}", state.outline.len());
        assert!((state.covered - 0.8).abs() < 0.01, "{}", state.covered);
        let again = masks.state(Some(&mask)).unwrap();
        assert!(Arc::ptr_eq(&state, &again), "it is made once");
        assert!(masks.state(None).is_none());
    }

    fn colors(illuminant: &str) -> (Colors, Slots) {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, illuminant, "1931-2").unwrap());
        let mut slots = [None; SLOTS];
        slots[1] = library.find("Zinc White").ok();
        slots[4] = library.find("Ultramarine").ok();
        (Colors::new(library, light), slots)
    }

    fn setting(reflectance: f64) -> FilmSetting {
        let count = PigmentLibrary::van_gogh_oils().grid.count();
        FilmSetting { ground: Arc::new(vec![reflectance; count]), scattering_per_mm: 50.0 }
    }

    fn heights(white: f64, blue: f64, vehicle: f64) -> [f64; SLOTS + 1] {
        let mut heights = [0.0; SLOTS + 1];
        (heights[1], heights[4], heights[SLOTS]) = (white, blue, vehicle);
        heights
    }

    #[test]
    fn a_thin_film_shows_what_is_below_and_a_thick_one_hides_it() {
        let (colors, slots) = colors("D65");
        let [thin, thick] = [0.1, 400.0].map(|scale| {
            let paint = heights(0.01 * scale, 0.02 * scale, 0.005 * scale);
            colors.swatch(&slots, &paint, &setting(0.7)).unwrap()
        });
        assert!(thin.contrast < 0.5 && thick.contrast > 0.999, "{thin:?} {thick:?}");
        assert!((thin.thickness_mm - 0.0035).abs() < 1e-12, "{}", thin.thickness_mm);
        let apart = (thick.over_cards[0].lab.lightness - thick.opaque.lab.lightness).abs();
        assert!(apart < 0.01, "{apart}");
        assert_eq!(thin.opaque, thick.opaque, "an opaque film has no thickness");
        let between = thin.over_ground.lab.lightness;
        assert!(between > thin.opaque.lab.lightness && between < thin.ground.lab.lightness);
    }

    #[test]
    fn a_film_over_the_ground_is_the_one_that_the_painting_shows() {
        let (colors, slots) = colors("A");
        let library = PigmentLibrary::van_gogh_oils();
        let quanta = [300_u32, 900];
        let cell_mm = 0.1;
        let setting = setting(0.62);
        let medium = Medium { scattering_per_mm: setting.scattering_per_mm, ..Medium::default() };
        let ground = Ground {
            name: "test".to_owned(),
            height: Field::filled(1, 1, 0),
            reflectance: setting.ground.to_vec(),
            gloss: paint::optics::Gloss { strength: 0.0, exponent: 10.0 },
        };
        let mut document =
            Document::bare("", cell_mm, ground, library, medium, slots, Lighting::default());
        let mut cell = document.wet.cell(0);
        (cell.pigments[1], cell.pigments[4]) = (quanta[0], quanta[1]);
        cell.vehicle = quanta_from_mm(0.2, cell_mm);
        document.wet.set_cell(0, cell);
        let wanted = SpectralDocument::full(&document).measured_reflectance(0, 0);
        let mm = quanta.map(|quanta| mm_from_quanta(1, cell_mm) * f64::from(quanta));
        let swatch = colors.swatch(&slots, &heights(mm[0], mm[1], 0.2), &setting).unwrap();
        let wanted = colors.film_color(&wanted).lab.to_array();
        for (found, wanted) in swatch.over_ground.lab.to_array().into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{swatch:?} {wanted:?}");
        }
    }

    #[test]
    fn the_swatch_follows_the_light_and_medium_alone_has_none() {
        let paint = heights(0.02, 0.01, 0.0);
        let [day, lamp] = ["D65", "A"].map(|light| {
            let (colors, slots) = colors(light);
            colors.swatch(&slots, &paint, &setting(0.7)).unwrap().opaque.lab
        });
        assert_ne!(day, lamp);
        let (colors, slots) = colors("D65");
        assert_eq!(colors.swatch(&slots, &heights(0.0, 0.0, 0.3), &setting(0.7)), None);
    }
}
