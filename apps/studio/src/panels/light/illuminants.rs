//! Control of one illuminant: a list of the CIE illuminants with a search field, a slider of colour
//! temperature (CIE daylight, or a black body below 4000 K), and a chart of the spectral power.

use std::path::Path;

use eframe::egui::{
    Align, Align2, Button, Color32, Key, Label, Layout, Popup, PopupCloseBehavior, Response,
    RichText, ScrollArea, Shape, Slider, Stroke, Ui, vec2,
};
use paint::light::Light;
use spectra::{ColorTemperature, Illuminant, light_from_text};

use super::super::context::Edit;
use super::super::controls::{self, Highlight, mark, touch_padding};
use crate::chart::{BAND_NM, Chart, Curve};
use crate::language::{tr, tr_format};
use crate::theme;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Daylight phases and their indoor versions.
    Daylight,
    /// Incandescent (tungsten) lamps.
    Incandescent,
    /// Fluorescent tubes of the FL series.
    Fluorescent,
    Discharge,
    /// White LED lamps.
    Led,
    /// Theoretical illuminants, e.g. E.
    Reference,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Daylight => "Daylight",
            Self::Incandescent => "Incandescent",
            Self::Fluorescent => "Fluorescent",
            Self::Discharge => "High-pressure discharge",
            Self::Led => "LED",
            Self::Reference => "Reference",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ListedIlluminant {
    /// Name of the illuminant in `spectra`.
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    /// Short description, from CIE 15:2018.
    pub(super) note: &'static str,
}

impl ListedIlluminant {
    /// Whether name, kind or note contain every word of `search`, ignoring case.
    pub(super) fn matches(&self, search: &str) -> bool {
        let text = format!("{} {} {}", self.name, self.kind.name(), self.note).to_lowercase();
        search.to_lowercase().split_whitespace().all(|word| text.contains(word))
    }
}

/// All illuminants of `spectra`, grouped by kind, each group in the CIE's order.
pub(super) fn listed_illuminants() -> Vec<ListedIlluminant> {
    let mut lamps: Vec<ListedIlluminant> = Illuminant::names()
        .map(|name: &'static str| {
            let (kind, note) = description(name);
            ListedIlluminant { name, kind, note }
        })
        .collect();
    lamps.sort_by_key(|lamp| lamp.kind);
    lamps
}

fn description(name: &str) -> (Kind, &'static str) {
    let number = |prefix: &str| name.strip_prefix(prefix).and_then(|rest| rest.parse::<u32>().ok());
    if let Some(of_third_set) = number("FL3.") {
        let note = match of_third_set {
            1..=3 => "halophosphate tube",
            4..=6 => "de luxe tube",
            7..=11 => "three-band tube",
            12..=14 => "multi-band tube",
            _ => "daylight simulator tube",
        };
        return (Kind::Fluorescent, note);
    }
    if let Some(of_first_set) = number("FL") {
        let note = match of_first_set {
            1..=6 => "standard tube",
            7..=9 => "broad-band tube",
            _ => "three-band tube",
        };
        return (Kind::Fluorescent, note);
    }
    match name {
        "A" => (Kind::Incandescent, "tungsten filament, 2856 K"),
        "B" => (Kind::Daylight, "noon sun, withdrawn"),
        "C" => (Kind::Daylight, "average daylight, withdrawn"),
        "D50" => (Kind::Daylight, "horizon light, graphic arts"),
        "D55" => (Kind::Daylight, "mid-morning, photography"),
        "D60" => (Kind::Daylight, "cinema white"),
        "D65" => (Kind::Daylight, "noon daylight, the usual reference"),
        "D75" => (Kind::Daylight, "north sky"),
        "ID50" => (Kind::Daylight, "D50 through a window pane"),
        "ID65" => (Kind::Daylight, "D65 through a window pane"),
        "E" => (Kind::Reference, "equal power at every wavelength"),
        "HP1" => (Kind::Discharge, "high-pressure sodium"),
        "HP2" => (Kind::Discharge, "colour-enhanced high-pressure sodium"),
        "HP3" | "HP4" | "HP5" => (Kind::Discharge, "metal halide"),
        "LED-BH1" => (Kind::Led, "blue LED with phosphor, and a red LED"),
        "LED-RGB1" => (Kind::Led, "red, green and blue LEDs"),
        "LED-V1" | "LED-V2" => (Kind::Led, "violet LED with phosphors"),
        _ if name.starts_with("LED-B") => (Kind::Led, "blue LED with phosphor"),
        _ => (Kind::Reference, ""),
    }
}

