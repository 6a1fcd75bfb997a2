//! The black and the white card on which the swatches of a set were painted.

use pigment::palette::Cards;
use spectra::TristimulusWeights;

use crate::swatch::SwatchSet;

impl SwatchSet {
    /// Cards under the films of this set, chosen by [`Cards::among`]; the standard cards if the set is on
    /// another grid than `weights`.
    #[must_use]
    pub fn cards(&self, weights: &TristimulusWeights) -> Cards {
        if self.grid != weights.grid() {
            return Cards::standard(weights.grid());
        }
        Cards::among(bare_backings(self), weights)
    }
}

/// Mean bare reflectance of each backing over the films that lie on it.
fn bare_backings(set: &SwatchSet) -> Vec<Vec<f64>> {
    let films = || set.swatches.iter().flat_map(|swatch| &swatch.films);
    let mut names: Vec<&str> = films().map(|film| film.backing.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let mean = |name: &str| {
        let bare: Vec<&[f64]> = films()
            .filter(|film| film.backing == name)
            .filter_map(|film| film.bare.as_deref())
            .collect();
        let sum = |at: usize| bare.iter().map(|card| card[at]).sum::<f64>();
        let values = (0..set.grid.count()).map(|at| sum(at) / bare.len() as f64).collect();
        (!bare.is_empty()).then_some(values)
    };
    names.into_iter().filter_map(mean).collect()
}
