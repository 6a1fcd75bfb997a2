//! JCAMP-DX: labelled records `##LABEL= value`, one spectrum per block, blocks linked or in
//! sequence.
//!
//! McDonald and Wilks, "JCAMP-DX: a standard form for exchange of infrared spectra in computer
//! readable form", Applied Spectroscopy 42 (1988) 151. We read XYDATA= (X++(Y..Y)) in every packed
//! form, XYPOINTS= (XY..XY), and the pages of NTUPLES.

mod data;

use data::{Field, Scaling, StatedStep, pages, points, runs};

use super::columns::Axis;
use super::decode::{Decimal, lines, required_number};
use super::measured::{InstrumentError, MeasuredSpectrum, Role, Unit, stem};
use super::points::{Duplicates, Ordered, Point, ordered};
use super::quantity::MeasuredQuantity;

/// If all values of a processed spectrum exceed this percentage, they are in fact counts.
const MOST_PERCENT: f64 = 200.0;

pub(super) fn read(file: &str, text: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
    let mut records = Vec::new();
    let mut block = Block::default();
    // Line of the last content, and whether it was ##END=.
    let mut ended = (1, true);
    for (number, line) in lines(text) {
        let line = line.split("$$").next().unwrap_or_default().trim();
        let Some(labelled) = line.strip_prefix("##") else {
            if let Some(field) = block.fields.last_mut().filter(|_| !line.is_empty()) {
                field.lines.push((number, line));
                ended.0 = number;
            }
            continue;
        };
        let (label, value) = labelled.split_once('=').unwrap_or((labelled, ""));
        let label = normalize(label);
        // The labels of a LINK block end where its first inner block begins.
        if label == "TITLE" && !block.fields.is_empty() || label == "END" {
            records.extend(std::mem::take(&mut block).spectra(file)?);
        }
        ended = (number, label == "END");
        if label != "END" {
            block.fields.push(Field { label, lines: vec![(number, value.trim())] });
        }
    }
    if !ended.1 {
        let text = lines(text).nth(ended.0 - 1).map_or("", |(_, line)| line);
        return Err(InstrumentError::line(file, ended.0, "##END=", text));
    }
    let stem = stem(file);
    for record in &mut records {
        if record.name.is_empty() {
            record.name.clone_from(&stem);
        }
    }
    Ok(records)
}

/// Writes a label as the standard compares labels: in upper case, without spaces and `-/_`.
fn normalize(label: &str) -> String {
    let kept = label.chars().filter(|c| !c.is_whitespace() && !"-/_".contains(*c));
    kept.map(|c| c.to_ascii_uppercase()).collect()
}

#[derive(Default)]
struct Block<'a> {
    fields: Vec<Field<'a>>,
}

