//! Takes one step of spilling on a graphics device.

use std::sync::Arc;

use graphics::gpu::{Buffer, Device, DeviceError, Kernel, Recording, Rows, Storage, layout};
use paint::layer::{Cell, SLOTS};

use super::graph::Graph;
use super::grid::Grid;
use super::spill::{Birth, Spilling};
use crate::device_memory::DeviceMemory;

/// Amounts of a cell: pigments by slot, then vehicle.
const AMOUNTS: usize = SLOTS + 1;

const GROUP: u32 = 64;

const NONE: u32 = u32::MAX;

#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct SpillParams {
    rates: [u32; 3],
    count: u32,
    births: u32,
    uneven: u32,
    padding: [u32; 2],
}

const fn kernel(name: &'static str) -> Kernel {
    Kernel {
        name,
        source: concat!(
            include_str!("../../../../paint/src/amount.wgsl"),
            include_str!("spill.wgsl")
        ),
        parameters: layout!(SpillParams { rates, count, births, uneven, padding }),
        structs: &[],
        storage: &[
            Storage::Read,
            Storage::Read,
            Storage::Read,
            Storage::Write,
            Storage::Write,
            Storage::Write,
            Storage::Write,
        ],
    }
}

static MEASURE: Kernel = kernel("volumes_spill_measure");
static OFFER: Kernel = kernel("volumes_spill_offer");
static ACCEPT: Kernel = kernel("volumes_spill_accept");
static GATHER: Kernel = kernel("volumes_spill_gather");

/// The kernels of a step of spilling, in their order.
pub(crate) static SPILL: [&Kernel; 4] = [&MEASURE, &OFFER, &ACCEPT, &GATHER];

/// Spilling on a graphics device. It keeps its memory there from step to step. Paint goes to the
/// device and comes back in every step.
#[derive(Debug, Default)]
pub struct DeviceSpilling {
    graph: Option<(Arc<Grid>, Buffer)>,
    cells: DeviceMemory,
    paint: DeviceMemory,
    measured: DeviceMemory,
    shares: DeviceMemory,
    next: DeviceMemory,
    highest: DeviceMemory,
}

impl DeviceSpilling {
    /// Takes one step like [`Spilling::step`] on a graphics device. You get the same quanta to the
    /// bit. Pass the same device in all calls.
    ///
    /// # Errors
    /// [`DeviceError`] for a device that has no room, or failed. No paint has moved then.
    ///
    /// # Panics
    /// If `paint` and `grid` are not of the same number of cells.
    pub fn step(
        &mut self,
        device: &mut Device,
        (spilling, grid): (&Spilling, &Arc<Grid>),
        paint: &mut [Cell],
        births: bool,
    ) -> Result<Vec<Birth>, DeviceError> {
        let count = grid.graph.len();
        let links = grid.graph.others.len();
        assert_eq!((paint.len(), grid.cells.len()), (count, count), "one entry a cell");
        if count == 0 {
            return Ok(Vec::new());
        }
        let graph = self.graph(device, grid)?;
        let capacities = grid.cells.capacities.iter().zip(&spilling.lifts);
        let cells: Vec<[u32; 2]> = capacities.map(|(&capacity, &lift)| [capacity, lift]).collect();
        let amounts: Vec<[u32; AMOUNTS]> = paint.iter().map(amounts_of).collect();
        fn words(count: usize) -> usize {
            count * size_of::<u32>()
        }
        let next = self.next.of_bytes(device, "paint", words((AMOUNTS + 1) * count))?;
        let buffers = [
            &graph,
            &self.cells.holding(device, "cells", &cells)?,
            &self.paint.holding(device, "paint", &amounts)?,
            &self.measured.of_bytes(device, "volumes of paint", words(2 * count))?,
            &self.shares.of_bytes(device, "shares of paint", words(links + count))?,
            &next,
            &self.highest.holding(device, "the highest cell", &[0_u32])?,
        ];
        let params = SpillParams {
            rates: spilling.rates.map(|rate| rate as u32),
            count: count as u32,
            births: births.into(),
            uneven: spilling.uneven.into(),
            padding: [0; 2],
        };
        let mut recording = Recording::default();
        for kernel in SPILL {
            let groups = (count as u32).div_ceil(GROUP);
            recording.dispatch(kernel, &params, &buffers, [groups, 1, 1]);
        }
        device.submit(&mut recording)?;
        let found: Vec<[u32; AMOUNTS + 1]> = device.read(&next, Rows::start(count))?;
        let mut born = Vec::new();
        for ((cell, paint), [pigments @ .., vehicle, giver]) in (0..).zip(paint).zip(found) {
            *paint = Cell { pigments, vehicle };
            born.extend((giver != NONE).then_some(Birth { cell, giver }));
        }
        Ok(born)
    }

    /// The links of a grid. We write them once.
    fn graph(&mut self, device: &mut Device, grid: &Arc<Grid>) -> Result<Buffer, DeviceError> {
        if let Some((own, buffer)) = &self.graph
            && Arc::ptr_eq(own, grid)
        {
            return Ok(buffer.clone());
        }
        self.graph = None;
        let buffer = device.buffer_of("joined cells", &words_of(&grid.graph))?;
        self.graph = Some((Arc::clone(grid), buffer.clone()));
        Ok(buffer)
    }
}

