//! Paint that flows into the rows of a band during a sub-step.

use std::ops::Range;

use super::cells::Cells;
use super::columns::Row;
use super::velocities::Velocities;
use crate::amount::share_of_65536;
use crate::layer::{Cell, SLOTS};

/// Paint by cell, row by row; none between sub-steps. Holds its buffers, so that no sub-step
/// allocates.
#[derive(Debug, Default)]
pub(super) struct Inflow {
    width: usize,
    cells: Cells,
    /// Whether paint flows into or out of each row.
    flows: Vec<bool>,
    /// Vehicle that leaves each column of a row along x, along y and diagonally.
    leaving: [Vec<u32>; 3],
}

impl Inflow {
    /// Makes room for `rows` rows of `width` cells, into which nothing flows yet.
    pub(super) fn begin(&mut self, width: usize, rows: usize) {
        self.cells.grow(width * rows);
        self.width = width;
        self.flows.clear();
        self.flows.resize(rows, false);
    }

    /// Whether paint flows into or out of row `y`.
    pub(super) fn has_flow(&self, y: usize) -> bool {
        self.flows[y]
    }

    /// Takes what leaves the columns of `row` and adds it to the cells that it reaches. The first
    /// column lies at column `x` of row `y`, which is neither the first row nor the last.
    #[inline(always)]
    pub(super) fn scatter(
        &mut self,
        velocities: &Velocities,
        row: &mut Row<'_>,
        (x, y): (usize, usize),
    ) {
        self.take_vehicle(velocities, row.vehicle);
        let Self { cells: Cells { pigments, vehicle }, leaving, .. } = self;
        // Slices of one length, so that one check of an index is enough.
        let count = pigments.len();
        let to_pigments = &mut pigments[..count];
        let to_vehicle = &mut vehicle[..count];
        let first = y * self.width + x;
        let width = self.width as isize;
        let [in_x, in_y, diagonal] = &velocities.outflow;
        let shares = in_x.iter().zip(in_y).zip(diagonal);
        let to = velocities.beside.iter().zip(&velocities.below);
        let [in_x, in_y, diagonal] = &*leaving;
        let vehicle = in_x.iter().zip(in_y).zip(diagonal);
        let columns = row.pigments.iter_mut().zip(shares).zip(to).zip(vehicle).enumerate();
        let mut flows = false;
        for (i, (((pigments, ((&in_x, &in_y), &diagonal)), (&beside, &below)), vehicle)) in columns
        {
            if in_x | in_y | diagonal == 0 {
                continue;
            }
            flows = true;
            let before = Cell { pigments: *pigments, vehicle: 0 };
            let in_x = before.share_of_65536(in_x);
            let in_y = before.share_of_65536(in_y);
            let diagonal = before.share_of_65536(diagonal);
            *pigments = before.minus(&in_x).minus(&in_y).minus(&diagonal).pigments;
            let at_x = (first + i).wrapping_add_signed(beside as isize);
            let at_y = (first + i).wrapping_add_signed(below as isize * width);
            let at_diagonal = at_y.wrapping_add_signed(beside as isize);
            let ((vehicle_x, vehicle_y), vehicle_diagonal) = vehicle;
            to_pigments[at_x] = sum(&to_pigments[at_x], &in_x);
            to_vehicle[at_x] += vehicle_x;
            to_pigments[at_y] = sum(&to_pigments[at_y], &in_y);
            to_vehicle[at_y] += vehicle_y;
            to_pigments[at_diagonal] = sum(&to_pigments[at_diagonal], &diagonal);
            to_vehicle[at_diagonal] += vehicle_diagonal;
        }
        if flows {
            self.flows[y - 1..=y + 1].fill(true);
        }
    }

    /// Takes the vehicle that leaves the columns of a row from `vehicle`.
    #[inline(always)]
    fn take_vehicle(&mut self, velocities: &Velocities, vehicle: &mut [u32]) {
        for (parts, shares) in self.leaving.iter_mut().zip(&velocities.outflow) {
            parts.resize(vehicle.len(), 0);
            for ((part, &vehicle), &share) in parts.iter_mut().zip(&*vehicle).zip(shares) {
                *part = share_of_65536(vehicle, share);
            }
        }
        let [in_x, in_y, diagonal] = &self.leaving;
        let parts = in_x.iter().zip(in_y).zip(diagonal);
        for (vehicle, ((in_x, in_y), diagonal)) in vehicle.iter_mut().zip(parts) {
            *vehicle -= in_x + in_y + diagonal;
        }
    }

    /// Moves what flows into the last row of this band and the first of the band `below`, but was
    /// computed by the other one, to the band that owns the row. Each band has a row of the other.
    pub(super) fn exchange_border_rows(&mut self, below: &mut Self) {
        let last = self.flows.len() - 2;
        let beyond = self.flows.len() - 1;
        self.flows[last] |= below.flows[0];
        below.flows[1] |= self.flows[beyond];
        self.take_row(last, below, 0);
        below.take_row(1, self, beyond);
    }

    /// Moves row `from` of `other` to row `to`.
    fn take_row(&mut self, to: usize, other: &mut Self, from: usize) {
        let width = self.width;
        for x in 0..width {
            let Some(more) = other.cells.take(from * width + x) else { continue };
            let to = to * width + x;
            self.cells.pigments[to] = sum(&self.cells.pigments[to], &more);
            self.cells.vehicle[to] += more.vehicle;
        }
    }

    /// Moves the paint at `columns` of row `y` into `row`, which has as many cells.
    #[inline(always)]
    pub(super) fn pour(&mut self, columns: Range<usize>, y: usize, row: Row<'_>) {
        let first = y * self.width;
        let cells = first + columns.start..first + columns.end;
        let Cells { pigments, vehicle } = &mut self.cells;
        let vehicle = &mut vehicle[cells.clone()];
        for (amount, more) in row.vehicle.iter_mut().zip(&*vehicle) {
            *amount += more;
        }
        vehicle.fill(0);
        let more = row.pigments.iter_mut().zip(&mut pigments[cells]);
        for ((volume, &vehicle), (pigments, more)) in
            row.volume.iter_mut().zip(&*row.vehicle).zip(more)
        {
            *pigments = sum(pigments, &Cell { pigments: *more, vehicle: 0 });
            *volume = Cell { pigments: *pigments, vehicle }.volume();
            *more = [0; SLOTS];
        }
    }
}

/// Sum of `pigments` and those of `more`.
#[inline(always)]
fn sum(pigments: &[u32; SLOTS], more: &Cell) -> [u32; SLOTS] {
    more.plus(&Cell { pigments: *pigments, vehicle: 0 }).pigments
}
