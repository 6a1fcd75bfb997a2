//! Paint spills from full cells to the cells joined to them, in whole quanta.

use paint::amount::{ratio_of_65536, share_of_65536};
use paint::layer::Cell;
use rayon::prelude::*;

use super::graph::Graph;
use super::grid::{Cells, MOST_FILMS, room};
use super::lattice::WettingError;

/// Greatest rate for which a step is stable. The shares of 6 neighbours across faces, 12 across
/// edges and 8 across corners then sum to less than 1.
pub const FASTEST_RATE: f32 = 0.067;

const STEEPEST: f32 = 1000.0;

/// Heads and shares are integers. This one stands for 1.
const ONE: u64 = 1 << 16;

/// A thread works on this many cells at a time.
const BLOCK: usize = 1 << 10;

/// A cell that paint reaches for the first time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Birth {
    /// The cell.
    pub cell: u32,
    /// The neighbour that gave it the most paint.
    pub giver: u32,
}

/// Spilling over a graph of cells. It holds the rates, and lists that each step fills anew.
#[derive(Debug, Clone)]
pub struct Spilling {
    /// Share of a difference of heads that crosses a face, an edge and a corner per step, in parts
    /// of 65536.
    pub(super) rates: [u64; 3],
    /// Head that each cell gains by its height, in parts of 65536.
    pub(super) lifts: Vec<u32>,
    /// Whether cells lie at different heights, or a cell has no room for 16 films.
    pub(super) uneven: bool,
    volumes: Vec<u32>,
    heads: Vec<u32>,
    /// How much each cell gives along each of its links, as a share of its paint.
    shares: Vec<u32>,
    /// Each cell has room for this share of what it is offered.
    accepted: Vec<u32>,
    next: Vec<Cell>,
}

impl Spilling {
    /// Spilling between `cells` of width `cell` in the unit of the scene. `rate` is the share of a
    /// difference of heads that crosses a face per step, 0 to [`FASTEST_RATE`]. If a cell is
    /// higher by one width, this raises its head by `slope`, 0 to 1000.
    ///
    /// # Errors
    /// If the rate or the slope is out of its range.
    pub fn new(cells: &Cells, cell: f32, rate: f32, slope: f32) -> Result<Self, WettingError> {
        for (what, found, most) in [("rate", rate, FASTEST_RATE), ("slope", slope, STEEPEST)] {
            if !(0.0..=most).contains(&found) {
                return Err(WettingError::Spilling { what, found });
            }
        }
        let heights =
            (0..cells.len()).filter(|i| cells.capacities[*i] > 0).map(|i| cells.centers[i].y);
        let lowest = heights.fold(f32::INFINITY, f32::min);
        let lifts: Vec<u32> = (0..cells.len())
            .map(|i: usize| {
                let height =
                    if cells.capacities[i] > 0 { cells.centers[i].y - lowest } else { 0.0 };
                (slope * height / cell * ONE as f32).clamp(0.0, (1 << 30) as f32) as u32
            })
            .collect();
        Ok(Self {
            rates: [1.0, 2.0, 3.0].map(|axes: f32| (rate * ONE as f32 / axes) as u64),
            uneven: lifts.iter().any(|lift| *lift > 0)
                || cells
                    .capacities
                    .iter()
                    .any(|&capacity: &u32| room(capacity) < capacity.saturating_mul(MOST_FILMS)),
            lifts,
            volumes: Vec::new(),
            heads: Vec::new(),
            shares: Vec::new(),
            accepted: Vec::new(),
            next: Vec::new(),
        })
    }

    /// Takes one step. This moves what is over the capacity of cells in `paint` to joined cells
    /// with a lower head. You get the cells that were dry before, in ascending order. If `births`
    /// is false, no paint enters dry cells.
    ///
    /// Whole quanta move, so sums are exact and the result does not depend on threads. A cell
    /// gives `(H_i - H_j) rate C` quanta to each lower neighbour. C is the smaller of both
    /// capacities. All gifts together are scaled down to what is over the cell's own capacity, and
    /// to the room of the taker.
    ///
    /// # Panics
    /// If `paint`, `cells` and `graph` are not of the same number of cells.
    pub fn step(
        &mut self,
        (graph, cells): (&Graph, &Cells),
        paint: &mut Vec<Cell>,
        births: bool,
    ) -> Vec<Birth> {
        let count = graph.len();
        assert_eq!((paint.len(), cells.len()), (count, count), "one entry a cell");
        self.volumes.resize(count, 0);
        self.heads.resize(count, 0);
        self.accepted.resize(count, 0);
        self.shares.resize(graph.others.len(), 0);
        self.next.resize(count, Cell::default());
        let most = self.measure(cells, paint);
        self.offer(graph, cells, births);
        // A level cell never rises above its highest neighbour, except for rounding.
        match self.uneven || u64::from(most) >= u64::from(MOST_FILMS - 1) * ONE {
            true => self.accept(graph, cells),
            false => self.accepted.fill(ONE as u32),
        }
        let found = self.gather(graph, paint);
        std::mem::swap(paint, &mut self.next);
        found
    }

    /// Fills `volumes` and `heads`, and returns the highest head.
    fn measure(&mut self, cells: &Cells, paint: &[Cell]) -> u32 {
        let blocks = self.volumes.chunks_mut(BLOCK).zip(self.heads.chunks_mut(BLOCK));
        let most = each(blocks.enumerate().collect(), |(block, (volumes, heads))| {
            let mut most = 0;
            for (cell, (volume, head)) in (block * BLOCK..).zip(volumes.iter_mut().zip(heads)) {
                *volume = paint[cell].volume();
                let films = (u64::from(*volume) << 16) / u64::from(cells.capacities[cell].max(1));
                // We may have cut cells, so that they hold more than they could now.
                *head = self.lifts[cell] + films.min(1 << 30) as u32;
                most = most.max(*head);
            }
            most
        });
        most.into_iter().max().unwrap_or(0)
    }

