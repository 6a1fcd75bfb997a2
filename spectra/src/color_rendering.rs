//! How lights render colours: the colour rendering index of CIE 13.3-1995, and fidelity and gamut
//! of ANSI/IES TM-30-18, which shares its fidelity index with CIE 224:2017.
//!
//! We compare a light with the black body or daylight of its colour temperature. We compute
//! fidelity in CAM02-UCS, the uniform space of CIECAM02, for the conditions of CIE 224: adapting
//! luminance 100 cd/m2, background 20 %, average surround, full adaptation.

use std::sync::OnceLock;

use documents::hint::Explain;

use crate::color::{Matrix3, Xyz};
use crate::color_temperature::ColorTemperature;
use crate::grid::Grid;
use crate::illuminant;
use crate::illuminant::{Illuminant, IlluminantError, Observer};
use crate::interpolate::{Extrapolation, Interpolation};
use crate::light::{black_body, daylight};
use crate::viewing::TristimulusWeights;

/// Colour temperature in K of the bluest daylight with which we compare a light.
const BLUEST: f64 = 25_000.0;

/// Colour temperature and colour rendering of a light.
///
/// ```
/// use spectra::{ColorRendering, light_from_text};
///
/// let tube = ColorRendering::of(&light_from_text("FL11")?)?;
/// assert_eq!(tube.temperature.kelvin.round(), 4001.0);
/// assert_eq!(tube.index.general.round(), 83.0);
/// assert_eq!(tube.fidelity.fidelity.round(), 80.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ColorRendering {
    /// Correlated colour temperature and distance from the black body.
    pub temperature: ColorTemperature,
    /// Colour rendering indices of CIE 13.3.
    pub index: RenderingIndex,
    /// Fidelity and gamut of TM-30.
    pub fidelity: ColorFidelity,
    /// Doubts about the figures, as messages for the user.
    pub remarks: Vec<String>,
}

/// Lamps measured at this step in nm or coarser are not sampled well enough for colour rendering. Both
/// standards ask for 5 nm or finer.
const COARSE_NM: f64 = 9.5;

impl ColorRendering {
    /// Colour rendering of `light`. If you did not measure the lamp at some wavelengths, the
    /// nearest end value counts there.
    ///
    /// # Errors
    /// [`ColorRenderingError`] if the light has no colour temperature because it is far from every
    /// black body, or if it is bluer than daylight of 25000 K. Both standards compare a lamp with a
    /// white of its temperature.
    pub fn of(light: &Illuminant) -> Result<Self, ColorRenderingError> {
        let temperature = ColorTemperature::of(light)
            .ok_or_else(|| ColorRenderingError::NotWhite(light.name().to_owned()))?;
        let kelvin = temperature.kelvin;
        if kelvin > BLUEST {
            return Err(ColorRenderingError::TooBlue { name: light.name().to_owned(), kelvin });
        }
        Ok(Self {
            temperature,
            index: RenderingIndex::of(light, kelvin)?,
            fidelity: ColorFidelity::of(light, kelvin)?,
            remarks: coarse_steps(light).into_iter().collect(),
        })
    }
}

/// A remark if the lamp was measured at coarse steps. The errors are the largest of the CIE's LEDs and
/// fluorescent lamps, of which we left out every second or fourth value.
fn coarse_steps(light: &Illuminant) -> Option<String> {
    let lamp = light.lamp().filter(|lamp| lamp.step_nm >= COARSE_NM)?;
    let error = match lamp.is_smooth {
        true if lamp.step_nm < 15.0 => "by 0.2",
        true => "by 2",
        false => "by 10 and more",
    };
    Some(format!(
        "{}: Ra and Rf of a lamp measured every {} nm may be off {error}; the standards ask for 5 nm",
        light.name(),
        lamp.step_nm
    ))
}

/// A light that has no colour rendering.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum ColorRenderingError {
    /// The light is coloured.
    #[error(
        "{0} is not a white light: it is farther than 0.05 from every black body in CIE 1960 (u, v)"
    )]
    #[hint("colour rendering compares a lamp with a white of its temperature")]
    NotWhite(String),
    /// There is no daylight that is so blue.
    #[error("{name} has a colour temperature of {kelvin:.0} K, and the reference ends at 25000 K")]
    #[hint("colour rendering compares a lamp with a white of its temperature")]
    TooBlue {
        /// Name of the light.
        name: String,
        /// Correlated colour temperature in K.
        kelvin: f64,
    },
    /// The light or its reference has no power at a wavelength that we need.
    #[error(transparent)]
    Light(#[from] IlluminantError),
}