impl Block<'_> {
    fn field(&self, label: &str) -> Option<(usize, &str)> {
        let field = self.fields.iter().find(|field| field.label == label)?;
        field.lines.first().copied()
    }

    fn number(&self, file: &str, label: &str) -> Result<Option<f64>, InstrumentError> {
        let Some((line, text)) = self.field(label) else { return Ok(None) };
        required_number(file, line, "a number", text, Decimal::Point).map(Some)
    }

    /// The spectra of the block: one, or one for each page of NTUPLES.
    fn spectra(self, file: &str) -> Result<Vec<MeasuredSpectrum>, InstrumentError> {
        if self.field("NTUPLES").is_none() {
            return Ok(self.spectrum(file)?.into_iter().collect());
        }
        let title = self.field("TITLE").map_or("", |(_, title)| title);
        let pages = pages(file, &self.fields)?;
        let several = pages.len() > 1;
        pages
            .into_iter()
            .map(|page| {
                let axis = axis(file, page.line, &page.x_units)?;
                let ordered = in_nm(file, page.points, axis)?;
                let words = format!("{} {}", page.units, page.variable);
                let is_percent =
                    words.contains('%') || words.to_ascii_lowercase().contains("percent");
                let mut details = self.details();
                details.extend(
                    (!page.name.is_empty()).then(|| ("PAGE".to_owned(), page.name.clone())),
                );
                Ok(MeasuredSpectrum {
                    name: if several { format!("{title} {}", page.name) } else { title.to_owned() },
                    quantity: match MeasuredQuantity::of_words(&words) {
                        MeasuredQuantity::Unstated => MeasuredQuantity::of_field(&page.units),
                        stated => stated,
                    },
                    role: Role::Main,
                    unit: if is_percent { Unit::Percent } else { Unit::Unstated },
                    wavelengths_nm: ordered.wavelengths_nm,
                    values: ordered.values,
                    line: page.line,
                    point_lines: ordered.lines,
                    details,
                    remarks: ordered.remarks,
                })
            })
            .collect()
    }

    fn stated_step(&self, file: &str) -> Result<Option<StatedStep>, InstrumentError> {
        let Some(step) = self.number(file, "DELTAX")? else { return Ok(None) };
        let (line, text) = self.field("DELTAX").unwrap_or((1, ""));
        let decimals = text.trim().split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let rounding = 0.5 * 10_f64.powi(-i32::try_from(decimals).unwrap_or(0));
        Ok(Some(StatedStep { line, step, rounding }))
    }

    fn spectrum(&self, file: &str) -> Result<Option<MeasuredSpectrum>, InstrumentError> {
        let Some(data) =
            self.fields.iter().find(|field| ["XYDATA", "XYPOINTS"].contains(&field.label.as_str()))
        else {
            return Ok(None);
        };
        let (line, form) = data.lines[0];
        let scaling = Scaling {
            x: self.number(file, "XFACTOR")?.unwrap_or(1.0),
            y: self.number(file, "YFACTOR")?.unwrap_or(1.0),
            first_x: self.number(file, "FIRSTX")?,
            last_x: self.number(file, "LASTX")?,
            count: self.number(file, "NPOINTS")?,
            stated_step: self.stated_step(file)?,
        };
        let axis = match self.field("XUNITS") {
            None => Axis::Nanometres,
            Some((line, units)) => axis(file, line, units)?,
        };
        let shape: String = form.chars().filter(|c| !c.is_whitespace()).collect();
        let lines = &data.lines[1..];
        let raw = match (data.label.as_str(), shape.to_ascii_uppercase().as_str()) {
            ("XYDATA", "(X++(Y..Y))") => runs(file, lines, &scaling)?,
            (_, "(XY..XY)") => points(file, lines, &scaling)?,
            _ => {
                let expected = "(X++(Y..Y)) or (XY..XY)";
                return Err(InstrumentError::line(file, line, expected, form));
            }
        };
        let found = raw.len();
        if let Some(expected) = scaling.count.filter(|count| *count != found as f64) {
            let line = data.lines[data.lines.len() - 1].0;
            let file = file.to_owned();
            let what = "points (NPOINTS)";
            let expected = expected.max(0.0) as usize;
            return Err(InstrumentError::Count { file, line, what, expected, found });
        }
        if raw.is_empty() {
            return Ok(None);
        }
        let ordered = in_nm(file, raw, axis)?;
        let (line, title) = self.field("TITLE").unwrap_or((line, ""));
        let (quantity, role, unit) = self.kind(title, &ordered.values);
        Ok(Some(MeasuredSpectrum {
            name: title.to_owned(),
            quantity,
            role,
            unit,
            wavelengths_nm: ordered.wavelengths_nm,
            values: ordered.values,
            line,
            point_lines: ordered.lines,
            details: self.details(),
            remarks: ordered.remarks,
        }))
    }

    /// Quantity, role and unit of the block's values.
    fn kind(&self, title: &str, values: &[f64]) -> (MeasuredQuantity, Role, Unit) {
        // SpectraSuite gives dark and reference blocks the unit of the processed block.
        let title = title.to_ascii_uppercase();
        for (end, role) in [("DARK SPECTRUM", Role::Dark), ("REFERENCE SPECTRUM", Role::White)] {
            if title.ends_with(end) {
                return (MeasuredQuantity::Counts, role, Unit::Unstated);
            }
        }
        let units = self.field("YUNITS").map_or("", |(_, units)| units);
        let unit = if units.contains('%') || units.to_ascii_lowercase().contains("percent") {
            Unit::Percent
        } else {
            Unit::Unstated
        };
        // SpectraSuite writes that unit for unprocessed counts too.
        if title.ends_with("PROCESSED SPECTRUM")
            && unit == Unit::Percent
            && values.iter().all(|&value| value > MOST_PERCENT)
        {
            return (MeasuredQuantity::Counts, Role::Main, Unit::Unstated);
        }
        (MeasuredQuantity::of_field(units), Role::Main, unit)
    }

    /// The records that we do not need to read the data.
    fn details(&self) -> Vec<(String, String)> {
        let needed = [
            "TITLE",
            "JCAMPDX",
            "XUNITS",
            "XFACTOR",
            "YFACTOR",
            "FIRSTX",
            "LASTX",
            "FIRSTY",
            "MINX",
            "MAXX",
            "MINY",
            "MAXY",
            "NPOINTS",
            "DELTAX",
            "XYDATA",
            "XYPOINTS",
            "BLOCKID",
            "NTUPLES",
            "VARNAME",
            "SYMBOL",
            "VARTYPE",
            "VARFORM",
            "VARDIM",
            "UNITS",
            "FIRST",
            "LAST",
            "MIN",
            "MAX",
            "FACTOR",
            "PAGE",
            "DATATABLE",
            "ENDNTUPLES",
        ];
        let kept = self.fields.iter().filter(|field| !needed.contains(&field.label.as_str()));
        kept.map(|field| (field.label.clone(), field.lines[0].1.to_owned())).collect()
    }
}

