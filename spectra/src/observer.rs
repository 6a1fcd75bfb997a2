//! The standard observers of the CIE.

use std::sync::OnceLock;

use crate::grid::Grid;
use crate::spectrum::{Response, Spectrum};
use crate::table;
use documents::hint::{Explain, Fault};

/// A set of colour-matching functions at 1 nm.
///
/// Outside the tabulated band the functions are 0. Sources and licences: `data/SOURCES.md`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Observer {
    /// CIE 1931, 2 degrees (ISO/CIE 11664-1).
    #[default]
    Cie1931Deg2,
    /// CIE 1964, 10 degrees (ISO/CIE 11664-1).
    Cie1964Deg10,
    /// CIE 2015, cone-fundamental-based, 2 degrees (CIE 170-2:2015).
    Cie2015Deg2,
    /// CIE 2015, cone-fundamental-based, 10 degrees (CIE 170-2:2015).
    Cie2015Deg10,
}

impl Observer {
    /// All observers, by year and field of view.
    pub const ALL: [Self; 4] =
        [Self::Cie1931Deg2, Self::Cie1964Deg10, Self::Cie2015Deg2, Self::Cie2015Deg10];

    /// Name of the observer in files and settings.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cie1931Deg2 => "1931-2",
            Self::Cie1964Deg10 => "1964-10",
            Self::Cie2015Deg2 => "2015-2",
            Self::Cie2015Deg10 => "2015-10",
        }
    }

    /// The observer with the given name. `2` and `10` are the observers of 1931 and 1964.
    ///
    /// # Errors
    /// [`ObserverError`], whose message lists the names.
    pub fn named(name: &str) -> Result<Self, ObserverError> {
        match name {
            "2" => Ok(Self::Cie1931Deg2),
            "10" => Ok(Self::Cie1964Deg10),
            _ => Self::ALL
                .into_iter()
                .find(|observer| observer.name() == name)
                .ok_or_else(|| ObserverError { name: name.to_owned() }),
        }
    }

    /// The colour-matching functions x, y and z (with a bar) on [`Grid::cie`].
    #[must_use]
    pub fn functions(self) -> &'static [Spectrum<Response>; 3] {
        static TABLES: [OnceLock<[Spectrum<Response>; 3]>; 4] = [const { OnceLock::new() }; 4];
        TABLES[self as usize].get_or_init(|| self.read_table())
    }

    fn read_table(self) -> [Spectrum<Response>; 3] {
        let columns = table::columns(match self {
            Self::Cie1931Deg2 => include_str!("../data/observers/cie-1931-2.csv"),
            Self::Cie1964Deg10 => include_str!("../data/observers/cie-1964-10.csv"),
            Self::Cie2015Deg2 => include_str!("../data/observers/cie-2015-2.csv"),
            Self::Cie2015Deg10 => include_str!("../data/observers/cie-2015-10.csv"),
        });
        ["x", "y", "z"].map(|name| {
            let (nm, tabulated) =
                table::filled(&columns, name).expect("a shipped observer has x, y and z");
            let grid = Grid::cie();
            let mut values = vec![0.0; grid.count()];
            for (nm, value) in nm.iter().zip(tabulated) {
                // The tables are given at whole nanometres inside this band.
                values[(nm - grid.start_nm()) as usize] = value;
            }
            Spectrum::new(grid, values).expect("a shipped observer is finite")
        })
    }
}

impl std::fmt::Display for Observer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// An unknown name of an observer.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("observers are 1931-2 (or 2), 1964-10 (or 10), 2015-2 and 2015-10, found `{name}`")]
pub struct ObserverError {
    /// The name that was given.
    pub name: String,
}

impl Explain for ObserverError {
    fn fault(&self) -> Fault {
        Fault::Setting
    }
}
