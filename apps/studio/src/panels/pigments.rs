//! Pigment lists and cards that several panels share, and the window that replaces a pigment in
//! paint.

use std::sync::{Arc, OnceLock};

use eframe::egui::{
    Align, ComboBox, Context, Key, Rect, RichText, ScrollArea, TextStyle, Ui, vec2,
};
use paint::document::Slots;
use paint::light::Light;
use paint::strokes::{Action, LayerRef};
use pigment::PigmentId;
use pigment::library::PigmentLibrary;
use pigment::palette::{
    Appearance, Cards, Hides, Palette, TINT_PARTS, hiding_powers, tinting_strengths,
};
use session::{LayerState, PaintingState};

use crate::chart::{Chart, Curve};
use crate::language::{layer_label, tr, tr_format};
use crate::panels::PanelContext;
use crate::panels::controls::{self, Highlight, between, mark, millimetres, patch, row, text};
use crate::{floating, theme};

/// Colour of one pigment, alone and as a tint.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PigmentColors {
    pub(super) masstone: Vec<f64>,
    /// Reflectance of one part in nine parts of white (or water); `None` if the scattering is
    /// unknown.
    pub(super) tint: Option<Vec<f64>>,
    /// 8-bit sRGB of the masstone.
    pub(super) masstone_srgb: [u8; 3],
    pub(super) tint_srgb: Option<[u8; 3]>,
}

/// Hiding power and tinting strength of one pigment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct PaintStrength {
    pub(super) hides: Option<Hides>,
    /// Tinting strength in percent of the strongest in the library; `None` for the white.
    pub(super) tints_percent: Option<f64>,
}

#[derive(Debug)]
pub(super) struct Catalogue {
    pub(super) library: Arc<PigmentLibrary>,
    light: Arc<Light>,
    colors: Vec<PigmentColors>,
    /// Strengths in the order of the library. We compute them on first use, because they take
    /// longer than the colours.
    strengths: OnceLock<Vec<PaintStrength>>,
}

impl Catalogue {
    fn new(library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> Self {
        let colors = colors(library, light);
        let library = Arc::clone(library);
        let light = Arc::clone(light);
        Self { library, light, colors, strengths: OnceLock::new() }
    }

    fn is_of(&self, library: &Arc<PigmentLibrary>, light: &Arc<Light>) -> bool {
        Arc::ptr_eq(&self.library, library) && Arc::ptr_eq(&self.light, light)
    }

    pub(super) fn colors(&self, pigment: PigmentId) -> &PigmentColors {
        &self.colors[pigment.index()]
    }

    pub(super) fn name(&self, pigment: PigmentId) -> &str {
        &self.library[pigment].name
    }

    pub(super) fn strength(&self, pigment: PigmentId) -> PaintStrength {
        self.strengths.get_or_init(|| strengths(&self.library, &self.light))[pigment.index()]
    }

    /// The smallest height in mm at which a film of the pigment hides its ground, as text, or
    /// `never` or `not known`.
    pub(super) fn hiding(&self, pigment: PigmentId, scattering_per_mm: f64) -> String {
        match self.strength(pigment).hides {
            Some(Hides::From(thickness)) => millimetres(thickness / scattering_per_mm),
            Some(Hides::Never { .. }) => tr("never").to_owned(),
            None => tr("not known").to_owned(),
        }
    }
}

fn colors(library: &PigmentLibrary, light: &Light) -> Vec<PigmentColors> {
    let weights = light
        .viewing
        .weights(library.grid)
        .expect("the tristimulus method fits every library grid");
    let srgb = |reflectance: &[f64]| {
        let encoded = Appearance::of(weights.xyz(reflectance), weights.white()).srgb;
        encoded.0.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
    };
    let palette = Palette::new(library, &light.viewing, Cards::standard(library.grid)).ok();
    library
        .ids()
        .map(|pigment| {
            let alone = library.mix([(pigment, 1.0)]).expect("one part is a mixture");
            let masstone = alone.hiding(library.saunderson);
            let palette = palette.as_ref().filter(|_| library[pigment].identified);
            let tint = palette.map(|p| p.reflectance(&p.tint(pigment, TINT_PARTS)));
            let masstone_srgb = srgb(&masstone);
            let tint_srgb = tint.as_deref().map(srgb);
            PigmentColors { masstone, tint, masstone_srgb, tint_srgb }
        })
        .collect()
}

fn strengths(library: &PigmentLibrary, light: &Light) -> Vec<PaintStrength> {
    let mut strengths = vec![PaintStrength::default(); library.pigments.len()];
    let Ok(palette) = Palette::new(library, &light.viewing, Cards::standard(library.grid)) else {
        return strengths;
    };
    for power in hiding_powers(&palette) {
        strengths[power.paint.index()].hides = Some(power.hides);
    }
    for strength in tinting_strengths(&palette, None) {
        strengths[strength.paint.index()].tints_percent = Some(strength.percent);
    }
    strengths
}

/// Cached catalogue for the painting's library and light.
#[derive(Debug, Clone, Default)]
pub(super) struct CatalogueCache(Option<Arc<Catalogue>>);

impl CatalogueCache {
    /// Returns the catalogue. If library or light changed, this recomputes it.
    pub(super) fn get(&mut self, painting: &PaintingState) -> Arc<Catalogue> {
        self.under(&painting.library, &painting.light)
    }

