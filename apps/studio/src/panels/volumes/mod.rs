//! The panels of a scene of paint volumes: tubes, the tool in hand, picture, light, readings,
//! events and exports. Each panel shows the state that the scene's worker last reported and queues
//! requests.

mod context;

use std::sync::Arc;

use eframe::egui::{
    Align, Area, Button, Context, CornerRadius, Frame, Grid, Id, Key, Layout, Order, Pos2,
    RichText, ScrollArea, Sense, Slider, TextStyle, Ui, vec2,
};
use paint::document::Medium;
use pigment::library::PigmentLibrary;
use session::volumes::{Here, Inside, SceneState, SceneTool, Show, VolumeCommand};
use spectra::color::Rgb;

use crate::chart::{Chart, Curve};
use crate::keymap::hint;
use crate::language::{english, tr, tr_format};
use crate::panels::controls::{
    button, button_background, item, named_button, percent, row, row_height, section, slider, text,
};
use crate::panels::eyedropper::{LayerPaint, layer, swatch};
use crate::panels::light::{Direction, direction_control, direction_text};
use crate::panels::tubes::{TUBE_SIZE, draw_tube};
use crate::theme;
use context::TubeChoice;

pub use crate::files::SceneExport;
pub use context::{
    SceneContext, SceneFileRequest, SceneIlluminant, SceneRequest, SceneTab, SceneTools,
    TIME_BAR_HEIGHT, TubeChooser, seconds_text, show_time_bar,
};

impl SceneTab {
    const ALL: [Self; 5] = [Self::View, Self::Light, Self::Here, Self::Events, Self::Export];

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::View => (tr("View"), tr("The picture that is shown")),
            Self::Light => {
                (tr("Light"), tr("Where the light comes from, and the light on pigments"))
            }
            Self::Here => (tr("Here"), tr("Colour and paint at the last right click")),
            Self::Events => (tr("Events"), tr("All that was done, to go back to and to take back")),
            Self::Export => (tr("Export"), tr("Pictures, a painting, the script, an animation")),
        }
    }
}

/// Draws the side panel.
pub fn show_side(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    section(ui, tr("Tubes"), |ui| show_tubes(ui, cx));
    section(ui, tr("Tool in hand"), |ui| show_tool(ui, cx));
    ui.add_space(6.0);
    tabs(ui, &mut cx.tools.tab);
    ui.add_space(4.0);
    let tab = cx.tools.tab;
    let body = ScrollArea::vertical().id_salt(tab.words().0).auto_shrink(false);
    body.show(ui, |ui| match tab {
        SceneTab::View => show_view(ui, cx),
        SceneTab::Light => show_light(ui, cx),
        SceneTab::Here => show_readings(ui, cx),
        SceneTab::Events => show_events(ui, cx),
        SceneTab::Export => show_export(ui, cx),
    });
}

fn tabs(ui: &mut Ui, chosen: &mut SceneTab) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        let count = SceneTab::ALL.len() as f32;
        let width = (ui.available_width() - (count - 1.0)) / count;
        for tab in SceneTab::ALL {
            let (name, description) = tab.words();
            let here = tab == *chosen;
            let button = Button::new(RichText::new(name).size(12.0))
                .fill(if here {
                    theme::colors(ui.ctx()).chosen
                } else {
                    theme::colors(ui.ctx()).bar
                })
                .selected(here)
                .corner_radius(CornerRadius {
                    sw: 0,
                    se: 0,
                    ..CornerRadius::same(theme::CORNER_RADIUS)
                });
            if ui
                .add_sized(vec2(width, row_height(ui, 24.0)), button)
                .on_hover_text(description)
                .clicked()
            {
                *chosen = tab;
            }
        }
    });
}

const ROW: usize = 3;