fn amounts_of(paint: &Cell) -> [u32; AMOUNTS] {
    let mut amounts = [paint.vehicle; AMOUNTS];
    amounts[..SLOTS].copy_from_slice(&paint.pigments);
    amounts
}

/// The graph in the form of the kernels: starts, then two words per link.
fn words_of(graph: &Graph) -> Vec<u32> {
    let links = (0..graph.others.len()).flat_map(|link| {
        let axes = u32::from(graph.axes[link]);
        [graph.others[link] | (axes << 30), graph.back[link]]
    });
    graph.starts.iter().copied().chain(links).collect()
}

#[cfg(test)]
mod tests {
    use graphics::mesh::{Mesh, SampleModel};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::test_volumes::{device, joined, sheet};

    fn opened() -> Option<Device> {
        device()?.into_device()
    }

    fn amount(random: &mut ChaCha8Rng, most: u32) -> u32 {
        let most = (most >> random.random_range(0..24)).max(1);
        random.random_range(0..=most)
    }

    fn random_paint(random: &mut ChaCha8Rng, room: u32) -> Cell {
        let whole = [0, room / 16, room / 3, room][random.random_range(0..4)];
        let mut cell = Cell::default();
        for slot in 0..SLOTS {
            cell.pigments[slot] = amount(random, whole / 9);
        }
        cell.vehicle = amount(random, whole / 9) + whole / 9 * 7 * random.random_range(0..2);
        cell
    }

    fn grids() -> Vec<Grid> {
        fn level(side: f32, y: f32) -> Mesh {
            sheet(3, move |u, v| [side * u, y, side * v])
        }
        let plates = joined(level(5.0, 0.0), &level(4.0, 3.0));
        let slope = sheet(4, |u, v| [7.0 * u, 3.0 * u + v, 6.0 * v]);
        let small = sheet(1, |u, v| [0.1 * u + 0.3, 0.4, 0.1 * v + 0.3]);
        let village = SampleModel::Village.mesh(2000);
        fn grid(mesh: &Mesh, cell: f32) -> Grid {
            Grid::of(mesh, cell, 16, 1).unwrap()
        }
        vec![grid(&small, 1.0), grid(&plates, 1.0), grid(&slope, 1.0), grid(&village, 0.15)]
    }

    #[test]
    fn a_device_spills_the_same_quanta_to_the_bit() {
        let Some(mut device) = opened() else { return };
        let random = &mut ChaCha8Rng::seed_from_u64(3);
        let mut on_device = DeviceSpilling::default();
        let grids = grids();
        assert_eq!(grids[0].cells.len(), 1);
        let mut births_seen = 0;
        let mut moved = 0;
        // Capacities of the grid, and ones of any magnitude up to a whole column.
        for (wild, grid) in [false, true]
            .into_iter()
            .flat_map(|wild| grids.iter().map(move |grid| (wild, grid.clone())))
        {
            let mut grid = grid;
            if wild {
                let capacities = grid.cells.capacities.iter_mut();
                capacities.for_each(|capacity| *capacity = amount(random, 1 << 30));
            }
            let grid = Arc::new(grid);
            for (rate, slope) in [(0.04, 0.0), (0.067, 0.0), (0.05, 3.0), (0.067, 1000.0)] {
                let mut spilling = Spilling::new(&grid.cells, 1.0, rate, slope).unwrap();
                let rooms = (0..grid.cells.len()).map(|cell| grid.cells.room(cell));
                let mut own: Vec<Cell> = rooms.map(|room| random_paint(random, room)).collect();
                let mut other = own.clone();
                for step in 0..6 {
                    let before = own.clone();
                    let births = step % 3 != 1;
                    let found = on_device.step(&mut device, (&spilling, &grid), &mut other, births);
                    let born = spilling.step((&grid.graph, &grid.cells), &mut own, births);
                    assert_eq!(found, Ok(born.clone()), "{wild} {rate} {slope} {step}");
                    assert!(own == other, "{wild} {rate} {slope} {step}");
                    births_seen += born.len();
                    moved += own.iter().zip(&before).filter(|(own, before)| own != before).count();
                }
            }
        }
        assert!(births_seen > 20 && moved > 2000, "{births_seen} {moved}");
    }

    #[test]
    fn a_lost_device_is_an_error_and_moves_nothing() {
        let Some(mut device) = opened() else { return };
        let grid = Arc::new(grids().swap_remove(1));
        let spilling = Spilling::new(&grid.cells, 1.0, 0.04, 0.0).unwrap();
        let mut paint = vec![Cell::default(); grid.cells.len()];
        paint[0].vehicle = grid.cells.room(0);
        let before = paint.clone();
        device.close();
        let mut on_device = DeviceSpilling::default();
        let found = on_device.step(&mut device, (&spilling, &grid), &mut paint, true);
        assert!(matches!(found, Err(DeviceError::Lost(..))), "{found:?}");
        assert!(paint == before);
    }
}
