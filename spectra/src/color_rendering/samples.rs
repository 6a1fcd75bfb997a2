//! The test colour samples of both standards.

use std::sync::OnceLock;

use crate::grid::Grid;
use crate::table;

/// Reflectances on one grid.
#[derive(Debug)]
pub(super) struct Samples {
    pub(super) grid: Grid,
    pub(super) reflectances: Vec<Vec<f64>>,
}

/// The 14 test colour samples of CIE 13.3, 360 to 830 nm.
pub(super) fn of_rendering() -> &'static Samples {
    static SAMPLES: OnceLock<Samples> = OnceLock::new();
    SAMPLES.get_or_init(|| read(include_str!("../../data/rendering/cie-13.3-samples.csv")))
}

/// The 99 colour evaluation samples of TM-30 and CIE 224, 380 to 780 nm.
pub(super) fn of_fidelity() -> &'static Samples {
    static SAMPLES: OnceLock<Samples> = OnceLock::new();
    SAMPLES.get_or_init(|| read(include_str!("../../data/rendering/cie-224-samples.csv")))
}

fn read(text: &str) -> Samples {
    let columns = table::columns(text);
    let values = |(_, cells): &(String, Vec<Option<f64>>)| -> Vec<f64> {
        cells.iter().map(|cell| cell.expect("a shipped sample is complete")).collect()
    };
    let nm = values(&columns[0]);
    let grid = Grid::from_nm(nm[0], nm[1] - nm[0], nm.len()).expect("shipped wavelengths rise");
    Samples { grid, reflectances: columns[1..].iter().map(values).collect() }
}
