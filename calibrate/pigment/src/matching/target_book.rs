//! Target colours of a file: a swatch file of a painting program, or a table of named colours.

use spectra::color_book::{BookColor, BookValue, ColorBook, ColorBookError};

use super::target::{ColorTarget, TargetColor};
use crate::evaluate::{Remark, Viewing};

/// Named colours of a file as targets.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetBook {
    /// The targets in the order of the file, at least one.
    pub targets: Vec<ColorTarget>,
    /// Remarks on colours that we left out, and on the light that we took.
    pub remarks: Vec<Remark>,
}

impl TargetBook {
    /// Reads `bytes`, the content of `file`: a swatch file (`.ase`, `.aco`, `.gpl`), or a table of names with
    /// CIELAB, XYZ or codes (see [`spectra::color_book`]). Pass a `name`, or a place counted from 1, for one colour.
    /// You get `None` for other files, for example if they hold spectra.
    ///
    /// `light` is the light of a table of CIELAB or XYZ. Otherwise we take the one that its headings state, or D65.
    /// In a search, we adapt these colours from their light to the first light of the search (Bradford).
    ///
    /// ```
    /// use pigment::matching::TargetBook;
    ///
    /// let book = b"name,L,a,b\nSky,60,-5,-30\nSand,80,3,25\n";
    /// let sand = TargetBook::read("book.csv", book, Some("sand"), None)?.expect("a table of colours");
    /// assert_eq!(sand.targets[0].name, "Sand");
    /// # Ok::<(), spectra::color_book::ColorBookError>(())
    /// ```
    ///
    /// # Errors
    /// [`ColorBookError`] for a damaged file, or a name that is not in it.
    pub fn read(
        file: &str,
        bytes: &[u8],
        name: Option<&str>,
        light: Option<&Viewing>,
    ) -> Result<Option<Self>, ColorBookError> {
        let Some(book) = ColorBook::read(file, bytes, light)? else { return Ok(None) };
        let targets = match name {
            Some(name) => vec![book.find(name)?.into()],
            None => book.colors.iter().map(ColorTarget::from).collect(),
        };
        let mut remarks: Vec<Remark> = book.remarks.iter().map(Remark::note).collect();
        remarks.extend(book.assumed_light.map(|light| {
            let Viewing { illuminant, observer } = light;
            let light = illuminant.name();
            Remark::note(format!(
                "{file} states no light, so its colours are taken as under {light} ({})",
                observer.name()
            ))
            .with_hint("name another with [target_light=D50]")
        }));
        Ok(Some(Self { targets, remarks }))
    }
}

impl From<&BookColor> for ColorTarget {
    fn from(color: &BookColor) -> Self {
        let name = color.name.clone();
        match color.value {
            BookValue::Srgb(rgb) => Self { name, ..Self::srgb(rgb) },
            BookValue::Lab { lab, white } => {
                Self { name, color: TargetColor::LabUnder { lab, white } }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::target::ViewingCondition;
    use super::*;

    fn lab_under(text: &str, light: Option<&str>, seen: &str) -> [f64; 3] {
        let viewing = |name: &str| Viewing::named(name, "1931-2").unwrap();
        let given = light.map(viewing);
        let book = TargetBook::read("book.csv", text.as_bytes(), Some("1"), given.as_ref());
        let condition = ViewingCondition { viewing: viewing(seen), weight: 1.0 };
        let target = book.unwrap().unwrap().targets[0].under(&[condition]).unwrap();
        target.lab[0].to_array()
    }

    #[test]
    fn colours_of_a_book_are_adapted_from_their_light() {
        let table = "name,L,a,b\nSky,60,-5,-30\n";
        for (light, seen, expected) in [
            (None, "D65", [60.0, -5.0, -30.0]),
            (Some("D50"), "D50", [60.0, -5.0, -30.0]),
            // By the Bradford matrix, for the whites 96.42, 100, 82.51 and 95.05, 100, 108.88.
            (Some("D50"), "D65", [60.405, -1.391, -29.483]),
        ] {
            let found = lab_under(table, light, seen);
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 0.03, "{light:?} {seen} {found:?}");
        }
        let codes = lab_under("name,hex\nSky,#3b83bd\n", None, "A");
        let typed = "#3b83bd".parse::<ColorTarget>().unwrap();
        let typed = typed.under(&[ViewingCondition::default()]).unwrap().lab[0].to_array();
        assert_eq!(codes, typed, "as a typed code");
    }

    #[test]
    fn a_light_that_nobody_states_is_told() {
        let remarks = |text: &str| {
            let book = TargetBook::read("b.csv", text.as_bytes(), None, None).unwrap().unwrap();
            book.remarks.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        let told = remarks("name,L,a,b\nSky,60,-5,-30\n");
        assert_eq!(
            told,
            ["b.csv states no light, so its colours are taken as under D65 (1931-2); \
              name another with `target_light = D50`"]
        );
        assert!(remarks("name,hex\nSky,#3b83bd\n").is_empty());
    }
}