/// The general index is the mean of this many special indices.
const GENERAL: usize = 8;
/// An index falls by this for one unit of CIE 1964 U*V*W*.
const FALL: f64 = 4.6;
/// Largest distance from the reference in CIE 1960 (u, v) for which the CIE meant this index (CIE
/// 13.3, 5.3).
const FARTHEST: f64 = 5.4e-3;

/// Colour rendering indices of a light (CIE 13.3-1995).
#[derive(Debug, Clone, PartialEq)]
pub struct RenderingIndex {
    /// General colour rendering index Ra, the mean of the first eight special indices, 100 at most.
    pub general: f64,
    /// Special indices R1 to R14: R9 is a strong red, R13 a light skin, R14 a leaf.
    pub special: Vec<f64>,
    /// Distance of the light from its reference in CIE 1960 (u, v).
    pub distance_from_reference: f64,
}

impl RenderingIndex {
    fn of(light: &Illuminant, kelvin: f64) -> Result<Self, IlluminantError> {
        let reference = of_rendering(kelvin)?;
        let samples = samples_of_rendering();
        let weights = [light, &reference].map(|light| {
            let observer = Observer::Cie1931Deg2;
            TristimulusWeights::new(samples.grid, light, observer, Interpolation::Sprague)
                .expect("the samples have many wavelengths")
        });
        let whites = [white_uv(&weights[0]), white_uv(&weights[1])];
        let special: Vec<f64> = samples
            .reflectances
            .iter()
            .map(|reflectance| {
                let [own, wanted] = [weights[0].xyz(reflectance), weights[1].xyz(reflectance)];
                let own = uvw(own, adapted(uv(own), whites), whites[1]);
                let wanted = uvw(wanted, uv(wanted), whites[1]);
                let squares = own.iter().zip(wanted).map(|(own, wanted)| (own - wanted).powi(2));
                100.0 - FALL * squares.sum::<f64>().sqrt()
            })
            .collect();
        let [own, wanted] = whites;
        Ok(Self {
            general: special[..GENERAL].iter().sum::<f64>() / GENERAL as f64,
            special,
            distance_from_reference: (own[0] - wanted[0]).hypot(own[1] - wanted[1]),
        })
    }

    /// Whether the CIE meant the index for this light: it must lie within 0.0054 of its reference.
    #[must_use]
    pub fn is_meant(&self) -> bool {
        self.distance_from_reference <= FARTHEST
    }
}

/// Adapts a chromaticity from the first of two whites to the second by von Kries' law, as in CIE
/// 13.3, section 5.7.
fn adapted(at: [f64; 2], whites: [[f64; 2]; 2]) -> [f64; 2] {
    let [own, reference] = whites;
    let c = adaptation_c(reference) / adaptation_c(own) * adaptation_c(at);
    let d = adaptation_d(reference) / adaptation_d(own) * adaptation_d(at);
    let below = 16.518 + 1.481 * c - d;
    [(10.872 + 0.404 * c - 4.0 * d) / below, 5.52 / below]
}

fn adaptation_d([u, v]: [f64; 2]) -> f64 {
    (1.708 * v + 0.404 - 1.481 * u) / v
}

fn adaptation_c([u, v]: [f64; 2]) -> f64 {
    (4.0 - u - 10.0 * v) / v
}

/// CIE 1964 U*, V*, W* of a colour with luminance factor and chromaticity.
fn uvw(xyz: Xyz, [u, v]: [f64; 2], white: [f64; 2]) -> [f64; 3] {
    let lightness = 25.0 * xyz.y.cbrt() - 17.0;
    [13.0 * lightness * (u - white[0]), 13.0 * lightness * (v - white[1]), lightness]
}

/// The fidelity falls by this for one unit of CAM02-UCS (CIE 224:2017, equation 16).
const FIDELITY_FALL: f64 = 6.73;
const BINS: usize = 16;
/// Band in nm over which TM-30 sums.
const BAND_NM: [f64; 2] = [380.0, 780.0];

