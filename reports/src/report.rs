//! The report: its sections, drawn in parallel, and the files made of them.
//!
//! The page is one HTML file that needs no other file.

use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use calibrate::comparison::Comparison;
use calibrate::evaluate::Summary;
use calibrate::validation::Validation;
use documents::{Task, name_list};

use crate::figure::{Cell, Column, Figure, Table};
#[cfg(feature = "pictures")]
use crate::picture::{PictureError, png};
use crate::style::{Color, PAPER, RESERVED, SERIES};
use crate::subject::{Part, Section, Subject};
use crate::svg::escaped;

type Drawer = fn(&Subject<'_>) -> Section;

/// Every section, in the order of the page.
const SECTIONS: [Drawer; 11] = [
    crate::fit::samples_section,
    crate::fit::errors_section,
    crate::fit::left_out_section,
    crate::fit::residuals_section,
    crate::fit::curves_section,
    crate::palette::mixing_section,
    crate::palette::graded_section,
    crate::palette::gamut_section,
    crate::palette::strength_section,
    crate::palette::lights_section,
    crate::light::section,
];

/// Number of steps of [`Report::draw`] and [`page_alone`].
pub const STEPS: usize = SECTIONS.len();

/// A finished report.
#[cfg(feature = "pictures")]
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Title, facts and warnings above the sections.
    pub head: Head,
    /// The sections that are not empty.
    pub sections: Vec<Section>,
    pictures: Vec<Vec<u8>>,
}

/// Writes title, facts and warnings of a report on `subject`.
fn head(subject: &Subject<'_>) -> Head {
    let library = subject.library;
    let mut facts = vec![
        fact("Pigments", library.pigments.len().to_string()),
        fact("Wavelengths", library.grid.to_string()),
        fact("K and S", subject.unit()),
        fact("Surface", format!("k1 = {}, k2 = {}", library.saunderson.k1, library.saunderson.k2)),
    ];
    if library.unevenness > 0.0 {
        facts.push(fact("Unevenness", library.unevenness.to_string()));
    }
    facts.push(fact("Light", subject.light()));
    if let Some(comparison) = &subject.comparison {
        let samples = comparison.sure().count();
        facts.push(fact("Fitted", errors(samples, "sample", &comparison.delta_e)));
    }
    if let Some(Validation { per_sample, delta_e, .. }) = &subject.validation {
        facts.push(fact("Left out", errors(per_sample.len(), "mixture", delta_e)));
    }
    facts.push(fact("Source", library.source.clone()));
    facts.push(fact("Licence", library.licence.clone()));
    for input in &library.inputs {
        facts.push(fact("Fitted to", format!("{} (SHA-256 {})", input.path, input.sha256)));
    }
    let mut warnings = Vec::new();
    for pigment in &library.pigments {
        // A fit repeats these notes among its warnings.
        if library.evidence.is_none() {
            warnings.extend(pigment.notes.iter().map(|note| format!("{}: {note}", pigment.name)));
        }
        if pigment.guessed {
            warnings.push(format!("{}: guessed from a colour, not measured", pigment.name));
        }
    }
    warnings.extend(subject.comparison.iter().flat_map(absences));
    warnings.extend(library.evidence.iter().flat_map(|evidence| evidence.warnings.clone()));
    let title = if library.title.is_empty() { "A pigment library" } else { &library.title };
    let warnings = warnings.into_iter().map(|text: String| {
        let recipes = subject.named_recipes(&text);
        Warning { text, recipes }
    });
    let title = title.to_owned();
    let command = subject.command.clone();
    Head { title, facts, warnings: warnings.collect(), command }
}

fn fact(name: &str, fact: String) -> (String, String) {
    (name.to_owned(), fact)
}

fn errors(count: usize, item: &str, errors: &Summary) -> String {
    let items = documents::counted(count, item);
    format!(
        "{items}, CIEDE2000 mean {:.2}, median {:.2}, 90 % below {:.2}, largest {:.2}",
        errors.mean, errors.median, errors.p90, errors.max
    )
}

/// A warning names at most this many samples.
const NAMED: usize = 20;

