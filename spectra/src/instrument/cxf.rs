//! CxF3, the Color Exchange Format (ISO 17972-1:2015, namespace "CxF3-core").
//!
//! The objects of a collection contain spectra. Each spectrum refers to a colour specification with
//! the increment of the wavelengths, the geometry and the device. Reflectance and transmittance are
//! fractions, white near 1. We skip objects that hold colours only.
//!
//! When we write a file, the elements, their order and their bounds follow the schema of CxF3-core.
//! A list of values must start at a whole wavelength from 360 to 400 nm and have a whole increment.
//! We write other grids point by point.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use quick_xml::escape::escape;

use super::decode::{Decimal, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit};
use super::points::{Duplicates, Point, ordered, sorted};
use super::quantity::MeasuredQuantity;
use super::xml::{Element, parse};
use crate::grid::Grid;
use crate::spectrum::{Reflectance, Spectrum};

/// If a file has a reflectance of this or more, it is in percent, because the schema keeps
/// fractions below 3.
const MOST_FRACTION: f64 = 3.0;

/// We average values at one wavelength if they differ by at most this fraction of full scale
/// (chosen by eye).
const MOST_APART: f64 = 0.1;

const NM: &str = "a wavelength in nm";

const NUMBER: &str = "a number";

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let root = parse(file, text)?;
    // CxF 1 and 2 hold samples and no resources.
    let is_older = root.name.eq_ignore_ascii_case("cxf") && root.child("Resources").is_none();
    if is_older && (root.name != "CxF" || root.child("SampleSet").is_some()) {
        return Err(InstrumentError::NotRead {
            file: file.to_owned(),
            kind: "a Color Exchange Format file older than CxF3",
            way: "export it as CxF3 or CGATS",
        });
    }
    if root.name != "CxF" {
        return Err(InstrumentError::line(file, root.line, "a CxF element", &root.name));
    }
    let specifications = specifications(&root);
    let mut found = Vec::new();
    for object in descendants(&root, ["Resources", "ObjectCollection", "Object"]) {
        for element in object.all("ColorValues").flat_map(|values| &values.children) {
            if let Some(quantity) = quantity(&element.name) {
                found.push(spectrum(file, object, element, quantity, &specifications)?);
            }
        }
    }
    make_names_unique(&mut found);
    let mut records: Vec<MeasuredSpectrum> = found.into_iter().map(|found| found.record).collect();

    // Some writers use percent. One value of 3 or more shows that all fractions of the file are
    // percent.
    let mut fractions = records.iter().filter(|record| record.unit == Unit::Fraction);
    if fractions.any(|record| record.values.iter().any(|&value| value >= MOST_FRACTION)) {
        for record in records.iter_mut().filter(|record| record.unit == Unit::Fraction) {
            record.unit = Unit::Percent;
        }
    }
    Ok(records)
}

/// A spectrum with the specification and the illumination under which it was measured.
struct Found {
    record: MeasuredSpectrum,
    specification: String,
    /// Illumination condition, `M0` to `M3` (ISO 13655), if the file states it.
    condition: Option<String>,
}