/// Fidelity and gamut of a light by 99 samples (ANSI/IES TM-30-18).
#[derive(Debug, Clone, PartialEq)]
pub struct ColorFidelity {
    /// Fidelity index Rf, 0 to 100, as in CIE 224:2017.
    pub fidelity: f64,
    /// Gamut index Rg: 100 where the light shows as much chroma as its reference, more where it shows more.
    pub gamut: f64,
    /// Fidelity of each of the 99 samples, 0 to 100.
    pub samples: Vec<f64>,
    /// Fidelity of the samples in each of 16 bins of hue, from red at 0 degrees on. `None` for an empty bin.
    pub hue_bins: Vec<Option<f64>>,
}

impl ColorFidelity {
    fn of(light: &Illuminant, kelvin: f64) -> Result<Self, IlluminantError> {
        let reference = of_fidelity(kelvin)?;
        let colors = [colors(light)?, colors(&reference)?];
        let [own, wanted] = &colors;
        let differences: Vec<f64> = own
            .iter()
            .zip(wanted)
            .map(|(own, wanted)| {
                let squares =
                    [own.lightness - wanted.lightness, own.a - wanted.a, own.b - wanted.b];
                squares.iter().map(|d| d * d).sum::<f64>().sqrt()
            })
            .collect();
        let mut bins: [Vec<usize>; BINS] = std::array::from_fn(|_| Vec::new());
        for (sample, color) in wanted.iter().enumerate() {
            let bin = (color.hue_deg * BINS as f64 / 360.0) as usize;
            bins[bin.min(BINS - 1)].push(sample);
        }
        let [area, area_wanted] = [own, wanted].map(|colors| {
            let filled = bins.iter().filter(|bin| !bin.is_empty());
            let corners = filled.map(|bin| {
                let a = mean(bin.iter().map(|&at| colors[at].a));
                [a, mean(bin.iter().map(|&at| colors[at].b))]
            });
            polygon_area(&corners.collect::<Vec<[f64; 2]>>())
        });
        Ok(Self {
            fidelity: fidelity(mean(differences.iter().copied())),
            gamut: 100.0 * area / area_wanted,
            samples: differences.iter().copied().map(fidelity).collect(),
            hue_bins: bins
                .iter()
                .map(|bin| {
                    (!bin.is_empty()).then(|| fidelity(mean(bin.iter().map(|&at| differences[at]))))
                })
                .collect(),
        })
    }
}

/// The 99 samples under a light. Only 380 to 780 nm count.
fn colors(light: &Illuminant) -> Result<Vec<UniformColor>, IlluminantError> {
    let [first, last] = BAND_NM;
    let light = Illuminant::from_function(light.name(), |nm| {
        if (first..=last).contains(&nm) { power_at(light, nm) } else { 0.0 }
    })?;
    let samples = samples_of_fidelity();
    let observer = Observer::Cie1964Deg10;
    let weights = TristimulusWeights::new(samples.grid, &light, observer, Interpolation::Sprague)
        .expect("the samples have many wavelengths");
    let adapted = Appearance::under(weights.white());
    Ok(samples.reflectances.iter().map(|sample| adapted.of(weights.xyz(sample))).collect())
}

/// Fidelity of a colour difference in CAM02-UCS (CIE 224:2017, equation 17).
fn fidelity(difference: f64) -> f64 {
    10.0 * ((100.0 - FIDELITY_FALL * difference) / 10.0).exp().ln_1p()
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

fn polygon_area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let crosses = corners.iter().zip(next).map(|([a, b], [c, d])| a * d - b * c);
    crosses.sum::<f64>() / 2.0
}

/// The adaptation transform CAT02 (CIE 159:2004, equation 1).
const CAT02: Matrix3 =
    Matrix3([[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0030, 0.0136, 0.9834]]);
/// Cone responses of Hunt, Pointer and Estevez (CIE 159:2004, equation 11).
const CONES: Matrix3 =
    Matrix3([[0.38971, 0.68898, -0.07868], [-0.22981, 1.18340, 0.04641], [0.0, 0.0, 1.0]]);

/// Adapting luminance in cd/m2.
const ADAPTING: f64 = 100.0;
/// Luminance factor of the background relative to the white.
const BACKGROUND: f64 = 0.2;
/// Impact c of the average surround. The induction factor is 1.
const IMPACT: f64 = 0.69;

/// A light, with an observer who is adapted to it.
#[derive(Debug, Clone)]
struct Appearance {
    /// Matrix from XYZ to the cone responses of the adapted observer.
    cones: Matrix3,
    /// Luminance-level adaptation factor F_L.
    level: f64,
    /// Achromatic response of the white.
    white: f64,
}

