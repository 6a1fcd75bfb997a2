//! Axes: a quantity with its unit, range and ticks.

use spectra::Grid;

/// Mapping of values to positions along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Position proportional to the value.
    Linear,
    /// Position proportional to the logarithm of the value.
    Log,
}

/// One axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit, such as `Wavelength (nm)`.
    pub name: String,
    /// Value at the low end.
    pub low: f64,
    /// Value at the high end.
    pub high: f64,
    /// Linear or logarithmic scale.
    pub scale: Scale,
    /// Values of the ticks, with their labels.
    pub ticks: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis from `low` to `high` with about `count` ticks at round numbers.
    #[must_use]
    pub fn linear(quantity: &str, unit: &str, low: f64, high: f64, count: usize) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        let step = round_step((high - low) / count.max(1) as f64);
        let digits = (-step.log10().floor()).max(0.0) as usize;
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let ticks = (first..=last).map(|i| {
            let value = i as f64 * step;
            (value, format!("{value:.digits$}"))
        });
        Self {
            name: named(quantity, unit),
            low,
            high,
            scale: Scale::Linear,
            ticks: ticks.collect(),
        }
    }

    /// A linear axis that includes `low` to `high` and ends at ticks.
    #[must_use]
    pub fn around(quantity: &str, unit: &str, low: f64, high: f64, count: usize) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        let step = round_step((high - low) / count.max(1) as f64);
        let low = (low / step + 1e-9).floor() * step;
        let high = (high / step - 1e-9).ceil() * step;
        Self::linear(quantity, unit, low, high, count)
    }

    /// A logarithmic axis of whole decades that includes `low` to `high`, but of these at most the
    /// uppermost `decades`. Values below the axis, including 0, are drawn at its low end.
    #[must_use]
    pub fn log(quantity: &str, unit: &str, low: f64, high: f64, decades: i32) -> Self {
        let top = if high > 0.0 { (high.log10() - 1e-9).ceil() as i32 } else { 0 };
        let foot = if low > 0.0 { (low.log10() + 1e-9).floor() as i32 } else { top - decades };
        let foot = foot.clamp(top - decades, top - 1);
        let stride = if top - foot > 4 { 2 } else { 1 };
        let ticks = (foot..=top).filter(|power| (top - power) % stride == 0).map(|power| {
            let value = 10_f64.powi(power);
            let label =
                if (-3..=4).contains(&power) { format!("{value}") } else { format!("1e{power}") };
            (value, label)
        });
        Self {
            name: named(quantity, unit),
            low: 10_f64.powi(foot),
            high: 10_f64.powi(top),
            scale: Scale::Log,
            ticks: ticks.collect(),
        }
    }

    /// A logarithmic axis with the smallest range around `low` to `high` that ends at 1, 2 or 5
    /// times a power of ten, with ticks at all of these.
    #[must_use]
    pub fn log_close(quantity: &str, unit: &str, low: f64, high: f64) -> Self {
        let round: Vec<f64> = (-9..=9)
            .flat_map(|power| [1.0, 2.0, 5.0].map(|step| step * 10_f64.powi(power)))
            .collect();
        let below = round.iter().rposition(|v| *v <= low.max(1e-9) * (1.0 + 1e-9)).unwrap_or(0);
        let above = round.iter().position(|v| *v >= high * (1.0 - 1e-9));
        let above = above.unwrap_or(round.len() - 1).clamp(1, round.len() - 1).max(below + 1);
        let below = below.min(above - 1);
        let ticks = round[below..=above].iter().map(|&value| {
            let digits = (-value.log10() - 1e-9).ceil().max(0.0) as usize;
            (value, format!("{value:.digits$}"))
        });
        let low = round[below];
        let high = round[above];
        let ticks = ticks.collect();
        Self { name: named(quantity, unit), low, high, scale: Scale::Log, ticks }
    }

    /// The wavelength axis of all figures: 380 to 730 nm, extended if `grid` reaches further, with
    /// a tick every `every_nm`.
    #[must_use]
    pub fn wavelength(grid: Grid, every_nm: u32) -> Self {
        let low = 10.0 * (grid.start_nm().min(380.0) / 10.0).floor();
        let high = 10.0 * (grid.end_nm().max(730.0) / 10.0).ceil();
        let every = f64::from(every_nm);
        let ticks = ((low / every).ceil() as i64..=(high / every).floor() as i64)
            .map(|i| (i as f64 * every, format!("{}", i as f64 * every)));
        let ticks = ticks.collect();
        Self { name: named("Wavelength", "nm"), low, high, scale: Scale::Linear, ticks }
    }

    /// An axis of reflectance from 0 to 1, or to `high` rounded up to 0.2 if that is larger.
    #[must_use]
    pub fn reflectance(high: f64, count: usize) -> Self {
        let high = if high <= 1.0 { 1.0 } else { (high * 5.0).ceil() / 5.0 };
        Self::linear("Reflectance", "white = 1", 0.0, high, count)
    }

    /// Position of `value` along the axis, 0 at the low and 1 at the high end. Values beyond an
    /// end are clamped to it.
    #[must_use]
    pub fn place(&self, value: f64) -> f64 {
        let along = |v: f64| match self.scale {
            Scale::Linear => v,
            Scale::Log => v.max(self.low).log10(),
        };
        let low = along(self.low);
        let high = along(self.high);
        ((along(value) - low) / (high - low)).clamp(0.0, 1.0)
    }
}

fn named(quantity: &str, unit: &str) -> String {
    format!("{quantity} ({unit})")
}

/// The smallest of 1, 2 or 5 times a power of ten that is at least `rough`.
fn round_step(rough: f64) -> f64 {
    let power = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    steps.into_iter().find(|step| *step >= rough * (1.0 - 1e-9)).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, label)| label.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(labels(&Axis::linear("x", "1", 0.0, 1.0, 4)), ["0.0", "0.5", "1.0"]);
        assert_eq!(labels(&Axis::linear("x", "1", -0.03, 0.03, 3)), ["-0.02", "0.00", "0.02"]);
        let around = Axis::around("x", "1", 0.0, 20.9, 5);
        assert_eq!((around.low, around.high), (0.0, 25.0));
        assert_eq!(labels(&around), ["0", "5", "10", "15", "20", "25"]);
    }

    #[test]
    fn a_log_axis_spans_whole_decades_and_places_zero_at_its_low_end() {
        let axis = Axis::log("K", "1", 0.0, 70.0, 4);
        assert_eq!((axis.low, axis.high), (0.01, 100.0));
        assert_eq!(labels(&axis), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(axis.place(0.0), 0.0);
        assert!((axis.place(1.0) - 0.5).abs() < 1e-12);
        assert_eq!(axis.place(1e9), 1.0);
    }

    #[test]
    fn a_close_log_axis_ends_at_one_two_or_five() {
        let axis = Axis::log_close("x", "1", 0.19, 20.9);
        assert_eq!(labels(&axis), ["0.1", "0.2", "0.5", "1", "2", "5", "10", "20", "50"]);
        let axis = Axis::log_close("x", "1", 0.0, 0.0);
        assert!(axis.low > 0.0 && axis.high > axis.low, "{axis:?}");
    }

    #[test]
    fn libraries_share_one_wavelength_axis_unless_they_reach_further() {
        let of = |start, count| Axis::wavelength(Grid::from_nm(start, 10.0, count).unwrap(), 100);
        assert_eq!(of(400.0, 31), of(380.0, 36));
        assert_eq!(of(360.0, 48).low, 360.0);
        assert_eq!(labels(&of(400.0, 31)), ["400", "500", "600", "700"]);
    }
}
