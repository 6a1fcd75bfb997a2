//! Pigment libraries: their curves as arrays, and mixtures by the thousand.

use std::path::PathBuf;
use std::sync::Arc;

use calibrate::curves::Curves;
use calibrate::library::AmountKind;
use calibrate::{Backing, FilmOver, PigmentLibrary};
use documents::hint::Fault;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::arrays::{GridNumbers, reflectance, rows};
use crate::failure::{Exception, Raised, RemarkTuple, remarks};
use crate::light::{Light, viewing};
use crate::running::beside;

/// A library of calibrated pigments.
#[pyclass(frozen, module = "impasto._native")]
pub(crate) struct Library(pub(crate) Arc<PigmentLibrary>);

/// A bare ground: one reflectance, or a grid and a spectrum.
#[derive(FromPyObject)]
pub(crate) enum Ground<'py> {
    Even(f64),
    Measured(GridNumbers, PyReadonlyArray1<'py, f64>),
}

impl Ground<'_> {
    pub(crate) fn backing(&self, py: Python<'_>) -> PyResult<Backing> {
        match self {
            Self::Even(value) => Backing::even(*value).raised(py, Exception::Recipe),
            Self::Measured(grid, values) => Ok(Backing::Measured(reflectance(py, *grid, values)?)),
        }
    }
}

#[pymethods]
impl Library {
    /// Reads a library from its JSON file.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let library = py.detach(|| PigmentLibrary::open(path));
        library.map(|library| Self(Arc::new(library))).raised(py, Exception::Reading)
    }

    /// Reads a library from JSON text.
    #[staticmethod]
    fn from_json(py: Python<'_>, name: &str, text: &str) -> PyResult<Self> {
        let library = PigmentLibrary::from_json(name, text);
        library.map(|library| Self(Arc::new(library))).raised(py, Exception::Reading)
    }

    /// Van Gogh's oils, which ship with impasto.
    #[staticmethod]
    fn van_gogh_oils() -> Self {
        Self(Arc::new(PigmentLibrary::van_gogh_oils()))
    }

    /// The library as the JSON text of its file.
    fn to_json(&self) -> String {
        self.0.to_json()
    }

    /// Writes the JSON file, completely or not at all.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| self.0.save(path)).raised(py, Exception::Other)
    }

    /// Names of the pigments, in order.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.0.pigments.iter().map(|pigment| pigment.name.clone()).collect()
    }

    /// Index of the pigment that `name` names.
    fn find(&self, py: Python<'_>, name: &str) -> PyResult<usize> {
        self.0.find(name).map(|id| id.index()).raised(py, Exception::Recipe)
    }

    /// First wavelength, step and count.
    #[getter]
    fn grid(&self) -> GridNumbers {
        let grid = self.0.grid;
        (grid.start_nm(), grid.step_nm(), grid.count())
    }

    /// Wavelengths in nm.
    #[getter]
    fn wavelengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.0.grid.wavelengths_nm().collect())
    }

    /// Values of a curve of every pigment: `absorption`, `scattering`, `absorption_sd` or
    /// `scattering_sd`. An unknown deviation is NaN.
    fn curves<'py>(&self, py: Python<'py>, curve: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let count = self.0.grid.count();
        let values = self.0.pigments.iter().flat_map(|pigment| {
            let values = match curve {
                "absorption" => &pigment.absorption,
                "scattering" => &pigment.scattering,
                "absorption_sd" => &pigment.absorption_sd,
                _ => &pigment.scattering_sd,
            };
            (0..count).map(|index| values.get(index).copied().unwrap_or(f64::NAN))
        });
        let values = values.collect();
        PyArray1::from_vec(py, values).reshape([self.0.pigments.len(), count])
    }

    /// All but the curves, as JSON: title, licence, source, amounts, reference, surface, evidence,
    /// and of each pigment its name, notes and whether its S is known.
    fn about(&self) -> String {
        let library = &*self.0;
        let pigments = library.pigments.iter().map(|p| {
            json!({
                "name": p.name, "colour_index": p.color_index, "identified": p.identified,
                "guessed": p.guessed, "measured_amounts": p.measured_amounts, "notes": p.notes,
            })
        });
        let surface = library.saunderson;
        json!({
            "title": library.title, "licence": library.licence, "source": library.source,
            "amounts": library.amounts, "reference": library.reference,
            "surface": {"k1": surface.k1, "k2": surface.k2},
            "inputs": library.inputs, "evidence": library.evidence,
            "pigments": pigments.collect::<Vec<Value>>(),
        })
        .to_string()
    }

    /// Reflectance of each row of parts: of films that hide, or of `thickness` over `ground`.
    #[pyo3(signature = (parts, thickness=None, ground=None))]
    fn mix<'py>(
        &self,
        py: Python<'py>,
        parts: PyReadonlyArray2<'py, f64>,
        thickness: Option<f64>,
        ground: Option<Ground<'py>>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Vec<RemarkTuple>)> {
        let library = &*self.0;
        let (values, [count, pigments]) = rows(py, &parts)?;
        let film = film(py, library, thickness, ground.as_ref())?;
        let bands = library.grid.count();
        let mut mixed = vec![0.0; count * bands];
        let ids: Vec<_> = library.ids().collect();
        let done = beside(py, || {
            let pairs = mixed.par_chunks_mut(bands).zip(values.par_chunks(pigments)).enumerate();
            pairs.try_for_each(|(row, (mixed, parts))| {
                let recipe = ids.iter().copied().zip(parts.iter().copied());
                let recipe: Vec<_> = recipe.filter(|(_, part)| *part != 0.0).collect();
                let curves = library.mix(&recipe).map_err(|error| (row, error))?;
                mixed.copy_from_slice(&film.reflectance(&curves, library));
                Ok::<(), (usize, calibrate::library::RecipeError)>(())
            })
        });
        done.map_err(|(row, error)| {
            let message = format!("row {row}: {error}");
            Exception::Recipe.with(
                py,
                Fault::Input,
                &message,
                Some("parts are 0 and up, with a sum above 0"),
            )
        })?;
        Ok((PyArray1::from_vec(py, mixed).reshape([count, bands])?, film.remarks))
    }

    /// Colour of one mixture by names, as JSON, with remarks.
    #[pyo3(signature = (parts, light, observer, thickness=None, ground=None))]
    fn color<'py>(
        &self,
        py: Python<'py>,
        parts: Vec<(String, f64)>,
        light: &Light,
        observer: &str,
        thickness: Option<f64>,
        ground: Option<Ground<'py>>,
    ) -> PyResult<(String, Vec<RemarkTuple>)> {
        let viewing = viewing(py, light, observer)?;
        let parts = parts.iter().map(|(name, part)| (name, *part));
        let color = if thickness.is_none() && ground.is_none() {
            self.0.color(parts, &viewing)
        } else {
            let ground = ground.map_or(Ok(Backing::default()), |ground| ground.backing(py))?;
            let film = FilmOver { thickness: thickness.unwrap_or(1.0), ground };
            self.0.film_color(parts, &film, &viewing)
        };
        let color = color.raised(py, Exception::Recipe)?;
        let json = json!({
            "reflectance": color.reflectance.values(),
            "xyz": color.xyz.to_array(), "lab": color.lab.to_array(), "srgb": color.srgb.0,
            "hex": color.hex(), "in_gamut": color.srgb.in_gamut(),
        });
        Ok((json.to_string(), remarks(&color.remarks)))
    }
}