/// Draws the controls of the tab View: which picture you see, what the volumes show inside, and
/// whether there is hatching.
fn show_view(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let look = cx.state.look;
    ui.label(tr("Picture"));
    for row in Show::ALL.chunks(ROW) {
        let choices = row.iter().map(|&one| {
            let key =
                if one == Show::Volumes { hint(ui.ctx(), "scene.volumes") } else { String::new() };
            (one, show_name(one), format!("{}{key}", show_tip(one)))
        });
        let choices = choices.collect();
        if let Some(show) = choose(ui, choices, look.show) {
            cx.change_look(|look| look.show = show);
        }
    }
    ui.add_space(4.0);
    ui.label(tr("Inside of the volumes"));
    let key = hint(ui.ctx(), "scene.inside");
    let has_tubes = !cx.state.tubes.is_empty();
    for row in Inside::choices(cx.state.by_region).chunks(ROW) {
        let choices = row
            .iter()
            .map(|&one| (one, inside_name(one), format!("{}{key}", inside_tip(one))))
            .collect();
        let chosen = ui.add_enabled_ui(has_tubes, |ui| choose(ui, choices, look.inside));
        if let Some(inside) = chosen.inner {
            cx.change_look(|look| look.inside = inside);
        }
    }
    ui.add_space(4.0);
    let mut hatching = look.hatching;
    let key = hint(ui.ctx(), "scene.hatching");
    let tip = format!("{}{key}", tr("Pencil strokes that show how the light falls"));
    if ui.checkbox(&mut hatching, tr("Hatching")).on_hover_text(tip).changed() {
        cx.change_look(|look| look.hatching = hatching);
    }
}

/// Draws a row of choices of equal width. Returns the clicked one.
fn choose<T: Copy + PartialEq>(
    ui: &mut Ui,
    choices: Vec<(T, &'static str, String)>,
    chosen: T,
) -> Option<T> {
    let mut clicked = None;
    ui.horizontal(|ui| {
        let gap = ui.spacing().item_spacing.x;
        let width = (ui.available_width() - (ROW - 1) as f32 * gap) / ROW as f32;
        for (one, name, tip) in choices {
            let button = Button::new(name).selected(one == chosen);
            if ui.add_sized(vec2(width, row_height(ui, 24.0)), button).on_hover_text(tip).clicked()
            {
                clicked = Some(one);
            }
        }
    });
    clicked
}

fn show_name(show: Show) -> &'static str {
    match show {
        Show::Final => tr("Final"),
        Show::Volumes => tr("Volumes"),
        Show::Mask => tr("Mask"),
        Show::Grey => tr("Grey"),
        Show::Color => tr("Colour"),
        Show::Hatching => tr("Strokes"),
    }
}

fn show_tip(show: Show) -> &'static str {
    match show {
        Show::Final => tr("The drawing, with colour inside of the volumes"),
        Show::Volumes => tr("The volumes themselves over the grey drawing"),
        Show::Mask => tr("White inside of the volumes, black outside"),
        Show::Grey => tr("The grey drawing alone"),
        Show::Color => tr("Colour everywhere"),
        Show::Hatching => tr("The pencil strokes alone"),
    }
}

fn inside_name(inside: Inside) -> &'static str {
    match inside {
        Inside::OwnColours => tr("Own"),
        Inside::Glaze => tr("Glaze"),
        Inside::Both => tr("Both"),
        Inside::ByRegion => tr("By region"),
    }
}

fn inside_tip(inside: Inside) -> &'static str {
    match inside {
        Inside::OwnColours => tr("The subject's own colours"),
        Inside::Glaze => tr("A film of the poured pigments over the grey drawing"),
        Inside::Both => tr("A film of the poured pigments over the subject's own colours"),
        Inside::ByRegion => tr("What the script names for each of its regions"),
    }
}

/// Draws the card beside `at`. Returns whether it stays open. Escape and a click elsewhere close
/// it.
pub fn show_here(context: &Context, at: Pos2, here: &Here, state: &SceneState) -> bool {
    let area = Area::new(Id::unique("here"))
        .order(Order::Foreground)
        .constrain(true)
        .fixed_pos(at + vec2(14.0, 14.0));
    let shown = area.show(context, |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width(250.0);
            found(ui, here, &state.library);
        });
    });
    let elsewhere = context.input(|input| input.pointer.any_pressed())
        && context
            .pointer_interact_pos()
            .is_some_and(|pointer| !shown.response.rect.contains(pointer));
    !elsewhere && !context.input(|input| input.key_pressed(Key::Escape))
}