/// Reads the unit of abscissas from `units`, the text in line `line`.
fn axis(file: &str, line: usize, units: &str) -> Result<Axis, InstrumentError> {
    let expected = "NANOMETERS, MICROMETERS or 1/CM";
    Axis::of_words(units).ok_or_else(|| InstrumentError::line(file, line, expected, units))
}

/// Points with abscissas in the unit `axis`, in order of wavelength.
fn in_nm(file: &str, raw: Vec<Point>, axis: Axis) -> Result<Ordered, InstrumentError> {
    let in_nm = raw.into_iter().map(|point| Point { nm: axis.nm(point.nm), ..point });
    ordered(file, in_nm.collect(), Duplicates::Average)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(title: &str, data: &str) -> String {
        format!(
            "##TITLE= {title}\n##JCAMP-DX= 4.24 $$ made up\n##X UNITS= NANOMETERS\n##YUNITS= % REFLECTANCE\n\
             ##XFACTOR= 0.5\n##YFACTOR= 0.1\n##FIRSTX= 400\n##LASTX= 430\n##NPOINTS= 4\n{data}\n##END=\n"
        )
    }

    #[test]
    fn every_packed_form_gives_the_same_values() {
        // Every form encodes 120, 130, 130, 95, in units of a tenth.
        for data in [
            "800 120 130 130 95",
            "800+120+130+130+95",
            "800A20A30A30I5",
            "800A20A30TI5",
            "800A20J0%l5\n860I5 $$ check",
            "800A20J0\n820A30%l5\n860I5",
        ] {
            let text = block("A", &format!("##XYDATA= (X++(Y..Y))\n{data}"));
            let found = read("f", &text).unwrap_or_else(|error| panic!("{data}: {error}"));
            assert_eq!(found[0].wavelengths_nm, [400.0, 410.0, 420.0, 430.0], "{data}");
            assert_eq!(found[0].values, [12.0, 13.0, 13.0, 9.5], "{data}");
            assert_eq!((found[0].unit, found[0].line), (Unit::Percent, 1));
            assert_eq!(found[0].quantity, MeasuredQuantity::Reflectance);
        }
    }

    #[test]
    fn linked_blocks_and_points_are_read() {
        let points = "##XYPOINTS= (XY..XY)\n860, 95; 840 130\n820 130 800,120";
        let text = format!(
            "##TITLE= all\n##DATA TYPE= LINK\n##BLOCKS= 2\n{}{}##END=\n",
            block("A", points),
            block("X: DARK SPECTRUM", points)
        );
        let scope = block("X: PROCESSED SPECTRUM", points);
        let processed = &read("f", &scope).unwrap()[0];
        assert_eq!(processed.quantity, MeasuredQuantity::Reflectance);
        let counts = &read("f", &scope.replace("YFACTOR= 0.1", "YFACTOR= 10")).unwrap()[0];
        assert_eq!((counts.quantity, counts.role), (MeasuredQuantity::Counts, Role::Main));
        let found = read("f", &text).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].name.as_str(), found[0].line), ("A", 4));
        assert_eq!(found[0].values, [12.0, 13.0, 13.0, 9.5]);
        assert_eq!((found[1].quantity, found[1].role), (MeasuredQuantity::Counts, Role::Dark));
    }

    #[test]
    fn the_announced_step_is_checked_and_used() {
        for delta in ["10", "-10", "10.00", "0", "1E1"] {
            assert!(read("f", &stepped(delta)).is_ok(), "{delta}");
        }
        let error = read("f", &stepped("5")).unwrap_err().to_string();
        assert!(
            error.starts_with("f, line 10: expected a DELTAX") && error.contains("10 does"),
            "{error}"
        );
        let alone = stepped("10").replace("##LASTX= 430\n", "");
        assert_eq!(read("f", &alone).unwrap()[0].wavelengths_nm, [400.0, 410.0, 420.0, 430.0]);
        assert!(read("f", &alone.replace("##DELTAX= 10\n", "")).is_err(), "no step at all");
    }

    fn stepped(delta: &str) -> String {
        block("A", &format!("##DELTAX= {delta}\n##XYDATA= (X++(Y..Y))\n800 120 130 130 95"))
    }

    const TUPLES: &str = "##TITLE= Paint\n##JCAMP-DX= 5.01\n##NTUPLES= UV/VIS SPECTRUM\n\
        ##VAR_NAME= WAVELENGTH, REFLECTANCE, PAGE NUMBER\n##SYMBOL= X, Y, N\n\
        ##VAR_TYPE= INDEPENDENT, DEPENDENT, PAGE\n##VAR_DIM= 4, 4, 2\n\
        ##UNITS= NANOMETERS, PERCENT,\n##FIRST= 400, , 1\n##LAST= 430, , 2\n##FACTOR= 0.5, 0.1, 1\n\
        ##PAGE= N=1\n##DATA TABLE= (X++(Y..Y)), XYDATA\n800 120 130\n840 130 95\n\
        ##PAGE= N=2\n##DATA TABLE= (XY..XY), XYPOINTS\n860, 95; 840 130\n820 130 800,120\n\
        ##END NTUPLES= UV/VIS SPECTRUM\n##END=\n";

    #[test]
    fn every_page_of_tuples_is_a_spectrum() {
        let found = read("f", TUPLES).unwrap();
        let names: Vec<&str> = found.iter().map(|record| record.name.as_str()).collect();
        assert_eq!(names, ["Paint N=1", "Paint N=2"]);
        for record in &found {
            assert_eq!(record.wavelengths_nm, [400.0, 410.0, 420.0, 430.0]);
            assert_eq!(record.values, [12.0, 13.0, 13.0, 9.5]);
            assert_eq!(
                (record.quantity, record.unit),
                (MeasuredQuantity::Reflectance, Unit::Percent)
            );
        }
        assert_eq!((found[0].line, found[1].line), (13, 17));
    }

    fn faulty_line(text: &str) -> usize {
        match read("f", text) {
            Err(InstrumentError::Line { line, .. } | InstrumentError::Count { line, .. }) => line,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn faults_of_tuples_name_their_line() {
        for (old, new, at) in [
            ("840 130 95", "840 130", 15),
            ("(X++(Y..Y))", "(Z++(Y..Y))", 13),
            ("NANOMETERS", "SECONDS", 13),
            ("FACTOR= 0.5", "FACTOR= x", 11),
            ("LAST= 430", "LAST= 830", 15),
            ("##SYMBOL= X, Y, N\n", "", 12),
        ] {
            assert_eq!(faulty_line(&TUPLES.replacen(old, new, 1)), at, "{new}");
        }
    }

    #[test]
    fn faults_name_their_line() {
        let good = block("A", "##XYDATA= (X++(Y..Y))\n800A20J0\n820A30%l5\n860I5");
        assert!(read("f", &good).is_ok());
        for (old, new, at) in [
            ("820A30", "820A31", 12),
            ("820A30", "840A30", 12),
            ("820A30", "820A3?", 12),
            ("l5\n860I5", "l5l5\n", 12),
            ("NPOINTS= 4", "NPOINTS= 5", 13),
            ("NANOMETERS", "SECONDS", 3),
            ("XFACTOR= 0.5", "XFACTOR= x", 5),
            ("##END=\n", "", 13),
            ("(X++(Y..Y))", "(XYA)", 10),
        ] {
            assert_eq!(faulty_line(&good.replacen(old, new, 1)), at, "{new}");
        }
    }
}