/// A film to mix.
struct Film {
    /// Thickness, and the ground on the library's grid. A film that hides has neither.
    over: Option<(f64, Vec<f64>)>,
    remarks: Vec<RemarkTuple>,
}

impl Film {
    fn reflectance(&self, curves: &Curves, library: &PigmentLibrary) -> Vec<f64> {
        match &self.over {
            None => curves.hiding(library.saunderson),
            Some((thickness, ground)) => curves.film(*thickness, ground, library.film()),
        }
    }
}

fn film(
    py: Python<'_>,
    library: &PigmentLibrary,
    thickness: Option<f64>,
    ground: Option<&Ground<'_>>,
) -> PyResult<Film> {
    let hides = library.amounts == AmountKind::Relative && thickness.is_none() && ground.is_none();
    if hides {
        return Ok(Film { over: None, remarks: Vec::new() });
    }
    let thickness = thickness.unwrap_or(1.0);
    if !(thickness > 0.0 && thickness <= 1e9) {
        let message = format!("a film's thickness is above 0 and up to 1e9, found {thickness}");
        let hint = "leave `thickness` out for a film that hides";
        return Err(Exception::Recipe.with(py, Fault::Setting, &message, Some(hint)));
    }
    let backing = ground.map_or(Ok(Backing::default()), |ground| ground.backing(py))?;
    let (ground, warning) = backing.on_grid(library.grid).raised(py, Exception::Recipe)?;
    Ok(Film { over: Some((thickness, ground)), remarks: remarks(&warning) })
}