fn spectrum(
    file: &str,
    object: &Element,
    element: &Element,
    stated: MeasuredQuantity,
    specifications: &BTreeMap<&str, &Element>,
) -> Result<Found, InstrumentError> {
    let id = element.attribute("ColorSpecification").unwrap_or_default();
    let measurement = specifications.get(id).and_then(|it| it.child("MeasurementSpec"));
    let name = [object.attribute("Name"), object.attribute("Id")];
    let name = name.into_iter().flatten().map(str::trim).find(|name| !name.is_empty());
    let name = name.map_or_else(|| format!("line {}", object.line), str::to_owned);
    let quantity = match measurement.and_then(|it| it.child("MeasurementType")) {
        Some(kind) if element.name == "CustomSpectrum" => custom_quantity(kind.text.trim()),
        _ => stated,
    };
    let points = if element.name == "CustomSpectrum" {
        irregular(file, element)?
    } else {
        regular(file, element, id, measurement.and_then(|it| it.child("WavelengthRange")))?
    };
    if points.is_empty() {
        return Err(InstrumentError::line(file, element.line, "a value", &element.name));
    }
    let unit = match quantity {
        MeasuredQuantity::Reflectance | MeasuredQuantity::Transmittance => Unit::Fraction,
        _ => Unit::Unstated,
    };
    let duplicates = if element.name == "CustomSpectrum" {
        let white = if unit == Unit::Fraction { 1.0 } else { 0.0 };
        let largest = points.iter().map(|point| point.value.abs()).fold(white, f64::max);
        Duplicates::AverageWithin(MOST_APART * largest)
    } else {
        Duplicates::Refuse
    };
    let (points, order) = sorted(points);
    let ordered = ordered(file, points, duplicates)?;
    let mut details = Vec::new();
    for (key, holder) in [("ObjectType", object), ("Id", object), ("ColorSpecification", element)] {
        details.extend(holder.attribute(key).map(|value| (key.to_owned(), value.to_owned())));
    }
    for key in ["CreationDate", "Comment"] {
        details.extend(object.child(key).map(|child| (key.to_owned(), child.text.trim().into())));
    }
    let measured = measurement.map_or_else(Vec::new, |it| it.leaves());
    let condition = measured.iter().find(|(key, _)| key == "DeviceIllumination");
    let condition = condition
        .map(|(_, value)| value.split('_').next().unwrap_or_default().to_owned())
        .filter(|it| matches!(it.as_str(), "M0" | "M1" | "M2" | "M3"));
    details.extend(measured);
    let record = MeasuredSpectrum {
        name,
        quantity,
        role: Role::Main,
        unit,
        wavelengths_nm: ordered.wavelengths_nm,
        values: ordered.values,
        line: object.line,
        point_lines: Vec::new(),
        details,
        remarks: order.into_iter().chain(ordered.remarks).collect(),
    };
    Ok(Found { record, specification: id.to_owned(), condition })
}

/// Values at a constant increment, separated by white space.
fn regular(
    file: &str,
    element: &Element,
    id: &str,
    range: Option<&Element>,
) -> Result<Vec<Point>, InstrumentError> {
    let missing = |what| InstrumentError::Incomplete {
        file: file.to_owned(),
        line: element.line,
        element: element.name.clone(),
        missing: what,
        specification: id.to_owned(),
    };
    let increment = range.and_then(|range| Some((range.attribute("Increment")?, range.line)));
    let start = element.attribute("StartWL").map(|start| (start, element.line));
    let start =
        start.or_else(|| range.and_then(|range| Some((range.attribute("StartWL")?, range.line))));
    let (start, line) = start.ok_or_else(|| missing("StartWL"))?;
    let start = number(file, line, NM, start)?;
    let (increment, line) = increment.ok_or_else(|| missing("Increment"))?;
    let increment = number(file, line, NM, increment)?;
    let mut points = Vec::new();
    for (offset, text) in element.text.lines().enumerate() {
        let line = element.line + offset;
        for token in text.split_ascii_whitespace() {
            let nm = start + increment * points.len() as f64;
            points.push(Point { nm, value: number(file, line, NUMBER, token)?, line });
        }
    }
    Ok(points)
}

fn number(
    file: &str,
    line: usize,
    expected: &'static str,
    text: &str,
) -> Result<f64, InstrumentError> {
    required_number(file, line, expected, text, Decimal::Point)
}

/// Values with a wavelength for each.
fn irregular(file: &str, element: &Element) -> Result<Vec<Point>, InstrumentError> {
    element
        .all("SpectralPoint")
        .map(|child| {
            let nm = number(file, child.line, NM, child.attribute("WL").unwrap_or_default())?;
            let value = number(file, child.line, NUMBER, &child.text)?;
            Ok(Point { nm, value, line: child.line })
        })
        .collect()
}