    /// The catalogue of a library under a light. If these changed, this recomputes it.
    pub(super) fn under(
        &mut self,
        library: &Arc<PigmentLibrary>,
        light: &Arc<Light>,
    ) -> Arc<Catalogue> {
        match &self.0 {
            Some(known) if known.is_of(library, light) => Arc::clone(known),
            _ => Arc::clone(self.0.insert(Arc::new(Catalogue::new(library, light)))),
        }
    }
}

const LIST: f32 = 300.0;

/// The search text.
#[derive(Debug, Clone, Default)]
pub(super) struct PigmentList {
    search: String,
    highlight: Highlight,
}

impl PigmentList {
    /// Draws the list. `disabled_reason` says why you cannot choose a pigment. Returns the pigment
    /// that you clicked or took with Enter.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        catalogue: &Catalogue,
        scattering_per_mm: f64,
        disabled_reason: impl Fn(PigmentId) -> Option<String>,
    ) -> Option<PigmentId> {
        let id = ui.scope_id().with("search of a pigment");
        self.highlight.read_arrows(ui, ui.memory(|memory| memory.has_focus(id)));
        let field = theme::text_field(&mut self.search)
            .id(id)
            .hint_text(tr("name or colour index"))
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name(tr("Search")).on_hover_text(tr(
            "Lists only pigments whose name or colour index contains this text. Enter takes the \
             marked one, arrows move the mark",
        ));
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let searches = field.has_focus() || entered;
        heads(ui, catalogue);
        let pigments = catalogue.library.ids();
        let mut found: Vec<PigmentId> =
            pigments.filter(|&pigment| self.finds(catalogue, pigment)).collect();
        controls::sort(&mut found, &self.search, |&pigment| catalogue.name(pigment));
        let marked = self.highlight.among(&self.search, found.len());
        let moved = std::mem::take(&mut self.highlight.moved);
        if found.is_empty() {
            ui.weak(tr_format!("no pigment of {title} matches", title = catalogue.library.title));
        }
        let mut chosen = None;
        let list = ScrollArea::vertical().max_height(LIST).min_scrolled_height(LIST);
        list.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for (line, pigment) in found.into_iter().enumerate() {
                let why = disabled_reason(pigment);
                ui.add_enabled_ui(why.is_none(), |ui| {
                    let response = row(ui, 24.0, catalogue.name(pigment), false);
                    draw(ui, response.rect, catalogue, pigment, scattering_per_mm);
                    let marked = searches && line == marked;
                    if marked {
                        mark(ui, &response, moved);
                    }
                    if response.clicked() || (marked && entered && why.is_none()) {
                        chosen = Some(pigment);
                    }
                    response
                        .on_hover_ui(|ui| card(ui, catalogue, pigment, scattering_per_mm))
                        .on_disabled_hover_text(why.unwrap_or_default());
                });
            }
        });
        chosen
    }

    fn finds(&self, catalogue: &Catalogue, pigment: PigmentId) -> bool {
        let wanted = self.search.trim().to_lowercase();
        let pigment = &catalogue.library[pigment];
        let index = pigment.color_index.as_deref().unwrap_or_default();
        pigment.name.to_lowercase().contains(&wanted) || index.to_lowercase().contains(&wanted)
    }
}

fn places(rect: Rect) -> [Rect; 4] {
    let inner = rect.shrink2(vec2(4.0, 3.0));
    let left = inner.left();
    let right = inner.right();
    [
        between(inner, left, left + 40.0),
        between(inner, left + 48.0, right - 128.0),
        between(inner, right - 124.0, right - 72.0),
        between(inner, right - 68.0, right),
    ]
}

