//! Speed of the program under the hand: the built binary on a virtual screen of 1280 x 800, whose
//! mouse paints with the round brush that the program opens with (60 cells) at 95 mm/s.
//!
//! `cargo bench -p impasto-studio --bench pen [-- SECONDS]` prints the program's own figures,
//! one line a second, and their summary. Needs Xvfb and a graphics adapter. A software adapter
//! shares the processor with the paint.

#![expect(clippy::print_stdout, clippy::unwrap_used, reason = "a bench prints, and may panic")]

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../tests/window/screen.rs"]
mod screen;

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../tests/window/program.rs"]
mod program;

use std::error::Error;
use std::time::{Duration, Instant};

use program::Program;
use screen::Screen;

/// Speed of the hand.
const MM_PER_SECOND: f64 = 95.0;

/// Width of the canvas that the program opens with, in mm.
const CANVAS_MM: f64 = 192.0;

/// Time between two positions of the mouse: 250 a second.
const INTERVAL: Duration = Duration::from_millis(4);

/// Seconds at the start and the end that are not counted, as the hand does not paint all the
/// time.
const MARGIN: f64 = 1.5;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo passes `--bench`.
    let seconds = std::env::args().skip(1).find_map(|argument| argument.parse().ok());
    let seconds: f64 = seconds.unwrap_or(20.0);
    let screen = Screen::start(1280, 800).ok_or("there is no Xvfb")?;
    let home = tempfile::tempdir()?;
    let program = Program::start(&screen, home.path(), "1280x800", &[]);
    let [left, _, right, _] = program.canvas().ok_or("the program has no canvas")?;
    let pixels_per_second = MM_PER_SECOND * (right - left) / CANVAS_MM;
    let before = program.figures()?.len();
    paint(&screen, &program, pixels_per_second, seconds);
    let all = program.figures()?;
    println!("second  frames/s  sub-steps/s  behind  pen to screen ms  worst ms");
    let lines = &all[before.min(all.len())..];
    let counted = lines.iter().filter(|line| {
        let since =
            line["seconds"].as_f64().unwrap_or(0.0) - lines[0]["seconds"].as_f64().unwrap_or(0.0);
        (MARGIN..seconds - MARGIN).contains(&since)
    });
    let (mut behind, mut latency, mut count) = (0.0_f64, 0.0, 0.0);
    for line in counted {
        let figure = |name: &str| line[name].as_f64().unwrap_or(f64::NAN);
        println!(
            "{:6.1}  {:8.0}  {:11.0}  {:6.0}  {:16.1}  {:8.1}",
            figure("seconds"),
            figure("frames_a_second"),
            figure("substeps_a_second"),
            figure("behind"),
            figure("latency_ms"),
            figure("worst_latency_ms"),
        );
        behind = behind.max(figure("behind"));
        latency += figure("latency_ms");
        count += 1.0;
    }
    println!("at most {behind:.0} sub-steps behind, pen to screen {:.1} ms mean", latency / count);
    Ok(())
}

/// Paints one stroke from side to side and down the canvas for `seconds`.
fn paint(screen: &Screen, program: &Program<'_>, pixels_per_second: f64, seconds: f64) {
    let (left, top) = program.at(0.1, 0.15);
    let (right, bottom) = program.at(0.9, 0.85);
    let (width, height) = (f64::from(right - left), f64::from(bottom - top));
    let began = Instant::now();
    screen.point((left, top));
    screen.button(true);
    loop {
        let now = began.elapsed().as_secs_f64();
        if now >= seconds {
            break;
        }
        let way = pixels_per_second * now;
        // From the left to the right and back.
        let across = (way + width).rem_euclid(2.0 * width) - width;
        let x = f64::from(left) + across.abs();
        // A part of the height for each crossing, so that most strokes meet bare canvas.
        let y = f64::from(top) + height * now / seconds;
        screen.point((x as i32, y as i32));
        std::thread::sleep(INTERVAL);
    }
    screen.button(false);
}
