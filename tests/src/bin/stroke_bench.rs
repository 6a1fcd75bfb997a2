//! Paints and measures the bench of strokes, and writes its table, its figures as JSON and its
//! picture sheet:
//!
//! `cargo run --release -p suite --bin stroke-bench -- --out FOLDER [--case NAME]... [--small]`

#![expect(clippy::print_stdout, reason = "a program prints its results")]

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use suite::stroke_bench::canvas::Bench;
use suite::stroke_bench::strokes::CASES;
use suite::stroke_bench::{report, sheet};

const USAGE: &str = "stroke-bench [--out FOLDER] [--case NAME]... [--small]

Paints a fixed set of strokes, measures them in mm, and writes strokes.txt, strokes.json, strokes.png
and one PNG a case to FOLDER (stroke-bench by default). --small takes cells of 0.2 mm and fewer
strokes.";

struct Arguments {
    out: PathBuf,
    cases: Vec<String>,
    small: bool,
}

impl Arguments {
    fn parse() -> Result<Self, String> {
        let mut parsed =
            Self { out: PathBuf::from("stroke-bench"), cases: Vec::new(), small: false };
        let mut rest = std::env::args().skip(1);
        while let Some(argument) = rest.next() {
            let mut value = || rest.next().ok_or(format!("{argument} needs a value"));
            match argument.as_str() {
                "--out" => parsed.out = value()?.into(),
                "--case" => parsed.cases.push(value()?),
                "--small" => parsed.small = true,
                _ => return Err(format!("unknown argument {argument}\n\n{USAGE}")),
            }
        }
        let names: Vec<&str> = CASES.iter().map(|(name, _)| *name).collect();
        match parsed.cases.iter().find(|case| !names.contains(&case.as_str())) {
            Some(case) => Err(format!("no case {case}; cases are {}", names.join(", "))),
            None => Ok(parsed),
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().any(|argument| argument == "--help") {
        println!("{USAGE}");
        return Ok(());
    }
    let Arguments { out, cases, small } = Arguments::parse()?;
    let bench = Bench::new(small);
    let mut reports = Vec::new();
    std::fs::create_dir_all(&out)?;
    for (name, case) in CASES {
        if cases.is_empty() || cases.iter().any(|chosen| chosen == name) {
            let start = Instant::now();
            let report = case(&bench);
            sheet::picture(&report)?.save(out.join(format!("{name}.png")))?;
            println!("{name}: {:.1} s", start.elapsed().as_secs_f64());
            reports.push(report);
        }
    }
    let table = report::table(&reports);
    let json = serde_json::to_string_pretty(&report::json(bench.cell_mm, bench.small, &reports))?;
    documents::file::write_whole(&out.join("strokes.txt"), table.as_bytes())?;
    documents::file::write_whole(&out.join("strokes.json"), json.as_bytes())?;
    sheet::sheet(&reports)?.save(out.join("strokes.png"))?;
    println!("\n{table}\nWrote strokes.txt, strokes.json and strokes.png to {}", out.display());
    Ok(())
}
