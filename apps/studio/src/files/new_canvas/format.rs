//! Formats of paper and canvas by name.
//!
//! Paper: ISO 216 and US Letter (ANSI/ASME Y14.1). French canvases by number, figure, paysage
//! and marine: B. Haaf, "Industriell vorgrundierte Malleinen", Zeitschrift fuer
//! Kunsttechnologie und Konservierung 1 (1987), 7-71, as tabulated in Wikipedia, "French
//! standard sizes for oil paintings".

/// A format with a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Format {
    /// Heading under which it is listed.
    pub(crate) group: &'static str,
    /// Name, without the group.
    pub(crate) name: &'static str,
    /// Longer side in mm.
    pub(crate) long_mm: f64,
    /// Shorter side in mm.
    pub(crate) short_mm: f64,
}

impl Format {
    /// The format of a canvas, upright or across; `None` for an own size.
    #[must_use]
    pub(crate) fn of(width_mm: f64, height_mm: f64) -> Option<&'static Self> {
        let long = width_mm.max(height_mm);
        let short = width_mm.min(height_mm);
        let near = |a: f64, b: f64| (a - b).abs() < 0.05;
        FORMATS.iter().find(|own| near(own.long_mm, long) && near(own.short_mm, short))
    }
}

const fn format(group: &'static str, name: &'static str, long_mm: f64, short_mm: f64) -> Format {
    Format { group, name, long_mm, short_mm }
}

/// Every format; those of one group follow each other.
pub(crate) const FORMATS: [Format; 74] = [
    format("Screen", "192 x 108 mm", 192.0, 108.0),
    format("Paper", "A6", 148.0, 105.0),
    format("Paper", "A5", 210.0, 148.0),
    format("Paper", "A4", 297.0, 210.0),
    format("Paper", "A3", 420.0, 297.0),
    format("Paper", "A2", 594.0, 420.0),
    format("Paper", "US Letter", 279.4, 215.9),
    format("Stretched canvas", "18 x 24 cm", 240.0, 180.0),
    format("Stretched canvas", "20 x 30 cm", 300.0, 200.0),
    format("Stretched canvas", "24 x 30 cm", 300.0, 240.0),
    format("Stretched canvas", "30 x 40 cm", 400.0, 300.0),
    format("Stretched canvas", "40 x 50 cm", 500.0, 400.0),
    format("Stretched canvas", "50 x 70 cm", 700.0, 500.0),
    format("Stretched canvas", "60 x 80 cm", 800.0, 600.0),
    format("French, figure", "0 F", 180.0, 140.0),
    format("French, figure", "1 F", 220.0, 160.0),
    format("French, figure", "2 F", 240.0, 190.0),
    format("French, figure", "3 F", 270.0, 220.0),
    format("French, figure", "4 F", 330.0, 240.0),
    format("French, figure", "5 F", 350.0, 270.0),
    format("French, figure", "6 F", 410.0, 330.0),
    format("French, figure", "8 F", 460.0, 380.0),
    format("French, figure", "10 F", 550.0, 460.0),
    format("French, figure", "12 F", 610.0, 500.0),
    format("French, figure", "15 F", 650.0, 540.0),
    format("French, figure", "20 F", 730.0, 600.0),
    format("French, figure", "25 F", 810.0, 650.0),
    format("French, figure", "30 F", 920.0, 730.0),
    format("French, figure", "40 F", 1000.0, 810.0),
    format("French, figure", "50 F", 1160.0, 890.0),
    format("French, figure", "60 F", 1300.0, 970.0),
    format("French, figure", "80 F", 1460.0, 1140.0),
    format("French, figure", "100 F", 1620.0, 1300.0),
    format("French, figure", "120 F", 1950.0, 1300.0),
    format("French, paysage", "0 P", 180.0, 120.0),
    format("French, paysage", "1 P", 220.0, 140.0),
    format("French, paysage", "2 P", 240.0, 160.0),
    format("French, paysage", "3 P", 270.0, 190.0),
    format("French, paysage", "4 P", 330.0, 220.0),
    format("French, paysage", "5 P", 350.0, 240.0),
    format("French, paysage", "6 P", 410.0, 270.0),
    format("French, paysage", "8 P", 460.0, 330.0),
    format("French, paysage", "10 P", 550.0, 380.0),
    format("French, paysage", "12 P", 610.0, 460.0),
    format("French, paysage", "15 P", 650.0, 500.0),
    format("French, paysage", "20 P", 730.0, 540.0),
    format("French, paysage", "25 P", 810.0, 600.0),
    format("French, paysage", "30 P", 920.0, 650.0),
    format("French, paysage", "40 P", 1000.0, 730.0),
    format("French, paysage", "50 P", 1160.0, 810.0),
    format("French, paysage", "60 P", 1300.0, 890.0),
    format("French, paysage", "80 P", 1460.0, 970.0),
    format("French, paysage", "100 P", 1620.0, 1140.0),
    format("French, paysage", "120 P", 1950.0, 1140.0),
    format("French, marine", "0 M", 180.0, 100.0),
    format("French, marine", "1 M", 220.0, 120.0),
    format("French, marine", "2 M", 240.0, 140.0),
    format("French, marine", "3 M", 270.0, 160.0),
    format("French, marine", "4 M", 330.0, 190.0),
    format("French, marine", "5 M", 350.0, 220.0),
    format("French, marine", "6 M", 410.0, 240.0),
    format("French, marine", "8 M", 460.0, 270.0),
    format("French, marine", "10 M", 550.0, 330.0),
    format("French, marine", "12 M", 610.0, 380.0),
    format("French, marine", "15 M", 650.0, 460.0),
    format("French, marine", "20 M", 730.0, 500.0),
    format("French, marine", "25 M", 810.0, 540.0),
    format("French, marine", "30 M", 920.0, 600.0),
    format("French, marine", "40 M", 1000.0, 650.0),
    format("French, marine", "50 M", 1160.0, 730.0),
    format("French, marine", "60 M", 1300.0, 810.0),
    format("French, marine", "80 M", 1460.0, 890.0),
    format("French, marine", "100 M", 1620.0, 970.0),
    format("French, marine", "120 M", 1950.0, 970.0),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_found_upright_and_across() {
        assert_eq!(Format::of(210.0, 297.0).unwrap().name, "A4");
        assert_eq!(Format::of(297.0, 210.0).unwrap().name, "A4");
        assert_eq!(Format::of(400.0, 300.0).unwrap().name, "30 x 40 cm");
        assert_eq!(Format::of(920.0, 730.0).unwrap().name, "30 F");
        assert_eq!(Format::of(211.0, 297.0), None, "an own size");
    }

    #[test]
    fn each_format_has_its_own_size_and_a_longer_side() {
        for (index, own) in FORMATS.iter().enumerate() {
            assert!(own.long_mm > own.short_mm, "{own:?}");
            assert!(
                !FORMATS[..index]
                    .iter()
                    .any(|other: &Format| (other.group, other.name) == (own.group, own.name)),
                "{} twice",
                own.name
            );
        }
        // The sides of A formats are in the ratio of the square root of 2, rounded to mm.
        for own in FORMATS.iter().filter(|own| own.name.starts_with('A')) {
            assert!((own.long_mm - own.short_mm * 2.0_f64.sqrt()).abs() < 1.0, "{own:?}");
        }
    }
}
