//! The commands of docs/guide/measuring.md, run in order.

use suite::guides::commands;
use suite::program::{impasto, repository};

use crate::painted::{filled, oils};

/// Splits a filled measurement file into a file of spectra and a file of recipes.
fn parted(full: &str) -> (String, String) {
    let header: Vec<&str> = full.lines().next().unwrap().split(',').collect();
    let first_nm = header.iter().position(|name| *name == "400").unwrap();
    let mut spectra = String::new();
    let mut amounts = String::new();
    let mut last = "";
    for line in full.lines() {
        let cells: Vec<&str> = line.split(',').collect();
        spectra += &format!("{},{}\n", cells[..3].join(","), cells[first_nm..].join(","));
        if cells[0] != last && cells[1] != "none" {
            amounts += &format!("{},{}\n", cells[0], cells[4..first_nm].join(","));
        }
        last = cells[0];
    }
    (spectra, amounts)
}

/// Readings of bare paper and of washes of two paints with invented K and S on it.
fn washes() -> String {
    let nm: Vec<f64> = (0..16).map(|step| 400.0 + 20.0 * f64::from(step)).collect();
    let band = |nm: f64, center: f64| (-((nm - center) / 70.0).powi(2)).exp();
    let paper = |nm: f64| 0.8 + 0.1 * (nm - 400.0) / 300.0;
    let wash = |amounts: [f64; 2], nm: f64| {
        let k = amounts[0] * (1.5 + 100.0 * band(nm, 590.0))
            + amounts[1] * (6.0 + 90.0 * band(nm, 430.0));
        let s = amounts[0] * 4.0 + amounts[1] * 12.0;
        if s == 0.0 {
            return paper(nm);
        }
        // Kubelka (1948), a layer on a ground.
        let a = 1.0 + k / s;
        let b = (a * a - 1.0).sqrt();
        let b_coth = b / (b * s).tanh();
        (1.0 - paper(nm) * (a - b_coth)) / (a - paper(nm) + b_coth)
    };
    let header = nm.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let mut text = format!("sample,film,Ultramarine,Burnt Sienna,{header}\n");
    let ladder = [0.01, 0.02, 0.04, 0.08];
    let alone = ladder.iter().flat_map(|&amount| [[amount, 0.0], [0.0, amount]]);
    for amounts in std::iter::once([0.0, 0.0]).chain(alone).chain([[0.02, 0.02], [0.04, 0.01]]) {
        let (name, film) = match amounts {
            [0.0, 0.0] => ("paper".to_owned(), "none"),
            [first, second] => (format!("U {first} S {second}"), "paint"),
        };
        let values: Vec<String> =
            nm.iter().map(|&nm| format!("{:.4}", wash(amounts, nm))).collect();
        let [first, second] = amounts;
        text += &format!("{name},{film},{first},{second},{}\n", values.join(","));
    }
    text
}

#[test]
fn every_command_of_the_page_on_measuring_runs() {
    let page = std::fs::read_to_string(repository("docs/guide/measuring.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let oils = oils();
    for (name, light) in [("white.txt", 20_000.0), ("dark.txt", 200.0), ("swatch.txt", 9_000.0)] {
        let text: String = (0..31)
            .map(|step: u32| format!("{} {}\n", 400 + 10 * step, light + f64::from(step)))
            .collect();
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    std::fs::write(folder.path().join("washes.csv"), washes()).unwrap();
    let mut ran = 0;
    for command in commands(&page) {
        let in_folder = |word: &String| {
            // A spectrum of a file stands behind its name.
            let file = word.split('#').next().unwrap_or_default();
            let is_file = [".csv", ".json", ".txt"].iter().any(|end| file.ends_with(end));
            if is_file { folder.path().join(word).display().to_string() } else { word.clone() }
        };
        let words: Vec<String> = command.words.iter().skip(1).map(in_folder).collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let run = impasto(&words);
        assert_eq!(run.status, 0, "{}\n{}", command.line, run.err);
        assert!(!run.err.contains("left out: card"), "the cards are lost\n{}", run.err);
        ran += 1;
        // The file of a plan is filled in before the next command reads it.
        if let Some(at) = words.iter().position(|word| *word == "-o")
            && words[0] == "plan"
        {
            let empty = std::fs::read_to_string(words[at + 1]).unwrap();
            let full = filled(&empty, &oils, 0.002, 3);
            std::fs::write(words[at + 1], &full).unwrap();
            let (spectra, amounts) = parted(&full);
            std::fs::write(folder.path().join("spectra.csv"), spectra).unwrap();
            std::fs::write(folder.path().join("amounts.csv"), amounts).unwrap();
        }
    }
    assert!(ran >= 11, "{ran} commands");
}