/// Warnings about measurements that the report leaves out or has resampled.
#[must_use]
pub fn absences(comparison: &Comparison) -> Vec<String> {
    let resampled = comparison
        .resampled_from
        .map(|grid| format!("the readings ({grid}) were brought to the library's wavelengths"));
    let absent = &comparison.absent;
    let mut lacking: Vec<&str> =
        absent.iter().flat_map(|(_, pigments)| pigments.iter().map(String::as_str)).collect();
    lacking.sort_unstable();
    lacking.dedup();
    let samples: Vec<&str> = absent.iter().map(|(sample, _)| sample.as_str()).collect();
    let absent = (!samples.is_empty()).then(|| {
        format!(
            "left out of this report, since the library has no {}: {}",
            lacking.join(", no "),
            name_list(&samples, NAMED, ", ")
        )
    });
    resampled.into_iter().chain(absent).collect()
}

/// Draws all sections of `subject` as one HTML page with the numbers inside its figures: for a program
/// without files. `task` counts the sections, of which there are [`STEPS`].
///
/// # Panics
/// If a drawing thread panics.
#[must_use]
pub fn page_alone(subject: &Subject<'_>, task: &Task) -> String {
    html(&head(subject), &drawn(subject, task), &[])
}

/// The sections that are not empty.
fn drawn(subject: &Subject<'_>, task: &Task) -> Vec<Section> {
    let steps = task.steps_of("drawing", STEPS);
    let mut sections = on_all_cores(&SECTIONS, |section| {
        let section = section(subject);
        steps.step();
        section
    });
    sections.retain(|section| !section.is_empty());
    sections
}

#[cfg(feature = "pictures")]
impl Report {
    /// Draws all sections of `subject` on all cores. `task` counts the sections, of which there are
    /// [`STEPS`].
    ///
    /// # Errors
    /// [`PictureError`] if a figure cannot be rendered as PNG.
    ///
    /// # Panics
    /// If a drawing thread panics.
    pub fn draw(subject: &Subject<'_>, task: &Task) -> Result<Self, PictureError> {
        let sections = drawn(subject, task);
        let figures: Vec<&Figure> = sections.iter().flat_map(Section::figures).collect();
        let pictures = on_all_cores(&figures, |figure| png(&figure.svg));
        let pictures = pictures.into_iter().collect::<Result<_, _>>()?;
        Ok(Self { head: head(subject), sections, pictures })
    }

    /// All figures in the order of the page.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.sections.iter().flat_map(Section::figures)
    }

    /// The files of the report: path relative to its folder, and content. The page comes last, so
    /// that all files it links to exist when you write it.
    #[must_use]
    pub fn files(&self) -> Vec<(String, Vec<u8>)> {
        let mut files = Vec::new();
        for (figure, picture) in self.figures().zip(&self.pictures) {
            for (ending, bytes) in [
                ("svg", figure.svg.clone().into_bytes()),
                ("png", picture.clone()),
                ("csv", figure.data.csv().into_bytes()),
            ] {
                files.push((format!("figures/{}.{ending}", figure.name), bytes));
            }
        }
        let page = html(&self.head, &self.sections, &["svg", "png", "csv"]);
        files.push(("report.html".to_owned(), page.into_bytes()));
        files
    }
}

/// Applies `work` to each item on all cores. The results are in the order of the items.
fn on_all_cores<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let made = Mutex::new(Vec::new());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    // A browser has no threads.
    if cores == 1 {
        return items.iter().map(work).collect();
    }
    std::thread::scope(|scope| {
        for _ in 0..cores.min(items.len()) {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(index) else { break };
                    let result = work(item);
                    made.lock().expect("no other thread panicked").push((index, result));
                }
            });
        }
    });
    let mut made = made.into_inner().expect("no thread panicked");
    made.sort_by_key(|(index, _)| *index);
    made.into_iter().map(|(_, result)| result).collect()
}

/// Title, facts and warnings above the sections.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Head {
    /// Title of the page.
    pub title: String,
    /// Name and value of each fact.
    pub facts: Vec<(String, String)>,
    /// Warnings that a reader should know before trusting the figures.
    pub warnings: Vec<Warning>,
    /// The command line that made the report.
    pub command: String,
}

/// A warning above the sections.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// One line of text.
    pub text: String,
    /// Name and recipe of each sample that the text names.
    pub recipes: Vec<(String, String)>,
}