/// A colour in CAM02-UCS.
#[derive(Debug, Clone, Copy, PartialEq)]
struct UniformColor {
    lightness: f64,
    a: f64,
    b: f64,
    hue_deg: f64,
}

impl Appearance {
    /// An observer adapted to a white with Y = 100.
    fn under(white: Xyz) -> Self {
        let sharpened = CAT02.apply(white.to_array());
        let scale = Matrix3::diagonal(sharpened.map(|response| white.y / response));
        let k = 1.0 / (5.0 * ADAPTING + 1.0);
        let level = 0.2 * k.powi(4) * 5.0 * ADAPTING
            + 0.1 * (1.0 - k.powi(4)).powi(2) * (5.0 * ADAPTING).cbrt();
        let cones = CONES.after(&CAT02.inverse()).after(&scale).after(&CAT02);
        let mut adapted = Self { cones, level, white: 1.0 };
        adapted.white = achromatic(adapted.responses(white));
        adapted
    }

    fn responses(&self, xyz: Xyz) -> [f64; 3] {
        self.cones.apply(xyz.to_array()).map(|response| {
            let strength = (self.level * response.abs() / 100.0).powf(0.42);
            (400.0 * strength / (strength + 27.13)).copysign(response) + 0.1
        })
    }

    /// Coordinates of a colour in CAM02-UCS (Luo, Cui and Li 2006).
    fn of(&self, xyz: Xyz) -> UniformColor {
        let responses = self.responses(xyz);
        let [red, green, blue] = responses;
        let a = red - 12.0 * green / 11.0 + blue / 11.0;
        let b = (red + green - 2.0 * blue) / 9.0;
        let hue = b.atan2(a);
        let eccentricity = ((hue + 2.0).cos() + 3.8) / 4.0;
        let lightness =
            100.0 * (achromatic(responses) / self.white).powf(IMPACT * (1.48 + BACKGROUND.sqrt()));
        let t = 50_000.0 / 13.0 * induction() * eccentricity * a.hypot(b)
            / (red + green + 21.0 / 20.0 * blue);
        let chroma = t.powf(0.9)
            * (lightness / 100.0).sqrt()
            * (1.64 - 0.29_f64.powf(BACKGROUND)).powf(0.73);
        let colorfulness = (0.0228 * chroma * self.level.powf(0.25)).ln_1p() / 0.0228;
        let degrees = hue.to_degrees();
        UniformColor {
            lightness: 1.7 * lightness / (1.0 + 0.007 * lightness),
            a: colorfulness * hue.cos(),
            b: colorfulness * hue.sin(),
            hue_deg: if degrees < 0.0 { degrees + 360.0 } else { degrees },
        }
    }
}

fn achromatic([red, green, blue]: [f64; 3]) -> f64 {
    (2.0 * red + green + blue / 20.0 - 0.305) * induction()
}

/// Induction factor of background and chroma.
fn induction() -> f64 {
    0.725 * (1.0 / BACKGROUND).powf(0.2)
}

/// Between these colour temperatures in K the reference of TM-30 goes from black body to daylight.
/// The reference of CIE 13.3 changes at the upper one.
const BLEND: [f64; 2] = [4000.0, 5000.0];

/// Reference of CIE 13.3: a black body below 5000 K, daylight from there on.
fn of_rendering(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    if kelvin < BLEND[1] { black_body(kelvin) } else { daylight(kelvin) }
}

/// Reference of TM-30: a black body up to 4000 K, daylight from 5000 K, and between them a mixture
/// of both at equal luminance.
fn of_fidelity(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    let [first, last] = BLEND;
    if kelvin <= first {
        return black_body(kelvin);
    }
    if kelvin >= last {
        return daylight(kelvin);
    }
    let share = (kelvin - first) / (last - first);
    let [body, day] = [black_body(kelvin)?, daylight(kelvin)?];
    let [of_body, of_day] = [luminance(&body), luminance(&day)];
    Illuminant::from_function(&format!("reference of {kelvin} K"), |nm| {
        (1.0 - share) * power_at(&body, nm) / of_body + share * power_at(&day, nm) / of_day
    })
}

fn power_at(light: &Illuminant, nm: f64) -> f64 {
    light.power().at(nm, Interpolation::Linear, Extrapolation::Hold).unwrap_or(0.0)
}

/// Luminance of a light for the observer of 1931, in the light's own unit.
fn luminance(light: &Illuminant) -> f64 {
    let response = Observer::Cie1931Deg2.functions()[1].values();
    light.power().values().iter().zip(response).map(|(power, y)| power * y).sum()
}