fn show_readings(ui: &mut Ui, cx: &SceneContext<'_>) {
    let Some(here) = &cx.tools.here else {
        ui.weak(tr("Right-click the scene to tell which paint lies there, and its colour."));
        return;
    };
    let library = &cx.state.library;
    found(ui, here, library);
    let paint = here.paint.as_ref().and_then(LayerPaint::of);
    let Some(paint) = paint.filter(|paint| !paint.shares.is_empty()) else { return };
    let Ok(mixture) = library.mix(&paint.shares) else { return };
    ui.separator();
    let reflectance = mixture.hiding(library.saunderson);
    let curve = Curve::new(tr("this paint"), library.grid, &reflectance);
    let chart = Chart { curves: &[curve], marks: &[], quantity: tr("reflectance"), max: Some(1.0) };
    let chart = chart.show(ui, vec2(ui.available_width(), 110.0));
    chart.on_hover_text(tr(
        "Reflectance of this paint over wavelength, where it is so thick that it hides",
    ));
}

fn found(ui: &mut Ui, here: &Here, library: &PigmentLibrary) {
    ui.horizontal_top(|ui| {
        let rgb = Rgb(here.srgb.map(|channel| f64::from(channel) / 255.0));
        let patch = swatch(ui, tr("Colour here"), vec2(52.0, 52.0), &[rgb]);
        patch.on_hover_text(tr("The colour as the screen shows it"));
        numbers(ui, here);
    });
    let Some(place) = here.place else {
        ui.label(tr("There is no surface here."));
        return;
    };
    let volumes = match here.volumes {
        0 => tr("outside of all volumes").to_owned(),
        1 => tr("inside of 1 volume").to_owned(),
        count => tr_format!("inside of {count} volumes", count),
    };
    ui.label(match &here.region {
        Some(region) => tr_format!("{volumes}, region {region}", volumes, region),
        None => volumes,
    })
    .on_hover_text(tr_format!(
        "At {x:.3}, {y:.3}, {z:.3} of the model",
        x = place.x,
        y = place.y,
        z = place.z
    ));
    if let Some(paint) = here.paint.as_ref().and_then(LayerPaint::of) {
        layer(ui, (library, &Medium::of(library)), tr("Paint"), &paint);
    }
}

fn numbers(ui: &mut Ui, here: &Here) {
    let grid = Grid::new("numbers here").num_columns(2).min_row_height(16.0);
    grid.spacing(vec2(8.0, 1.0)).show(ui, |ui| {
        ui.weak("Lab")
            .on_hover_text(tr("CIELAB of the colour shown, against the white of the screen"));
        ui.monospace(here.lab.map(|value| format!("{value:.2}")).join(" "));
        ui.end_row();
        ui.weak("sRGB").on_hover_text(tr("As shown on the screen"));
        let [red, green, blue] = here.srgb;
        ui.monospace(format!("#{red:02x}{green:02x}{blue:02x}"));
        ui.end_row();
    });
}

const SIZE: f32 = 128.0;

/// Share of the light that comes from all sides, for the shading of the control.
const AMBIENT: f64 = 0.1;

fn show_light(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let light = &cx.state.look.light;
    let mut direction =
        Direction { azimuth_deg: light.azimuth_deg, elevation_deg: light.elevation_deg };
    let before = direction;
    ui.label(tr("Direction"));
    ui.horizontal(|ui| {
        let (response, _) = direction_control(ui, SIZE, &mut direction, AMBIENT);
        response
            .on_hover_text(tr("Drag it, or use the arrow keys. The light turns with the camera"));
        ui.vertical(|ui| {
            ui.label(direction_text(before));
            ui.weak(tr("clockwise from the top"));
        });
    });
    if direction != before {
        cx.change_look(|look| {
            look.light.azimuth_deg = direction.azimuth_deg;
            look.light.elevation_deg = direction.elevation_deg;
        });
    }
    if !cx.state.tubes.is_empty() {
        ui.separator();
        if let Some(chosen) = cx.tools.illuminant.show(ui, cx.state) {
            cx.command(VolumeCommand::Illuminant(chosen));
        }
    }
}

