//! Results of `spectra` compared with the golden files, each within the tolerance of its file.

mod adaptation;
mod difference;
mod films;
mod lab;
mod lights;
mod metamerism;
mod rendering;
mod rgb;
mod spectrum;
mod whiteness;

use serde::Deserialize;
use spectra::{Grid, Interpolation, Observer};

/// A spectrum at a constant step, in the form of the golden files.
#[derive(Deserialize)]
struct Regular {
    start_nm: f64,
    step_nm: f64,
    values: Vec<f64>,
}

impl Regular {
    fn grid(&self) -> Grid {
        Grid::from_nm(self.start_nm, self.step_nm, self.values.len()).unwrap()
    }
}

/// The observer whose table is called `stem`.
fn observer(stem: &str) -> Observer {
    Observer::named(stem.strip_prefix("cie-").unwrap()).unwrap()
}

fn interpolation(name: &str) -> Interpolation {
    [Interpolation::Linear, Interpolation::Sprague]
        .into_iter()
        .find(|method| method.name() == name)
        .unwrap_or_else(|| panic!("no interpolation is called {name}"))
}