fn heads(ui: &mut Ui, catalogue: &Catalogue) {
    let (rect, _) =
        ui.allocate_exact_size(vec2(ui.available_width(), 16.0), eframe::egui::Sense::hover());
    let [_, name, index, hides] = places(rect);
    let any_marked = catalogue.library.ids().any(|p| !remark(catalogue, p).is_empty());
    for (place, align, words) in [
        (name, Align::Min, tr("pigment")),
        (index, Align::Min, if any_marked { tr("index") } else { "" }),
        (hides, Align::Max, tr("hides from")),
    ] {
        text(
            ui,
            place.expand2(vec2(0.0, 3.0)),
            align,
            TextStyle::Small,
            theme::colors(ui.ctx()).faint,
            words,
        );
    }
}

fn draw(ui: &Ui, rect: Rect, catalogue: &Catalogue, pigment: PigmentId, scattering_per_mm: f64) {
    let [swatch, name, index, hides] = places(rect);
    let color =
        if ui.is_enabled() { theme::colors(ui.ctx()).text } else { theme::colors(ui.ctx()).faint };
    let colors = catalogue.colors(pigment);
    let (full, tint) = swatch.split_left_right_at_fraction(0.55);
    // A disabled row must not change the colour of its swatch.
    let mut painter = ui.painter().clone();
    painter.set_opacity(1.0);
    patch(&painter, tint, colors.tint_srgb);
    patch(&painter, full, Some(colors.masstone_srgb));
    text(ui, name, Align::Min, TextStyle::Body, color, catalogue.name(pigment));
    let marked = remark(catalogue, pigment);
    text(ui, index, Align::Min, TextStyle::Small, theme::colors(ui.ctx()).faint, marked);
    let words = catalogue.hiding(pigment, scattering_per_mm);
    text(ui, hides, Align::Max, TextStyle::Small, theme::colors(ui.ctx()).faint, &words);
}

/// The colour index, or `guessed` for a pigment that was not measured.
fn remark(catalogue: &Catalogue, pigment: PigmentId) -> &str {
    let known = &catalogue.library[pigment];
    match (&known.color_index, known.guessed) {
        (Some(index), _) => index,
        (None, true) => tr("guessed"),
        (None, false) => "",
    }
}

const WIDTH: f32 = 280.0;

/// Draws name, colour index, reflectance of masstone and tint, hiding power, tinting
/// strength and notes of a pigment.
pub(super) fn card(ui: &mut Ui, catalogue: &Catalogue, pigment: PigmentId, scattering_per_mm: f64) {
    let known = &catalogue.library[pigment];
    ui.set_max_width(WIDTH);
    ui.horizontal(|ui| {
        ui.label(RichText::new(&known.name).strong());
        if let Some(index) = &known.color_index {
            ui.weak(index);
        }
    });
    let grid = catalogue.library.grid;
    let colors = catalogue.colors(pigment);
    let mut curves =
        vec![Curve::new(tr("full"), grid, &colors.masstone).colored(colors.masstone_srgb)];
    if let (Some(tint), Some(srgb)) = (&colors.tint, colors.tint_srgb) {
        curves.push(Curve::new(tr("one in ten"), grid, tint).colored(srgb));
    }
    let chart = Chart { curves: &curves, marks: &[], quantity: tr("reflectance"), max: Some(1.0) };
    chart.show(ui, vec2(WIDTH, 120.0));
    for line in lines(catalogue, pigment, scattering_per_mm) {
        ui.label(line);
    }
    for note in &known.notes {
        ui.weak(note);
    }
}

fn lines(catalogue: &Catalogue, pigment: PigmentId, scattering_per_mm: f64) -> Vec<String> {
    let known = &catalogue.library[pigment];
    let power = catalogue.strength(pigment);
    let mut lines = vec![match power.hides {
        Some(Hides::From(thickness)) => {
            tr_format!("hides from {height}", height = millimetres(thickness / scattering_per_mm))
        }
        Some(Hides::Never { contrast }) => {
            tr_format!(
                "hides at no height (contrast {contrast:.0} % at max)",
                contrast = 100.0 * contrast
            )
        }
        None => tr("hiding power not known").to_owned(),
    }];
    if let Some(percent) = power.tints_percent {
        lines.push(tr_format!(
            "tinting strength {percent:.0} % of the library's strongest",
            percent
        ));
    }
    if known.guessed {
        lines.push(tr("guessed from a colour, not measured").to_owned());
    }
    if !known.identified {
        lines.push(tr("scattering not identified: mixtures with it are a guess").to_owned());
    }
    lines
}

