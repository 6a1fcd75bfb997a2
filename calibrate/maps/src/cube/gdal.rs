//! Metadata of GDAL: in the tag 42112 of a TIFF file (`GDALMetadata`), and in the file `NAME.aux.xml` beside any
//! raster (`PAMDataset`).
//!
//! GDAL passes on what other formats state: the wavelengths of an ENVI header as `wavelength` of each band or as
//! `Band_1` of the whole file, the central wavelength of the domain IMAGERY (RFC 100), scale and offset of a band,
//! and names of quantities.

use std::path::{Path, PathBuf};

use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::error::CubeError;
use super::window::Values;
use spectra::WavelengthList;

/// One entry: its name in lower case, the band from 0 or none for the whole file, and its text.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
struct Item {
    name: String,
    band: Option<usize>,
    text: String,
}

/// Entries of one or several files or pages.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct GdalMetadata {
    items: Vec<Item>,
}

/// Elements that hold an entry. The name of an entry is the attribute `name` or `key`, or else the element.
const ENTRIES: [&str; 8] =
    ["item", "mdi", "description", "scale", "offset", "unittype", "nodatavalue", "categoryname"];

/// Names of entries on the quantity of the values.
const QUANTITIES: [&str; 7] = [
    "data_units",
    "z_plot_titles",
    "unittype",
    "units",
    "description",
    "long_name",
    "standard_name",
];

impl GdalMetadata {
    /// Reads the text of a tag or of a file. Anything that is not XML ends the reading: GDAL itself ignores
    /// metadata that it cannot read.
    pub(crate) fn parse(xml: &str) -> Self {
        let mut reader = Reader::from_str(xml.trim_end_matches('\0'));
        let mut items = Vec::new();
        let mut raster_band = None;
        let mut open: Option<Item> = None;
        while let Ok(event) = reader.read_event() {
            match event {
                Event::Start(tag) if local(&tag) == "pamrasterband" => {
                    let number = attribute(&tag, &["band"]);
                    raster_band = number.and_then(|n| n.parse::<usize>().ok()?.checked_sub(1));
                }
                Event::Start(tag) if ENTRIES.contains(&local(&tag).as_str()) => {
                    let name = attribute(&tag, &["name", "key"]).unwrap_or_else(|| local(&tag));
                    let sample = attribute(&tag, &["sample"]).and_then(|text| text.parse().ok());
                    let band = sample.or(raster_band);
                    open = Some(Item { name: name.to_lowercase(), band, text: String::new() });
                }
                Event::Text(text) => {
                    if let Some(item) = &mut open {
                        item.text += &text.xml10_content();
                    }
                }
                Event::GeneralRef(entity) => {
                    if let (Some(item), Some(text)) =
                        (&mut open, resolve_predefined_entity(&entity))
                    {
                        item.text += text;
                    }
                }
                Event::End(tag) => {
                    let name = tag.local_name().as_ref().to_lowercase();
                    match name == "pamrasterband" {
                        true => raster_band = None,
                        false => items.extend(open.take()),
                    }
                }
                Event::Eof => break,
                _ => {}
            }
        }
        for item in &mut items {
            item.text = item.text.trim().to_owned();
        }
        Self { items }
    }

    /// Reads the file `PATH.aux.xml`, if it is there.
    pub(crate) fn beside(path: &Path) -> Result<Option<(PathBuf, Self)>, CubeError> {
        let mut name = path.as_os_str().to_owned();
        name.push(".aux.xml");
        let place = PathBuf::from(name);
        if !place.is_file() {
            return Ok(None);
        }
        let bytes = documents::file::read(&place)?;
        let found = Self::parse(&String::from_utf8_lossy(&bytes));
        Ok(Some((place, found)))
    }

    /// Adds the entries of a page. Its first band is `band` of the whole file.
    pub(crate) fn add_page(&mut self, page: Self, band: usize) {
        self.items.extend(page.items.into_iter().map(|item| Item {
            // A page of one band may state its wavelength without a number of the sample.
            band: Some(band + item.band.unwrap_or(0)),
            ..item
        }));
    }

