//! Limits on what a script may ask for, and what would fit where it asks for more.

use documents::counted_as;

use crate::sphere_mesh::MOST_DETAIL;
use crate::toml_text::{Checked, Fault, KeyPath};
use crate::wetting::MOST_CELLS;
use crate::world::MOST_PARTICLES;

/// Most frames of an animation.
pub const MOST_FRAMES: u64 = 100_000;

/// Most tables that do something: pours, volumes, pushes, walls, lifts, splits and dryings.
pub const MOST_EVENTS: usize = 10_000;

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

/// The fault of cells that are `cell` wide, by the scene's longest side, where this is too narrow
/// and cells of `fits` would do.
#[must_use]
pub fn cells_too_small(cell: f64, fits: f64) -> Box<Fault> {
    let wanted = format!("a width of at most {MOST_CELLS} cells");
    let hint = format!("cell = {} fits", (fits * 1e5).ceil() / 1e5);
    Fault::new(&KeyPath::of("grid.cell"), wanted, cell as f32, hint)
}

/// The fault of `found` samples in a cell, where `fits` would do.
#[must_use]
pub fn samples_too_many(found: usize, fits: usize) -> Box<Fault> {
    let wanted = format!("1 to {fits} for cells of this width");
    let hint = format!("samples = {fits} fits, or larger cells (grid.cell)");
    Fault::new(&KeyPath::of("grid.samples"), wanted, found, hint)
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
                None => counted_as(index, "volume fits", "volumes fit"),
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
    use documents::hint::Explain;

    use super::*;

    #[test]
    fn refusals_say_what_would_fit() {
        assert_eq!(frames_fit(6.0, 24.0), Ok(145));
        let fault = frames_fit(3600.0, 30.0).unwrap_err();
        let hint = fault.hint().unwrap().to_string();
        assert_eq!(hint, "3333.3 seconds fit at 30 frames a second, or 27.7 frames a second");
        assert!(frames_fit(3333.3, 30.0).is_ok() && frames_fit(3600.0, 27.7).is_ok());
        let fault = cells_too_small(0.001, 0.002_105_3);
        assert_eq!(fault.hint().unwrap().to_string(), "cell = 0.00211 fits");
        let told = "grid.cell takes a width of at most 1048576 cells, found `0.001`";
        assert_eq!(fault.to_string(), told);
        assert_eq!(check_particles(&[3; 3000]), Ok(()));
        let fault = check_particles(&[5; 300]).unwrap_err();
        assert_eq!(fault.key.to_string(), "[[volume]] 196, detail");
        assert_eq!(fault.hint().unwrap().to_string(), "detail = 4 fits for all 300");
    }
}