/// Makes names unique where one object has spectra under several specifications, e.g. M0 and M1 or
/// several angles. These are not repeated readings.
fn make_names_unique(found: &mut [Found]) {
    let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (index, found) in found.iter().enumerate() {
        groups.entry(found.record.name.clone()).or_default().push(index);
    }
    for group in groups.values() {
        let ids: BTreeSet<&str> = group.iter().map(|&i| found[i].specification.as_str()).collect();
        if ids.len() < 2 {
            continue;
        }
        let conditions: BTreeSet<&str> =
            group.iter().filter_map(|&i| found[i].condition.as_deref()).collect();
        let by_condition = conditions.len() == ids.len();
        for &index in group {
            let it = &mut found[index];
            let label = match &it.condition {
                Some(condition) if by_condition => condition,
                _ => &it.specification,
            };
            it.record.name = format!("{} ({label})", it.record.name);
        }
    }
}

fn quantity(element: &str) -> Option<MeasuredQuantity> {
    match element {
        "ReflectanceSpectrum" => Some(MeasuredQuantity::Reflectance),
        "TransmittanceSpectrum" => Some(MeasuredQuantity::Transmittance),
        "EmissiveSpectrum" => Some(MeasuredQuantity::Power),
        "CustomSpectrum" => Some(MeasuredQuantity::Unstated),
        _ => None,
    }
}

/// The quantity that the specification states for a spectrum with its own wavelengths.
fn custom_quantity(measurement_type: &str) -> MeasuredQuantity {
    match measurement_type {
        "Spectrum_Reflectance" => MeasuredQuantity::Reflectance,
        "Spectrum_Transmittance" | "Spectrum_TotalTransmittance" => MeasuredQuantity::Transmittance,
        "Spectrum_Emissive" => MeasuredQuantity::Power,
        _ => MeasuredQuantity::Unstated,
    }
}

fn specifications(root: &Element) -> BTreeMap<&str, &Element> {
    let path = ["Resources", "ColorSpecificationCollection", "ColorSpecification"];
    descendants(root, path).into_iter().filter_map(|it| Some((it.attribute("Id")?, it))).collect()
}

/// The descendants of `root` along a path of three element names.
fn descendants<'a>(root: &'a Element, path: [&'a str; 3]) -> Vec<&'a Element> {
    let mut found = vec![root];
    for name in path {
        found = found.into_iter().flat_map(|element| element.all(name)).collect();
    }
    found
}

/// Statements about a CxF file as a whole.
#[derive(Debug, Clone, Copy)]
pub struct CxfHead<'a> {
    /// The program or person that made the file.
    pub creator: &'a str,
    /// Description of the content.
    pub description: &'a str,
    /// Origin of the reflectances: the geometry of the measurement, or `predicted`.
    pub geometry: &'a str,
    /// Date and time as `2026-01-31T12:00:00Z`. The schema requires one for every object. With
    /// `None` we write 1970, so that equal spectra give equal files.
    pub creation_date: Option<&'a str>,
}

/// Writes named reflectances as a CxF3 file, to six decimals.
///
/// Names may contain any character. A control character, which XML cannot represent, becomes
/// U+FFFD. If you read the file again, white space around a name is lost.
#[must_use]
pub fn write_cxf(head: &CxfHead<'_>, spectra: &[(&str, &Spectrum<Reflectance>)]) -> String {
    let date = escaped(head.creation_date.unwrap_or("1970-01-01T00:00:00Z"));
    let mut grids: Vec<Grid> = Vec::new();
    let mut objects = String::new();
    for (number, (name, spectrum)) in (1..).zip(spectra) {
        let grid = spectrum.grid();
        let known = grids.iter().position(|&other| other == grid);
        let specification = 1 + known.unwrap_or_else(|| {
            grids.push(grid);
            grids.len() - 1
        });
        let _ = write!(
            objects,
            "      <Object ObjectType=\"Standard\" Name=\"{}\" Id=\"object{number}\">\n        \
             <CreationDate>{date}</CreationDate>\n        <ColorValues>\n{}        </ColorValues>\n      \
             </Object>\n",
            escaped(name),
            values(spectrum, specification)
        );
    }
    let specifications: String = (1..)
        .zip(&grids)
        .map(|(number, &grid)| specification(number, grid, &escaped(head.geometry)))
        .collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <CxF xmlns=\"http://colorexchangeformat.com/CxF3-core\">\n  <FileInformation>\n    \
         <Creator>{}</Creator>\n    <CreationDate>{date}</CreationDate>\n    \
         <Description>{}</Description>\n  </FileInformation>\n  <Resources>\n    \
         <ObjectCollection>\n{objects}    </ObjectCollection>\n    \
         <ColorSpecificationCollection>\n{specifications}    </ColorSpecificationCollection>\n  \
         </Resources>\n</CxF>\n",
        escaped(head.creator),
        escaped(head.description)
    )
}

