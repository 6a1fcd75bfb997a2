//! Manual pages: those that clap makes, with examples to copy, exit status and environment.

use std::io;

use clap::Command;
use clap::builder::Resettable;
use clap_mangen::Man;
use clap_mangen::roff::{Inline, Roff, bold, roman};

use crate::library_choice::VARIABLE;

/// Exit status of every verb, as docs/guide/command-line.md tells it.
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
    shown(command).try_for_each(|inner| collect(inner, pages))
}

/// Verbs below `command` that have a page.
fn shown(command: &Command) -> impl Iterator<Item = &Command> {
    let inner = command.get_subcommands();
    inner.filter(|inner| !inner.is_hide_set() && inner.get_name() != "help")
}

fn page(command: &Command, name: &str) -> io::Result<Vec<u8>> {
    let mut page = Vec::new();
    // Sections of their own follow for both. The verb `help` has no page to refer to.
    let plain = command.clone().after_help(Resettable::Reset).version(Resettable::Reset);
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

/// Examples of the help, whose lines stay whole so that they can be copied.
fn examples(command: &Command, page: &mut Roff) {
    let Some(help) = command.get_after_help().map(ToString::to_string) else { return };
    page.control("SH", ["EXAMPLES"]);
    page.control("nf", []);
    for line in help.lines().skip(1) {
        page.text([roman(line.trim_start())]);
    }
    page.control("fi", []);
}
