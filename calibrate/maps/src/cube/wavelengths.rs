//! Wavelengths of the bands of a file in nm, whatever unit the file uses.

/// Shortest wavelength of a reflectance scan, in nm.
const SHORTEST_NM: f64 = 150.0;
/// Longest wavelength of a reflectance scan, in nm.
const LONGEST_NM: f64 = 30_000.0;

/// Wavelengths in nm, and how the unit was found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Wavelengths {
    /// One wavelength a band, in the order of the file.
    pub(crate) nm: Vec<f64>,
    /// Factor from the file's unit to nm.
    pub(crate) factor: f64,
    /// Remark if we judged the unit by the range.
    pub(crate) remark: Option<String>,
}

/// Factor from the unit `name` to nm. You get `Ok(None)` if the name is not a unit.
fn factor(name: &str) -> Result<Option<f64>, String> {
    let plain = name.trim().trim_matches(['"', '{', '}']).trim().to_lowercase();
    match plain.as_str() {
        "" | "unknown" | "none" | "wavelength" => Ok(None),
        "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => Ok(Some(1.0)),
        // Micro signs, and a micro sign of Latin-1 read as UTF-8.
        "um" | "\u{b5}m" | "\u{3bc}m" | "\u{fffd}m" | "micrometer" | "micrometers"
        | "micrometre" | "micrometres" | "micron" | "microns" => Ok(Some(1000.0)),
        "mm" | "millimeter" | "millimeters" => Ok(Some(1e6)),
        "cm" | "centimeter" | "centimeters" => Ok(Some(1e7)),
        "m" | "meter" | "meters" => Ok(Some(1e9)),
        "angstrom" | "angstroms" => Ok(Some(0.1)),
        _ => Err(format!("has the unit `{}`, which is not a length", name.trim())),
    }
}

impl Wavelengths {
    /// Converts `values` with the unit `unit`. If you pass no unit, we take values from 0.15 to 30
    /// for micrometres and values from 150 to 30,000 for nm.
    ///
    /// The error says what is wrong with the list, but not its name.
    pub(crate) fn of(values: &[f64], unit: Option<&str>) -> Result<Self, String> {
        let told = unit.map(factor).transpose()?.flatten();
        if let Some(at) = values.iter().position(|value| !(value.is_finite() && *value > 0.0)) {
            return Err(format!(
                "has `{}` as number {}, which is not a wavelength",
                values[at],
                at + 1
            ));
        }
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        let inside = |factor: f64| least * factor >= SHORTEST_NM && most * factor <= LONGEST_NM;
        let judged = [(1.0, "nm"), (1000.0, "micrometres")].into_iter().find(|it| inside(it.0));
        let (factor, remark) = match (told, judged) {
            (Some(factor), _) if inside(factor) => (factor, None),
            (Some(_), Some((_, better))) => {
                let unit = unit.unwrap_or_default().trim();
                return Err(format!(
                    "runs from `{least}` to `{most}`, which are not {unit}: these look like {better}"
                ));
            }
            (None, Some((factor, name))) => {
                let remark =
                    format!("wavelengths have no unit: {least} to {most} are taken for {name}");
                (factor, Some(remark))
            }
            (_, None) => {
                return Err(format!(
                    "runs from `{least}` to `{most}`, expected {SHORTEST_NM} to {LONGEST_NM} nm"
                ));
            }
        };
        let nm: Vec<f64> = values.iter().map(|value| value * factor).collect();
        let mut order: Vec<usize> = (0..nm.len()).collect();
        order.sort_by(|&a, &b| nm[a].total_cmp(&nm[b]));
        if let Some(pair) = order.windows(2).find(|pair| nm[pair[0]] >= nm[pair[1]]) {
            let a = pair[0].min(pair[1]) + 1;
            let b = pair[0].max(pair[1]) + 1;
            return Err(format!("has `{}` twice, as numbers {a} and {b}", values[pair[0]]));
        }
        Ok(Self { nm, factor, remark })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nm(values: &[f64], unit: Option<&str>) -> Result<Vec<f64>, String> {
        Wavelengths::of(values, unit).map(|found| found.nm)
    }

    #[test]
    fn units_by_name_give_nm() {
        for unit in ["nm", "Nanometers", " nanometre "] {
            assert_eq!(nm(&[400.0, 700.5], Some(unit)), Ok(vec![400.0, 700.5]), "{unit}");
        }
        for unit in ["um", "Micrometers", "\u{b5}m", "\u{fffd}m", "microns"] {
            assert_eq!(nm(&[0.5, 2.5], Some(unit)), Ok(vec![500.0, 2500.0]), "{unit}");
        }
        assert_eq!(nm(&[4000.0], Some("Angstroms")), Ok(vec![400.0]));
        let error = nm(&[1.0, 2.0], Some("Index")).unwrap_err();
        assert_eq!(error, "has the unit `Index`, which is not a length");
        assert!(nm(&[20_000.0], Some("Wavenumber")).is_err(), "a wavenumber is not a wavelength");
    }

    #[test]
    fn a_missing_unit_is_judged_by_the_range_and_told() {
        let found = Wavelengths::of(&[400.0, 1000.0], None).unwrap();
        assert_eq!(found.nm, [400.0, 1000.0]);
        let remark = found.remark.unwrap();
        assert_eq!(remark, "wavelengths have no unit: 400 to 1000 are taken for nm");
        let found = Wavelengths::of(&[0.4, 1.0], Some("Unknown")).unwrap();
        assert_eq!((found.nm, found.factor), (vec![400.0, 1000.0], 1000.0));
        assert!(found.remark.unwrap().ends_with("are taken for micrometres"));
        assert!(nm(&[1.0, 31.0], None).is_err(), "numbers of bands are not wavelengths");
    }

    #[test]
    fn a_wrong_unit_is_refused_with_the_better_one() {
        let error = nm(&[400.0, 700.0], Some("Micrometers")).unwrap_err();
        assert!(error.ends_with("are not Micrometers: these look like nm"), "{error}");
        let error = nm(&[0.4, 0.7], Some("nm")).unwrap_err();
        assert!(error.ends_with("are not nm: these look like micrometres"), "{error}");
    }

    #[test]
    fn lists_that_are_no_wavelengths_are_refused() {
        assert!(nm(&[400.0, f64::NAN], None).unwrap_err().contains("number 2"));
        assert!(nm(&[-400.0], None).unwrap_err().contains("`-400`"));
        let error = nm(&[410.0, 400.0, 410.0], Some("nm")).unwrap_err();
        assert_eq!(error, "has `410` twice, as numbers 1 and 3");
    }
}