    /// Adds the entries of `more`. An entry that is there already stays.
    pub(crate) fn merge(&mut self, more: Self) {
        for item in more.items {
            if !self.items.iter().any(|known| (&known.name, known.band) == (&item.name, item.band))
            {
                self.items.push(item);
            }
        }
    }

    /// Text of an entry of a band.
    fn of_band(&self, names: &[&str], band: usize) -> Option<&str> {
        let mut items = self.items.iter();
        let found =
            items.find(|item| item.band == Some(band) && names.contains(&item.name.as_str()));
        found.map(|item| item.text.as_str())
    }

    /// Text of an entry of the whole file.
    fn of_file(&self, name: &str) -> Option<&str> {
        let mut items = self.items.iter();
        let found = items.find(|item| item.band.is_none() && item.name == name);
        found.map(|item| item.text.as_str())
    }

    /// Numbers of one entry for each of `bands` bands.
    fn numbers(&self, names: &[&str], bands: usize) -> Option<Vec<f64>> {
        (0..bands).map(|band| self.of_band(names, band)?.parse().ok()).collect()
    }

    /// Wavelengths of `bands` bands, or `None` if the metadata name none. The error says what is wrong with
    /// them, but not their place.
    pub(crate) fn wavelengths(&self, bands: usize) -> Result<Option<WavelengthList>, String> {
        let unit_of = |band| {
            let names = ["wavelength_units", "wavelength_unit", "wavelength units"];
            self.of_band(&names, band).or_else(|| self.of_file("wavelength_units"))
        };
        if let Some(micrometres) = self.numbers(&["central_wavelength_um"], bands) {
            return WavelengthList::of(&micrometres, Some("um")).map(Some);
        }
        if let Some(values) = self.numbers(&["wavelength", "wavelengths", "wavelength_nm"], bands) {
            let is_nm = self.of_band(&["wavelength_nm"], 0).is_some();
            return WavelengthList::of(&values, if is_nm { Some("nm") } else { unit_of(0) })
                .map(Some);
        }
        // A list in braces, as in the header of ENVI.
        if let Some(list) = self.of_file("wavelength") {
            let words = list.trim_matches(['{', '}']).split([',', ' ', '\n', '\t']);
            let values: Option<Vec<f64>> =
                words.filter(|word| !word.is_empty()).map(|word| word.parse().ok()).collect();
            if let Some(values) = values.filter(|values| values.len() == bands) {
                return WavelengthList::of(&values, unit_of(0)).map(Some);
            }
        }
        let texts: Vec<Option<(f64, &str)>> = (0..bands)
            .map(|band| {
                let of_file = self.of_file(&format!("band_{}", band + 1));
                of_file.and_then(length).or_else(|| length(self.of_band(&["description"], band)?))
            })
            .collect();
        match texts.iter().flatten().count() {
            0 => Ok(None),
            known if known < bands => {
                Err(format!("name a wavelength for {known} of {bands} bands"))
            }
            _ => {
                let unit = texts.first().copied().flatten().map(|(_, unit)| unit);
                let values: Vec<f64> = texts.iter().flatten().map(|(value, _)| *value).collect();
                WavelengthList::of(&values, unit).map(Some)
            }
        }
    }

    /// How values become reflectance, if the metadata state scale and offset of every band, or the scale
    /// factor of ENVI.
    pub(crate) fn values(&self, bands: usize) -> Option<Values> {
        if let Some(scales) = self.numbers(&["scale"], bands) {
            let offsets = self.numbers(&["offset"], bands).unwrap_or_else(|| vec![0.0; bands]);
            let pairs: Vec<(f64, f64)> = scales.into_iter().zip(offsets).collect();
            let changes = pairs.iter().any(|pair| *pair != (1.0, 0.0));
            let are_finite = pairs.iter().all(|(a, b)| a.is_finite() && b.is_finite() && *a != 0.0);
            if changes && are_finite {
                return Some(Values::Gains(pairs));
            }
        }
        let factor = self.of_file("reflectance_scale_factor")?.parse::<f64>().ok()?;
        (factor.is_finite() && factor > 0.0).then_some(Values::Divided(factor))
    }