/// Endings of the files `figures/NAME.ENDING` of each figure, to which the page links. Without endings,
/// the page holds the numbers of its figures itself.
type Endings<'a> = &'a [&'a str];

#[must_use]
pub(crate) fn html(head: &Head, sections: &[Section], files: Endings<'_>) -> String {
    let title = escaped(&head.title);
    let style = style(sections);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <link rel=\"icon\" href=\"data:,\">\n\
         <title>{title}</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
    );
    out += &format!("<main>\n<header>\n<h1>{title}</h1>\n<dl>\n");
    for (name, fact) in &head.facts {
        out += &format!("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(fact));
    }
    out += "</dl>\n";
    if !head.warnings.is_empty() {
        out += "<details open class=\"warnings\"><summary>Not identified by the data, or inconsistent with it</summary>\n<ul>\n";
        for warning in &head.warnings {
            out += &format!("<li>{}{}</li>\n", escaped(&warning.text), recipes(&warning.recipes));
        }
        out += "</ul>\n</details>\n";
    }
    out += &command_html(&head.command);
    out += "</header>\n";
    out += &contents(sections);
    let mut number = 0;
    for (index, section) in sections.iter().enumerate() {
        // Heading and first figure are on one printed page.
        let title = escaped(&section.title);
        out +=
            &format!("<section id=\"s{}\">\n<div class=\"head\">\n<h2>{title}</h2>\n", index + 1);
        for paragraph in &section.paragraphs {
            out += &format!("<p>{}</p>\n", escaped(paragraph));
        }
        for (place, part) in section.parts.iter().enumerate() {
            let figure = matches!(part, Part::Figure(_));
            if place == 0 && !figure {
                out += "</div>\n";
            }
            match part {
                Part::Figure(figure) => {
                    number += 1;
                    out += &figure_html(figure, number, files);
                }
                Part::Table(title, table) => out += &table_html(title, table),
            }
            if place == 0 && figure {
                out += "</div>\n";
            }
        }
        out += if section.parts.is_empty() { "</div>\n</section>\n" } else { "</section>\n" };
    }
    out += "</main>\n</body>\n</html>\n";
    out
}

/// The recipes of samples, on a line of their own.
fn recipes(samples: &[(String, String)]) -> String {
    if samples.is_empty() {
        return String::new();
    }
    let all = samples.iter().map(|(name, recipe)| format!("{name}: {recipe}"));
    format!(" <small>{}</small>", escaped(&all.collect::<Vec<_>>().join("; ")))
}

fn command_html(command: &str) -> String {
    let command = escaped(command);
    format!("<details class=\"made\"><summary>Command</summary><code>{command}</code></details>\n")
}

fn contents(sections: &[Section]) -> String {
    let mut out = String::from("<nav aria-label=\"contents\">\n<ol>\n");
    let mut number = 0;
    for (index, section) in sections.iter().enumerate() {
        out += &format!("<li><a href=\"#s{}\">{}</a>\n<ol>\n", index + 1, escaped(&section.title));
        for figure in section.figures() {
            number += 1;
            let name = &figure.name;
            let title = escaped(&figure.title);
            out += &format!("<li><a href=\"#{name}\">{number}. {title}</a></li>\n");
        }
        out += "</ol></li>\n";
    }
    out + "</ol>\n</nav>\n"
}

fn figure_html(figure: &Figure, number: usize, files: Endings<'_>) -> String {
    let Figure { name, title, caption, command, svg, .. } = figure;
    let [title, caption] = [title, caption].map(|text| escaped(text));
    let files = if files.is_empty() {
        let csv = percent_encoded(&figure.data.csv());
        format!("<a download=\"{name}.csv\" href=\"data:text/csv;charset=utf-8,{csv}\">CSV</a>")
    } else {
        let links = files.iter().map(|ending: &&str| {
            format!("<a href=\"figures/{name}.{ending}\">{}</a>", ending.to_uppercase())
        });
        links.collect::<Vec<_>>().join(" ")
    };
    format!(
        "<figure id=\"{name}\">\n<div class=\"drawing\" tabindex=\"0\">\n{svg}</div>\n\
         <figcaption><b>Figure {number}. {title}.</b> {caption}\n\
         <div class=\"made\">{}</div>\n{}</figcaption>\n</figure>\n",
        files,
        command_html(command)
    )
}

/// `text` as the data of a URL.
fn percent_encoded(text: &str) -> String {
    let mut encoded = String::with_capacity(text.len());
    for byte in text.bytes() {
        match byte {
            b'0'..=b'9' | b'A'..=b'Z' | b'a'..=b'z' | b'-' | b'.' | b'_' | b',' => {
                encoded.push(char::from(byte));
            }
            _ => {
                let _ = write!(encoded, "%{byte:02X}");
            }
        }
    }
    encoded
}

fn table_html(title: &str, table: &Table) -> String {
    let mut out = format!(
        "<div class=\"table\" tabindex=\"0\"><table>\n<caption>{}</caption>\n<thead><tr>",
        escaped(title)
    );
    for column in &table.columns {
        // The unit `1` of a ratio is not written.
        let unit = column.unit.as_deref().filter(|unit| *unit != "1");
        let unit = unit.map(|unit| format!(" <small>{}</small>", escaped(unit)));
        let class = class(column);
        let name = escaped(&column.name);
        let _ = write!(out, "<th scope=\"col\"{class}>{name}{}</th>", unit.unwrap_or_default());
    }
    out += "</tr></thead>\n<tbody>\n";
    for row in &table.rows {
        out += "<tr>";
        for (cell, column) in row.iter().zip(&table.columns) {
            let class = class(column);
            let _ = match cell {
                Cell::Text(text) => write!(out, "<td{class}>{}</td>", escaped(text)),
                Cell::Number(number) => write!(out, "<td{class}>{number:.*}</td>", column.digits),
                Cell::Patch(color) => write!(
                    out,
                    "<td class=\"c\"><i class=\"patch\" style=\"background:{hex}\"></i> <code>{hex}</code></td>",
                    hex = color.hex()
                ),
                Cell::Empty => write!(out, "<td{class}></td>"),
            };
        }
        out += "</tr>\n";
    }
    out + "</tbody>\n</table></div>\n"
}

fn class(column: &Column) -> &str {
    if column.unit.is_some() { " class=\"n\"" } else { "" }
}

/// The style sheet. If the screen is dark, lines and text of figures get lighter colours.
fn style(sections: &[Section]) -> String {
    let mut colors: Vec<Color> =
        sections.iter().flat_map(Section::figures).flat_map(Figure::line_colors).collect();
    colors.sort_unstable();
    colors.dedup();
    let mut dark = String::new();
    for (reserved, replacement) in RESERVED {
        let from = reserved.hex();
        let to = replacement.hex();
        dark +=
            &format!("svg [fill=\"{from}\"]{{fill:{to}}}svg [stroke=\"{from}\"]{{stroke:{to}}}\n");
    }
    for color in SERIES {
        let from = color.hex();
        let to = color.for_dark_screen().hex();
        dark +=
            &format!("svg [fill=\"{from}\"]{{fill:{to}}}svg [stroke=\"{from}\"]{{stroke:{to}}}\n");
    }
    for color in colors.into_iter().filter(|color| !color.is_reserved()) {
        let from = color.hex();
        let to = color.for_dark_screen().hex();
        dark += &format!(
            "svg :not(rect)[fill=\"{from}\"]{{fill:{to}}}svg :not(rect)[stroke=\"{from}\"]{{stroke:{to}}}\n"
        );
    }
    let light = root(|pair| pair.0, "#0057A0");
    let night = root(|pair| pair.1, "#7FB8F0");
    let paper = PAPER.hex();
    let white = Color([0xFF; 3]).hex();
    format!(
        "{light}\n{STYLE}\
         @media print{{:root{{--paper:{white}}}\
         svg [fill=\"{paper}\"]{{fill:{white}}}svg [stroke=\"{paper}\"]{{stroke:{white}}}}}\n\
         @media screen and (prefers-color-scheme:dark){{\n\
         {night}\nsvg text{{stroke:var(--paper)}}\n{dark}}}\n"
    )
}

fn root(of: fn(&(Color, Color)) -> Color, link: &str) -> String {
    let [ink, faint, grid, paper] = RESERVED.each_ref().map(|pair| of(pair).hex());
    format!(":root{{--ink:{ink};--faint:{faint};--grid:{grid};--paper:{paper};--link:{link}}}")
}

const STYLE: &str = "\
:root{color-scheme:light dark}
*{box-sizing:border-box}
body{margin:0;color:var(--ink);background:var(--paper);font:15px/1.5 Ubuntu,system-ui,sans-serif}
a{color:var(--link)}
nav{position:fixed;inset:0 auto 0 0;width:250px;overflow-y:auto;padding:20px 16px;border-right:1px solid var(--grid);font-size:13px;line-height:1.35}
nav ol{list-style:none;margin:0;padding:0}
nav>ol>li{margin:0 0 12px;font-weight:600}
nav ol ol{font-weight:400;padding:4px 0 0 8px}
nav li li{margin:4px 0}
nav a{text-decoration:none}
main{max-width:1040px;margin-left:250px;padding:20px 28px 60px;overflow-wrap:break-word}
h1{font-size:26px;line-height:1.2;margin:0 0 12px}
h2{font-size:20px;margin:36px 0 8px;padding-top:12px;border-top:1px solid var(--grid)}
dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 16px;margin:0 0 16px}
dt{color:var(--faint)}
dd{margin:0;overflow-wrap:anywhere}
.warnings{border-left:3px solid var(--faint);padding:2px 14px}
summary{font-weight:600}
.warnings ul{margin:6px 0;padding-left:18px}
.warnings small{display:block;color:var(--faint)}
figure{margin:18px 0 28px}
.drawing{overflow-x:auto}
.drawing svg{display:block;max-width:100%;height:auto}
figcaption{max-width:960px;font-size:14px}
.made{color:var(--faint);font-size:12px}
.made summary{font-weight:400}
.made a{margin-right:4px}
code{font:12px/1.4 ui-monospace,Hack,monospace;overflow-wrap:anywhere}
.table{overflow-x:auto;margin:18px 0}
table{border-collapse:collapse;font-size:13.5px}
caption{text-align:left;font-weight:600;padding-bottom:6px;white-space:nowrap}
th,td{padding:2px 14px 2px 0;text-align:left;border-bottom:1px solid var(--grid);vertical-align:top}
.n+:not(.n){padding-left:10px}
td{overflow-wrap:anywhere}
td:first-child{min-width:6em}
td:nth-child(2):not(.n,.c){min-width:17em}
th{vertical-align:bottom}
th small{display:block;font-weight:400;color:var(--faint)}
.c{white-space:nowrap}
.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.patch{display:inline-block;width:28px;height:13px;vertical-align:-2px;print-color-adjust:exact;-webkit-print-color-adjust:exact}
@media (max-width:1100px){nav{position:static;width:auto;border:0;padding:0;margin:18px 0}main{margin:0}}
@media screen and (max-width:900px){
main{padding:14px 16px 40px}
nav ol ol{display:none}
nav>ol{columns:2;column-gap:14px}
nav>ol>li{margin:0 0 8px;break-inside:avoid}
.drawing svg{max-width:none;width:820px}
dl{display:block}
dd{margin:0 0 6px}
table{width:max-content}
td,th{max-width:22em}
td:first-child,th:first-child{position:sticky;left:0;background:var(--paper);min-width:5em;max-width:38vw}
}
@media print{
@page{margin:14mm}
nav{display:none}
main{margin:0;padding:0;max-width:none}
.head,figure,tr,li{break-inside:avoid}
h2,h2~p,caption,thead,summary{break-after:avoid}
p{orphans:3;widows:3}
.made{display:none}
.drawing{overflow:visible}
.drawing svg{max-height:200mm;print-color-adjust:exact;-webkit-print-color-adjust:exact}
body{font-size:10pt}
table{font-size:8pt}
th,td{padding:1px 9px 1px 0}
.table{overflow:visible}
.c code{display:none}
}
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_alone_holds_the_numbers_of_every_figure() {
        let library = calibrate::PigmentLibrary::van_gogh_oils();
        let viewing = spectra::Viewing::default();
        let subject = Subject::of_library(&library, &viewing, "test").unwrap();
        let page = page_alone(&subject, &Task::default());
        let figures: Vec<Figure> =
            drawn(&subject, &Task::default()).iter().flat_map(Section::figures).cloned().collect();
        assert!(figures.len() > 5, "{} figures", figures.len());
        let numbers = "href=\"data:text/csv;charset=utf-8,";
        assert_eq!(page.matches(numbers).count(), figures.len());
        assert!(!page.contains("href=\"figures/"), "a link to a file that is not there");
        for (figure, link) in figures.iter().zip(page.split(numbers).skip(1)) {
            let told = {
                let mut parts = (link.split('"').next().unwrap()).split('%');
                let mut bytes = parts.next().unwrap().as_bytes().to_vec();
                for part in parts {
                    bytes.push(u8::from_str_radix(&part[..2], 16).unwrap());
                    bytes.extend_from_slice(&part.as_bytes()[2..]);
                }
                String::from_utf8(bytes).unwrap()
            };
            assert_eq!(told, figure.data.csv(), "{}", figure.name);
        }
    }

    #[test]
    fn results_from_all_cores_keep_the_order_of_the_items() {
        let items: Vec<u64> = (0..40).collect();
        let squares: Vec<u64> = items.iter().map(|i| i * i).collect();
        assert_eq!(on_all_cores(&items, |i| i * i), squares);
    }
}
