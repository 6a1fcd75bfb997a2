//! The library that ships with impasto: the oils of Van Gogh's palette.

use super::pigment_library::PigmentLibrary;

/// Output of `impasto fit` for `measurements/van-gogh-oils.csv`.
const VAN_GOGH_OILS: &str = include_str!("../../../../measurements/van-gogh-oils.pigments.json");

impl PigmentLibrary {
    /// The library that ships: 20 oil paints of Van Gogh's palette, calibrated from the readings of
    /// Geldof and others (2018, CC0).
    ///
    /// # Panics
    /// Never: a test reads the library that is compiled in.
    #[must_use]
    pub fn van_gogh_oils() -> Self {
        Self::from_json("van-gogh-oils.pigments.json", VAN_GOGH_OILS)
            .expect("the shipped library is valid")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_library_is_valid_and_has_20_pigments() {
        let oils = PigmentLibrary::van_gogh_oils();
        assert_eq!(oils.pigments.len(), 20);
        assert!(oils.find("Zinc White").is_ok(), "the reference white");
    }
}
