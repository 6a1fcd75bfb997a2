//! Sub-steps in order, each on as many threads as its contact is worth.

use pulp::{Arch, Simd, WithSimd};

use super::band::{Band, SubStep};
use super::columns::{Columns, Rows};
use super::pressed::Pressed;
use crate::contact::Contact;
use crate::motion::Motion;
use graphics::field::Field;
use graphics::tile::Rect;

/// Cells of reach that are worth a thread of their own.
const CELLS_A_BAND: usize = 2500;

/// What sub-steps need besides the paint; kept so that none allocates.
#[derive(Debug, Default)]
pub(super) struct Player {
    pressed: Pressed,
    bands: Vec<Band>,
}

/// How many bands a contact of `reach` is cut into.
fn bands_for(reach: Rect) -> usize {
    let worth = reach.width * reach.height / CELLS_A_BAND;
    worth.min(rayon::current_num_threads()).clamp(1, reach.height.max(1))
}

impl Player {
    /// Plays `contacts` in order.
    ///
    /// # Panics
    /// If a contact reaches beyond the canvas, or its touches do not fill it.
    pub(super) fn play(
        &mut self,
        motion: &Motion,
        contacts: &[Contact],
        floor: &Field<i32>,
        wet: &mut Columns,
        brush: &mut Columns,
    ) {
        let bounds = floor.bounds();
        for Contact { rect, touches } in contacts {
            let inside =
                rect.x + rect.width <= bounds.width && rect.y + rect.height <= bounds.height;
            assert!(inside, "a contact of {rect:?} on a canvas of {bounds:?}");
            let cells = rect.width * rect.height;
            assert_eq!(touches.len(), cells, "touches of a contact of {rect:?}");
        }
        let arch = Arch::new();
        let mut all = || {
            for contact in contacts.iter().filter(|contact| !contact.rect.is_empty()) {
                self.sub_step(arch, motion, contact, floor, wet, brush);
            }
        };
        // Inside the pool, so that no sub-step waits to be let in.
        if contacts.iter().any(|contact| bands_for(contact.rect) > 1) {
            rayon::scope(|_| all());
        } else {
            all();
        }
    }

    fn sub_step(
        &mut self,
        arch: Arch,
        motion: &Motion,
        contact: &Contact,
        floor: &Field<i32>,
        wet: &mut Columns,
        brush: &mut Columns,
    ) {
        let bounds = floor.bounds();
        let reach = contact.rect.grown(2, bounds);
        let count = bands_for(reach);
        self.bands.resize_with(self.bands.len().max(count), Band::default);
        let bands = &mut self.bands[..count];
        for (i, band) in bands.iter_mut().enumerate() {
            let edge = |i: usize| reach.y + reach.height * i / count;
            band.begin(edge(i)..edge(i + 1), reach, brush.volume().len());
        }
        let pressed = &mut self.pressed;
        arch.dispatch(Measure { pressed, contact, reach, floor, wet });
        let step = SubStep { motion, contact, bounds, reach, pressed, brush };
        let mut rows = wet.rows(reach.y, reach.height);
        on_each(bands, &mut rows, &|band, rows| {
            arch.dispatch(Advect { band, step, rows });
        });
        for i in 1..count {
            let (above, below) = bands.split_at_mut(i);
            above[i - 1].join(&mut below[0], reach.width);
        }
        on_each(bands, &mut rows, &|band, rows| {
            arch.dispatch(Settle { band, step, rows });
        });
        for band in bands {
            arch.dispatch(PayOut { band, brush });
        }
    }
}

/// `act` on each band with its rows, on as many threads as there are bands.
fn on_each(
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
    rayon::join(|| on_each(above, &mut rows_above, act), || on_each(below, &mut rows_below, act));
}

// What is compiled once for every instruction set. Closures will not do: their
// shims are not inlined, and what is not inlined is not compiled anew.

struct Measure<'a> {
    pressed: &'a mut Pressed,
    contact: &'a Contact,
    reach: Rect,
    floor: &'a Field<i32>,
    wet: &'a Columns,
}

struct Advect<'a, 'b> {
    band: &'a mut Band,
    step: SubStep<'a>,
    rows: &'a mut Rows<'b>,
}

struct Settle<'a, 'b> {
    band: &'a mut Band,
    step: SubStep<'a>,
    rows: &'a mut Rows<'b>,
}

struct PayOut<'a> {
    band: &'a mut Band,
    brush: &'a mut Columns,
}

impl WithSimd for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.pressed.measure(self.contact, self.reach, self.floor, self.wet);
    }
}

impl WithSimd for Advect<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.band.advect(&self.step, self.rows);
    }
}

impl WithSimd for Settle<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.band.settle(&self.step, self.rows);
    }
}

impl WithSimd for PayOut<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.band.pay_out(self.brush);
    }
}