const EXCHANGE_WIDTH: f32 = 380.0;

/// The layers in which we replace a pigment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ExchangeScope {
    /// All layers with the pigment.
    AllLayers,
    Layer(LayerRef),
}

/// State of the window: layers, pigment to replace, and list of replacements.
#[derive(Debug, Clone)]
pub(super) struct Exchange {
    open: bool,
    from: PigmentId,
    scope: ExchangeScope,
    list: PigmentList,
}

impl Default for Exchange {
    fn default() -> Self {
        Self {
            open: false,
            from: PigmentId(0),
            scope: ExchangeScope::AllLayers,
            list: PigmentList::default(),
        }
    }
}

impl Exchange {
    /// Opens the window for a pigment.
    pub(super) fn open(&mut self, from: PigmentId, scope: ExchangeScope) {
        *self = Self { open: true, from, scope, ..Self::default() };
    }

    /// Draws the window if it is open, and queues the exchange.
    pub(super) fn show(
        &mut self,
        context: &Context,
        id: &str,
        catalogue: &Catalogue,
        cx: &mut PanelContext<'_>,
    ) {
        if self.open && !self.is_valid(cx.painting) {
            self.open = false;
        }
        let mut open = self.open;
        let chosen = floating::show(context, tr("Exchange a pigment"), id, &mut open, |ui| {
            ui.set_width(EXCHANGE_WIDTH);
            self.contents(ui, catalogue, cx.painting)
        });
        self.open = open;
        if let Some(to) = chosen.flatten() {
            for layer in layers(cx.painting, self.scope, self.from, to) {
                let [from, to] = [self.from, to].map(|pigment| catalogue.name(pigment).to_owned());
                cx.act(Action::Swap { layer, from, to });
            }
            self.open = false;
        }
    }

    /// Whether the layer and its pigment still exist.
    fn is_valid(&self, painting: &PaintingState) -> bool {
        pigments(painting, self.scope).contains(&self.from)
    }

    fn contents(
        &mut self,
        ui: &mut Ui,
        catalogue: &Catalogue,
        painting: &PaintingState,
    ) -> Option<PigmentId> {
        ui.horizontal(|ui| {
            ui.label(tr("In"));
            let tip = tr("Layers in which the pigment is replaced");
            let shown =
                ComboBox::from_id_salt("scope").selected_text(scope_name(painting, self.scope));
            let scopes = shown.show_ui(ui, |ui| {
                for scope in all_scopes(painting) {
                    ui.selectable_value(&mut self.scope, scope, scope_name(painting, scope))
                        .on_hover_text(tip);
                }
            });
            scopes.response.accessible_name(tr("In")).on_hover_text(tip);
            let here = pigments(painting, self.scope);
            if !here.contains(&self.from) {
                self.from = here.first().copied().unwrap_or(self.from);
            }
            ui.label(tr("exchange"));
            let tip = tr("The pigment to replace");
            let shown = ComboBox::from_id_salt("from").width(150.0);
            let shown = shown.selected_text(catalogue.name(self.from));
            let from = shown.show_ui(ui, |ui| {
                for pigment in here {
                    let name = catalogue.name(pigment);
                    ui.selectable_value(&mut self.from, pigment, name).on_hover_text(tip);
                }
            });
            from.response.accessible_name(tr("Exchange")).on_hover_text(tip);
        });
        ui.label(tr("for"));
        let scope = self.scope;
        let from = self.from;
        self.list.show(ui, catalogue, painting.medium.scattering_per_mm, |to| {
            if to == from {
                Some(tr("it is the pigment to replace").to_owned())
            } else if layers(painting, scope, from, to).is_empty() {
                Some(tr("every such layer already has it").to_owned())
            } else {
                None
            }
        })
    }
}

fn scope_name(painting: &PaintingState, scope: ExchangeScope) -> String {
    match scope {
        ExchangeScope::AllLayers => tr("all layers").to_owned(),
        ExchangeScope::Layer(LayerRef::Wet) => tr("the wet layer").to_owned(),
        ExchangeScope::Layer(layer) => match state(painting, layer) {
            Some(state) => layer_label(&state.label()),
            None => tr("no layer").to_owned(),
        },
    }
}

