//! Free positions for a heap of paint.

use graphics::tile::Rect;
use paint::painting::{Painting, PaintingError};

/// The first of `places`, in mm, that has no wet paint in the square of half side `reach_mm` around
/// it; if all have some, the one with the least. `None` if no place is on the surface.
///
/// # Errors
/// [`PaintingError`] if the device was lost.
pub(super) fn freest_place(
    painting: &mut Painting,
    places: &[[f64; 2]],
    reach_mm: f64,
) -> Result<Option<[f64; 2]>, PaintingError> {
    let mut best: Option<([f64; 2], u64)> = None;
    for &place in places {
        let Some(quanta) = wet_paint_around(painting, place, reach_mm)? else { continue };
        if best.is_none_or(|(_, least)| quanta < least) {
            best = Some((place, quanta));
        }
        if quanta == 0 {
            break;
        }
    }
    Ok(best.map(|(place, _)| place))
}

/// Wet paint in quanta within the square of half side `reach_mm` around a place; `None` if the
/// place is outside the surface.
fn wet_paint_around(
    painting: &mut Painting,
    [x_mm, y_mm]: [f64; 2],
    reach_mm: f64,
) -> Result<Option<u64>, PaintingError> {
    let bounds = painting.bounds();
    let cell_mm = painting.cell_mm();
    let span = |at_mm: f64, end: usize| {
        let first = ((at_mm - reach_mm) / cell_mm).floor().max(0.0) as usize;
        let last = ((at_mm + reach_mm) / cell_mm).ceil().clamp(0.0, end as f64) as usize;
        (first.min(end), last)
    };
    let (x, right) = span(x_mm, bounds.width);
    let (y, bottom) = span(y_mm, bounds.height);
    let inside = (0.0..=bounds.width as f64 * cell_mm).contains(&x_mm)
        && (0.0..=bounds.height as f64 * cell_mm).contains(&y_mm);
    if !inside || right <= x || bottom <= y {
        return Ok(None);
    }
    let rect = Rect { x, y, width: right - x, height: bottom - y };
    let wet = painting.wet_in(rect)?;
    Ok(Some((0..rect.width * rect.height).map(|cell| u64::from(wet.cell(cell).volume())).sum()))
}
