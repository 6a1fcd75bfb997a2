//! Manual pages. We add examples, exit status and environment to the pages that clap makes, and
//! examples to the help of every verb.

use std::io;

use clap::Command;
use clap::builder::Resettable;
use clap_mangen::Man;
use clap_mangen::roff::{Inline, Roff, bold, roman};

use crate::library_choice::VARIABLE;

/// Exit status of every verb, as docs/guide/command-line.md describes it.
const STATUS: [(&str, &str); 4] = [
    ("0", "Done, also where the reader of a pipe wants no more."),
    ("1", "The data: a file does not hold what is needed, or a check says no."),
    (
        "2",
        "The command or the machine: an unknown option or value, a file that is not there, no \
         graphics adapter. Nothing was computed.",
    ),
    ("129, 130, 143", "Ended by SIGHUP, SIGINT or SIGTERM."),
];

/// The name of a file, and the page that it holds.
type Page = (String, Vec<u8>);

/// Pages of a built command and of those below it, with the names of their files.
///
/// # Errors
/// The name of a page that could not be made, with the reason.
pub(crate) fn pages(command: &Command) -> Result<Vec<Page>, (String, io::Error)> {
    let mut pages = Vec::new();
    collect(command, &mut pages)?;
    Ok(pages)
}

fn collect(command: &Command, pages: &mut Vec<Page>) -> Result<(), (String, io::Error)> {
    let name = command.get_display_name().unwrap_or(command.get_name()).to_owned();
    let page = page(command, &name).map_err(|error| (name.clone(), error))?;
    pages.push((format!("{name}.1"), page));
    listed_verbs(command).try_for_each(|inner| collect(inner, pages))
}

/// Verbs below `command` that have a page.
fn listed_verbs(command: &Command) -> impl Iterator<Item = &Command> {
    let inner = command.get_subcommands();
    inner.filter(|inner| !inner.is_hide_set() && inner.get_name() != "help")
}

fn page(command: &Command, name: &str) -> io::Result<Vec<u8>> {
    let mut page = Vec::new();
    // Sections of their own follow for both. The verb `help` has no page to refer to.
    let plain = command.clone().after_help(Resettable::Reset).after_long_help(Resettable::Reset);
    let plain = plain.version(Resettable::Reset);
    let plain = match plain.find_subcommand("help").is_some() {
        true => plain.mut_subcommand("help", |help| help.hide(true)),
        false => plain,
    };
    Man::new(plain)
        // An empty date, which the crate would leave out together with its place.
        .date("\"\"")
        .source(concat!("impasto ", env!("CARGO_PKG_VERSION")))
        .manual("Manual of impasto")
        .render(&mut page)?;
    let mut more = Roff::new();
    match name == "impasto" {
        true => {
            more.control("SH", ["EXIT STATUS"]);
            for (status, text) in STATUS {
                entry(&mut more, bold(status), text);
            }
            more.control("SH", ["ENVIRONMENT"]);
            let text = "Path of the library that verbs use where none is named.";
            entry(&mut more, bold(VARIABLE), text);
        }
        false => {
            examples(command, &mut more);
            more.control("SH", ["SEE ALSO"]);
            more.text([bold("impasto"), roman("(1)")]);
        }
    }
    more.to_writer(&mut page)?;
    Ok(page)
}

/// A term and the text that explains it.
fn entry(page: &mut Roff, term: Inline, text: &str) {
    page.control("TP", []);
    page.text([term]);
    page.text([roman(text)]);
}

/// Examples of the help. Their lines stay whole so that you can copy them.
fn examples(command: &Command, page: &mut Roff) {
    let Some(help) = command.get_after_long_help().map(ToString::to_string) else { return };
    page.control("SH", ["EXAMPLES"]);
    page.control("nf", []);
    for line in help.lines().skip(1) {
        page.text([roman(line.trim_start())]);
    }
    page.control("fi", []);
}

