//! Runs sub-steps in order, each on the number of threads that suits the size of its contact.
//!
//! Each thread moves some rows of the contact. The transfers between a row and the head above it
//! are step 4 of the specification in [`crate::motion`]. Their loop does not branch, so that the
//! compiler makes vector instructions of it.

use std::ops::Range;

use graphics::lanes::vectorized;
use graphics::tile::Rect;
use pulp::{Simd, WithSimd};

use super::columns::{Columns, HeadPaint, Planes, Row, Rows, has_paint};
use super::penetration::{Below, PenetrationMap};
use super::velocities::{Cells, Inflow, SubStep, Velocities};
use super::wick::Wick;
use crate::contact::{Contact, Touch, Wicking};
use crate::layer::Cell;
use crate::motion::MotionConstants;
use crate::motion::press::NO_CONTACT;
use crate::motion::skin::stirred;
use crate::motion::transfer::{Exchange, exchange, leaving};

/// Minimum number of cells of a contact's reach per thread. For example, a contact of 26 x 26 cells
/// stays on one thread, and one of 88 x 88 cells may use three.
const CELLS_PER_BAND: usize = 2500;

/// [`CELLS_PER_BAND`] on a machine with two threads. Its second thread bends the head most of the
/// time. On small contacts you would wait for it longer than the work takes alone.
const CELLS_PER_BAND_OF_TWO: usize = 12_500;

/// Runs sub-steps. This holds their buffers, so that sub-steps do not allocate.
#[derive(Debug, Default)]
pub(super) struct SubStepRunner {
    penetration: PenetrationMap,
    bands: Vec<Band>,
    wick: Wick,
}

/// Number of bands into which we cut a reach, one thread each.
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
        // We enter the thread pool once for all sub-steps rather than once for each.
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
            band.begin(
                reach.y + reach.height * i / count..reach.y + reach.height * (i + 1) / count,
                reach,
                head.cells.volume().len(),
                wet.skin_volume().is_some(),
            );
        }
        let penetration = &mut self.penetration;
        vectorized(MeasurePenetration { penetration, motion, contact, reach, below, wet, head });
        let bed = below.bed;
        let step = SubStep { motion, contact, bounds, reach, penetration, bed, head };
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

// pulp compiles this work once per instruction set. It is not in closures: the compiler does not
// inline their shims, and it compiles only inlined code for each instruction set.

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

/// Rows of the canvas and the buffers of the thread that works on them. Buffers are all zero
/// between sub-steps. We reuse them, so that sub-steps do not allocate.
#[derive(Debug, Default)]
pub(super) struct Band {
    pub(super) rows: Range<usize>,
    /// Paint of the body that flows into these rows and into one row above and below.
    inflow: Inflow,
    /// Paint of the skin that flows there. Empty if no cell has one.
    skin_inflow: Inflow,
    /// Whether there was wet paint before the stroke on the cells of a row.
    painted: Vec<bool>,
    /// Paint that each cell of the head gains from this band, modulo 2^32.
    gains: Cells,
    /// Indices of the head's cells that may gain or lose paint. An index may occur several times or
    /// lie beyond the head.
    changed: Vec<u32>,
    velocities: Velocities,
    exchanges: Exchanges,
}

impl Band {
    /// Assigns `rows` of `reach` to this band and makes its buffers large enough.
    pub(super) fn begin(
        &mut self,
        rows: Range<usize>,
        reach: Rect,
        brush_cells: usize,
        has_skin: bool,
    ) {
        self.inflow.begin(reach.width, rows.len() + 2);
        if has_skin {
            self.skin_inflow.begin(reach.width, rows.len() + 2);
        }
        self.rows = rows;
        self.gains.grow(brush_cells);
    }

    /// Steps 2 and 3 of the specification. [`Band::add_inflow_and_transfer`] adds the paint that
    /// flows in later.
    #[inline(always)]
    pub(super) fn advect(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        self.velocities.begin(step, self.rows.start);
        for y in self.rows.clone() {
            let columns = step.penetration.moving(y);
            let mut row = rows.row(y, columns.start, columns.len());
            self.velocities.of_row(step, row.body.volume, y);
            if !columns.is_empty() {
                let place = (columns.start - step.reach.x, y + 1 - self.rows.start);
                self.inflow.scatter(&self.velocities, &mut row.body, place);
                if let Some(skin) = row.skin.as_mut().filter(
                    #[inline(always)]
                    |skin| has_paint(skin.volume),
                ) {
                    self.skin_inflow.scatter(&self.velocities, skin, place);
                }
            }
        }
    }

    /// This band and the band `below` compute inflow for each other's border rows. This moves it to
    /// the band that owns the row.
    pub(super) fn exchange_border_rows(&mut self, below: &mut Self) {
        self.inflow.exchange_border_rows(&mut below.inflow);
        if self.skin_inflow.begun() {
            self.skin_inflow.exchange_border_rows(&mut below.skin_inflow);
        }
    }

