//! Uses the window of the tests for screenshots: a scene of paint volumes, marks of samples, and
//! guides of strokes.

use std::error::Error;
use std::path::Path;
use std::time::Duration;

use eframe::egui::{Event, Pos2, Rect, pos2, vec2};
use egui_kittest::kittest::Queryable;
use graphics::camera::Framing;
use graphics::compute::Compute;
use graphics::export::{frame_of, frame_png};
use graphics::mesh::SampleModel;
use session::volumes::{Subject, VolumeCommand};
use studio::app::Volumes;
use watercolor::{ModelPainter, Preset};

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../../tests/panels/harness.rs"]
mod harness;

pub(crate) use harness::{Window, button, has_adapter};

pub(crate) fn wait_for(window: &mut Window, label: &str) -> Result<(), Box<dyn Error>> {
    for _ in 0..6000 {
        if window.harness().query_by_label(label).is_some() {
            return Ok(());
        }
        std::thread::sleep(Duration::from_millis(5));
        window.harness().step();
    }
    Err(format!("the window shows no \"{label}\"").into())
}

/// Paint poured a second, in mm3.
const RATE: f64 = 130.0;

/// The pen rests for this many steps of time at the start of a drag, and at its end.
const STEPS: u64 = 60;

/// Drags over the village: shares of the picture's width and height.
const DRAGS: [[[f32; 2]; 2]; 3] =
    [[[0.5, 0.52], [0.46, 0.6]], [[0.25, 0.6], [0.3, 0.64]], [[0.72, 0.62], [0.66, 0.66]]];

/// Pours over the village, and stops time while the pen is still down.
pub(crate) fn pouring(window: &mut Window) -> Result<(), Box<dyn Error>> {
    let context = window.harness().ctx.clone();
    window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    wait(window, |volumes| volumes.picture().is_some())?;
    window.click("Events");
    for (number, drag) in DRAGS.iter().enumerate() {
        if let Some(volumes) = &mut window.studio_mut().volumes {
            (volumes.tools.grip.rate_mm3_s, volumes.tools.grip.tube) = (RATE, 2 * number + 1);
        }
        let [from, to] = drag.map(|place| point(window, place));
        window.frame(vec![Event::PointerMoved(from)]);
        window.frame(vec![button(from, true)]);
        wait_steps(window, STEPS)?;
        window.frame(vec![Event::PointerMoved(to)]);
        wait_steps(window, STEPS)?;
        if number + 1 < DRAGS.len() {
            window.frame(vec![button(to, false)]);
            wait_steps(window, STEPS)?;
        }
    }
    if let Some(volumes) = &mut window.studio_mut().volumes {
        volumes.ask(VolumeCommand::Play(false));
    }
    wait(window, |volumes| {
        let time = volumes.state().map(|state| state.time);
        let stands = time.is_some_and(|time| !time.playing);
        stands && volumes.picture().is_some_and(|shown| shown.fine)
    })?;
    window.frame(Vec::new());
    Ok(())
}

/// A point of the window at shares of the picture's width and height.
fn point(window: &Window, [x, y]: [f32; 2]) -> Pos2 {
    let rect = window.studio().volumes.as_ref().map_or(Rect::NOTHING, Volumes::rect);
    rect.min + vec2(x, y) * rect.size()
}

/// Draws frames until some steps of time have passed.
fn wait_steps(window: &mut Window, steps: u64) -> Result<(), Box<dyn Error>> {
    let until = steps + window.studio().volumes.as_ref().map_or(0, step);
    wait(window, |volumes| step(volumes) >= until)
}

fn step(volumes: &Volumes) -> u64 {
    volumes.state().map_or(0, |state| state.time.step)
}

fn wait(window: &mut Window, done: impl Fn(&Volumes) -> bool) -> Result<(), Box<dyn Error>> {
    for _ in 0..20_000 {
        if window.studio().volumes.as_ref().is_some_and(&done) {
            return Ok(());
        }
        std::thread::sleep(Duration::from_millis(3));
        window.harness().step();
    }
    Err("the scene stands still".into())
}

/// Width of the reference picture in the window, in points.
const WIDTH: f32 = 620.0;

/// Width and height of the rendered picture of the model, in pixels.
const VIEW: (usize, usize) = (900, 600);

type Places = &'static [[f32; 2]];

