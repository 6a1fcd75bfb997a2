//! Limits on what a script may ask for, and what would fit where it asks for more.

use crate::sphere_mesh::MOST_DETAIL;
use crate::toml_text::{Checked, Fault, KeyPath};

/// Most single volumes.
pub const MOST_VOLUMES: usize = 4096;

/// Most particles of all volumes.
pub const MOST_PARTICLES: usize = 2_000_000;

/// Most cells of the grid.
pub const MOST_CELLS: u64 = 1 << 20;

/// Most frames of an animation.
pub const MOST_FRAMES: u64 = 100_000;

/// Most tables that do something: pours, volumes, pushes, walls, lifts, splits and dryings.
pub const MOST_EVENTS: usize = 10_000;

/// Most regions of a script.
pub const MOST_REGIONS: usize = 64;

/// Longest script in seconds.
pub const MOST_SECONDS: f64 = 3600.0;

/// Most points of the paths of all pours and lifts.
pub(super) const MOST_POINTS: usize = 1_000_000;

/// Number of frames of `seconds` at `rate` frames a second, the first and the last included.
///
/// # Errors
/// [`Fault`] of `seconds` for more than [`MOST_FRAMES`], with seconds and rate that fit.
pub fn frames_fit(seconds: f64, rate: f64) -> Result<u64, Box<Fault>> {
    let count = (seconds * rate).floor().max(0.0) + 1.0;
    if count <= MOST_FRAMES as f64 {
        return Ok(count as u64);
    }
    let most = (MOST_FRAMES - 1) as f64;
    let hint = format!(
        "{} seconds fit at {rate} frames a second, or {} frames a second",
        floored(most / rate),
        floored(most / seconds)
    );
    let wanted = format!("at most {MOST_FRAMES} frames");
    Err(Fault::new(&KeyPath::of("seconds"), wanted, format!("{count} frames"), hint))
}

/// Checks the number of cells of a grid whose cells are `cell` wide, by the longest side.
///
/// # Errors
/// [`Fault`] of `grid.cell` for more than [`MOST_CELLS`], with a width that fits.
pub fn cells_fit(count: u64, cell: f64) -> Result<(), Box<Fault>> {
    if count <= MOST_CELLS {
        return Ok(());
    }
    // Cells lie over a surface, so their number falls with the square of their width.
    let fits = cell * (count as f64 / MOST_CELLS as f64).sqrt();
    let hint = format!("cell = {} fits", (fits * 1.05 * 1e5).ceil() / 1e5);
    let wanted = format!("a width of at most {MOST_CELLS} cells");
    Err(Fault::new(&KeyPath::of("grid.cell"), wanted, format!("{cell}: {count} cells"), hint))
}

/// Checks the length of the list `key`.
pub(super) fn check_count(key: &str, count: usize, most: usize) -> Checked {
    if count <= most {
        return Ok(());
    }
    let hint = format!("the first {most} fit; leave out the others, or divide the script");
    let key = KeyPath::of(key).index(most);
    Err(Fault::new(&key, format!("at most {most} tables"), count, hint))
}

/// Checks the particles of volumes with these levels of detail.
pub(super) fn check_particles(details: &[u8]) -> Checked {
    let of = |detail: u8| 10 * 4_usize.pow(detail.into()) + 2;
    let mut total = 0;
    for (index, &detail) in details.iter().enumerate() {
        total += of(detail);
        if total > MOST_PARTICLES {
            let mut finest = (0..=MOST_DETAIL).rev();
            let fits = finest.find(|&detail| of(detail) * details.len() <= MOST_PARTICLES);
            let hint = match fits {
                Some(fits) => format!("detail = {fits} fits for all {}", details.len()),
                None => format!("{index} volumes fit"),
            };
            let key = KeyPath::of("volume").index(index).key("detail");
            let wanted = format!("at most {MOST_PARTICLES} particles in all volumes");
            return Err(Fault::new(&key, wanted, format!("{detail}: {total} so far"), hint));
        }
    }
    Ok(())
}

/// A number rounded down to one decimal.
fn floored(number: f64) -> f64 {
    (number * 10.0).floor() / 10.0
}

#[cfg(test)]
mod tests {
    use spectra::hint::Explain;

    use super::*;

    #[test]
    fn refusals_say_what_would_fit() {
        assert_eq!(frames_fit(6.0, 24.0), Ok(145));
        let fault = frames_fit(3600.0, 30.0).unwrap_err();
        let hint = fault.hint().unwrap().to_string();
        assert_eq!(hint, "3333.3 seconds fit at 30 frames a second, or 27.7 frames a second");
        assert!(frames_fit(3333.3, 30.0).is_ok() && frames_fit(3600.0, 27.7).is_ok());
        assert_eq!(cells_fit(MOST_CELLS, 0.001), Ok(()));
        let hint = cells_fit(4 << 20, 0.001).unwrap_err().hint().unwrap().to_string();
        assert_eq!(hint, "cell = 0.00211 fits");
        assert_eq!(check_particles(&[3; 3000]), Ok(()));
        let fault = check_particles(&[5; 300]).unwrap_err();
        assert_eq!(fault.key.to_string(), "[[volume]] 196, detail");
        assert_eq!(fault.hint().unwrap().to_string(), "detail = 4 fits for all 300");
    }
}
