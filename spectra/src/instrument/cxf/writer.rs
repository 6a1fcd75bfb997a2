//! Writing reflectances as a CxF3 file.
//!
//! The order of elements, required elements and bounds follow the schema of CxF3-core. A list
//! of values must start at a whole wavelength from 360 to 400 nm and have a whole increment;
//! other grids are written point by point.

use std::fmt::Write;

use quick_xml::escape::escape;

use crate::grid::Grid;
use crate::spectrum::{Reflectance, Spectrum};

/// Statements about a CxF file as a whole.
#[derive(Debug, Clone, Copy)]
pub struct CxfHead<'a> {
    /// The program or person that made the file.
    pub creator: &'a str,
    /// Description of the content.
    pub description: &'a str,
    /// Origin of the reflectances: the geometry of the measurement, or `predicted`.
    pub geometry: &'a str,
    /// Date and time as `2026-01-31T12:00:00Z`. The schema requires one for every object;
    /// `None` writes 1970, so that equal spectra give equal files.
    pub creation_date: Option<&'a str>,
}

/// Writes named reflectances as a CxF3 file, to six decimals.
///
/// Names may contain any character. Characters that XML cannot represent (control characters)
/// become U+FFFD. White space around a name is lost on reading.
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
    let whole = |nm: f64| (nm.fract() == 0.0 && nm <= 1000.0).then_some(nm as u32);
    let start = whole(grid.start_nm()).filter(|start| (360..=400).contains(start))?;
    Some((start, whole(grid.step_nm())?))
}

/// Escapes text for an element or an attribute. Characters that would be read back as a space
/// are written by number.
fn escaped(text: &str) -> String {
    let text: String = text
        .chars()
        .map(|c: char| match c {
            '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'.. => c,
            _ => '\u{fffd}',
        })
        .collect();
    escape(text).replace('\n', "&#10;").replace('\t', "&#9;")
}

#[cfg(test)]
mod tests {
    use super::super::reader::read;
    use super::*;
    use crate::instrument::{MeasuredQuantity, Unit};

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