    fn offer(&mut self, graph: &Graph, cells: &Cells, births: bool) {
        let volumes = &self.volumes;
        let heads = &self.heads;
        let rates = self.rates;
        each(blocks_of(graph, &mut self.shares), |(first, shares)| {
            let offset = graph.starts[first] as usize;
            for cell in first..(first + BLOCK).min(graph.len()) {
                let links = graph.links(cell);
                let shares = &mut shares[links.start - offset..links.end - offset];
                let capacity = cells.capacities[cell];
                let excess = volumes[cell].saturating_sub(capacity);
                if excess == 0 {
                    shares.fill(0);
                    continue;
                }
                let mut sum = 0;
                for (share, link) in shares.iter_mut().zip(links) {
                    let other = graph.others[link] as usize;
                    let fall = u64::from(heads[cell].saturating_sub(heads[other])).min(16 * ONE);
                    let closed = !births && volumes[other] == 0;
                    let smaller = u64::from(capacity.min(cells.capacities[other]));
                    let rate = if closed { 0 } else { rates[usize::from(graph.axes[link]) - 1] };
                    let wanted = (fall * rate * smaller) >> 32;
                    sum += wanted;
                    *share = wanted as u32;
                }
                let excess = u64::from(excess);
                for share in shares.iter_mut().filter(|share| **share > 0) {
                    if sum > excess {
                        *share = (excess * u64::from(*share) / sum) as u32;
                    }
                    *share = ratio_of_65536(*share, volumes[cell]);
                }
            }
        });
    }

    fn accept(&mut self, graph: &Graph, cells: &Cells) {
        let volumes = &self.volumes;
        let shares = &self.shares;
        let blocks = self.accepted.chunks_mut(BLOCK).enumerate().collect();
        each(blocks, |(block, all)| {
            for (cell, accepted) in (block * BLOCK..).zip(all) {
                let offers = graph.links(cell).map(|link| {
                    let share = shares[graph.back[link] as usize];
                    let offer = share_of_65536(volumes[graph.others[link] as usize], share);
                    u64::from(offer) + u64::from(share > 0)
                });
                let offered: u64 = offers.sum();
                let free = u64::from(room(cells.capacities[cell]).saturating_sub(volumes[cell]));
                *accepted = if offered > free { free * ONE / offered } else { ONE } as u32;
            }
        });
    }

    fn gather(&mut self, graph: &Graph, paint: &[Cell]) -> Vec<Birth> {
        let volumes = &self.volumes;
        let shares = &self.shares;
        let accepted = &self.accepted;
        let blocks = self.next.chunks_mut(BLOCK).enumerate().collect();
        let births = each(blocks, |(block, next)| {
            let first = block * BLOCK;
            let gathering = Gathering { graph, paint, volumes, shares, accepted, first, next };
            graphics::lanes::vectorized(gathering)
        });
        births.concat()
    }
}

/// The cells of a block. They gather what their neighbours give. We compile this for every
/// instruction set.
struct Gathering<'a> {
    graph: &'a Graph,
    paint: &'a [Cell],
    volumes: &'a [u32],
    shares: &'a [u32],
    accepted: &'a [u32],
    first: usize,
    next: &'a mut [Cell],
}

impl pulp::WithSimd for Gathering<'_> {
    type Output = Vec<Birth>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Vec<Birth> {
        let Self { graph, paint, volumes, shares, accepted, first, next } = self;
        let mut births = Vec::new();
        for (cell, next) in (first..).zip(next) {
            let own = paint[cell];
            let mut sum = own;
            let mut most = 0;
            let mut giver = None;
            for link in graph.links(cell) {
                let other = graph.others[link] as usize;
                let back = graph.back[link] as usize;
                // Paint flows one way, from the higher head to the lower.
                if shares[link] > 0 {
                    let share = share_of_65536(shares[link], accepted[other]);
                    sum = sum.minus(&own.share_of_65536(share));
                } else if shares[back] > 0 {
                    let share = share_of_65536(shares[back], accepted[cell]);
                    let part = paint[other].share_of_65536(share);
                    sum = sum.plus(&part);
                    if volumes[cell] == 0 && part.volume() > most {
                        (most, giver) = (part.volume(), Some(other as u32));
                    }
                }
            }
            *next = sum;
            births.extend(giver.map(|giver| Birth { cell: cell as u32, giver }));
        }
        births
    }
}

/// Runs `act` for all blocks and returns the results in their order. A single block needs no other
/// thread.
fn each<T: Send, R: Send>(blocks: Vec<T>, act: impl Fn(T) -> R + Sync + Send) -> Vec<R> {
    match blocks.len() {
        0 | 1 => blocks.into_iter().map(act).collect(),
        _ => blocks.into_par_iter().map(act).collect(),
    }
}

/// The first cell of each block, with its part of a list over all links.
fn blocks_of<'a>(graph: &Graph, mut links: &'a mut [u32]) -> Vec<(usize, &'a mut [u32])> {
    let firsts = (0..graph.len()).step_by(BLOCK);
    let cut = firsts.map(|first| {
        let end = graph.starts[(first + BLOCK).min(graph.len())] - graph.starts[first];
        let (own, rest) = std::mem::take(&mut links).split_at_mut(end as usize);
        links = rest;
        (first, own)
    });
    cut.collect()
}
