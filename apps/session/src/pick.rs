//! Picking paint and reflectance at a position.

use graphics::tile::Rect;
use paint::amount::mm_from_quanta;
use paint::layer::{Layer, SLOTS};
use paint::painting::{Painting, PaintingError};
use paint::strokes::SurfaceId;

use super::event::{Picked, PickedLayer};

/// A circle on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) surface: SurfaceId,
    pub(super) x_mm: f64,
    pub(super) y_mm: f64,
    pub(super) radius_mm: f64,
}

/// Mean reflectance and paint of the cells within `place`. `painting` must be that of
/// `place.surface`. Returns `None` if the centre is outside the surface.
///
/// # Errors
/// [`PaintingError`] if the device was lost.
pub(super) fn pick(painting: &mut Painting, place: Place) -> Result<Option<Picked>, PaintingError> {
    let cell_mm = painting.cell_mm();
    let rows = rows(painting.bounds(), cell_mm, place);
    let cells: usize = rows.iter().map(|row| row.width).sum();
    if cells == 0 {
        return Ok(None);
    }
    let mut reflectance = vec![0.0; painting.library().grid.count()];
    for &row in &rows {
        let share = row.width as f64 / cells as f64;
        for (sum, value) in reflectance.iter_mut().zip(painting.reflectance_in(row)?) {
            *sum += share * value;
        }
    }
    let state = painting.state().clone();
    let mut layers = Vec::with_capacity(state.dry.len() + 1);
    for (index, dry) in state.dry.iter().enumerate() {
        let amounts_mm = mean_mm(&rows, cell_mm, |row| painting.dry_in(index, row))?;
        let label = dry.label();
        let opacity = dry.shown_opacity();
        layers.push(PickedLayer { label, slots: dry.slots, amounts_mm, opacity });
    }
    let amounts_mm = mean_mm(&rows, cell_mm, |row| painting.wet_in(row))?;
    let label = "Wet".to_owned();
    layers.push(PickedLayer { label, slots: state.slots, amounts_mm, opacity: 1.0 });
    let Place { surface, x_mm, y_mm, .. } = place;
    Ok(Some(Picked { surface, x_mm, y_mm, reflectance, layers }))
}

/// Mean height of each slot and, last, of the vehicle over the cells of `rows`, in mm.
fn mean_mm(
    rows: &[Rect],
    cell_mm: f64,
    mut read: impl FnMut(Rect) -> Result<Layer, PaintingError>,
) -> Result<[f64; SLOTS + 1], PaintingError> {
    let mut totals = [0_u64; SLOTS + 1];
    let mut cells = 0;
    for &row in rows {
        for (total, more) in totals.iter_mut().zip(read(row)?.totals()) {
            *total += more;
        }
        cells += row.width;
    }
    Ok(totals.map(|total| total as f64 / cells as f64 * mm_from_quanta(1, cell_mm)))
}

/// Cells whose centres lie within the circle, and always the cell that contains its centre: one
/// rectangle per row. Empty if the centre is outside `bounds`.
fn rows(bounds: Rect, cell_mm: f64, place: Place) -> Vec<Rect> {
    let [x, y, radius] = [place.x_mm, place.y_mm, place.radius_mm.max(0.0)].map(|mm| mm / cell_mm);
    if !(x >= 0.0 && y >= 0.0 && x < bounds.width as f64 && y < bounds.height as f64) {
        return Vec::new();
    }
    let own = (x.floor(), y.floor());
    let row = |row: usize| {
        let away = row as f64 + 0.5 - y;
        let half = (radius * radius - away * away).max(0.0).sqrt();
        let mut first = (x - half - 0.5).ceil();
        let mut last = (x + half - 0.5).floor();
        if row as f64 == own.1 {
            (first, last) = (first.min(own.0), last.max(own.0));
        } else if away.abs() > radius {
            return Rect::default();
        }
        let first = first.max(0.0);
        let last = last.min(bounds.width as f64 - 1.0);
        if last < first {
            return Rect::default();
        }
        Rect { x: first as usize, y: row, width: (last - first) as usize + 1, height: 1 }
    };
    (0..bounds.height).map(row).filter(|row| !row.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rect = Rect { x: 0, y: 0, width: 40, height: 30 };

    fn cells(x_mm: f64, y_mm: f64, radius_mm: f64) -> Vec<(usize, usize)> {
        let place = Place { surface: SurfaceId::Canvas, x_mm, y_mm, radius_mm };
        let rows = rows(BOUNDS, 0.1, place);
        rows.iter().flat_map(|row| (row.x..row.x + row.width).map(|x| (x, row.y))).collect()
    }

    #[test]
    fn a_place_is_the_cells_around_it() {
        assert_eq!(cells(0.51, 0.79, 0.0), [(5, 7)], "one cell");
        assert_eq!(cells(0.599, 0.701, 0.01), [(5, 7)], "one cell, though its middle is far");
        let around = cells(0.55, 0.75, 0.101);
        assert_eq!(around, [(5, 6), (4, 7), (5, 7), (6, 7), (5, 8)]);
        for (x, y) in cells(1.03, 1.48, 0.6) {
            let away = (0.1 * x as f64 + 0.05 - 1.03).hypot(0.1 * y as f64 + 0.05 - 1.48);
            assert!(away <= 0.6 || (x, y) == (10, 14), "column {x}, row {y}");
        }
        let area = cells(2.0, 1.5, 1.0).len() as f64;
        assert!((area - 314.0).abs() < 10.0, "a disc of 314 cells, found {area}");
    }

    #[test]
    fn beside_the_surface_lies_nothing() {
        for (x_mm, y_mm) in [(-0.01, 1.0), (1.0, 3.0), (4.0, 1.0), (f64::NAN, 1.0)] {
            assert!(cells(x_mm, y_mm, 2.0).is_empty(), "{x_mm} {y_mm}");
        }
        let corner = cells(0.0, 0.0, 0.2);
        assert!(corner.contains(&(0, 0)) && corner.len() == 3, "what is there: {corner:?}");
    }
}