fn values(spectrum: &Spectrum<Reflectance>, specification: usize) -> String {
    let grid = spectrum.grid();
    let id = format!("ColorSpecification=\"specification{specification}\"");
    if let Some((start, _)) = whole_start_and_step(grid) {
        let values: Vec<_> = spectrum.values().iter().map(|value| format!("{value:.6}")).collect();
        let values = values.join(" ");
        return format!(
            "          <ReflectanceSpectrum StartWL=\"{start}\" {id}>{values}</ReflectanceSpectrum>\n"
        );
    }
    let mut text = format!("          <CustomSpectrum {id}>\n");
    for (nm, value) in grid.wavelengths_nm().zip(spectrum.values()) {
        let _ = writeln!(text, "            <SpectralPoint WL=\"{nm}\">{value:.6}</SpectralPoint>");
    }
    text + "          </CustomSpectrum>\n"
}

fn specification(number: usize, grid: Grid, geometry: &str) -> String {
    let range = whole_start_and_step(grid).map_or_else(String::new, |(start, step)| {
        format!("          <WavelengthRange StartWL=\"{start}\" Increment=\"{step}\"/>\n")
    });
    // The schema requires at least one character.
    let geometry = if geometry.is_empty() { "unknown" } else { geometry };
    format!(
        "      <ColorSpecification Id=\"specification{number}\">\n        <MeasurementSpec>\n          \
         <MeasurementType>Spectrum_Reflectance</MeasurementType>\n          <GeometryChoice>\n            \
         <UnknownGeometry>{geometry}</UnknownGeometry>\n          </GeometryChoice>\n{range}        \
         </MeasurementSpec>\n      </ColorSpecification>\n"
    )
}

/// Start and step in whole nm, if the schema can express them.
fn whole_start_and_step(grid: Grid) -> Option<(u32, u32)> {
    let start = whole_nm(grid.start_nm()).filter(|start| (360..=400).contains(start))?;
    Some((start, whole_nm(grid.step_nm())?))
}

fn whole_nm(nm: f64) -> Option<u32> {
    (nm.fract() == 0.0 && nm <= 1000.0).then_some(nm as u32)
}

