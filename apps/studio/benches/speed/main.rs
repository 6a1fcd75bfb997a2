//! Speed and memory of the built program on a virtual screen.
//!
//! `cargo bench -p impasto-studio --bench speed [-- MEASUREMENT ..] [SECONDS]` makes the
//! measurements that you name:
//!
//! - `round`: the round brush that the program opens with (60 cells) at 95 mm/s
//! - `flat`: a loaded flat brush of 25 mm (250 cells), as fast
//! - `idle`: time of the processor while nobody does anything
//! - `strokes`: memory at the start and after 200 strokes of the round brush
//! - `large`: memory with a canvas of 8000 x 8000 cells
//!
//! If you name none, it makes all. The window has 1920 x 1080 points. Figures of strokes come from
//! the program's option `--figures`, one line a second. You need Xvfb and a graphics adapter. A
//! software adapter shares the processor with the paint.

#![expect(clippy::print_stdout, clippy::unwrap_used, reason = "a bench prints, and may panic")]

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../../tests/window/screen.rs"]
mod screen;

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../../tests/window/program.rs"]
mod program;
mod paintings;
mod process;

use std::error::Error;
use std::path::Path;
use web_time::{Duration, Instant};

use process::Usage;
use program::Program;
use screen::Screen;

const MM_PER_SECOND: f64 = 95.0;

/// Width of the canvas that the program opens with, in mm.
const CANVAS_MM: f64 = 192.0;

/// Time between two positions of the mouse: 250 a second.
const INTERVAL: Duration = Duration::from_millis(4);

/// We ignore the figures of this many seconds at the start and at the end of a stroke, because the
/// hand paints only a part of them.
const MARGIN: f64 = 1.5;

const NAMES: [&str; 5] = ["round", "flat", "idle", "strokes", "large"];

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo passes `--bench`.
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let seconds = arguments.iter().find_map(|argument| argument.parse().ok()).unwrap_or(20.0);
    let named: Vec<&str> =
        NAMES.into_iter().filter(|name| arguments.iter().any(|a| a == name)).collect();
    let chosen = if named.is_empty() { NAMES.to_vec() } else { named };
    let screen = Screen::start(1920, 1080).ok_or("there is no Xvfb")?;
    let folder = tempfile::tempdir()?;
    for name in chosen {
        println!("{name}");
        // Each run has its own home. Otherwise the program would recover paintings of a killed one.
        let folder = &folder.path().join(name);
        std::fs::create_dir(folder)?;
        match name {
            "round" => speed(&screen, folder, &[], "1", seconds)?,
            "flat" => {
                let path = folder.join("flat.exr");
                paintings::loaded_flat(&path, 25.0)?;
                speed(&screen, folder, &[&path], "1", seconds)?;
            }
            "idle" => idle(&screen, folder, seconds),
            "strokes" => strokes(&screen, folder),
            _ => large(&screen, folder)?,
        }
    }
    Ok(())
}

fn start<'a>(screen: &'a Screen, folder: &Path, files: &[&Path]) -> Program<'a> {
    Program::start(screen, folder, "1920x1080", files)
}

/// Paints one stroke with the brush that the number key `brush` selects, for example `1`, and
/// prints the program's performance figures of each second.
fn speed(
    screen: &Screen,
    folder: &Path,
    files: &[&Path],
    brush: &str,
    seconds: f64,
) -> Result<(), Box<dyn Error>> {
    let program = start(screen, folder, files);
    screen.text(brush);
    let before = program.figures()?.len();
    Hand::over(&program).wander(seconds);
    let all = program.figures()?;
    println!("  second  frames/s  sub-steps/s  behind  pen to screen ms  worst ms");
    let lines = &all[before.min(all.len())..];
    let counted: Vec<&serde_json::Value> = lines
        .iter()
        .filter(|line| {
            let [second, first] =
                [*line, &lines[0]].map(|line| line["seconds"].as_f64().unwrap_or(0.0));
            (MARGIN..seconds - MARGIN).contains(&(second - first))
        })
        .collect();
    for line in &counted {
        println!(
            "  {:6.1}  {:8.0}  {:11.0}  {:6.0}  {:16.1}  {:8.1}",
            figure(line, "seconds"),
            figure(line, "frames_a_second"),
            figure(line, "substeps_a_second"),
            figure(line, "behind"),
            figure(line, "latency_ms"),
            figure(line, "worst_latency_ms"),
        );
    }
    let all = |name: &str| counted.iter().map(|line| figure(line, name)).collect::<Vec<f64>>();
    println!(
        "  median: {:.0} frames/s, pen to screen {:.1} ms; worst {:.1} ms, {:.0} sub-steps behind",
        median(&all("frames_a_second")),
        median(&all("latency_ms")),
        all("worst_latency_ms").into_iter().fold(0.0, f64::max),
        all("behind").into_iter().fold(0.0, f64::max),
    );
    Ok(())
}

