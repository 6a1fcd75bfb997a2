//! Renders the pictures of the window for the README: the real window with a real worker, without a
//! window system, while it paints a small study.
//!
//! `cargo run -p impasto-studio --example screenshots -- FOLDER` writes `studio.png`,
//! `studio-lights.png`, `studio-colour.png`, `studio-marks.png`, `studio-guides.png`,
//! `studio-layers.png` and `studio-volumes.png` there. If you add the name `studio-volumes`, it
//! makes only the picture of the scene. `docs/images/studio.sh` converts them to the JPEGs in
//! `docs/images/`. You need a graphics adapter, but a software one is enough.

mod window;
mod study;

use std::error::Error;
use std::path::{Path, PathBuf};
use web_time::Instant;

use eframe::egui::{Event, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use paint::document::Lighting;
use paint::pose::Sample;
use paint::strokes::{Action, SampleDecimals, SurfaceId};
use session::{Command, PenSample};
use studio::app::Tab;
use studio::panels::Mode;

use study::{Hand, samples};
use window::{Window, has_adapter, wait_for};

const SIZE: Vec2 = vec2(1440.0, 900.0);

/// Window size in points, tall enough for two groups of tabs.
const TALL: Vec2 = vec2(1440.0, 960.0);

/// Seed of the unsteadiness of the hand.
const SEED: u64 = 1890;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or("which folder? screenshots FOLDER")?;
    if !has_adapter() {
        return Err("the window is drawn on a graphics adapter; install a Vulkan driver, such as \
                    lavapipe (mesa-vulkan-drivers)"
            .into());
    }
    let mut window = Window::with_commands("screenshots", SIZE, 1.0, vec![study::new_painting()]);
    if std::env::args().nth(2).as_deref() == Some("studio-volumes") {
        window::pouring(&mut window)?;
        return save(&mut window, &folder, "studio-volumes");
    }
    at_work(&mut window);
    save(&mut window, &folder, "studio")?;
    window.studio_mut().ask(Command::PenUp);
    window.settle();
    two_lights(&mut window);
    save(&mut window, &folder, "studio-lights")?;
    window.studio_mut().ask(Command::SetSecondLight(None));
    colors(&mut window)?;
    save(&mut window, &folder, "studio-colour")?;
    window.studio_mut().panels.reference.close();
    window::marks(&mut window)?;
    save(&mut window, &folder, "studio-marks")?;
    window::guides(&mut window, &folder)?;
    save(&mut window, &folder, "studio-guides")?;
    window.studio_mut().panels.reference.close();
    layers(&mut window);
    save(&mut window, &folder, "studio-layers")?;
    window.harness().set_size(SIZE);
    window::pouring(&mut window)?;
    save(&mut window, &folder, "studio-volumes")
}

/// Paints the study, and takes a picture during a stroke.
fn at_work(window: &mut Window) {
    let mut hand = Hand::new(SEED);
    study::palette(&mut hand);
    study::surroundings(&mut hand);
    hand.actions.push(Action::Dry { fraction: 1.0 });
    study::fruits(&mut hand);
    hand.actions.push(Action::Dry { fraction: 1.0 });
    study::lights(&mut hand);
    carry_out(window, hand);
    window.studio_mut().tools.brush = "round".to_owned();
    let brush = "round".to_owned();
    window.studio_mut().ask(Command::PenDown {
        surface: SurfaceId::Canvas,
        brush,
        decimals: SampleDecimals::RECORDING,
    });
    let mut led = samples(&study::AT_WORK, 0.55);
    // We stop before the pen is lifted.
    led.truncate(led.len() * 4 / 5);
    let arrived = Instant::now();
    // The pen is held in the right hand.
    let led = led
        .into_iter()
        .map(|sample| PenSample {
            sample: Sample { tilt_x_deg: 38.0, tilt_y_deg: 26.0, ..sample },
            arrived,
        })
        .collect();
    window.studio_mut().ask(Command::PenMove(led));
    window.settle();
}

fn carry_out(window: &mut Window, hand: Hand) {
    for action in hand.actions {
        window.studio_mut().ask(Command::Apply(action));
        window.settle();
    }
}

/// Shows daylight and a lamp side by side.
fn two_lights(window: &mut Window) {
    let lamp = Lighting { illuminant: "A".to_owned(), ..study::light() };
    window.studio_mut().ask(Command::SetSecondLight(Some(lamp)));
    window.studio_mut().panels.select(Tab::Light);
    window.studio_mut().tools.split = 0.5;
    window.settle();
}

/// Matches a colour of the reference photograph.
fn colors(window: &mut Window) -> Result<(), Box<dyn Error>> {
    let photograph = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/images/still-life.png");
    let context = window.harness().ctx.clone();
    window.studio_mut().panels.reference.open(&context, &photograph);
    wait_for(window, "Reference picture")?;
    window.settle();
    window.studio_mut().tools.mode = Mode::Pick;
    let there = window.point(SurfaceId::Canvas, 55.5, 34.0);
    window.pen_stroke(&[there, there]);
    window.settle();
    let picture = window.harness().get_by_label("Reference picture").rect();
    let pear = picture.center() + vec2(0.02, 0.0) * picture.width();
    window.pen_stroke(&[pear, pear]);
    wait_for(window, "Load recipe 3")?;
    window.frame(vec![Event::PointerMoved(there)]);
    window.settle();
    Ok(())
}

/// Dries all paint and adds a glaze.
fn layers(window: &mut Window) {
    window.studio_mut().tools.mode = Mode::Paint;
    window.frame(vec![Event::PointerGone]);
    window.harness().set_size(TALL);
    let mut hand = Hand::new(SEED);
    hand.actions.push(Action::Dry { fraction: 1.0 });
    study::glazes(&mut hand);
    carry_out(window, hand);
    window.studio_mut().panels.select(Tab::Layers);
    window.studio_mut().panels.select(Tab::History);
    window.studio_mut().tools.brush = "mop".to_owned();
    window.settle();
}

fn save(window: &mut Window, folder: &Path, name: &str) -> Result<(), Box<dyn Error>> {
    let picture = window.picture().ok_or("the graphics adapter is gone")?;
    Ok(picture.save(folder.join(format!("{name}.png")))?)
}