/// CIE 1960 (u, v) of a colour.
fn uv(Xyz { x, y, z }: Xyz) -> [f64; 2] {
    let sum = x + 15.0 * y + 3.0 * z;
    [4.0 * x / sum, 6.0 * y / sum]
}

/// White point of `weights` in CIE 1960 (u, v).
fn white_uv(weights: &TristimulusWeights) -> [f64; 2] {
    uv(weights.white())
}

#[derive(Debug)]
struct Samples {
    grid: Grid,
    reflectances: Vec<Vec<f64>>,
}

/// The 14 test colour samples of CIE 13.3, 360 to 830 nm.
fn samples_of_rendering() -> &'static Samples {
    static SAMPLES: OnceLock<Samples> = OnceLock::new();
    SAMPLES.get_or_init(|| read(include_str!("../data/rendering/cie-13.3-samples.csv")))
}

/// The 99 colour evaluation samples of TM-30 and CIE 224, 380 to 780 nm.
fn samples_of_fidelity() -> &'static Samples {
    static SAMPLES: OnceLock<Samples> = OnceLock::new();
    SAMPLES.get_or_init(|| read(include_str!("../data/rendering/cie-224-samples.csv")))
}

fn read(text: &str) -> Samples {
    let columns = illuminant::columns(text);
    let nm = complete(&columns[0]);
    let grid = Grid::from_nm(nm[0], nm[1] - nm[0], nm.len()).expect("shipped wavelengths rise");
    Samples { grid, reflectances: columns[1..].iter().map(complete).collect() }
}