    /// The rest of step 3, and step 4 for the canvas. [`Band::add_brush_gains`] changes the head's
    /// cells later.
    #[inline(always)]
    pub(super) fn add_inflow_and_transfer(&mut self, step: &SubStep<'_>, rows: &mut Rows<'_>) {
        for y in self.rows.clone() {
            let inflow_row = y + 1 - self.rows.start;
            let changing = step.penetration.changing(y);
            let skin_flows = self.skin_inflow.has_flow(inflow_row);
            if (self.inflow.has_flow(inflow_row) || skin_flows) && !changing.is_empty() {
                let mut row = rows.row(y, changing.start, changing.len());
                let from = changing.start - step.reach.x;
                self.inflow.pour(from..from + changing.len(), inflow_row, &mut row.body);
                if let Some(mut skin) = row.skin {
                    if skin_flows {
                        self.skin_inflow.pour(from..from + changing.len(), inflow_row, &mut skin);
                    }
                    for (both, skin) in row.body.volume.iter_mut().zip(skin.volume) {
                        *both += *skin;
                    }
                }
            }
            let columns = step.penetration.in_contact(y);
            if !columns.is_empty() {
                self.transfer(step, rows.row(y, columns.start, columns.len()), y);
            }
        }
    }

    #[inline(always)]
    fn transfer(&mut self, step: &SubStep<'_>, mut row: Row<'_>, y: usize) {
        let columns = step.penetration.in_contact(y);
        let touches = step.touches(y);
        self.changed.extend(touches.iter().map(|touch| touch.brush_cell));
        // The head lays a skin where there was wet paint before the stroke.
        self.painted.resize(columns.len(), false);
        let layered =
            row.skin.is_some() && step.bed.painted_row((columns.start, y), &mut self.painted);
        let skin = row.skin.take().filter(
            #[inline(always)]
            |skin| layered || has_paint(skin.volume),
        );
        self.exchanges.of_row(step, row.body.volume, skin.as_ref().map(|skin| &*skin.volume), y);
        match skin {
            None => self.transfer_one_film(step, touches, row.body),
            Some(skin) => self.transfer_two_films(step, y, row.body, skin),
        }
    }

    /// Transfers between the head and cells without a skin.
    #[inline(always)]
    fn transfer_one_film(&mut self, step: &SubStep<'_>, touches: &[Touch], row: Planes<'_>) {
        let head = step.head.cells.layer();
        let cells = head.vehicle.values().len();
        // We give the slices one length, so that one check of an index is enough.
        let above = (&head.pigments.values()[..cells], &head.vehicle.values()[..cells]);
        let gains = (&mut self.gains.pigments[..cells], &mut self.gains.vehicle[..cells]);
        let paint = row.pigments.iter_mut().zip(row.vehicle).zip(row.volume);
        let exchanges = touches.iter().zip(&self.exchanges.found);
        for (((pigments, vehicle), volume), (touch, &Exchange { down, up: [up, _] })) in
            paint.zip(exchanges)
        {
            if down | up == 0 {
                continue;
            }
            let at = touch.brush_cell as usize;
            let laid = Cell { pigments: above.0[at], vehicle: above.1[at] }.share_of_65536(down);
            let canvas = Cell { pigments: *pigments, vehicle: *vehicle };
            let taken = canvas.share_of_65536(up);
            let canvas = canvas.minus(&taken).plus(&laid);
            (*pigments, *vehicle, *volume) = (canvas.pigments, canvas.vehicle, canvas.volume());
            let gained = Cell { pigments: gains.0[at], vehicle: gains.1[at] };
            let gained = gained.wrapping_plus(&taken).wrapping_minus(&laid);
            (gains.0[at], gains.1[at]) = (gained.pigments, gained.vehicle);
        }
    }

