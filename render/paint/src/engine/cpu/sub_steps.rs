//! Runs sub-steps in order, each on a number of threads that suits its contact's size.

use pulp::{Simd, WithSimd};

use super::band::Band;
use super::below::Below;
use super::columns::{Columns, Rows};
use super::head_paint::HeadPaint;
use super::penetration::PenetrationMap;
use super::step::SubStep;
use super::wick::Wick;
use crate::contact::{Contact, Wicking};
use crate::motion::MotionConstants;
use graphics::lanes::vectorized;
use graphics::tile::Rect;

/// Minimum number of cells of a contact's reach per thread: a contact of 26 x 26 cells
/// stays on one thread, one of 88 x 88 cells may use three.
const CELLS_PER_BAND: usize = 2500;

/// [`CELLS_PER_BAND`] on a machine with two threads. Its second thread bends the head most of the
/// time, so on small contacts waiting for it takes longer than doing the work alone.
const CELLS_PER_BAND_OF_TWO: usize = 12_500;

/// Runs sub-steps. Holds their buffers, so that no sub-step allocates.
#[derive(Debug, Default)]
pub(super) struct SubStepRunner {
    penetration: PenetrationMap,
    bands: Vec<Band>,
    wick: Wick,
}

/// Number of bands that a reach is cut into, one thread each.
fn band_count(reach: Rect) -> usize {
    let threads = rayon::current_num_threads();
    let cells = if threads > 2 { CELLS_PER_BAND } else { CELLS_PER_BAND_OF_TWO };
    (reach.width * reach.height / cells).min(threads).clamp(1, reach.height.max(1))
}

impl SubStepRunner {
    /// Applies one sub-step for each of `contacts`, in order.
    ///
    /// # Panics
    /// If a contact reaches beyond the canvas, or does not have one touch per cell.
    pub(super) fn apply(
        &mut self,
        motion: &MotionConstants,
        contacts: &[Contact],
        below: Below<'_>,
        wet: &mut Columns,
        head: &mut HeadPaint,
    ) {
        let bounds = below.floor.bounds();
        for Contact { rect, touches, .. } in contacts {
            let inside =
                rect.x + rect.width <= bounds.width && rect.y + rect.height <= bounds.height;
            assert!(inside, "a contact over {rect:?} must lie within the canvas {bounds:?}");
            let cells = rect.width * rect.height;
            assert_eq!(touches.len(), cells, "a contact over {rect:?} has a touch per cell");
        }
        let mut all = || {
            for contact in contacts {
                if contact.wicking.share > 0 {
                    let wick = &mut self.wick;
                    let wicking = contact.wicking;
                    vectorized(ApplyWick { wick, wicking, head });
                }
                if !contact.rect.is_empty() {
                    self.sub_step(motion, contact, below, wet, head);
                }
            }
        };
        // Enter the thread pool once for all sub-steps rather than once for each.
        if contacts.iter().any(|contact| band_count(contact.rect) > 1) {
            rayon::scope(|_| all());
        } else {
            all();
        }
    }

    fn sub_step(
        &mut self,
        motion: &MotionConstants,
        contact: &Contact,
        below: Below<'_>,
        wet: &mut Columns,
        head: &mut HeadPaint,
    ) {
        let bounds = below.floor.bounds();
        let reach = contact.rect.grown(2, bounds);
        let count = band_count(reach);
        self.bands.resize_with(self.bands.len().max(count), Band::default);
        let bands = &mut self.bands[..count];
        for (i, band) in bands.iter_mut().enumerate() {
            let edge = |i: usize| reach.y + reach.height * i / count;
            band.begin(edge(i)..edge(i + 1), reach, head.cells.volume().len());
        }
        let penetration = &mut self.penetration;
        vectorized(MeasurePenetration { penetration, motion, contact, reach, below, wet, head });
        let step = SubStep { motion, contact, bounds, reach, penetration, head };
        let mut rows = wet.rows(reach.y, reach.height);
        on_each_band(bands, &mut rows, &|band, rows| {
            vectorized(Advect { band, step, rows });
        });
        for i in 1..count {
            let (above, below) = bands.split_at_mut(i);
            above[i - 1].exchange_border_rows(&mut below[0]);
        }
        on_each_band(bands, &mut rows, &|band, rows| {
            vectorized(AddInflowAndTransfer { band, step, rows });
        });
        for band in bands {
            vectorized(AddBrushGains { band, head });
        }
    }
}

/// Calls `act` for each band with its rows, each band on a thread of its own.
fn on_each_band(
    bands: &mut [Band],
    rows: &mut Rows<'_>,
    act: &(impl Fn(&mut Band, &mut Rows<'_>) + Sync),
) {
    if let [band] = bands {
        act(band, rows);
        return;
    }
    let (above, below) = bands.split_at_mut(bands.len() / 2);
    let (mut rows_above, mut rows_below) = rows.split(below[0].rows.start);
    rayon::join(
        || on_each_band(above, &mut rows_above, act),
        || on_each_band(below, &mut rows_below, act),
    );
}

// The work that pulp compiles once per instruction set. It is not in closures, as their
// shims are not inlined, and only inlined code is compiled for each instruction set.

struct MeasurePenetration<'a> {
    penetration: &'a mut PenetrationMap,
    motion: &'a MotionConstants,
    contact: &'a Contact,
    reach: Rect,
    below: Below<'a>,
    wet: &'a Columns,
    head: &'a HeadPaint,
}

struct Advect<'a, 'b> {
    band: &'a mut Band,
    step: SubStep<'a>,
    rows: &'a mut Rows<'b>,
}

struct AddInflowAndTransfer<'a, 'b> {
    band: &'a mut Band,
    step: SubStep<'a>,
    rows: &'a mut Rows<'b>,
}

struct AddBrushGains<'a> {
    band: &'a mut Band,
    head: &'a mut HeadPaint,
}

struct ApplyWick<'a> {
    wick: &'a mut Wick,
    wicking: Wicking,
    head: &'a mut HeadPaint,
}

impl WithSimd for ApplyWick<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.wick.apply(self.wicking, self.head);
    }
}

impl WithSimd for MeasurePenetration<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { penetration, motion, contact, reach, below, wet, head } = self;
        penetration.measure(motion, contact, reach, below, wet, head);
    }
}

impl WithSimd for Advect<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.band.advect(&self.step, self.rows);
    }
}

impl WithSimd for AddInflowAndTransfer<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.band.add_inflow_and_transfer(&self.step, self.rows);
    }
}

impl WithSimd for AddBrushGains<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.band.add_brush_gains(self.head);
    }
}