/// Verbs, by their words, and commands that show them.
const EXAMPLES: [(&str, &[&str]); 38] = [
    (
        "film",
        &[
            "impasto film cards.csv --thickness-mm 0.1",
            "impasto film films.ti3 --over-white W1 --over-black B1 --white-card W0 --black-card B0 --csv",
        ],
    ),
    (
        "fit",
        &[
            "impasto fit measurements/van-gogh-oils.csv --saunderson 0.03,0.6 --below-surface floor -o oils.json",
            "impasto fit swatches.ti3 --recipes recipes.csv --white \"Zinc White\" -o paints.json",
            "impasto fit measurements/van-gogh-oils.csv --below-surface floor --half 1 -o half.json",
            "impasto fit counts.csv --white-reading white.txt --dark-reading dark.txt --csv",
        ],
    ),
    (
        "validate",
        &[
            "impasto validate measurements/van-gogh-oils.csv",
            "impasto validate readings.csv --with Viridian --csv",
            "impasto validate readings.csv --residuals residuals.json",
        ],
    ),
    (
        "mix",
        &[
            "impasto mix oils.json \"Zinc White=9\" \"Cobalt Blue=1\"",
            "impasto mix \"Viridian=1\" --thickness 0.5 --over black",
        ],
    ),
    (
        "color",
        &[
            "impasto color batch.csv --against standard.csv --tolerance 1",
            "impasto color measurements/van-gogh-oils.csv --illuminant FL11 --observer 10",
            "impasto color swatch.txt --white-reading white.txt --dark-reading dark.txt --tile 0.98",
            "cat spectra.csv | impasto color - --csv",
        ],
    ),
    (
        "map",
        &[
            "impasto map scan.hdr oils.json -o maps.zarr --pictures maps",
            "impasto map scan.hdr oils.json --residuals residuals.json -o maps.zarr",
            "impasto map scan.hdr oils.json --ground 0..20,0..100 -o maps.zarr",
            "impasto map scan.hdr oils.json --palette \"Lead White\" --palette Ultramarine --json",
            "impasto map field.hdr oils.json -o maps.zarr --truth field-truth.zarr",
            "impasto map capture.hdr -o maps.zarr --white-reading white.hdr --dark-reading dark.hdr --resume",
            "impasto map reflectance.hdr oils.json --scale 10000 -o maps.zarr",
        ],
    ),
    (
        "identify",
        &[
            "impasto identify spots.csv oils.json",
            "impasto identify \"fors.txt#sky\" oils.json --palette \"Lead White\" --palette Ultramarine",
            "impasto identify spots.csv oils.json --residuals residuals.json --csv",
        ],
    ),
    (
        "simulate-scan",
        &[
            "impasto simulate-scan field.exr -o field.hdr",
            "impasto simulate-scan field.exr -o fine.hdr --bands 204 --seed 7",
        ],
    ),
    ("light", &["impasto light A FL11 LED-B3", "impasto light lamp.spdx --samples"]),
    (
        "quadrature",
        &["impasto quadrature oils.json --illuminant D65", "impasto quadrature -n 4 --csv"],
    ),
    (
        "match",
        &[
            "impasto match oils.json \"#4a7d8c\" --grams 40",
            "impasto match oils.json swatches.csv --illuminant D65 --illuminant A=0.5 --parts 12",
            "impasto match oils.json \"swatches.csv#sky\" --by spectrum",
            "impasto match 52,-10.5,8 --with \"Lead White\" --csv",
        ],
    ),
    (
        "correct",
        &[
            "impasto correct oils.json pot.csv#standard pot.csv#batch --made \"Zinc White=440\" \"Cobalt Blue=60\"",
            "impasto correct \"#5092e1\" batch.csv --made \"Zinc White=1\" --grams 500 --stock \"Cobalt Blue=20\"",
        ],
    ),
    ("library list", &["impasto library list oils.json", "impasto library list --csv"]),
    ("library show", &["impasto library show oils.json Viridian --csv"]),
    ("library check", &["impasto library check oils.json"]),
    ("library diff", &["impasto library diff oils.json batch2.json --tolerance 1"]),
    ("library merge", &["impasto library merge oils.json batch2.json --prefer last -o both.json"]),
    (
        "library convert",
        &[
            "impasto library convert oils.json --white \"Lead White\" -o lead.json",
            "impasto library convert oils.json --grid 400,700,5 -o fine.json",
        ],
    ),
    ("library rename", &["impasto library rename oils.json \"Viridian=PG18\" -o named.json"]),
    (
        "library subset",
        &["impasto library subset oils.json \"Zinc White\" Viridian Cobalt -o few.json"],
    ),
    (
        "library export",
        &[
            "impasto library export oils.json --tints -o oils.ase",
            "impasto library export oils.json --to csv -o -",
        ],
    ),
    (
        "library from-rgb",
        &["impasto library from-rgb oils.json \"#2a5caa\" --name Sky -o with-sky.json"],
    ),
    (
        "plan",
        &[
            "impasto plan \"Cobalt Blue\" Viridian --white \"Zinc White\" -o readings.csv",
            "impasto plan oils.json \"Cobalt Blue\" Viridian --white \"Zinc White\" --swatches 16 --csv",
        ],
    ),
    ("report", &["impasto report oils.json measurements/van-gogh-oils.csv -o out/oils"]),
    ("demo", &["impasto demo", "impasto demo -o out"]),
    (
        "paint",
        &[
            "impasto paint paintings/landscape.json -o field.png -o field.exr",
            "impasto paint --from photo.jpg oils.json -o painted.png",
        ],
    ),
    (
        "relight",
        &[
            "impasto relight field.exr --illuminant A --adaptation 0.4 -o evening.png",
            "impasto relight field.exr --swap \"all:Prussian Blue=Ultramarine\" -o other.png",
        ],
    ),
    (
        "watercolor",
        &[
            "impasto watercolor photo.jpg --preset portrait -o watercolor.png",
            "impasto watercolor photo.jpg oils.json -o glazed.exr",
            "impasto watercolor shape:village --turntable 60 --animation turning.gif",
        ],
    ),
    (
        "artmap sample",
        &[
            "impasto artmap sample painted.jpg --propose 4 -o marks.toml --marked marked.png",
            "impasto artmap sample painted.jpg --marks marks.toml -o samples.exr --sheet samples.png",
        ],
    ),
    ("artmap paint", &["impasto artmap paint oils.json --style dabs -o dabs.exr --sheet dabs.png"]),
    ("artmap build", &["impasto artmap build dabs.exr -o dabs.artmap.exr --sheet map.png"]),
    ("artmap check", &["impasto artmap check dabs.artmap.exr --csv"]),
    ("artmap show", &["impasto artmap show dabs.exr --sheet dabs.png"]),
    (
        "painterly",
        &[
            "impasto painterly shape:still-life --style oil-flat --set colour.from=model -o still-life.png",
            "impasto painterly photo.jpg --preset knife -o knife.png",
        ],
    ),
    (
        "stencil",
        &[
            "impasto stencil shape:village --pour 0.5,0.5,300 -o village.png",
            "impasto stencil shape:still-life oils.json --pour 0.4,0.5,15 --paint Ultramarine -o glazes.exr",
        ],
    ),
    ("gpu", &["impasto gpu"]),
    ("completions", &["impasto completions zsh"]),
    ("man", &["impasto man man/man1"]),
];