    /// Transfers between the head and cells with a body and a skin, then stirs both.
    #[inline(always)]
    fn transfer_two_films(
        &mut self,
        step: &SubStep<'_>,
        y: usize,
        body: Planes<'_>,
        skin: Planes<'_>,
    ) {
        let head = step.head.cells.layer();
        let cells = head.vehicle.values().len();
        let above = (&head.pigments.values()[..cells], &head.vehicle.values()[..cells]);
        let gains = (&mut self.gains.pigments[..cells], &mut self.gains.vehicle[..cells]);
        let rates = step.contact.rates;
        let columns = step.penetration.in_contact(y);
        let penetrations = step.penetration.row(y, columns.start, columns.len());
        let inputs = step.touches(y).iter().zip(penetrations);
        let inputs = inputs.zip(&self.exchanges.found).zip(&self.painted).enumerate();
        for (i, (((&touch, &penetration), &Exchange { down, up }), &painted)) in inputs {
            if penetration == NO_CONTACT {
                continue;
            }
            let mut films = [
                Cell { pigments: body.pigments[i], vehicle: body.vehicle[i] },
                Cell { pigments: skin.pigments[i], vehicle: skin.vehicle[i] },
            ];
            if down | up[0] | up[1] > 0 {
                let at = touch.brush_cell as usize;
                let laid = Cell { pigments: above.0[at], vehicle: above.1[at] };
                let laid = laid.share_of_65536(down);
                let taken = [films[0].share_of_65536(up[0]), films[1].share_of_65536(up[1])];
                films = [films[0].minus(&taken[0]), films[1].minus(&taken[1])];
                let upper = usize::from(painted);
                films[upper] = films[upper].plus(&laid);
                let gained = Cell { pigments: gains.0[at], vehicle: gains.1[at] };
                let taken = taken[0].plus(&taken[1]);
                let gained = gained.wrapping_plus(&taken).wrapping_minus(&laid);
                (gains.0[at], gains.1[at]) = (gained.pigments, gained.vehicle);
            }
            let volumes = [films[0].volume(), films[1].volume()];
            let shares = stirred(&rates, touch, penetration, volumes[0], volumes[1]);
            if shares[0] | shares[1] > 0 {
                let risen = films[0].share_of_65536(shares[0]);
                let sunk = films[1].share_of_65536(shares[1]);
                films[0] = films[0].minus(&risen).plus(&sunk);
                films[1] = films[1].minus(&sunk).plus(&risen);
            }
            (body.pigments[i], body.vehicle[i]) = (films[0].pigments, films[0].vehicle);
            (skin.pigments[i], skin.vehicle[i]) = (films[1].pigments, films[1].vehicle);
            skin.volume[i] = films[1].volume();
            body.volume[i] = films[0].volume() + skin.volume[i];
        }
    }

    /// Adds the gains of this band to the head's paint and clears them.
    #[inline(always)]
    pub(super) fn add_brush_gains(&mut self, head: &mut HeadPaint) {
        for at in self.changed.drain(..) {
            let at = at as usize;
            if let Some(gain) = self.gains.take(at) {
                head.cells.set_cell(at, head.cells.cell(at).wrapping_plus(&gain));
            }
        }
    }
}

/// Exchanges of one row after another. This holds its buffers, so that sub-steps do not allocate.
#[derive(Debug, Default)]
pub(super) struct Exchanges {
    /// Exchanges of the cells of a row, from the first to the last in contact.
    pub(super) found: Vec<Exchange>,
    brush_volumes: Vec<u32>,
    leaving: Vec<u32>,
    /// Heights of the skins of a row without skins: zeros.
    no_skin: Vec<u32>,
}

impl Exchanges {
    /// Computes the transfers of the cells in contact of row `y`. `volumes` holds the heights of its
    /// columns in quanta, both films together. `skin` holds the heights of the skins alone, or is `None`
    /// if there are none.
    #[inline(always)]
    pub(super) fn of_row(
        &mut self,
        step: &SubStep<'_>,
        volumes: &[u32],
        skin: Option<&[u32]>,
        y: usize,
    ) {
        let columns = step.penetration.in_contact(y);
        let bounds = step.bounds;
        let touches = step.touches(y);
        let above = step.head.cells.volume();
        self.brush_volumes.resize(columns.len(), 0);
        for (volume, touch) in self.brush_volumes.iter_mut().zip(touches) {
            *volume = above.get(touch.brush_cell as usize).copied().unwrap_or_default();
        }
        self.leaving.clear();
        self.leaving.resize(columns.len(), 0);
        let at_side = columns.start == 0 || columns.end == bounds.width;
        if at_side || y == 0 || y + 1 == bounds.height {
            for (x, (out, &touch)) in columns.clone().zip(self.leaving.iter_mut().zip(touches)) {
                *out = leaving(touch, (x, y), bounds);
            }
        }
        self.found.resize(columns.len(), Exchange { down: 0, up: [0; 2] });
        self.no_skin.resize(columns.len(), 0);
        let skin = skin.unwrap_or(&self.no_skin);
        let penetrations = step.penetration.row(y, columns.start, columns.len());
        let coats = step.penetration.coats(y, columns.start, columns.len());
        // We copy this, so that the loop need not load it again after each store.
        let rates = step.contact.rates;
        let heads = penetrations.iter().zip(coats);
        let volumes = volumes.iter().zip(skin).zip(&self.brush_volumes).zip(&self.leaving);
        let inputs = touches.iter().zip(heads).zip(volumes);
        for (found, ((&touch, (&penetration, &coat)), volumes)) in self.found.iter_mut().zip(inputs)
        {
            let (((&both, &skin), &brush), &leaving) = volumes;
            let canvas = [both - skin, skin];
            *found = exchange(&rates, touch, penetration, coat, canvas, brush, leaving);
        }
    }
}