/// Position of the slider for a light without a colour temperature, in kelvin.
const USUAL_KELVIN: f64 = 6500.0;

/// Controls that choose one illuminant.
#[derive(Debug)]
pub(in crate::panels) struct IlluminantControl {
    picker: Picker,
    temperature_name: &'static str,
    temperature: Temperature,
    /// Name and colour temperature (in kelvin) of the light that we showed last.
    known: (String, f64),
}

impl IlluminantControl {
    pub(in crate::panels) fn new(name: &'static str, temperature_name: &'static str) -> Self {
        Self {
            picker: Picker::new(name),
            temperature_name,
            temperature: Temperature::default(),
            known: (String::new(), USUAL_KELVIN),
        }
    }

    /// Draws the controls. Returns the name of the chosen illuminant.
    pub(in crate::panels) fn show(&mut self, ui: &mut Ui, chosen: &str) -> Option<String> {
        if self.known.0 != chosen {
            let light = light_from_text(chosen).ok();
            let temperature = light.as_ref().and_then(ColorTemperature::of);
            let kelvin = temperature.map_or(USUAL_KELVIN, |temperature| temperature.kelvin);
            self.known = (chosen.to_owned(), kelvin);
        }
        let picked = self.picker.show(ui, chosen);
        picked.or(self.temperature.show(ui, tr(self.temperature_name), self.known.1))
    }

    /// While you move the slider, this is the name of its illuminant.
    pub(in crate::panels) fn preview(&self) -> Option<String> {
        self.temperature.preview()
    }
}

#[derive(Debug)]
pub(super) struct Picker {
    name: &'static str,
    lamps: Vec<ListedIlluminant>,
    search: String,
    highlight: Highlight,
}

impl Picker {
    pub(super) fn new(name: &'static str) -> Self {
        let lamps = listed_illuminants();
        let highlight = Highlight::default();
        Self { name, lamps, search: String::new(), highlight }
    }

    /// Draws the button with the chosen illuminant, and the list while it is open. Returns the name
    /// that you picked.
    pub(super) fn show(&mut self, ui: &mut Ui, chosen: &str) -> Option<String> {
        let text = short(chosen);
        let width = ui.available_width();
        let button = Button::new(text.clone()).right_text("   ").truncate();
        let response = ui.add_sized([width, ui.spacing().interact_size.y], button);
        let tip = response.rect.right_center() - vec2(13.0, -2.5);
        let corners = vec![tip, tip + vec2(-4.0, -5.0), tip + vec2(4.0, -5.0)];
        ui.painter().add(Shape::convex_polygon(
            corners,
            theme::colors(ui.ctx()).faint,
            Stroke::NONE,
        ));
        response.widget_info(|| {
            let label = format!("{}: {text}", tr(self.name));
            eframe::egui::WidgetInfo::labeled(eframe::egui::Role::Button, true, label)
        });
        let response = response.on_hover_text(self.hover(chosen));
        let mut picked = None;
        let opened = response.clicked();
        Popup::menu(&response)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .width(width.max(260.0))
            .show(|ui| picked = self.list(ui, chosen, opened));
        if picked.is_some() {
            self.search.clear();
        }
        picked
    }

    fn hover(&self, chosen: &str) -> String {
        let lamp = self.lamps.iter().find(|lamp| lamp.name.eq_ignore_ascii_case(chosen));
        let note = lamp.map_or_else(String::new, |lamp| format!(": {}", lamp.note));
        tr_format!(
            "{name}: {chosen}{note}. Click to choose another",
            name = tr(self.name),
            chosen,
            note
        )
    }