fn figure(line: &serde_json::Value, name: &str) -> f64 {
    line[name].as_f64().unwrap_or(f64::NAN)
}

/// Prints the share of one core that the program takes at rest.
fn idle(screen: &Screen, folder: &Path, seconds: f64) {
    let program = start(screen, folder, &[]);
    let usage = Usage::of(&program.child);
    usage.settle();
    let before = usage.processor_seconds();
    std::thread::sleep(Duration::from_secs_f64(seconds));
    let share = 100.0 * (usage.processor_seconds() - before) / seconds;
    println!("  {share:.2} % of a core at rest, with one frame a second for the figures");
}

/// Prints the memory at the start and after 200 strokes.
fn strokes(screen: &Screen, folder: &Path) {
    let program = start(screen, folder, &[]);
    let usage = Usage::of(&program.child);
    usage.settle();
    println!("  at the start: {}", usage.memory());
    let hand = Hand::over(&program);
    for number in 0..200 {
        hand.stroke(number);
        if (number + 1) % 50 == 0 {
            usage.settle();
            println!("  after {:3} strokes: {}", number + 1, usage.memory());
        }
    }
}

/// Prints the memory of a large canvas, bare and after two strokes.
fn large(screen: &Screen, folder: &Path) -> Result<(), Box<dyn Error>> {
    let path = folder.join("large.exr");
    paintings::bare(&path, 8000)?;
    let program = start(screen, folder, &[&path]);
    let usage = Usage::of(&program.child);
    usage.settle();
    println!("  8000 x 8000 cells, opened: {}", usage.memory());
    let hand = Hand::over(&program);
    (0..2).for_each(|number| hand.stroke(40 * number));
    usage.settle();
    println!("  after two strokes: {}", usage.memory());
    Ok(())
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

struct Hand<'a> {
    program: &'a Program<'a>,
    pixels_per_second: f64,
}

impl<'a> Hand<'a> {
    fn over(program: &'a Program<'a>) -> Self {
        let [left, _, right, _] = program.canvas().expect("the program has a canvas");
        Self { program, pixels_per_second: MM_PER_SECOND * (right - left) / CANVAS_MM }
    }

    /// Paints one stroke from side to side and down the canvas for `seconds`.
    fn wander(&self, seconds: f64) {
        let screen = self.program.screen;
        let (left, top) = self.program.at(0.1, 0.15);
        let (right, bottom) = self.program.at(0.9, 0.85);
        let width = f64::from(right - left);
        let height = f64::from(bottom - top);
        let began = Instant::now();
        screen.point((left, top));
        screen.button(true);
        loop {
            let now = began.elapsed().as_secs_f64();
            if now >= seconds {
                break;
            }
            // The pen moves from the left to the right and back.
            let across = (self.pixels_per_second * now + width).rem_euclid(2.0 * width) - width;
            let x = f64::from(left) + across.abs();
            // It moves down a little for each crossing, so that most strokes meet bare canvas.
            let y = f64::from(top) + height * now / seconds;
            screen.point((x as i32, y as i32));
            std::thread::sleep(INTERVAL);
        }
        screen.button(false);
    }

    /// Paints a straight stroke across half of the canvas. `number` decides where.
    fn stroke(&self, number: i32) {
        let down = 0.1 + 0.8 * f64::from(number % 50) / 50.0;
        let across = if number % 100 < 50 { 0.08 } else { 0.5 };
        let [from, to] = [(across, down), (across + 0.4, down + 0.02)]
            .map(|(across, down)| self.program.at(across, down));
        self.program.screen.drag(from, to, 0.4);
        std::thread::sleep(Duration::from_millis(40));
    }
}