/// Marks on the painted coffee, in its pixels. Each has a line over a piece of brushwork, and one
/// place on each of two neighbouring strokes.
const MARKS: [(Places, [[f32; 2]; 2]); 4] = [
    (&[[20.0, 100.0], [110.0, 50.0], [190.0, 12.0]], [[60.0, 40.0], [68.0, 54.0]]),
    (&[[370.0, 230.0], [440.0, 250.0], [510.0, 235.0]], [[430.0, 215.0], [432.0, 230.0]]),
    (&[[170.0, 260.0], [180.0, 340.0], [240.0, 420.0]], [[200.0, 300.0], [216.0, 306.0]]),
    (&[[690.0, 60.0], [760.0, 120.0], [800.0, 210.0]], [[740.0, 60.0], [756.0, 54.0]]),
];

/// Control points of curves along the knot, in pixels of the picture.
const GUIDES: [Places; 3] = [
    &[[520.0, 90.0], [380.0, -20.0], [130.0, 90.0], [150.0, 300.0], [320.0, 370.0]],
    &[[320.0, 250.0], [370.0, 120.0], [600.0, 120.0], [650.0, 350.0]],
    &[[300.0, 420.0], [340.0, 600.0], [500.0, 580.0], [510.0, 290.0]],
];

/// Marks samples of the painted coffee.
pub(crate) fn marks(window: &mut Window) -> Result<(), Box<dyn Error>> {
    window.studio_mut().visible.palette = false;
    let coffee = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/images/coffee-painted.jpg");
    pin(window, &coffee)?;
    let rect = window.harness().get_by_label("Reference picture").rect();
    let edge = pos2(rect.right() + 4.0, rect.center().y);
    window.pen_stroke(&[edge, edge + vec2(WIDTH - rect.width(), 0.0)]);
    window.settle();
    window.click("Mark samples");
    for (line, _) in MARKS {
        draw(window, line);
    }
    window.click("Spacing");
    for (number, (_, strokes)) in (1..).zip(MARKS) {
        window.click(&format!("Select sample {number}"));
        draw(window, &strokes);
    }
    window.frame(vec![Event::PointerGone]);
    window.settle();
    Ok(())
}

/// Combs guides over a picture of a knot. This writes the picture into `folder`.
pub(crate) fn guides(window: &mut Window, folder: &Path) -> Result<(), Box<dyn Error>> {
    let mesh = SampleModel::TorusKnot.mesh(20_000);
    let camera = Framing { aspect: 1.5, ..Framing::default() }.fit(&mesh.positions);
    let style = Preset::Landscape.settings();
    let picture = ModelPainter::new(Compute::cpu(), mesh, &style, VIEW)?.paint(&camera)?;
    let view = folder.join("view.png");
    std::fs::write(&view, frame_png(&frame_of(&picture))?)?;
    window.studio_mut().panels.reference.close();
    pin(window, &view)?;
    window.click("Comb");
    window.click("View of a model");
    for line in GUIDES {
        draw(window, line);
    }
    window.frame(vec![Event::PointerGone]);
    window.settle();
    window.studio_mut().visible.palette = true;
    Ok(())
}

fn pin(window: &mut Window, path: &Path) -> Result<(), Box<dyn Error>> {
    let context = window.harness().ctx.clone();
    window.studio_mut().panels.reference.open(&context, path);
    wait_for(window, "Reference picture")?;
    std::thread::sleep(Duration::from_secs(1));
    window.settle();
    Ok(())
}

/// Draws a smooth curve with these control points on the fitted picture of 900 x 600 pixels.
fn draw(window: &mut Window, places: &[[f32; 2]]) {
    let panel = window.harness().get_by_label("Reference picture").rect();
    let zoom = (panel.width() / VIEW.0 as f32).min(panel.height() / VIEW.1 as f32);
    let middle = 0.5 * vec2(VIEW.0 as f32, VIEW.1 as f32);
    let along =
        (0..=40).map(|step| panel.center() + zoom * (curve(places, step as f32 / 40.0) - middle));
    window.pen_stroke(&along.collect::<Vec<Pos2>>());
    window.harness().run_steps(3);
}

/// A place on the curve with these control points (de Casteljau).
fn curve(places: &[[f32; 2]], share: f32) -> eframe::egui::Vec2 {
    let mut points: Vec<_> = places.iter().map(|&[x, y]| vec2(x, y)).collect();
    while points.len() > 1 {
        points = points.windows(2).map(|ends| ends[0] + share * (ends[1] - ends[0])).collect();
    }
    points[0]
}
