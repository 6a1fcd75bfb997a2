//! Frames of the whole window drawn on a graphics adapter without a window system.
//!
//! `cargo bench -p impasto-studio --bench offscreen [-- WIDTHxHEIGHT] [flat] [cpu] [SECONDS]`
//! paints one stroke at 95 mm/s, as a hand with a mouse would. It draws one frame after the other,
//! and waits until each is done. If you pass nothing, this uses 3840 x 2160 pixels at 2 pixels per
//! point, the round brush that the program opens with, the paint on the graphics adapter, and 10
//! seconds. `flat` takes a loaded flat brush of 25 mm, `cpu` simulates the paint on the processor.
//! In a window you also wait for the display.

#![expect(clippy::print_stdout, clippy::unwrap_used, reason = "a bench prints, and may panic")]

#[expect(dead_code, reason = "another bench needs more of it")]
#[path = "speed/paintings.rs"]
mod paintings;

use std::error::Error;
use std::path::PathBuf;
use web_time::{Duration, Instant};

use eframe::egui::{
    Context, Event, FullOutput, Modifiers, PointerButton, Pos2, TexturesDelta, UiBuilder, vec2,
};
use eframe::egui_wgpu::{RenderState, ScreenDescriptor, WgpuSetup, WgpuSetupCreateNew, wgpu};
use egui_kittest::wgpu::create_render_state;
use egui_kittest::{Harness, TestRenderer};
use graphics::gpu::BackendChoice;
use image::RgbaImage;
use session::{WorkerOptions, initial_commands};
use studio::app::{Parts, StartedWorker, Studio};
use studio::files::{FiguresLog, Files, Home, Preferences};
use studio::pen::{Pen, PenSettings};
use studio::theme;

/// Speed of the simulated hand.
const MM_PER_SECOND: f64 = 95.0;
const CANVAS_MM: f64 = 192.0;
/// Time between two positions of the mouse.
const INTERVAL: Duration = Duration::from_millis(4);
/// Pixels per point of the window.
const DENSITY: f32 = 2.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [on_cpu, flat_open] =
        ["cpu", "flat"].map(|word| arguments.iter().any(|argument| argument == word));
    let size = arguments.iter().find_map(|argument| {
        let (width, height) = argument.split_once('x')?;
        Some((width.parse::<f32>().ok()?, height.parse::<f32>().ok()?))
    });
    let (width, height) = size.unwrap_or((3840.0, 2160.0));
    let seconds = arguments.iter().find_map(|argument| argument.parse().ok()).unwrap_or(10.0);
    let folder = tempfile::tempdir()?;
    let flat = folder.path().join("flat.exr");
    paintings::loaded_flat(&flat, 25.0)?;
    let choice = if on_cpu { BackendChoice::Cpu } else { BackendChoice::Gpu };
    let open = flat_open.then_some(flat);
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = wgpu::Backends::VULKAN;
    let state = create_render_state(WgpuSetup::CreateNew(setup), Default::default());
    println!("{width} x {height} pixels on {}", state.adapter.get_info().name);
    let mut harness = window(folder.path().to_owned(), open, choice, (width, height), state);
    let log = folder.path().join("figures.jsonl");
    let start = Instant::now();
    while harness.state().as_ref().is_none_or(|studio| studio.painting().is_none())
        || start.elapsed() < Duration::from_secs(3)
    {
        harness.step();
        std::thread::sleep(INTERVAL);
    }
    let canvas = last_canvas(&log)?;
    press(&mut harness, "1");
    let times = paint(&mut harness, canvas, seconds);
    report(&times, seconds);
    println!("{}", std::fs::read_to_string(&log)?.lines().last().unwrap_or_default());
    Ok(())
}

/// The whole window with a worker. It draws itself after each step.
fn window(
    home: PathBuf,
    open: Option<PathBuf>,
    backend: BackendChoice,
    (width, height): (f32, f32),
    state: RenderState,
) -> Harness<'static, Option<Studio>> {
    let size = vec2(width / DENSITY, height / DENSITY);
    let mut begin = Some((initial_commands(), open));
    Harness::builder()
        .with_size(size)
        .with_pixels_per_point(DENSITY)
        .with_render_cursor(false)
        .with_context_setup(theme::apply)
        .renderer(OffscreenTexture { state, target: None })
        .build_ui_state(
            move |ui, studio: &mut Option<Studio>| {
                let studio = studio.get_or_insert_with(|| {
                    let options = WorkerOptions { backend, ..WorkerOptions::default() };
                    let (commands, open) = begin.take().unwrap_or_default();
                    let worker = StartedWorker::new(options, commands);
                    let preferences =
                        Preferences { first_steps_seen: true, ..Preferences::default() };
                    let log = FiguresLog::open(&home.join("figures.jsonl")).ok();
                    let files = Files::new(ui.ctx(), Home::in_folder(&home), preferences);
                    let pen = Pen::new(PenSettings::default());
                    Studio::new(ui.ctx(), Parts { worker, pen, files, open, log })
                });
                studio.logic(ui.ctx());
                // This uses the whole window, without the margin of the harness.
                let whole = ui.ctx().content_rect();
                let mut ui = ui.new_child(UiBuilder::new().max_rect(whole));
                ui.set_clip_rect(whole);
                studio.ui(&mut ui, None);
            },
            None,
        )
}

