//! The list of kept mixtures, and changes of it.

use spectra::TristimulusWeights;
use spectra::color::Rgb;
use spectra::swatch_file::{SwatchColor, SwatchEntry, SwatchFile};

use super::mixture::{KeptMixture, LONGEST_NAME};
use pigment::library::PigmentLibrary;

/// Kept mixtures in the painter's order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SwatchBook {
    /// Mixtures of all libraries.
    pub swatches: Vec<KeptMixture>,
}

/// A change of the list. Indices beyond its end change nothing.
#[derive(Debug, Clone, PartialEq)]
pub enum SwatchChange {
    /// Adds a mixture at the end; a name that is taken gets a number.
    Keep(Box<KeptMixture>),
    /// Gives another name to the mixture at an index. An empty name changes nothing.
    Rename(usize, String),
    /// Moves the mixture at the first index to the second.
    Move(usize, usize),
    /// Removes the mixture at an index.
    Remove(usize),
    /// Adds those mixtures of another list that this one does not have.
    Merge(SwatchBook),
}

impl SwatchBook {
    /// Applies a change.
    pub fn apply(&mut self, change: SwatchChange) {
        let count = self.swatches.len();
        match change {
            SwatchChange::Keep(mut kept) => {
                kept.name = self.free_name(&kept.name, None);
                self.swatches.push(*kept);
            }
            SwatchChange::Rename(index, name) => {
                let name = name.trim();
                if index < count && !name.is_empty() {
                    self.swatches[index].name = self.free_name(name, Some(index));
                }
            }
            SwatchChange::Move(from, to) => {
                if from < count && to < count {
                    let moved = self.swatches.remove(from);
                    self.swatches.insert(to, moved);
                }
            }
            SwatchChange::Remove(index) => {
                if index < count {
                    self.swatches.remove(index);
                }
            }
            SwatchChange::Merge(other) => {
                for kept in other.swatches {
                    if !self.swatches.contains(&kept) {
                        self.apply(SwatchChange::Keep(Box::new(kept)));
                    }
                }
            }
        }
    }

    /// The colours of the mixtures as a painting program reads them, in sRGB: under the light of
    /// `weights` where `library` can mix them, else as they were kept.
    #[must_use]
    pub fn colors(&self, library: &PigmentLibrary, weights: &TristimulusWeights) -> SwatchFile {
        let swatches = self
            .swatches
            .iter()
            .map(|kept: &KeptMixture| {
                let bytes = kept.screen_color(library, weights);
                let color = SwatchColor::Rgb(Rgb(bytes.map(|byte| f64::from(byte) / 255.0)));
                SwatchEntry { name: kept.name.clone(), group: String::new(), color }
            })
            .collect();
        SwatchFile { name: format!("{}: kept mixtures", library.title), swatches }
    }

    /// `name`, or `name 2` and so on if another mixture than that at `own` has it.
    fn free_name(&self, name: &str, own: Option<usize>) -> String {
        let taken = |name: &str| {
            let mut others = self.swatches.iter().enumerate();
            others.any(|(index, kept)| Some(index) != own && kept.name == name)
        };
        let short: String = name.chars().take(LONGEST_NAME).collect();
        let stem: String = name.chars().take(LONGEST_NAME - 6).collect();
        let numbered = (2..=self.swatches.len() + 1).map(|number| format!("{stem} {number}"));
        let mut names = std::iter::once(short.clone()).chain(numbered);
        names.find(|name| !taken(name)).unwrap_or(short)
    }
}

#[cfg(test)]
mod tests {
    use pigment::evaluate::Viewing;
    use spectra::swatch_file::{read_gpl, write_gpl};

    use super::*;

    fn kept(name: &str) -> KeptMixture {
        KeptMixture {
            name: name.to_owned(),
            library: "Oils".to_owned(),
            recipe: [("Vermilion".to_owned(), 1.0)].into(),
            vehicle: 0.0,
            color: "#102030".to_owned(),
            light: "D65".to_owned(),
        }
    }

    fn names(book: &SwatchBook) -> Vec<&str> {
        book.swatches.iter().map(|kept| kept.name.as_str()).collect()
    }

    #[test]
    fn changes_keep_order_and_names_apart() {
        let mut book = SwatchBook::default();
        for name in ["sky", "sea", "sky"] {
            book.apply(SwatchChange::Keep(Box::new(kept(name))));
        }
        assert_eq!(names(&book), ["sky", "sea", "sky 2"]);
        book.apply(SwatchChange::Move(2, 0));
        assert_eq!(names(&book), ["sky 2", "sky", "sea"]);
        book.apply(SwatchChange::Rename(1, "  dusk ".to_owned()));
        book.apply(SwatchChange::Rename(2, "dusk".to_owned()));
        book.apply(SwatchChange::Rename(0, " ".to_owned()));
        book.apply(SwatchChange::Rename(1, "dusk".to_owned()));
        assert_eq!(names(&book), ["sky 2", "dusk", "dusk 2"], "its own name is not taken");
        for change in [SwatchChange::Remove(7), SwatchChange::Move(0, 7), SwatchChange::Move(7, 0)]
        {
            book.apply(change);
        }
        book.apply(SwatchChange::Remove(1));
        assert_eq!(names(&book), ["sky 2", "dusk 2"]);
    }

    #[test]
    fn merging_adds_what_is_new_once() {
        let mut book = SwatchBook { swatches: vec![kept("sky"), kept("sea")] };
        let other = SwatchBook { swatches: vec![kept("sea"), kept("earth")] };
        book.apply(SwatchChange::Merge(other.clone()));
        book.apply(SwatchChange::Merge(other));
        assert_eq!(names(&book), ["sky", "sea", "earth"]);
    }

    #[test]
    fn colours_are_those_under_the_light_or_as_kept_and_survive_a_gpl() {
        let library = PigmentLibrary::van_gogh_oils();
        let weights = Viewing::default().weights(library.grid).unwrap();
        let mut unknown = kept("unknown");
        unknown.recipe = [("Moon Dust".to_owned(), 1.0)].into();
        let book = SwatchBook { swatches: vec![kept("red"), unknown] };
        let colors = book.colors(&library, &weights);
        let wanted = library.color([("Vermilion", 1.0)], &Viewing::default()).unwrap().hex();
        let text = write_gpl(&colors).unwrap();
        let read = read_gpl("a.gpl", text.as_bytes()).unwrap();
        let hex = read
            .swatches
            .iter()
            .map(|entry| (entry.name.as_str(), entry.color.srgb().expect("sRGB").to_hex()));
        let wanted = [("red", wanted), ("unknown", "#102030".to_owned())];
        assert_eq!(hex.collect::<Vec<_>>(), wanted);
    }
}
