//! How large a volume is that holds an amount of paint: its film is as thick as any other.

use super::cells::{Cells, quanta_per_sample};
use super::samples::SurfaceSamples;

/// Radii of the volumes of all cells by amount of paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// Distances of the samples of each cell from its middle, in ascending order.
    distances: Vec<f32>,
    /// Index of the first distance of each cell, and at last their number.
    starts: Vec<u32>,
    /// Quanta of a film over one sample.
    per_sample: f32,
    /// Mean distance between samples, in the unit of the scene.
    spacing: f32,
}

impl Reach {
    /// The reach over the samples around the middles of `cells`.
    #[must_use]
    pub fn of(samples: &SurfaceSamples, cells: &Cells) -> Self {
        let mut distances = Vec::with_capacity(samples.len());
        let mut starts = vec![0];
        for cell in 0..samples.cell_count() {
            let first = distances.len();
            let own = &samples.places[samples.of_cell(cell)];
            distances.extend(own.iter().map(|place| place.distance(cells.centers[cell])));
            distances[first..].sort_unstable_by(f32::total_cmp);
            starts.push(distances.len() as u32);
        }
        let spacing = samples.areas.first().map_or(0.0, |area| area.sqrt());
        Self { distances, starts, per_sample: quanta_per_sample(samples) as f32, spacing }
    }

    /// Radius of the volume of `cell` that holds `amount` quanta: a film over the samples within
    /// the radius has this amount, with linear steps between samples. From the capacity of the
    /// cell on, the volume reaches beyond its farthest sample by the distance between samples,
    /// even where a surface rough by `microstructure` (0 to below 1) is lowest.
    #[must_use]
    pub fn radius(&self, cell: usize, amount: u32, microstructure: f32) -> f32 {
        let own = &self.distances[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        let [Some(&nearest), Some(&farthest)] = [own.first(), own.last()] else { return 0.0 };
        let full = (farthest + self.spacing) / (1.0 - microstructure);
        // Half of a sample's area lies nearer than the sample.
        let covered = amount as f32 / self.per_sample - 0.5;
        if covered < 0.0 {
            return nearest * (2.0 * (covered + 0.5)).sqrt();
        }
        let before = covered as usize;
        let between = covered - before as f32;
        match (own.get(before), own.get(before + 1)) {
            (Some(from), Some(to)) => from + (to - from) * between,
            (Some(last), None) => last + (full - last) * (2.0 * between).min(1.0),
            (None, _) => full,
        }
    }
}