/// Escapes text for an element or an attribute. This writes characters by number if a reader would
/// turn them into a space.
fn escaped(text: &str) -> String {
    let text: String = text
        .chars()
        .map(|c| match c {
            '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'.. => c,
            _ => '\u{fffd}',
        })
        .collect();
    escape(text).replace('\n', "&#10;").replace('\t', "&#9;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instrument::{MeasuredQuantity, Unit};

    /// A CxF file with `objects` and the specifications `s` (steps of 10 nm), `m0` and `m1` (steps
    /// of 100 nm).
    fn file(objects: &str) -> String {
        format!(
            "<c:CxF xmlns:c='http://colorexchangeformat.com/CxF3-core'><c:Resources>\
             <c:ObjectCollection>\n{objects}\n</c:ObjectCollection>\
             <c:ColorSpecificationCollection><c:ColorSpecification Id='s'><c:MeasurementSpec>\
             <c:MeasurementType>Spectrum_Reflectance</c:MeasurementType>\
             <c:WavelengthRange StartWL='380' Increment='10'/>\
             </c:MeasurementSpec></c:ColorSpecification>{}{}\
             </c:ColorSpecificationCollection></c:Resources></c:CxF>",
            illuminated("m0", "M0_Incandescent"),
            illuminated("m1", "M1_Daylight")
        )
    }

    fn illuminated(id: &str, condition: &str) -> String {
        format!(
            "<c:ColorSpecification Id='{id}'><c:MeasurementSpec>\
                 <c:WavelengthRange StartWL='400' Increment='100'/><c:Device>\
                 <c:DeviceIllumination>{condition}</c:DeviceIllumination></c:Device>\
                 </c:MeasurementSpec></c:ColorSpecification>"
        )
    }

    fn object(name: &str, values: &str) -> String {
        format!("<c:Object Name='{name}' Id='1'><c:ColorValues>{values}</c:ColorValues></c:Object>")
    }

    fn reflectance(specification: &str, values: &str) -> String {
        let key = "ColorSpecification";
        format!("<c:ReflectanceSpectrum {key}='{specification}'>{values}</c:ReflectanceSpectrum>")
    }

    #[test]
    fn a_spectrum_takes_its_increment_from_the_specification() {
        let text = file(&object("a &amp; b", &reflectance("s", "0.1 2e-1\n0.3")));
        let records = read("f", &text).unwrap();
        assert_eq!(records.len(), 1);
        assert_eq!(records[0].name, "a & b");
        assert_eq!(records[0].wavelengths_nm, [380.0, 390.0, 400.0]);
        assert_eq!(records[0].values, [0.1, 0.2, 0.3]);
        assert_eq!((records[0].unit, records[0].line), (Unit::Fraction, 2));
        let kind = ("MeasurementType".to_owned(), "Spectrum_Reflectance".to_owned());
        assert!(records[0].details.contains(&kind), "{:?}", records[0].details);
    }

    #[test]
    fn a_start_of_its_own_and_own_wavelengths_are_read() {
        let own =
            "<c:ReflectanceSpectrum StartWL='360' ColorSpecification='s'>1</c:ReflectanceSpectrum>";
        let points = "<c:CustomSpectrum ColorSpecification='s'><c:SpectralPoint WL='500.5'>0.5\
                      </c:SpectralPoint><c:SpectralPoint WL='400'>0.4</c:SpectralPoint>\
                      </c:CustomSpectrum>";
        let records = read("f", &file(&(object("x", own) + &object("y", points)))).unwrap();
        assert_eq!(records[0].wavelengths_nm, [360.0]);
        assert_eq!(records[1].wavelengths_nm, [400.0, 500.5]);
        assert_eq!(records[1].values, [0.4, 0.5]);
        assert_eq!(records[1].quantity, MeasuredQuantity::Reflectance);
    }

    #[test]
    fn values_at_a_repeated_custom_wavelength_are_averaged_unless_far_apart() {
        let [near, far] = [0.28, 0.31].map(|second| {
            let points = point(400.0, 0.1) + &point(500.0, 0.2) + "\n" + &point(500.0, second);
            let spec = "<c:CustomSpectrum ColorSpecification='s'>";
            read("f", &file(&object("a", &format!("{spec}{points}</c:CustomSpectrum>"))))
        });
        let found = &near.unwrap()[0];
        assert!((found.values[1] - 0.24).abs() < 1e-12 && found.values.len() == 2, "{found:?}");
        assert!(found.remarks[0].contains("averaged"), "{found:?}");
        let error = far.unwrap_err().to_string();
        assert!(error.starts_with("f, line 3: 500 nm occurs more than once"), "{error}");
    }

    fn point(nm: f64, value: f64) -> String {
        format!("<c:SpectralPoint WL='{nm}'>{value}</c:SpectralPoint>")
    }

    #[test]
    fn conditions_get_different_names_and_repeats_do_not() {
        let both = reflectance("m0", "0.1 0.2") + &reflectance("m1", "0.3 0.4");
        let twice = reflectance("s", "0.1") + &reflectance("s", "0.2");
        let mixed = reflectance("s", "0.1") + &reflectance("m1", "0.2");
        let text = file(&(object("a", &both) + &object("b", &twice) + &object("c", &mixed)));
        let names: Vec<_> = read("f", &text).unwrap().into_iter().map(|r| r.name).collect();
        assert_eq!(names, ["a (M0)", "a (M1)", "b", "b", "c (s)", "c (m1)"]);
    }

    #[test]
    fn percent_in_one_spectrum_holds_for_the_whole_file() {
        let text =
            file(&(object("a", &reflectance("s", "80")) + &object("b", &reflectance("s", "2"))));
        let units: Vec<_> = read("f", &text).unwrap().into_iter().map(|r| r.unit).collect();
        assert_eq!(units, [Unit::Percent, Unit::Percent]);
    }

    #[test]
    fn files_older_than_cxf3_are_refused_by_name() {
        for text in ["<CXF><SampleSet/></CXF>", "<CxF><SampleSet/></CxF>"] {
            let error = read("f.cxf", text).unwrap_err();
            assert!(matches!(error, InstrumentError::NotRead { .. }), "{error}");
            assert!(error.to_string().contains("older than CxF3"), "{error}");
        }
    }

    #[test]
    fn faults_have_a_place() {
        let lab = object("a", "<c:ColorCIELab ColorSpecification='s'><c:L>5</c:L></c:ColorCIELab>");
        for (objects, expected) in [
            (
                object("a", &reflectance("s", "0.1\n0.2 x")),
                "f, line 3: expected a number, found `x`",
            ),
            (object("a", &reflectance("s", "NaN")), "f, line 2: expected a number, found `NaN`"),
            (object("a", &reflectance("s", " ")), "f, line 2: expected a value"),
            (
                object("a", &reflectance("none", "1")),
                "f, line 2: ReflectanceSpectrum has no StartWL, and neither has the specification `none`",
            ),
        ] {
            let error = read("f", &file(&objects)).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
        assert_eq!(read("f", &file(&lab)).unwrap(), [], "colours only");
        let error = read("f", "<svg/>").unwrap_err().to_string();
        assert_eq!(error, "f, line 1: expected a CxF element, found `svg`");
    }

    const HEAD: CxfHead<'_> = CxfHead {
        creator: "us & them",
        description: "two paints",
        geometry: "",
        creation_date: None,
    };

    fn spectrum(start_nm: f64, step_nm: f64, values: &[f64]) -> Spectrum<Reflectance> {
        let grid = Grid::from_nm(start_nm, step_nm, values.len()).unwrap();
        Spectrum::new(grid, values.to_vec()).unwrap()
    }

    #[test]
    fn reading_returns_what_was_written() {
        let white = spectrum(380.0, 10.0, &[0.25, 0.5, 1.0]);
        let fine = spectrum(402.5, 2.5, &[0.125, 0.75]);
        let name = "<\"blue\" & 'green'>\n\u{1f3a8}\u{1}";
        let text = write_cxf(&HEAD, &[(name, &white), ("fine", &fine)]);
        let records = read("f", &text).unwrap();
        assert_eq!(records[0].name, "<\"blue\" & 'green'>\n\u{1f3a8}\u{fffd}");
        assert_eq!(records[0].wavelengths_nm, [380.0, 390.0, 400.0]);
        assert_eq!(records[0].values, [0.25, 0.5, 1.0]);
        assert_eq!(records[1].wavelengths_nm, [402.5, 405.0]);
        assert_eq!(records[1].values, [0.125, 0.75]);
        for record in &records {
            let kind = (record.quantity, record.unit);
            assert_eq!(kind, (MeasuredQuantity::Reflectance, Unit::Fraction));
        }
    }

    #[test]
    fn elements_follow_the_order_of_the_schema() {
        let white = spectrum(400.0, 20.0, &[1.0]);
        let text = write_cxf(&HEAD, &[("white", &white), ("again", &white)]);
        let order = [
            "<FileInformation>",
            "<Creator>us &amp; them</Creator>",
            "<CreationDate>1970-01-01T00:00:00Z</CreationDate>",
            "<Resources>",
            "<ObjectCollection>",
            "<CreationDate>",
            "<ColorValues>",
            "StartWL=\"400\" ColorSpecification=\"specification1\">1.000000<",
            "Id=\"object2\"",
            "<ColorSpecificationCollection>",
            "<MeasurementType>",
            "<UnknownGeometry>unknown<",
            "<WavelengthRange StartWL=\"400\" Increment=\"20\"/>",
        ];
        let mut at = 0;
        for word in order {
            let found = text[at..].find(word);
            at += found.unwrap_or_else(|| panic!("{word} is not after place {at} of {text}"));
        }
        assert_eq!(text.matches("<ColorSpecification ").count(), 1);
    }
}