fn complete((_, cells): &(String, Vec<Option<f64>>)) -> Vec<f64> {
    cells.iter().map(|cell| cell.expect("a shipped sample is complete")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{black_body, daylight};
    use crate::spectrum::IrregularSpectrum;

    #[test]
    fn a_reference_renders_perfectly() {
        for light in [black_body(2700.0), black_body(3900.0), daylight(5600.0), daylight(9000.0)] {
            let found = ColorRendering::of(&light.unwrap()).unwrap();
            for value in [found.index.general, found.fidelity.fidelity, found.fidelity.gamut] {
                assert!((value - 100.0).abs() < 0.05, "{found:?}");
            }
            assert!(found.index.is_meant() && found.index.distance_from_reference < 1e-4);
        }
    }

    #[test]
    fn published_general_indices_are_found() {
        // CIE 15:2004, table T.6.2, and CIE 15:2018, table T.12 for the LED lamps.
        for (name, wanted) in [
            ("FL1", 76.0),
            ("FL2", 64.0),
            ("FL4", 51.0),
            ("FL7", 90.0),
            ("FL8", 95.0),
            ("FL11", 83.0),
            ("FL12", 83.0),
        ] {
            let found = ColorRendering::of(&Illuminant::named(name).unwrap()).unwrap();
            assert!((found.index.general - wanted).abs() < 0.6, "{name}: {}", found.index.general);
        }
    }

    #[test]
    fn coloured_and_very_blue_lights_are_refused() {
        let green =
            Illuminant::from_function(
                "green",
                |nm| if (nm - 530.0).abs() < 20.0 { 1.0 } else { 0.0 },
            );
        let refused = ColorRendering::of(&green.unwrap()).unwrap_err();
        assert!(matches!(refused, ColorRenderingError::NotWhite(..)) && refused.hint().is_some());
        let blue = ColorRendering::of(&black_body(40_000.0).unwrap()).unwrap_err();
        assert!(blue.to_string().contains("40000 K"), "{blue}");
    }

    #[test]
    fn a_light_far_from_its_reference_is_marked() {
        // A black body with some green added.
        let body = black_body(4500.0).unwrap();
        let power = body.power().values();
        let far = Illuminant::from_function("far", |nm| {
            power[(nm - 360.0) as usize] + 25.0 * (-((nm - 545.0) / 20.0).powi(2)).exp()
        });
        let found = ColorRendering::of(&far.unwrap()).unwrap();
        assert!(found.temperature.duv > 6e-3 && !found.index.is_meant(), "{found:?}");
    }

    /// A lamp as a file of values every `step` nm holds it.
    fn measured_every(step: f64, lamp: &Illuminant) -> Illuminant {
        let grid = Grid::from_range(380.0, 780.0, step).unwrap();
        let power = lamp.power();
        let linear = |nm| power.at(nm, Interpolation::Linear, Extrapolation::Hold).unwrap();
        let values = grid.wavelengths_nm().map(linear).collect();
        let samples = IrregularSpectrum::new(grid.wavelengths_nm().collect(), values).unwrap();
        Illuminant::from_lamp("lamp", &samples).unwrap()
    }

    #[test]
    fn smooth_lamps_keep_their_figures_at_coarse_steps() {
        // The CIE tabulates LEDs at 5 nm: Sprague's polynomial through their values stands for them.
        let leds = Illuminant::names().filter(|name| name.starts_with("LED"));
        let leds = leds.map(|name| measured_every(5.0, &Illuminant::named(name).unwrap()));
        let bodies = [2000.0, 2856.0, 6500.0].map(|kelvin| black_body(kelvin).unwrap());
        let lamps: Vec<Illuminant> = bodies.into_iter().chain(leds).collect();
        assert_eq!(lamps.len(), 12);
        for (at, lamp) in lamps.iter().enumerate() {
            let exact = ColorRendering::of(lamp).unwrap();
            for (step, most) in [(5.0, 0.02), (10.0, 0.15)] {
                let coarse = measured_every(step, lamp);
                assert!(coarse.lamp().unwrap().is_smooth, "{at} every {step} nm");
                let found = ColorRendering::of(&coarse).unwrap();
                let general = found.index.general - exact.index.general;
                let fidelity = found.fidelity.fidelity - exact.fidelity.fidelity;
                let kelvin = found.temperature.kelvin - exact.temperature.kelvin;
                assert!(general.abs() < most, "{at} every {step} nm: Ra off by {general}");
                assert!(fidelity.abs() < most, "{at} every {step} nm: Rf off by {fidelity}");
                assert!(kelvin.abs() < 2.0, "{at} every {step} nm: off by {kelvin} K");
                assert_eq!(found.remarks.len(), usize::from(step == 10.0), "{:?}", found.remarks);
            }
        }
    }

    #[test]
    fn lamps_with_lines_are_interpolated_linearly() {
        let lined = |name: &&str| name.starts_with("FL") || name.starts_with("HP");
        for name in Illuminant::names().filter(lined) {
            let lamp = Illuminant::named(name).unwrap();
            let found = measured_every(5.0, &lamp);
            assert!(!found.lamp().unwrap().is_smooth, "{name}");
            let linear = |nm| lamp.power().at(nm, Interpolation::Linear, Extrapolation::Hold);
            let between = found.power().at(548.0, Interpolation::Linear, Extrapolation::Hold);
            assert_eq!(between, linear(548.0), "{name}");
        }
        let tube = measured_every(10.0, &Illuminant::named("FL11").unwrap());
        assert!(tube.remarks()[0].contains("linearly"), "{:?}", tube.remarks());
        let remarks = ColorRendering::of(&tube).unwrap().remarks;
        assert!(remarks[0].contains("every 10 nm may be off by 10 and more"), "{remarks:?}");
    }

    #[test]
    fn a_lamp_that_is_rounded_to_two_digits_is_smooth() {
        let body = black_body(2856.0).unwrap();
        let nm: Vec<f64> = (38..=78).map(|ten| 10.0 * f64::from(ten)).collect();
        let rounded = |nm: &f64| body.power().values()[(nm - 360.0) as usize].round();
        let samples = IrregularSpectrum::new(nm.clone(), nm.iter().map(rounded).collect()).unwrap();
        assert!(Illuminant::from_lamp("lamp", &samples).unwrap().lamp().unwrap().is_smooth);
    }

    #[test]
    fn wavelengths_that_are_not_regular_take_a_spline() {
        let nm: Vec<f64> =
            (0..100).map(|at| 380.0 + 4.0 * f64::from(at) + f64::from(at % 2)).collect();
        let peak = |nm: f64| (-((nm - 560.0) / 60.0).powi(2)).exp();
        let values = nm.iter().copied().map(peak).collect();
        let samples = IrregularSpectrum::new(nm, values).unwrap();
        let lamp = Illuminant::from_lamp("lamp", &samples).unwrap();
        assert!(lamp.remarks()[0].contains("cubic spline"), "{:?}", lamp.remarks());
        let found = lamp.power().at(558.0, Interpolation::Linear, Extrapolation::Hold).unwrap();
        assert!((found - peak(558.0)).abs() < 1e-5, "{found}");
    }
}