    /// Texts on the values, each with the name of its entry.
    pub(crate) fn told(&self) -> Vec<(String, String)> {
        let of_all = self.items.iter().filter(|item| item.band.is_none_or(|band| band == 0));
        let named = of_all.filter(|item| QUANTITIES.contains(&item.name.as_str()));
        named.map(|item| (item.name.clone(), item.text.clone())).collect()
    }
}

/// Local name of an element in lower case.
fn local(tag: &BytesStart<'_>) -> String {
    tag.local_name().as_ref().to_lowercase()
}

fn attribute(tag: &BytesStart<'_>, names: &[&str]) -> Option<String> {
    tag.attributes().filter_map(Result::ok).find_map(|attribute| {
        let key = attribute.key.local_name().as_ref().to_lowercase();
        let value = attribute.value.as_ref().to_owned();
        names.contains(&key.as_str()).then_some(value)
    })
}

/// A length in a text and its unit, e.g. `450.5 Nanometers`, `450nm` or `Band 3 (0.45 um)`.
fn length(text: &str) -> Option<(f64, &str)> {
    const UNITS: [&str; 9] = [
        "nanometers",
        "nanometer",
        "nanometres",
        "nm",
        "micrometers",
        "micrometer",
        "micrometres",
        "microns",
        "um",
    ];
    let words: Vec<&str> = text
        .split([' ', '(', ')', '[', ']', ',', ':', ';', '=', '_'])
        .filter(|w| !w.is_empty())
        .collect();
    let of_words = words.windows(2).find_map(|pair| {
        let value: f64 = pair[0].parse().ok()?;
        UNITS.contains(&pair[1].to_lowercase().as_str()).then_some((value, pair[1]))
    });
    of_words.or_else(|| {
        words.iter().find_map(|word| {
            let end = word.find(|c: char| !(c.is_ascii_digit() || c == '.'))?;
            let (number, unit) = word.split_at(end);
            let value: f64 = number.parse().ok()?;
            UNITS.contains(&unit.to_lowercase().as_str()).then_some((value, unit))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nm(xml: &str, bands: usize) -> Result<Option<Vec<f64>>, String> {
        Ok(GdalMetadata::parse(xml).wavelengths(bands)?.map(|found| found.nm))
    }

    #[test]
    fn wavelengths_are_read_from_every_place_where_gdal_writes_them() {
        for xml in [
            r#"<GDALMetadata><Item name="wavelength" sample="0">450</Item>
               <Item name="wavelength_units" sample="0">Nanometers</Item>
               <Item name="wavelength" sample="1">550.5</Item></GDALMetadata>"#,
            r#"<GDALMetadata>
               <Item name="CENTRAL_WAVELENGTH_UM" sample="0" domain="IMAGERY">0.45</Item>
               <Item name="CENTRAL_WAVELENGTH_UM" sample="1" domain="IMAGERY">0.5505</Item>
               </GDALMetadata>"#,
            r#"<GDALMetadata><Item name="Band_1">450.0 Nanometers</Item>
               <Item name="Band_2">550.5 Nanometers</Item></GDALMetadata>"#,
            r#"<GDALMetadata><Item name="wavelength" domain="ENVI">{450, 550.5}</Item>
               <Item name="wavelength_units" domain="ENVI">Nanometers</Item></GDALMetadata>"#,
            r#"<GDALMetadata><Item name="DESCRIPTION" sample="0" role="description">Band 1 (450 nm)</Item>
               <Item name="DESCRIPTION" sample="1" role="description">Band 2 (550.5 nm)</Item></GDALMetadata>"#,
            r#"<PAMDataset><PAMRasterBand band="1"><Metadata><MDI key="wavelength">0.45</MDI>
               <MDI key="wavelength_units">Micrometers</MDI></Metadata></PAMRasterBand>
               <PAMRasterBand band="2"><Metadata><MDI key="wavelength">0.5505</MDI></Metadata>
               </PAMRasterBand></PAMDataset>"#,
            r#"<PAMDataset><PAMRasterBand band="1"><Description>450nm</Description></PAMRasterBand>
               <PAMRasterBand band="2"><Description>550.5nm</Description></PAMRasterBand></PAMDataset>"#,
        ] {
            let found = nm(xml, 2).unwrap().unwrap_or_default();
            let near = found.iter().zip([450.0, 550.5]).all(|(a, b)| (a - b).abs() < 1e-9);
            assert!(near && found.len() == 2, "{xml}: {found:?}");
        }
    }

    #[test]
    fn other_metadata_name_no_wavelengths_and_a_part_is_told() {
        for xml in [
            "",
            "no XML",
            "<GDALMetadata><Item name=\"AREA_OR_POINT\">Area</Item></GDALMetadata>",
            "<GDALMetadata><Item name=\"DESCRIPTION\" sample=\"0\">Red &amp; blue 4</Item></GDALMetadata>",
            "<GDALMetadata><Item name=\"wavelength\" sample=\"0\">450",
        ] {
            assert_eq!(nm(xml, 2), Ok(None), "{xml}");
        }
        let one = "<GDALMetadata><Item name=\"Band_1\">450 nm</Item></GDALMetadata>";
        assert_eq!(nm(one, 2), Err("name a wavelength for 1 of 2 bands".to_owned()));
        let wrong = "<GDALMetadata><Item name=\"wavelength\" sample=\"0\">99</Item></GDALMetadata>";
        assert!(nm(wrong, 1).unwrap_err().contains("expected 150 to 30000 nm"));
    }

    #[test]
    fn scales_and_quantities_are_read() {
        let xml = r#"<GDALMetadata><Item name="SCALE" sample="0" role="scale">0.0001</Item>
            <Item name="SCALE" sample="1" role="scale">0.0002</Item>
            <Item name="OFFSET" sample="0" role="offset">0</Item>
            <Item name="OFFSET" sample="1" role="offset">0.01</Item>
            <Item name="data_units" domain="ENVI">Reflectance &gt; 0</Item></GDALMetadata>"#;
        let found = GdalMetadata::parse(xml);
        let Some(Values::Gains(gains)) = found.values(2) else { panic!("{found:?}") };
        assert_eq!(gains, [(0.0001, 0.0), (0.0002, 0.01)]);
        assert_eq!(found.told(), [("data_units".to_owned(), "Reflectance > 0".to_owned())]);
        let pam = "<PAMDataset><Metadata domain=\"ENVI\"><MDI key=\"reflectance_scale_factor\">10000</MDI></Metadata></PAMDataset>";
        assert!(matches!(GdalMetadata::parse(pam).values(3), Some(Values::Divided(10_000.0))));
        let none =
            "<PAMDataset><PAMRasterBand band=\"1\"><Scale>1</Scale></PAMRasterBand></PAMDataset>";
        assert!(GdalMetadata::parse(none).values(1).is_none());
    }

    #[test]
    fn pages_of_one_band_follow_each_other() {
        let mut all = GdalMetadata::default();
        for (band, nm) in [450, 550].into_iter().enumerate() {
            let xml = format!("<GDALMetadata><Item name=\"wavelength\">{nm}</Item></GDALMetadata>");
            all.add_page(GdalMetadata::parse(&xml), band);
        }
        let found = all.wavelengths(2).unwrap().unwrap();
        assert_eq!(found.nm, [450.0, 550.0]);
        assert!(found.remark.is_some(), "no unit is stated");
    }
}