fn show_tool(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let grip = &mut cx.tools.grip;
    ui.horizontal(|ui| {
        ui.label(RichText::new(tr(grip.tool.name())).strong());
        ui.weak(about(grip.tool));
    });
    if grip.tool == SceneTool::Pour {
        let rate = Slider::new(&mut grip.rate_mm3_s, 1.0..=1000.0).logarithmic(true);
        let keys = ["scene.less", "scene.more"].map(|name| hint(ui.ctx(), name)).concat();
        let tip = tr("Paint poured in a second, in cubic millimetres, at full pressure");
        let tip = format!("{tip}{keys}");
        slider(ui, tr("Rate"), &tip, rate.fixed_decimals(0).suffix(" mm3/s"));
        return;
    }
    let radius = Slider::new(&mut grip.radius_mm, 1.0..=100.0).logarithmic(true);
    slider(
        ui,
        tr("Radius"),
        tr("How far the tool reaches, in mm"),
        radius.fixed_decimals(0).suffix(" mm"),
    );
    if grip.tool == SceneTool::Dry {
        let key = hint(ui.ctx(), "scene.dry-all");
        let tip = format!("{}{key}", tr("Dries all paint and its shape"));
        if button(ui, tr("Dry all paint"), &tip, None) {
            cx.command(VolumeCommand::DryAll);
        }
        return;
    }
    let tip = match grip.tool {
        SceneTool::Lift => tr("How much paint the sponge takes up at each place"),
        _ => tr("How strongly the air blows"),
    };
    percent(ui, tr("Strength"), tip, &mut grip.strength, 1.0..=100.0);
}

/// Describes a tool in a few words.
fn about(tool: SceneTool) -> &'static str {
    match tool {
        SceneTool::Pour => tr("the tube in hand, where the pen is held"),
        SceneTool::Push => tr("paint along the drag, as air does"),
        SceneTool::Lift => tr("paint, as a sponge does"),
        SceneTool::Dry => tr("paint below the pen, and its shape"),
    }
}

const TUBES_IN_ROW: usize = 4;

/// Draws the tubes. Click one to take it in hand.
fn show_tubes(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let tubes = cx.state.tubes.clone();
    if tubes.is_empty() {
        ui.weak(tr("This scene has no pigments: what is poured shows the subject's own colours."));
        return;
    }
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        for (row, tubes) in tubes.chunks(TUBES_IN_ROW).enumerate() {
            ui.horizontal(|ui| {
                for (column, tube) in tubes.iter().enumerate() {
                    let number = row * TUBES_IN_ROW + column;
                    let (rect, response) = ui.allocate_exact_size(TUBE_SIZE, Sense::click());
                    let chosen = number == cx.tools.grip.tube;
                    button_background(
                        ui,
                        &response,
                        &tr_format!("tube of {name}", name = tube.name),
                        chosen,
                    );
                    draw_tube(ui, rect, tube.masstone, tube.tint, &tube.name);
                    if response.clicked() {
                        cx.tools.grip.tube = number;
                        cx.tools.grip.tool = SceneTool::Pour;
                    }
                    response.context_menu(|ui| {
                        let tip = tr("Puts another pigment of the library into this tube");
                        if item(ui, tr("Put another here..."), tip, None) {
                            cx.tools.chooser.open(number);
                        }
                        let tip = tr("Fills all tubes from another pigment library (.json)");
                        if item(ui, tr("Open a library..."), tip, None) {
                            cx.file(SceneFileRequest::Library);
                        }
                    });
                    response.on_hover_ui(|ui| {
                        ui.horizontal(|ui| {
                            ui.strong(&tube.name);
                            ui.weak(format!("{}", number + 1));
                        });
                        ui.label(tr(
                            "Takes this tube in hand, to pour it; a right click changes it",
                        ));
                    });
                }
            });
        }
    });
    let chosen = tubes.get(cx.tools.grip.tube).map(|tube| tube.name.as_str());
    ui.horizontal(|ui| {
        ui.label(RichText::new(chosen.unwrap_or(tr("no tube in hand"))).strong());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let tip = tr("Chooses the pigment of the tube in hand, or another library");
            let reason = chosen.is_none().then_some(tr("no tube is in hand"));
            if button(ui, tr("Tube..."), tip, reason) {
                cx.tools.chooser.open(cx.tools.grip.tube);
            }
        });
    });
    match cx.tools.chooser.show(ui.ctx(), cx.state) {
        Some(TubeChoice::Pigment(tube, name)) => cx.command(VolumeCommand::Tube(tube, name)),
        Some(TubeChoice::Library) => cx.file(SceneFileRequest::Library),
        None => {}
    }
}

/// A button, its tooltip, and the request that it makes.
type Line = (&'static str, &'static str, SceneFileRequest);

