//! The file formats: their names, and detection by content.

use super::text::lines;
use super::{asd, columns, spectral_evolution, svc, uprtek};

/// A file format of measuring instruments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// CGATS.17 and related formats: Argyll .ti3, .sp and .cie, text files of X-Rite and
    /// GretagMacbeth.
    Cgats,
    /// Datacolor QTX: text with sections in square brackets.
    Qtx,
    /// Ocean Optics: SpectraSuite, OceanView, Jaz, binary `.ProcSpec`.
    OceanOptics,
    /// JCAMP-DX, a labelled text format of spectroscopy.
    Jcamp,
    /// Avantes AvaSoft: text, or binary files such as `.ROH`, `.TRM` and `.RFL8`.
    Avantes,
    /// Bruker OPUS data point table.
    Bruker,
    /// Columns of numbers: wavelength and one or more spectra.
    Columns,
    /// CxF3, the Color Exchange Format (XML).
    Cxf,
    /// IES TM-27, spectra of lamps (XML).
    Tm27,
    /// Sekonic SpectroMaster CSV.
    Sekonic,
    /// ASD FieldSpec: binary `.asd`, or the text converted from it.
    Asd,
    /// Spectral Evolution `.sed`.
    SpectralEvolution,
    /// Spectra Vista `.sig`.
    Svc,
    /// UPRtek's light meters and the LI-COR LI-180.
    Uprtek,
    /// Excel workbook `.xlsx`: a table or columns in one of its sheets.
    Workbook,
}

impl Format {
    /// All formats, for lists of choices.
    pub const ALL: [Self; 15] = [
        Self::Cgats,
        Self::Qtx,
        Self::OceanOptics,
        Self::Jcamp,
        Self::Avantes,
        Self::Bruker,
        Self::Columns,
        Self::Cxf,
        Self::Tm27,
        Self::Sekonic,
        Self::Asd,
        Self::SpectralEvolution,
        Self::Svc,
        Self::Uprtek,
        Self::Workbook,
    ];

    /// Short name of the format, as a setting takes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cgats => "cgats",
            Self::Qtx => "qtx",
            Self::OceanOptics => "ocean-optics",
            Self::Jcamp => "jcamp-dx",
            Self::Avantes => "avantes",
            Self::Bruker => "bruker",
            Self::Columns => "columns",
            Self::Cxf => "cxf",
            Self::Tm27 => "tm27",
            Self::Sekonic => "sekonic",
            Self::Asd => "asd",
            Self::SpectralEvolution => "sed",
            Self::Svc => "svc",
            Self::Uprtek => "uprtek",
            Self::Workbook => "xlsx",
        }
    }

    /// Name of the format for people.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Cgats => "CGATS",
            Self::Qtx => "Datacolor QTX",
            Self::OceanOptics => "Ocean Optics",
            Self::Jcamp => "JCAMP-DX",
            Self::Avantes => "Avantes",
            Self::Bruker => "Bruker OPUS",
            Self::Columns => "columns of text",
            Self::Cxf => "CxF3",
            Self::Tm27 => "IES TM-27",
            Self::Sekonic => "Sekonic",
            Self::Asd => "ASD FieldSpec",
            Self::SpectralEvolution => "Spectral Evolution",
            Self::Svc => "Spectra Vista",
            Self::Uprtek => "UPRtek or LI-180",
            Self::Workbook => "Excel workbook",
        }
    }

    /// The format with the given short name, ignoring case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// Detects the format of a text file from its content. Bruker OPUS files contain only numbers
    /// and are recognised by the ending `.dpt` of `file`.
    #[must_use]
    pub fn detect(file: &str, text: &str) -> Option<Self> {
        let start = text.trim_start();
        if start.starts_with('<') {
            let head: String = text.chars().take(4000).collect::<String>().to_lowercase();
            let is = |word: &str| head.contains(word);
            return if is("cxf") {
                Some(Self::Cxf)
            } else {
                (is("iestm27") || is("spectraldistribution")).then_some(Self::Tm27)
            };
        }
        if start.starts_with("##") {
            return Some(Self::Jcamp);
        } else if svc::is_text(text) {
            return Some(Self::Svc);
        } else if asd::is_text(text) {
            return Some(Self::Asd);
        }
        let mut before = "";
        for (_, line) in lines(text) {
            let line = line.trim();
            if line.starts_with("[STANDARD_DATA") || line.starts_with("[BATCH_DATA") {
                return Some(Self::Qtx);
            } else if line.starts_with(">>>>>Begin") {
                return Some(Self::OceanOptics);
            } else if line == "BEGIN_DATA_FORMAT" {
                return Some(Self::Cgats);
            } else if line.starts_with("Spectral Data ") && line.contains("[nm]") {
                return Some(Self::Sekonic);
            } else if before.starts_with("Wave") && line.starts_with("[nm]") {
                return Some(Self::Avantes);
            } else if spectral_evolution::is_heading(before, line) {
                return Some(Self::SpectralEvolution);
            }
            before = line;
        }
        if file.to_ascii_lowercase().ends_with(".dpt") {
            return Some(Self::Bruker);
        }
        if uprtek::is_text(text) {
            return Some(Self::Uprtek);
        }
        columns::is_column_text(text).then_some(Self::Columns)
    }
}