    fn list(&mut self, ui: &mut Ui, chosen: &str, opened: bool) -> Option<String> {
        let id = ui.scope_id().with("search of a light");
        self.highlight.read_arrows(ui, ui.memory(|memory| memory.has_focus(id)));
        let field = theme::text_field(&mut self.search)
            .id(id)
            .hint_text(tr("Search, or 3200K, D5600K"))
            .desired_width(f32::INFINITY)
            .align(Align2::LEFT_CENTER);
        let field = ui.add(field).on_hover_text(
            tr("Words of a light's name or kind; a temperature, such as 3200K for a black body or D5600K for \
             daylight; or the path of a lamp's file. Enter takes the marked one, arrows move the mark"),
        );
        if opened {
            field.request_focus();
        }
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let mut found: Vec<ListedIlluminant> =
            self.lamps.iter().copied().filter(|lamp| lamp.matches(&self.search)).collect();
        controls::sort(&mut found, &self.search, |lamp| lamp.name);
        let marked = self.highlight.among(&self.search, found.len());
        let typed = self.search.trim();
        let typed = (found.is_empty() && light_from_text(typed).is_ok()).then(|| typed.to_owned());
        let mut picked = None;
        if entered {
            picked = typed.clone().or(found.get(marked).map(|lamp| lamp.name.to_owned()));
        }
        if let Some(typed) = &typed
            && ui
                .button(tr_format!("Take {typed}", typed = short(typed)))
                .on_hover_text(tr("As typed"))
                .clicked()
        {
            picked = Some(typed.clone());
        }
        if found.is_empty() && typed.is_none() {
            ui.weak(tr("No such light"));
        }
        let moved = std::mem::take(&mut self.highlight.moved);
        ScrollArea::vertical().max_height(360.0).show(ui, |ui| {
            let mut kind: Option<Kind> = None;
            for (line, lamp) in found.iter().enumerate() {
                // Search results are sorted by match and not by kind.
                if self.search.trim().is_empty() && kind.replace(lamp.kind) != Some(lamp.kind) {
                    ui.add_space(3.0);
                    let name = RichText::new(lamp.kind.name()).small();
                    ui.label(name.color(theme::colors(ui.ctx()).faint));
                }
                let chosen = lamp.name.eq_ignore_ascii_case(chosen);
                let response = entry(ui, lamp, chosen);
                if line == marked {
                    mark(ui, &response, moved);
                }
                if response.clicked() {
                    picked = Some(lamp.name.to_owned());
                }
            }
        });
        if picked.is_some() {
            ui.close();
        }
        picked
    }
}

fn entry(ui: &mut Ui, lamp: &ListedIlluminant, chosen: bool) -> Response {
    let colors = theme::colors(ui.ctx());
    let note_color = if chosen { colors.text } else { colors.faint };
    let note = RichText::new(lamp.note).small().color(note_color);
    let line = Button::selectable(chosen, lamp.name).right_text(note);
    let response = ui.with_layout(Layout::top_down_justified(Align::Min), |ui| ui.add(line)).inner;
    let enabled = response.enabled();
    response.widget_info(|| {
        eframe::egui::WidgetInfo::selected(eframe::egui::Role::Button, enabled, chosen, lamp.name)
    });
    response.on_hover_ui(|ui| {
        ui.label(format!("{}: {}", lamp.name, lamp.note));
        let temperature = Illuminant::named(lamp.name).ok().as_ref().map(ColorTemperature::of);
        if let Some(Some(temperature)) = temperature {
            ui.label(format!("{:.0} K  Duv {:+.4}", temperature.kelvin, temperature.duv));
        }
    })
}

/// Short name of a light: the file name if it is a path.
pub(super) fn short(illuminant: &str) -> String {
    let path = Path::new(illuminant);
    match path.file_name() {
        Some(name) if path.components().count() > 1 => name.to_string_lossy().into_owned(),
        _ => illuminant.to_owned(),
    }
}

/// Lowest temperature of CIE daylight, in kelvin (CIE 15:2018).
const DAYLIGHT_FROM: f64 = 4000.0;

/// Range of the slider, in kelvin.
const KELVIN: (f64, f64) = (1500.0, 25000.0);

/// The temperature is applied this many seconds after the last key press.
const PAUSE: f64 = 0.5;