/// `-h` shows at most this many examples.
const SHOWN: usize = 2;

/// The command line with its examples.
pub(crate) fn with_examples(whole: Command) -> Command {
    EXAMPLES.iter().fold(whole, |whole, (path, lines)| {
        let words: Vec<&str> = path.split(' ').collect();
        let [short, whole_text] = [SHOWN.min(lines.len()), lines.len()]
            .map(|count| format!("Examples:\n  {}", lines[..count].join("\n  ")));
        at(whole, &words, [&short, &whole_text])
    })
}

/// The command with texts below the short and the long help of the verb that `words` name, if it has this verb.
fn at(command: Command, words: &[&str], [short, long]: [&str; 2]) -> Command {
    match words {
        [] => command.after_help(short.to_owned()).after_long_help(long.to_owned()),
        [first, rest @ ..] if command.find_subcommand(first).is_some() => {
            command.mut_subcommand(*first, |inner| at(inner, rest, [short, long]))
        }
        _ => command,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::command;

    /// Splits a command into words as a shell does, with double quotes.
    fn words(line: &str) -> Vec<String> {
        let mut words = Vec::new();
        for (index, part) in line.split('"').enumerate() {
            match index % 2 {
                1 => words.push(part.to_owned()),
                _ => words.extend(part.split_whitespace().map(str::to_owned)),
            }
        }
        words
    }

    #[test]
    fn every_example_is_a_command_of_its_verb() {
        for (path, lines) in EXAMPLES {
            for line in lines {
                let own = line.rsplit_once("| ").map_or(*line, |(_, own)| own);
                assert!(own.starts_with(&format!("impasto {path}")), "{line}");
                let parsed = command().try_get_matches_from(words(own));
                assert!(parsed.is_ok(), "{line}\n{}", parsed.unwrap_err());
            }
        }
    }

    #[test]
    fn every_verb_has_an_example() {
        fn check(command: &Command, path: &str) {
            for verb in command.get_subcommands().filter(|verb| !verb.is_hide_set()) {
                let own = format!("{path}{}", verb.get_name());
                if verb.has_subcommands() {
                    check(verb, &format!("{own} "));
                } else {
                    assert!(EXAMPLES.iter().any(|(path, _)| *path == own), "{own} has no example");
                }
            }
        }
        check(&command(), "");
    }
}