/// A texture that takes the place of a window. We draw into it and wait until it is drawn, but
/// never read it.
struct OffscreenTexture {
    state: RenderState,
    target: Option<wgpu::Texture>,
}

impl TestRenderer for OffscreenTexture {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let mut renderer = self.state.renderer.write();
        let set: Vec<_> = delta.set.drain().collect();
        for (id, images) in set {
            for image in images {
                renderer.update_texture(&self.state.device, &self.state.queue, id, &image);
            }
        }
        let freed: Vec<_> = delta.free.drain().collect();
        freed.iter().for_each(|id| renderer.free_texture(id));
    }

    fn render(&mut self, context: &Context, output: &FullOutput) -> Result<RgbaImage, String> {
        let RenderState { device, queue, target_format, .. } = &self.state;
        let mut renderer = self.state.renderer.write();
        let mut encoder = device.create_command_encoder(&Default::default());
        let size = context.content_rect().size() * context.pixels_per_point();
        let screen = ScreenDescriptor {
            pixels_per_point: context.pixels_per_point(),
            size_in_pixels: [size.x.round() as u32, size.y.round() as u32],
        };
        let shapes = context.tessellate(output.shapes.clone(), context.pixels_per_point());
        let buffers = renderer.update_buffers(device, queue, &mut encoder, &shapes, &screen);
        let [width, height] = screen.size_in_pixels;
        let target = self.target.get_or_insert_with(|| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: *target_format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            })
        });
        let view = target.create_view(&Default::default());
        let load = wgpu::LoadOp::Clear(wgpu::Color::BLACK);
        let attachment = wgpu::RenderPassColorAttachment {
            view: &view,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            depth_slice: None,
        };
        let mut pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(attachment)],
                ..Default::default()
            })
            .forget_lifetime();
        renderer.render(&mut pass, &shapes, &screen);
        drop(pass);
        queue.submit(buffers.into_iter().chain([encoder.finish()]));
        let wait = wgpu::PollType::Wait { submission_index: None, timeout: None };
        device.poll(wait).map_err(|error| error.to_string())?;
        Ok(RgbaImage::new(1, 1))
    }
}

/// Bounding box of the canvas in pixels, from the last line of the performance log.
fn last_canvas(log: &std::path::Path) -> Result<[f64; 4], Box<dyn Error>> {
    let text = std::fs::read_to_string(log)?;
    let line = text.lines().last().ok_or("no figures were printed")?;
    let canvas = serde_json::from_str::<serde_json::Value>(line)?["canvas_px"].clone();
    Ok(serde_json::from_value(canvas)?)
}

fn press(harness: &mut Harness<'static, Option<Studio>>, text: &str) {
    harness.input_mut().events.push(Event::Text(text.to_owned()));
    harness.step();
}

/// Paints one stroke. Returns two times for each frame, in seconds: for the step of the interface,
/// and for drawing it.
fn paint(
    harness: &mut Harness<'static, Option<Studio>>,
    [left, top, right, bottom]: [f64; 4],
    seconds: f64,
) -> Vec<[f64; 2]> {
    let width = 0.8 * (right - left);
    let height = 0.7 * (bottom - top);
    let speed = MM_PER_SECOND * (right - left) / CANVAS_MM;
    let place = |now: f64| {
        let across = (speed * now + width).rem_euclid(2.0 * width) - width;
        let x = left + 0.1 * (right - left) + across.abs();
        let y = top + 0.15 * (bottom - top) + height * now / seconds;
        Pos2::new(x as f32 / DENSITY, y as f32 / DENSITY)
    };
    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        }
    }
    let mut frame = |events: Vec<Event>| {
        harness.input_mut().events.extend(events);
        let began = Instant::now();
        harness.step();
        let stepped = Instant::now();
        harness.render().unwrap();
        [stepped - began, stepped.elapsed()].map(|time| time.as_secs_f64())
    };
    frame(vec![Event::PointerMoved(place(0.0))]);
    frame(vec![button(place(0.0), true)]);
    let began = Instant::now();
    let mut sent = 0.0;
    let mut times = Vec::new();
    while sent < seconds {
        let now = began.elapsed().as_secs_f64();
        let mut events = Vec::new();
        while sent < now {
            sent += INTERVAL.as_secs_f64();
            events.push(Event::PointerMoved(place(sent)));
        }
        times.push(frame(events));
    }
    frame(vec![button(place(seconds), false)]);
    times
}

fn report(times: &[[f64; 2]], seconds: f64) {
    println!("{:.0} frames/s", times.len() as f64 / seconds);
    report_part("interface", times.iter().map(|[step, _]| *step).collect());
    report_part("drawing", times.iter().map(|[_, draw]| *draw).collect());
    report_part("frame", times.iter().map(|[step, draw]| step + draw).collect());
}

fn report_part(name: &str, mut seconds: Vec<f64>) {
    seconds.sort_by(f64::total_cmp);
    let [median, most, worst] = [0.5, 0.95, 1.0]
        .map(|share: f64| 1e3 * seconds[(share * (seconds.len() - 1) as f64) as usize]);
    println!("{name}: median {median:.1} ms, 95 % {most:.1} ms, worst {worst:.1} ms");
}