/// The slider with a temperature that is not applied yet.
#[derive(Debug, Default)]
pub(super) struct Temperature {
    waiting: Option<(f64, Option<f64>)>,
}

impl Temperature {
    /// Name in `spectra` of the light that you are setting.
    pub(super) fn preview(&self) -> Option<String> {
        self.waiting.map(|(kelvin, _)| light(kelvin))
    }

    /// Draws the slider. `kelvin` is the temperature of the current light. Returns the name of the
    /// chosen light once you release the slider or press no key for a while.
    pub(super) fn show(&mut self, ui: &mut Ui, name: &str, kelvin: f64) -> Option<String> {
        let now = ui.input(|input| input.time);
        let mut value = self.waiting.map_or(kelvin, |(waiting, _)| waiting);
        let slider = Slider::new(&mut value, KELVIN.0..=KELVIN.1)
            .logarithmic(true)
            .smart_aim(false)
            .custom_formatter(|kelvin, _| format!("{:.0}", rounded(kelvin)))
            .suffix(" K")
            .update_while_editing(false);
        let response = labelled_slider(ui, tr("Temperature"), slider).accessible_name(name).on_hover_text(
            tr("Temperature of the light: daylight from 4000 K, a black body below. Applied on release"),
        );
        let value = rounded(value);
        match Edit::of(&response) {
            Edit::Dragged => self.waiting = Some((value, None)),
            Edit::Released => {
                self.waiting = None;
                return Some(light(value));
            }
            Edit::Set => {
                self.waiting = Some((value, Some(now)));
            }
            Edit::None => {}
        }
        let (value, since) = self.waiting?;
        let since = since?;
        if now >= since + PAUSE {
            self.waiting = None;
            return Some(light(value));
        }
        ui.ctx().request_repaint_after_secs((since + PAUSE - now) as f32);
        None
    }
}

/// Rounds to just visible steps: 10 K below 10000 K, else 100 K.
fn rounded(kelvin: f64) -> f64 {
    let step = if kelvin < 10000.0 { 10.0 } else { 100.0 };
    (kelvin / step).round() * step
}

/// Name of a light in `spectra`, e.g. `D5600K` for daylight or `3200K` for a black body.
fn light(kelvin: f64) -> String {
    if kelvin < DAYLIGHT_FROM { format!("{kelvin}K") } else { format!("D{kelvin}K") }
}

/// Distance between the points of a curve, in nm.
const STEP_NM: usize = 2;

/// Height of the chart in a panel lower than [`ROOMY`], in points. In any other it is [`HIGH`].
const LOW: f32 = 76.0;
const HIGH: f32 = 120.0;

/// From this height on, a panel counts as high, in points.
const ROOMY: f32 = 520.0;

/// Draws the current light with its quadrature wavelengths, and other lights in their colours. We
/// scale all curves to mean 1.
pub(in crate::panels) fn power_chart(ui: &mut Ui, light: &Light, others: &[(Illuminant, Color32)]) {
    let mut curves: Vec<Curve> =
        others.iter().map(|(other, color)| curve(other, Some(*color))).collect();
    curves.push(curve(&light.viewing.illuminant, None));
    let marks = &light.quadrature.rule.nodes_nm;
    let chart = Chart { curves: &curves, marks, quantity: tr("relative power"), max: None };
    let nodes: Vec<String> = marks.iter().map(|nm| format!("{nm:.0}")).collect();
    // In a low panel the controls need the room of the chart.
    let high = if ui.clip_rect().height() < ROOMY { LOW } else { HIGH };
    let size = vec2(ui.available_width(), high);
    chart.show(ui, size).on_hover_text(tr_format!(
        "Power over wavelength, mean 1. Paint is computed at {nodes} nm",
        nodes = nodes.join(", ")
    ));
}

fn curve(light: &Illuminant, color: Option<Color32>) -> Curve {
    let grid = light.power().grid();
    let values = light.power().values().iter().copied();
    let mut points: Vec<(f64, f64)> =
        grid.wavelengths_nm().zip(values).filter(|point| BAND_NM.contains(&point.0)).collect();
    let mean = points.iter().map(|point| point.1).sum::<f64>() / points.len().max(1) as f64;
    points = points.into_iter().step_by(STEP_NM).map(|(nm, power)| (nm, power / mean)).collect();
    Curve { name: light.name().to_owned(), points, color }
}

