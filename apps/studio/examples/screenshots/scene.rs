//! A scene of paint volumes while the pen pours.

use std::error::Error;
use std::time::Duration;

use eframe::egui::{Event, Pos2, Rect, vec2};
use session::volumes::{Subject, VolumeCommand};
use studio::app::Volumes;

use crate::window::{Window, button};

/// Paint poured a second, in mm3.
const RATE: f64 = 130.0;

/// Steps that the pen is held at the start of a drag, and at its end.
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
    let step = |volumes: &Volumes| volumes.state().map_or(0, |state| state.time.step);
    let until = steps + window.studio().volumes.as_ref().map_or(0, step);
    wait(window, |volumes| step(volumes) >= until)
}

/// Draws frames until `done`.
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
