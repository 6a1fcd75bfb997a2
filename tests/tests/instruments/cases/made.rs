//! Files that the cases are made of: known curves, written in the layouts of many instruments and
//! people.

use std::fmt::Write as _;

use super::super::readings::workbook;

/// Reflectance of spectrum `number` of every made file, as a fraction.
pub(super) fn curve(number: usize, nm: f64) -> f64 {
    0.3 + 0.2 * (nm / 90.0).sin() + 0.1 * number as f64
}

/// The characters of a file of text, or a workbook.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Written {
    Commas,
    /// With decimal commas, as in Europe.
    Semicolons,
    Tabs,
    Sheet,
}

impl Written {
    fn extension(self) -> &'static str {
        match self {
            Self::Commas | Self::Semicolons => "csv",
            Self::Tabs => "txt",
            Self::Sheet => "xlsx",
        }
    }

    fn bytes(self, rows: &[Vec<String>]) -> Vec<u8> {
        let separator = match self {
            Self::Commas | Self::Sheet => ",",
            Self::Semicolons => ";",
            Self::Tabs => "\t",
        };
        let lines = rows.iter().map(|row| row.join(separator) + "\n");
        match self {
            Self::Sheet => workbook(&lines.collect::<String>(), 1),
            _ => lines.collect::<String>().into_bytes(),
        }
    }

    fn number(self, value: f64) -> String {
        let text = format!("{value:.5}");
        if self == Self::Semicolons { text.replace('.', ",") } else { text }
    }
}

/// The wavelengths of a made file, in the unit in which they are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// 380 to 730 nm in steps of 10 nm.
    Visible,
    /// 190 to 800 nm in steps of 10 nm, as spectrometers with a deuterium lamp write.
    FromUltraviolet,
    /// 400 to 2600 nm in steps of 20 nm.
    ToInfrared,
    /// 380 to 730 nm, written in micrometres.
    Micrometres,
    /// 730 to 380 nm: falling.
    Falling,
    /// 28,000 to 13,000 in 1/cm, which are 357 to 769 nm.
    Wavenumbers,
}

impl Axis {
    /// Wavelengths in nm in the order of the file, with the text of each.
    fn points(self) -> Vec<(f64, String)> {
        let steps = |start: usize, end: usize, step: usize| (start..=end).step_by(step);
        let nm = |nm: usize| (nm as f64, nm.to_string());
        match self {
            Self::Visible => steps(380, 730, 10).map(nm).collect(),
            Self::FromUltraviolet => steps(190, 800, 10).map(nm).collect(),
            Self::ToInfrared => steps(400, 2600, 20).map(nm).collect(),
            Self::Falling => (38_usize..74).rev().map(|tens| nm(10 * tens)).collect(),
            Self::Micrometres => {
                steps(380, 730, 10).map(|nm| (nm as f64, format!("0.{nm}"))).collect()
            }
            Self::Wavenumbers => steps(13_000, 28_000, 200)
                .map(|per_cm| (1e7 / per_cm as f64, per_cm.to_string()))
                .collect(),
        }
    }
}

/// A table of spectra before it is written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Table {
    /// Whether wavelengths run down and each spectrum is a column.
    down: bool,
    /// Headings before the spectra or wavelengths, separated by `|`. With `=` the cells below are stated,
    /// for spectra in rows.
    head: &'static str,
    /// Names of the spectra, separated by `|`.
    names: &'static str,
    axis: Axis,
    /// The value of a perfect white.
    white: f64,
    /// Lines above the table.
    above: &'static str,
    /// Texts before and after the wavelength in its heading, e.g. `R` and ` nm`.
    around: (&'static str, &'static str),
    /// Factor on the last spectrum, for example of a black patch.
    last: f64,
}

/// Wavelengths down the first column, a column for each of `names`.
pub(super) const fn down(head: &'static str, names: &'static str) -> Table {
    Table {
        down: true,
        head,
        names,
        axis: Axis::Visible,
        white: 100.0,
        above: "",
        around: ("", ""),
        last: 1.0,
    }
}

/// A row for each of `names`, and a column for each wavelength.
pub(super) const fn across(head: &'static str, names: &'static str) -> Table {
    Table { down: false, ..down(head, names) }
}

impl Table {
    pub(super) const fn on(self, axis: Axis) -> Self {
        Self { axis, ..self }
    }

    pub(super) const fn fractions(self) -> Self {
        Self { white: 1.0, ..self }
    }

    /// Fractions under a heading in percent: the heading counts, and a remark says so.
    pub(super) const fn as_nearly_black(self) -> Self {
        self.last_times(0.01)
    }

