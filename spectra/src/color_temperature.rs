//! The correlated colour temperature of a light.

use crate::color::Xyz;
use crate::grid::Grid;
use crate::illuminant::{Illuminant, Observer};
use crate::interpolate::Interpolation;
use crate::light::black_body;
use crate::viewing::TristimulusWeights;

/// The correlated colour temperature of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorTemperature {
    /// Temperature in K of the black body with the nearest colour, 1000 to 50000.
    pub kelvin: f64,
    /// Distance from that black body in CIE 1960 (u, v): positive is greener, negative pinker.
    pub duv: f64,
}

/// Largest distance at which a colour temperature is defined (CIE 15:2018, section 9.5).
const FARTHEST: f64 = 0.05;

/// Range of the search in reciprocal megakelvin (mired): 50000 to 1000 K.
const MIREDS: (f64, f64) = (20.0, 1000.0);

/// Intervals of the first, coarse search.
const STEPS: usize = 49;

impl ColorTemperature {
    /// The correlated colour temperature of `light`: the temperature of the nearest black body in
    /// CIE 1960 (u, v), for the observer of 1931 (CIE 15:2018, section 9.5). You get `None` if the
    /// nearest black body is farther than 0.05, or outside 1000 to 50000 K.
    ///
    /// ```
    /// let light = spectra::Illuminant::named("A").unwrap();
    /// let temperature = spectra::ColorTemperature::of(&light).unwrap();
    /// assert_eq!(temperature.kelvin.round(), 2856.0);
    /// ```
    #[must_use]
    pub fn of(light: &Illuminant) -> Option<Self> {
        let [u, v] = uv(light);
        let width = (MIREDS.1 - MIREDS.0) / STEPS as f64;
        let at = |step: usize| MIREDS.0 + step as f64 * width;
        let nearest = (0..=STEPS).min_by(|&a, &b| {
            distance_from_body(u, v, at(a)).0.total_cmp(&distance_from_body(u, v, at(b)).0)
        })?;
        let mut low = at(nearest.max(1) - 1);
        let mut high = at((nearest + 1).min(STEPS));
        // Golden-section search: the distance has one minimum between the neighbours.
        let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
        while high - low > 1e-3 {
            let left = high - golden * (high - low);
            let right = low + golden * (high - low);
            if distance_from_body(u, v, left).0 < distance_from_body(u, v, right).0 {
                high = right;
            } else {
                low = left;
            }
        }
        let mired = 0.5 * (low + high);
        let inside = mired - MIREDS.0 > 2e-3 && MIREDS.1 - mired > 2e-3;
        let (distance, above) = distance_from_body(u, v, mired);
        (inside && distance <= FARTHEST)
            .then(|| Self { kelvin: 1e6 / mired, duv: distance.copysign(above) })
    }
}

fn distance_from_body(u: f64, v: f64, mired: f64) -> (f64, f64) {
    let body = black_body(1e6 / mired).expect("the search stays above 500 K");
    let [u_body, v_body] = uv(&body);
    ((u - u_body).hypot(v - v_body), v - v_body)
}

/// CIE 1960 (u, v) of the white point of a light, for the observer of 1931.
fn uv(light: &Illuminant) -> [f64; 2] {
    let weights =
        TristimulusWeights::new(Grid::cie(), light, Observer::Cie1931Deg2, Interpolation::Linear);
    let Xyz { x, y, z } = weights.expect("lines join any grid").white();
    let sum = x + 15.0 * y + 3.0 * z;
    [4.0 * x / sum, 6.0 * y / sum]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::light_from_text;
    use documents::hint::Explain;

    /// Colour temperatures in K from tables T.6.1, T.8.1, T.9.1, T.10 and T.12 of CIE 15:2018.
    const PUBLISHED: &[(&str, f64)] = &[
        ("A", 2856.0),
        ("D65", 6504.0),
        ("FL1", 6430.0),
        ("FL2", 4230.0),
        ("FL3", 3450.0),
        ("FL4", 2940.0),
        ("FL5", 6350.0),
        ("FL6", 4150.0),
        ("FL7", 6500.0),
        ("FL8", 5000.0),
        ("FL9", 4150.0),
        ("FL10", 5000.0),
        ("FL11", 4000.0),
        ("FL12", 3000.0),
        ("FL3.1", 2932.0),
        ("FL3.15", 6509.0),
        ("HP1", 1959.0),
        ("HP5", 4039.0),
        ("LED-B1", 2733.0),
        ("LED-B5", 6598.0),
        ("LED-BH1", 2851.0),
        ("LED-RGB1", 2840.0),
        ("LED-V1", 2724.0),
        ("LED-V2", 4070.0),
    ];

    /// Temperatures in K that sellers name for lamps of viewing booths.
    const SOLD: [(&str, f64); 9] = [
        ("TL83", 3000.0),
        ("TL84", 4000.0),
        ("TL85", 5000.0),
        ("U30", 3000.0),
        ("U40", 4000.0),
        ("U50", 5000.0),
        ("CWF", 4150.0),
        ("WWF", 3000.0),
        ("Inca", 2856.0),
    ];

    #[test]
    fn lamps_of_the_trade_are_taken_for_lights_of_their_temperature() {
        for (lamp, sold) in SOLD {
            let hint = light_from_text(lamp).unwrap_err().hint().unwrap().to_string();
            let name = hint.strip_prefix("did you mean ").unwrap().split('?').next().unwrap();
            let found = ColorTemperature::of(&Illuminant::named(name).unwrap()).unwrap().kelvin;
            assert!((found - sold).abs() < 100.0, "{lamp} as {name}: {found} K for {sold}");
        }
    }

    #[test]
    fn temperatures_agree_with_the_tables_of_the_cie() {
        for &(name, expected) in PUBLISHED {
            let found = ColorTemperature::of(&Illuminant::named(name).unwrap()).unwrap();
            let off = (found.kelvin / expected - 1.0).abs();
            // The CIE rounds FL1 to FL12 to three digits and sums at steps of 5 nm.
            assert!(off < 2e-3, "{name}: {found:?} for {expected}");
        }
    }

    #[test]
    fn a_black_body_has_its_own_temperature_and_lies_on_the_locus() {
        for kelvin in [1001.0, 1800.0, 3200.0, 6500.0, 24000.0, 49000.0] {
            let found = ColorTemperature::of(&black_body(kelvin).unwrap()).unwrap();
            assert!((found.kelvin / kelvin - 1.0).abs() < 1e-4, "{found:?} for {kelvin}");
            assert!(found.duv.abs() < 1e-6, "{found:?}");
        }
        let daylight = ColorTemperature::of(&Illuminant::d65()).unwrap();
        assert!((daylight.duv - 0.0032).abs() < 1e-4, "daylight is greener: {daylight:?}");
        let pink = ColorTemperature::of(&Illuminant::named("LED-V1").unwrap()).unwrap();
        assert!(pink.duv < -1e-3, "{pink:?}");
    }

    #[test]
    fn a_light_far_from_every_black_body_has_no_temperature() {
        let laser =
            Illuminant::from_function(
                "laser",
                |nm| {
                    if (nm - 532.0).abs() < 1.0 { 1.0 } else { 0.0 }
                },
            );
        assert_eq!(ColorTemperature::of(&laser.unwrap()), None);
        for kelvin in [900.0, 80000.0] {
            assert_eq!(ColorTemperature::of(&black_body(kelvin).unwrap()), None, "{kelvin} K");
        }
    }
}
