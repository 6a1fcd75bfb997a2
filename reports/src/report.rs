//! The report: its sections, drawn in parallel, and the files made of them.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use calibrate::comparison::Comparison;
use calibrate::evaluate::Summary;
use calibrate::validation::Validation;
use documents::name_list;

#[cfg(feature = "pictures")]
use crate::figure::Figure;
use crate::page::{self, Head, Links, Warning};
#[cfg(feature = "pictures")]
use crate::picture::{PictureError, png};
use crate::subject::{Section, Subject};

/// A function that draws a section.
type Drawer = fn(&Subject<'_>) -> Section;

/// Every section, in the order of the page.
const SECTIONS: [Drawer; 11] = [
    crate::samples::section,
    crate::errors::section,
    crate::left_out::section,
    crate::residuals::section,
    crate::curves::section,
    crate::palette::mixing,
    crate::palette::graded,
    crate::palette::gamut,
    crate::palette::strength,
    crate::palette::lights,
    crate::light::section,
];

/// Number of times that [`Report::draw`] and [`page_alone`] call `step`.
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

/// The head of a report on `subject`: title, facts and warnings.
fn head(subject: &Subject<'_>) -> Head {
    let library = subject.library;
    let fact = |name: &str, fact: String| (name.to_owned(), fact);
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

fn errors(count: usize, item: &str, errors: &Summary) -> String {
    let items = documents::counted(count, item);
    format!(
        "{items}, CIEDE2000 mean {:.2}, median {:.2}, 90 % below {:.2}, largest {:.2}",
        errors.mean, errors.median, errors.p90, errors.max
    )
}

/// Maximum number of samples that a warning names.
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

/// Draws all sections of `subject` as one HTML page, whose figures carry their numbers within: for a
/// program without files. `step` is called [`STEPS`] times, after each section.
///
/// # Panics
/// If a drawing thread panics.
#[must_use]
pub fn page_alone(subject: &Subject<'_>, step: &(dyn Fn() + Sync)) -> String {
    page::html(&head(subject), &drawn(subject, step), Links::Within)
}

/// The sections that are not empty.
fn drawn(subject: &Subject<'_>, step: &(dyn Fn() + Sync)) -> Vec<Section> {
    let mut sections = on_all_cores(&SECTIONS, |section| {
        let section = section(subject);
        step();
        section
    });
    sections.retain(|section| !section.is_empty());
    sections
}

#[cfg(feature = "pictures")]
impl Report {
    /// Draws all sections of `subject` on all cores. `step` is called [`STEPS`] times, after each
    /// section, for a display of progress.
    ///
    /// # Errors
    /// [`PictureError`] if a figure cannot be rendered as PNG.
    ///
    /// # Panics
    /// If a drawing thread panics.
    pub fn draw(subject: &Subject<'_>, step: &(dyn Fn() + Sync)) -> Result<Self, PictureError> {
        let sections = drawn(subject, step);
        let figures: Vec<&Figure> = sections.iter().flat_map(Section::figures).collect();
        let pictures = on_all_cores(&figures, |figure| png(&figure.svg));
        let pictures = pictures.into_iter().collect::<Result<_, _>>()?;
        Ok(Self { head: head(subject), sections, pictures })
    }

    /// All figures in the order of the page.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.sections.iter().flat_map(Section::figures)
    }

    /// The files of the report: path relative to its folder, and content. The page comes last,
    /// so that all files it links to exist when it is written.
    #[must_use]
    pub fn files(&self) -> Vec<(String, Vec<u8>)> {
        let mut files = Vec::new();
        for (figure, picture) in self.figures().zip(&self.pictures) {
            let path = |ending: &str| format!("figures/{}.{ending}", figure.name);
            files.push((path("svg"), figure.svg.clone().into_bytes()));
            files.push((path("png"), picture.clone()));
            files.push((path("csv"), figure.data.csv().into_bytes()));
        }
        let page = page::html(&self.head, &self.sections, Links::Beside);
        files.push(("report.html".to_owned(), page.into_bytes()));
        files
    }
}

/// Applies `work` to each item on all cores. Results are in the order of the items.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_alone_holds_the_numbers_of_every_figure() {
        let library = calibrate::PigmentLibrary::van_gogh_oils();
        let viewing = spectra::Viewing::default();
        let subject = Subject::of_library(&library, &viewing, "test").unwrap();
        let page = page_alone(&subject, &|| ());
        let figures: Vec<Figure> =
            drawn(&subject, &|| ()).iter().flat_map(Section::figures).cloned().collect();
        assert!(figures.len() > 5, "{} figures", figures.len());
        let numbers = "href=\"data:text/csv;charset=utf-8,";
        assert_eq!(page.matches(numbers).count(), figures.len());
        assert!(!page.contains("href=\"figures/"), "a link to a file that is not there");
        let decoded = |text: &str| {
            let mut parts = text.split('%');
            let mut bytes = parts.next().unwrap().as_bytes().to_vec();
            for part in parts {
                bytes.push(u8::from_str_radix(&part[..2], 16).unwrap());
                bytes.extend_from_slice(&part.as_bytes()[2..]);
            }
            String::from_utf8(bytes).unwrap()
        };
        for (figure, link) in figures.iter().zip(page.split(numbers).skip(1)) {
            let told = decoded(link.split('"').next().unwrap());
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