const LINES: [Line; 5] = [
    (
        english("Picture..."),
        english("The picture as it is seen now: PNG, or linear OpenEXR"),
        file(SceneExport::Picture),
    ),
    (
        english("Painting..."),
        english(
            "An OpenEXR file with the pigments of every cell: relight it, exchange its pigments, go \
         on painting it",
        ),
        file(SceneExport::Painting),
    ),
    (
        english("Layers, spectra, maps..."),
        english(
            "The painting in layers for other programs, its spectra, maps of its pigments, or its picture",
        ),
        SceneFileRequest::ExportOfPainting,
    ),
    (
        english("Script..."),
        english(
            "All that was done, as a text file that this program and `impasto stencil` play again",
        ),
        file(SceneExport::Script),
    ),
    (
        english("Animation..."),
        english("All pictures from the start to the end: GIF or APNG"),
        file(SceneExport::Animation),
    ),
];

const fn file(export: SceneExport) -> SceneFileRequest {
    SceneFileRequest::Export(export)
}

fn show_export(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    for (name, tip, request) in LINES {
        let paints =
            request == file(SceneExport::Painting) || request == SceneFileRequest::ExportOfPainting;
        let films = request == file(SceneExport::Animation);
        let reason = match cx.state.time.end {
            _ if paints && cx.state.tubes.is_empty() => Some(tr("the scene has no pigments")),
            0 if films => Some(tr("no time has passed yet")),
            _ => None,
        };
        let size = vec2(ui.available_width(), row_height(ui, 26.0));
        let button =
            ui.add_enabled_ui(reason.is_none(), |ui| ui.add_sized(size, Button::new(tr(name))));
        let button = button.inner.on_hover_text(tr(tip));
        if button.on_disabled_hover_text(reason.unwrap_or_default()).clicked() {
            cx.file(request);
        }
    }
}

const EVENTS_ROW: f32 = 22.0;

/// Width of the button that removes an event, with the gap, in points.
const REMOVE: f32 = 28.0;

/// Draws the list. If you click an event, the scene goes to its start.
fn show_events(ui: &mut Ui, cx: &mut SceneContext<'_>) {
    let events = Arc::clone(&cx.state.events);
    ui.horizontal(|ui| {
        let reason = events.is_empty().then_some(tr("nothing was done yet"));
        let key = hint(ui.ctx(), "scene.undo");
        let tip =
            tr_format!("Takes back what was done last, and replays the scene without it{key}", key);
        if button(ui, tr("Undo"), &tip, reason) {
            cx.command(VolumeCommand::Undo);
        }
        ui.weak(match events.len() {
            0 => tr("no events yet").to_owned(),
            1 => tr("1 event").to_owned(),
            count => tr_format!("{count} events", count),
        });
    });
    ui.spacing_mut().item_spacing.y = 1.0;
    let list = ScrollArea::vertical().auto_shrink([false, true]);
    let high = row_height(ui, EVENTS_ROW);
    let remove = REMOVE.max(theme::target(ui));
    list.show_rows(ui, high, events.len(), |ui, rows| {
        for number in rows {
            let event = &events[number];
            let began = seconds_text(event.from);
            ui.horizontal(|ui| {
                let runs = event.from <= cx.state.time.step && cx.state.time.step < event.to;
                let width = ui.available_width() - remove;
                let line = ui.allocate_ui(vec2(width, high), |ui| {
                    row(ui, high, &format!("{} {}", number + 1, event.label), runs)
                });
                let response = line.inner;
                let inner = response.rect.shrink2(vec2(6.0, 0.0));
                let (time, label) = inner.split_left_right_at_x(inner.left() + 58.0);
                let colors = theme::colors(ui.ctx());
                let faint = if runs { colors.text } else { colors.faint };
                text(ui, time, Align::Min, TextStyle::Small, faint, &began);
                text(
                    ui,
                    label,
                    Align::Min,
                    TextStyle::Body,
                    theme::colors(ui.ctx()).text,
                    &event.label,
                );
                if response.on_hover_text(tr("Goes to the moment at which it begins")).clicked() {
                    cx.command(VolumeCommand::Seek(event.from));
                }
                let name = tr_format!("Remove event {number}", number = number + 1);
                let tip = tr("Removes it, and replays the scene without it");
                if named_button(ui, "x", &name, tip, None) {
                    cx.command(VolumeCommand::Remove(number));
                }
            });
        }
    });
}
