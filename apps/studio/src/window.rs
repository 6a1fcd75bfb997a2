//! Opens the studio in a window of the operating system.

use std::sync::Arc;
use web_time::{Duration, Instant};

use eframe::egui::{Context, IconData, RawInput, Ui, ViewportBuilder, vec2};
use eframe::egui_wgpu::{SurfaceConfig, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew, wgpu};
use eframe::{App, NativeOptions};
use wgpu::{Adapter, Backends, DeviceType, PresentMode, Surface};

use crate::app::{Parts, StartedWorker, Studio};
use crate::arguments::Start;
use crate::files::{Files, Problem};
use crate::language::{Language, set_system};
use crate::pen::{Pen, PenSettings};
use crate::view::Drawing;
use crate::{pace, view};
use session::initial_commands;

/// Smallest window size in points. You can still reach all controls.
const SMALLEST: [f32; 2] = [900.0, 600.0];

/// Opens the window and returns when you close it.
///
/// # Errors
/// [`Problem`] with a hint if there is no display or no graphics adapter that can draw in the
/// window.
pub fn run(start: Start) -> Result<(), Problem> {
    set_system(Language::of_environment());
    // The worker prepares the canvas while the window opens.
    let worker = StartedWorker::new(start.worker, initial_commands());
    let options = options(start.window);
    let made = eframe::run_native(
        "impasto-studio",
        options,
        Box::new(move |creation| {
            let context = &creation.egui_ctx;
            let mut draws_on_processor = false;
            if let Some(drawn) = &creation.wgpu_render_state {
                view::set_drawing(context, Drawing::OwnShader(drawn.target_format));
                draws_on_processor = view::is_processor(&drawn.adapter);
                if draws_on_processor {
                    view::draw_meshes(context);
                }
            }
            let mut files = Files::new(context, start.home, start.preferences);
            files.pace = start.pace;
            start.problems.into_iter().for_each(|problem| files.report(problem));
            let mut pen = Pen::for_window(creation, PenSettings::default());
            if let Some(text) = pen.take_notice() {
                files.report(Problem { text, hint: None });
            }
            let display = creation.winit_window().and_then(|window| window.current_monitor());
            pace::set_display(
                context,
                display.and_then(|display| display.refresh_rate_millihertz()),
            );
            let parts = Parts { worker, pen, files, open: start.file, log: start.figures };
            let studio = Studio::new(context, parts);
            Ok(Box::new(Framed { studio, draws_on_processor, waited: [Duration::ZERO; 2] }))
        }),
    );
    made.map_err(|error| failure(&error))
}

/// Adapter from eframe's application trait to [`Studio`].
struct Framed {
    studio: Studio,
    draws_on_processor: bool,
    /// Time for which the previous frame and this one waited, so that the processor could simulate
    /// paint.
    waited: [Duration; 2],
}

impl App for Framed {
    fn logic(&mut self, context: &Context, _: &mut eframe::Frame) {
        self.studio.logic(context);
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        let busy = frame.info().cpu_usage.map(Duration::from_secs_f32);
        let busy = busy.map(|busy| busy.saturating_sub(self.waited[0]));
        self.studio.ui(ui, busy);
    }

    fn raw_input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let gives_way = self.draws_on_processor && self.studio.figures().paint_is_behind;
        let wait = if gives_way { pace::give_way(context, Instant::now()) } else { Duration::ZERO };
        std::thread::sleep(wait);
        self.waited = [self.waited[1], wait];
        self.studio.raw_input(context, input);
    }

    fn on_exit(&mut self) {
        self.studio.finish();
    }

    fn clear_color(&self, _: &eframe::egui::Visuals) -> [f32; 4] {
        crate::theme::SURROUND.to_normalized_gamma_f32()
    }
}

fn options([width, height]: [f32; 2]) -> NativeOptions {
    let viewport = ViewportBuilder::default()
        .with_title("impasto")
        .with_app_id("impasto-studio")
        .with_icon(Arc::new(icon()))
        .with_inner_size(vec2(width, height))
        .with_min_inner_size(SMALLEST)
        .with_drag_and_drop(true);
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = Backends::VULKAN;
    setup.native_adapter_selector = Some(Arc::new(choose));
    let wgpu_options = WgpuConfiguration {
        // With at most one frame in the queue, you see paint one frame earlier. AutoVsync is
        // FifoRelaxed or Fifo: frames wait for the display, as far as its driver lets them.
        surface: SurfaceConfig {
            present_mode: PresentMode::AutoVsync,
            desired_maximum_frame_latency: Some(1),
        },
        wgpu_setup: WgpuSetup::CreateNew(setup),
        ..WgpuConfiguration::default()
    };
    NativeOptions {
        viewport,
        wgpu_options,
        // Dithering would change the colour of cells.
        dithering: false,
        persist_window: false,
        ..NativeOptions::default()
    }
}

/// Chooses an adapter that can draw in the window, hardware before software.
fn choose(adapters: &[Adapter], surface: Option<&Surface<'_>>) -> Result<Adapter, String> {
    let able = adapters
        .iter()
        .filter(|adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface)));
    let best = able.min_by_key(|adapter: &&Adapter| match adapter.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    });
    best.cloned().ok_or_else(|| "no Vulkan adapter can draw in this window".to_owned())
}

/// Converts an error of eframe to a message with a hint.
fn failure(error: &eframe::Error) -> Problem {
    let (what, hint) = match error {
        eframe::Error::Wgpu(error) => (
            error.to_string(),
            "install a Vulkan driver: that of your graphics card, or the one in software, \
             mesa-vulkan-drivers on Debian and Ubuntu; `impasto gpu` lists what is found",
        ),
        // The error's own text names source files of the library.
        eframe::Error::WinitEventLoop(_) => {
            ("there is no display".to_owned(), "DISPLAY or WAYLAND_DISPLAY names one")
        }
        other => (other.to_string(), "is the display still there?"),
    };
    Problem::new(format!("the window cannot be opened: {what}"), hint)
}

/// Draws the window icon: a light paint stroke on a grey disc.
fn icon() -> IconData {
    const SIDE: u32 = 64;
    let mut rgba = Vec::with_capacity((4 * SIDE * SIDE) as usize);
    for y in 0..SIDE {
        for x in 0..SIDE {
            let x = x as f32 / SIDE as f32 - 0.5;
            let y = y as f32 / SIDE as f32 - 0.5;
            // A disc, and across it a curved, tapering stroke.
            let inside = x.hypot(y) < 0.48;
            let middle = 0.16 * (3.2 * x).sin() - 0.35 * x;
            let half = 0.13 - 0.09 * (x + 0.5);
            let across = (y - middle) / half;
            let painted = across.abs() < 1.0 && x.abs() < 0.4;
            let ridge = 0.75 + 0.25 * (across * 9.0).cos();
            let grey = if painted { 150.0 + 95.0 * ridge } else { 62.0 };
            let grey = grey as u8;
            rgba.extend([grey, grey, grey, if inside { 255 } else { 0 }]);
        }
    }
    IconData { rgba, width: SIDE, height: SIDE }
}