fn all_scopes(painting: &PaintingState) -> Vec<ExchangeScope> {
    let dry = painting.layers.iter().rev();
    let dry = dry.map(|layer| ExchangeScope::Layer(LayerRef::Id(layer.id)));
    [ExchangeScope::AllLayers, ExchangeScope::Layer(LayerRef::Wet)].into_iter().chain(dry).collect()
}

fn state(painting: &PaintingState, layer: LayerRef) -> Option<&LayerState> {
    match layer {
        LayerRef::Wet => None,
        LayerRef::Dry(index) => painting.layers.get(index),
        LayerRef::Id(id) => painting.layers.iter().find(|layer| layer.id == id),
    }
}

fn slots(painting: &PaintingState, layer: LayerRef) -> Slots {
    match layer {
        LayerRef::Wet => painting.slots,
        _ => state(painting, layer).map_or([None; 8], |layer| layer.slots),
    }
}

fn scope_layers(painting: &PaintingState, scope: ExchangeScope) -> Vec<LayerRef> {
    match scope {
        ExchangeScope::Layer(layer) => vec![layer],
        ExchangeScope::AllLayers => {
            let dry = painting.layers.iter().map(|layer| LayerRef::Id(layer.id));
            dry.chain([LayerRef::Wet]).collect()
        }
    }
}

/// Pigments of the given layers in slot order, without duplicates.
fn pigments(painting: &PaintingState, scope: ExchangeScope) -> Vec<PigmentId> {
    let mut found = Vec::new();
    let layers = scope_layers(painting, scope);
    for pigment in layers.into_iter().flat_map(|layer| slots(painting, layer)).flatten() {
        if !found.contains(&pigment) {
            found.push(pigment);
        }
    }
    found
}

/// Layers in which you can replace `from` by `to`: they contain `from` and not `to`.
fn layers(
    painting: &PaintingState,
    scope: ExchangeScope,
    from: PigmentId,
    to: PigmentId,
) -> Vec<LayerRef> {
    let mut found = scope_layers(painting, scope);
    found.retain(|&layer| {
        let slots = slots(painting, layer);
        slots.contains(&Some(from)) && !slots.contains(&Some(to))
    });
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use paint::light::Light;
    use pigment::library::PigmentLibrary;
    use pigment::palette::{Cards, Palette, hiding_powers};
    use std::sync::Arc;

    #[test]
    fn the_catalogue_is_rebuilt_only_for_a_new_library_or_light() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "D65", "1931-2").unwrap());
        let mut known = CatalogueCache::default();
        let first = known.under(&library, &light);
        assert!(Arc::ptr_eq(&first, &known.under(&library, &light)), "nothing changed");
        let other = Arc::new(light.as_ref().clone());
        assert!(!Arc::ptr_eq(&first, &known.under(&library, &other)), "another light");

        let [white, blue] = ["Zinc White", "Prussian Blue"].map(|n| library.find(n).unwrap());
        let [white, blue] = [white, blue].map(|pigment| first.colors(pigment));
        let [white_sum, blue_sum, tint_sum] =
            [white.masstone_srgb, blue.masstone_srgb, blue.tint_srgb.unwrap()]
                .map(|srgb| srgb.map(u32::from).iter().sum::<u32>());
        assert!(white_sum > 690, "{white:?}");
        assert!(blue_sum < tint_sum, "a tint is lighter");
    }

    #[test]
    fn a_card_shows_the_figures_of_the_library() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let light = Arc::new(Light::named(&library, "D65", "1931-2").unwrap());
        let catalogue = Catalogue::new(&library, &light);
        let [card, blue, unknown] = ["Zinc White", "Prussian Blue", "Chrome Yellow (poppyseed)"]
            .map(|name| lines(&catalogue, library.find(name).unwrap(), 50.0));

        let palette = Palette::new(&library, &light.viewing, Cards::standard(library.grid));
        let white = library.find("Zinc White").unwrap();
        let strengths = hiding_powers(&palette.unwrap());
        let own = strengths.iter().find(|power| power.paint == white).unwrap();
        let mm = own.hides.thickness().unwrap() / 50.0;
        assert_eq!(card, [format!("hides from {}", millimetres(mm))]);
        assert!(blue[1].starts_with("tinting strength "), "{blue:?}");
        assert_eq!(unknown[0], "hiding power not known");
        assert!(unknown[1].contains("not identified"), "{unknown:?}");
    }
}