    pub(super) const fn below(self, above: &'static str) -> Self {
        Self { above, ..self }
    }

    pub(super) const fn around(self, before: &'static str, after: &'static str) -> Self {
        Self { around: (before, after), ..self }
    }

    pub(super) const fn last_times(self, last: f64) -> Self {
        Self { last, ..self }
    }

    fn value(&self, number: usize, nm: f64) -> f64 {
        let is_last = number + 1 == self.names.split('|').count();
        curve(number, nm) * if is_last { self.last } else { 1.0 }
    }

    /// Name and content of the file.
    pub(super) fn file(&self, written: Written) -> (String, Vec<u8>) {
        let mut rows: Vec<Vec<String>> =
            self.above.lines().map(|line| vec![line.to_owned()]).collect();
        let names: Vec<&str> = self.names.split('|').collect();
        let points = self.axis.points();
        let decimal = |text: &str| {
            if written == Written::Semicolons { text.replace('.', ",") } else { text.to_owned() }
        };
        if self.down {
            if !self.head.is_empty() {
                let names = names.iter().map(|name| (*name).to_owned());
                rows.push(std::iter::once(self.head.to_owned()).chain(names).collect());
            }
            for (nm, text) in &points {
                let values = (0..names.len())
                    .map(|number| written.number(self.value(number, *nm) * self.white));
                rows.push(std::iter::once(decimal(text)).chain(values).collect());
            }
        } else {
            let head: Vec<(&str, Option<&str>)> = self
                .head
                .split('|')
                .map(|column| column.split_once('=').map_or((column, None), |(a, b)| (a, Some(b))))
                .collect();
            let (before, after) = self.around;
            let wavelengths =
                points.iter().map(|(_, text)| format!("{before}{}{after}", decimal(text)));
            rows.push(
                head.iter().map(|(heading, _)| (*heading).to_owned()).chain(wavelengths).collect(),
            );
            for (number, name) in names.iter().enumerate() {
                let cells = head.iter().map(|(_, cell)| decimal(cell.unwrap_or(name)));
                let values = points
                    .iter()
                    .map(|(nm, _)| written.number(self.value(number, *nm) * self.white));
                rows.push(cells.chain(values).collect());
            }
        }
        (format!("made.{}", written.extension()), written.bytes(&rows))
    }

    /// The expected reflectances at `nm`, in the order of the names.
    pub(super) fn expected(&self, nm: f64) -> Vec<f64> {
        (0..self.names.split('|').count()).map(|number| self.value(number, nm)).collect()
    }

    pub(super) fn is_at(&self, nm: f64) -> bool {
        self.axis.points().iter().any(|(point, _)| (point - nm).abs() < 0.01)
    }
}

/// A JCAMP-DX file of curve 0 with these YUNITS, in fractions or percent of `white`.
pub(super) fn jcamp(yunits: &str, white: f64) -> Vec<u8> {
    let points = Axis::Visible.points();
    let mut text = format!(
        "##TITLE= Made\n##JCAMP-DX= 4.24\n##DATA TYPE= UV-VIS SPECTRUM\n##XUNITS= NANOMETERS\n\
         ##YUNITS= {yunits}\n##FIRSTX= 380\n##LASTX= 730\n##NPOINTS= {}\n##XYPOINTS= (XY..XY)\n",
        points.len()
    );
    for (nm, _) in points {
        writeln!(text, "{nm}, {:.5}", curve(0, nm) * white).unwrap();
    }
    text += "##END=\n";
    text.into_bytes()
}

/// A CGATS file of the named patches, with this heading of each wavelength. The last patch is `last` times its curve.
pub(super) fn cgats(heading: &str, names: &[&str], white: f64, last: f64) -> Vec<u8> {
    let points = Axis::Visible.points();
    let fields: Vec<String> = points.iter().map(|(_, nm)| format!("{heading}{nm}")).collect();
    let mut text = format!(
        "CGATS.17\nNUMBER_OF_FIELDS {}\nBEGIN_DATA_FORMAT\nSAMPLE_NAME {}\nEND_DATA_FORMAT\n\
         NUMBER_OF_SETS {}\nBEGIN_DATA\n",
        fields.len() + 1,
        fields.join(" "),
        names.len()
    );
    for (number, name) in names.iter().enumerate() {
        let factor = white * if number + 1 == names.len() { last } else { 1.0 };
        let values: Vec<String> =
            points.iter().map(|(nm, _)| format!("{:.5}", curve(number, *nm) * factor)).collect();
        writeln!(text, "\"{name}\" {}", values.join(" ")).unwrap();
    }
    text += "END_DATA\n";
    text.into_bytes()
}