/// Widths of label and number in a wide panel, in points.
const WIDE: (f32, f32) = (78.0, 54.0);

/// Widths of label and number in a narrow panel, in points.
const NARROW: (f32, f32) = (54.0, 39.0);

pub(super) fn labelled_slider(ui: &mut Ui, name: &str, slider: Slider<'_>) -> Response {
    let width = ui.available_width();
    let (before, behind) = if width > 200.0 { WIDE } else { NARROW };
    let behind = behind + touch_padding(ui);
    let row = ui.horizontal(|ui| {
        let size = vec2(before, ui.spacing().interact_size.y);
        ui.allocate_ui(size, |ui| {
            ui.set_min_width(before);
            ui.add(Label::new(name));
        });
        let gaps = 2.0 * ui.spacing().item_spacing.x;
        ui.spacing_mut().slider_width = (width - before - behind - gaps).max(30.0);
        ui.add(slider)
    });
    row.inner
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [Kind; 6] = [
        Kind::Daylight,
        Kind::Incandescent,
        Kind::Fluorescent,
        Kind::Discharge,
        Kind::Led,
        Kind::Reference,
    ];

    #[test]
    fn every_illuminant_is_listed_once_with_a_note() {
        let listed = listed_illuminants();
        let mut names: Vec<&str> = listed.iter().map(|lamp| lamp.name).collect();
        let mut known: Vec<&str> = Illuminant::names().collect();
        names.sort_unstable();
        known.sort_unstable();
        assert_eq!(names, known);
        for lamp in &listed {
            assert!(!lamp.note.is_empty(), "{} has no description", lamp.name);
        }
    }

    #[test]
    fn lamps_are_grouped_by_kind() {
        let listed = listed_illuminants();
        assert!(listed.is_sorted_by_key(|lamp| lamp.kind), "{listed:?}");
        assert_eq!(
            KINDS.map(|kind| listed.iter().filter(|lamp| lamp.kind == kind).count()),
            [9, 1, 27, 5, 9, 1]
        );
    }

    #[test]
    fn the_search_matches_words_of_name_kind_and_note() {
        fn found(search: &str) -> Vec<&'static str> {
            listed_illuminants()
                .into_iter()
                .filter(|lamp| lamp.matches(search))
                .map(|lamp| lamp.name)
                .collect()
        }
        assert_eq!(found("window PANE"), ["ID50", "ID65"]);
        assert_eq!(found("violet"), ["LED-V1", "LED-V2"]);
        assert_eq!(found("led-rgb"), ["LED-RGB1"]);
        assert_eq!(found("").len(), Illuminant::names().count());
        assert!(found("candle").is_empty(), "there is no candle");
    }

    #[test]
    fn light_names_are_known_to_spectra() {
        for (kelvin, wanted) in
            [(1500.0, "1500K"), (3990.0, "3990K"), (4000.0, "D4000K"), (25000.0, "D25000K")]
        {
            assert_eq!(light(kelvin), wanted);
            light_from_text(wanted).unwrap();
        }
    }

    #[test]
    fn rounded_temperatures_stay_on_the_slider() {
        assert_eq!([5604.9, 12345.0, 9996.0].map(rounded), [5600.0, 12300.0, 10000.0]);
        assert_eq!([KELVIN.0, KELVIN.1].map(rounded), [KELVIN.0, KELVIN.1]);
    }

    #[test]
    fn a_curve_is_scaled_to_mean_one() {
        let light = Illuminant::d65();
        let shown = curve(&light, None);
        // The values begin at 360 nm.
        let power = light.power().values();
        let first = shown.points[0];
        let last = *shown.points.last().unwrap();
        assert_eq!((first.0, last.0), (380.0, 730.0));
        let ratio = first.1 / last.1;
        assert!((ratio - power[20] / power[370]).abs() < 1e-12, "{ratio}");
        let mean = shown.points.iter().map(|point| point.1).sum::<f64>() / 176.0;
        assert!((mean - 1.0).abs() < 0.01, "{mean}");
    }
}
