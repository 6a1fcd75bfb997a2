//! The file of kept mixtures: JSON, `impasto-swatches` version 1.
//!
//! ```json
//! {
//!   "format": "impasto-swatches",
//!   "version": 1,
//!   "swatches": [
//!     {
//!       "name": "Sea green",
//!       "library": "Van Gogh's oils",
//!       "recipe": {"Viridian": 2, "Zinc White": 5},
//!       "vehicle": 0.15,
//!       "color": "#8fb9a8",
//!       "light": "D65"
//!     }
//!   ]
//! }
//! ```
//!
//! `vehicle` and `light` may be left out.

use serde_json::{Map, Value, json};

use super::book::SwatchBook;
use super::error::SwatchBookError;
use super::mixture::KeptMixture;

/// Value of the key `format`.
const FORMAT: &str = "impasto-swatches";

/// Value of the key `version`.
const VERSION: u64 = 1;

impl SwatchBook {
    /// The list as JSON.
    #[must_use]
    pub fn to_json(&self) -> String {
        pigment::library::to_text(&json!({
            "format": FORMAT,
            "version": VERSION,
            "swatches": self.swatches,
        }))
    }

    /// Reads a list; `file` names it in errors.
    ///
    /// # Errors
    /// [`SwatchBookError`] naming the file and the key.
    pub fn from_json(file: &str, text: &str) -> Result<Self, SwatchBookError> {
        let named = || file.to_owned();
        let read: Map<String, Value> = serde_json::from_str(text)
            .map_err(|source| SwatchBookError::Json { file: named(), source })?;
        let found = |key: &str| read.get(key).cloned().unwrap_or(Value::Null);
        for (key, expected) in [("format", json!(FORMAT)), ("version", json!(VERSION))] {
            if found(key) != expected {
                let expected = expected.to_string();
                let found = found(key).to_string();
                return Err(SwatchBookError::Kind { file: named(), key, expected, found });
            }
        }
        let fault =
            |key: String, reason: String| SwatchBookError::Value { file: named(), key, reason };
        let Value::Array(listed) = found("swatches") else {
            let reason = format!("expected a list, found `{}`", found("swatches"));
            return Err(fault("swatches".to_owned(), reason));
        };
        let mut swatches = Vec::with_capacity(listed.len());
        for (index, value) in listed.into_iter().enumerate() {
            let kept: KeptMixture = serde_json::from_value(value)
                .map_err(|error| fault(format!("swatches[{index}]"), error.to_string()))?;
            if let Some((key, reason)) = kept.fault() {
                return Err(fault(format!("swatches[{index}].{key}"), reason));
            }
            swatches.push(kept);
        }
        Ok(Self { swatches })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(entry: &str) -> String {
        format!(r#"{{"format": "impasto-swatches", "version": 1, "swatches": [{entry}]}}"#)
    }

    const GREEN: &str = r##"{"name": "Sea green", "library": "Oils",
        "recipe": {"Viridian": 2, "Zinc White": 5}, "color": "#8fb9a8"}"##;

    #[test]
    fn a_list_survives_writing_and_reading() {
        let book = SwatchBook::from_json("a.json", &text(GREEN)).unwrap();
        let kept = &book.swatches[0];
        assert_eq!((kept.name.as_str(), kept.vehicle, kept.recipe.len()), ("Sea green", 0.0, 2));
        let again = SwatchBook::from_json("b.json", &book.to_json()).unwrap();
        assert_eq!(again, book);
        let empty = SwatchBook::default();
        assert_eq!(SwatchBook::from_json("c.json", &empty.to_json()).unwrap(), empty);
    }

    #[test]
    fn faults_name_the_file_and_the_key() {
        let wrong = |from: &str, to: &str| text(&format!("{GREEN}, {}", GREEN.replace(from, to)));
        let cases = [
            ("[1]".to_owned(), "kept.json: "),
            (r#"{"format": "impasto-paint"}"#.to_owned(), "kept.json: key `format`"),
            (text(GREEN).replace(": 1,", ": 2,"), "kept.json: key `version`"),
            (text(GREEN).replace("\"swatches\"", "\"swotches\""), "kept.json: key `swatches`"),
            (wrong("\"Viridian\": 2", "\"Viridian\": -2"), "key `swatches[1].recipe.Viridian`"),
            (wrong("#8fb9a8", "green"), "key `swatches[1].color`"),
            (wrong("Sea green", " "), "key `swatches[1].name`"),
            (wrong("\"library\"", "\"librory\""), "key `swatches[1]`: unknown field `librory`"),
            (wrong("\"color\"", "\"vehicle\": 1.5, \"color\""), "key `swatches[1].vehicle`"),
        ];
        for (text, wanted) in cases {
            let error = SwatchBook::from_json("kept.json", &text).unwrap_err();
            assert!(error.to_string().contains(wanted), "{error}, not {wanted}");
            assert!(documents::hint::Explain::hint(&error).is_some());
        }
    }
}
