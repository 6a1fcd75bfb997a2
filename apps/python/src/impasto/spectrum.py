"""Reflectances over wavelength: one spectrum or many, from arrays, pandas or colour-science."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from impasto.display import swatch, table
from impasto.errors import Error

if TYPE_CHECKING:
    import colour
    import pandas as pd

Floats = NDArray[np.float64]
"""Arrays of 64-bit floats."""


class Spectrum:
    """One or more reflectances on a regular grid of wavelengths.

    `values` has shape (L,) for one spectrum, (M, L) for several; fractions from 0 to 1, the mirror
    reflection of the surface included as it was measured. Arrays are read-only.
    """

    def __init__(
        self, wavelengths: ArrayLike, values: ArrayLike, names: Sequence[str] = ()
    ) -> None:
        nm = floats(wavelengths, "wavelengths", (1,))
        grid_of(nm)
        self.wavelengths = frozen(nm)
        self.values = frozen(floats(values, "values", (1, 2)))
        if self.values.shape[-1] != nm.size:
            raise Error(
                f"values has shape {self.values.shape}, but there are {nm.size} wavelengths",
                "the last axis is wavelength",
            )
        count = 1 if self.values.ndim == 1 else len(self.values)
        # An Index of pandas or an array has no truth value.
        self.names = tuple(str(name) for name in _listed(names))
        if self.names and len(self.names) != count:
            raise Error(f"{len(self.names)} names for {count} spectra", "give one name a spectrum")

    @property
    def grid(self) -> tuple[float, float, int]:
        """First wavelength and step in nm, and the number of wavelengths."""
        return grid_of(self.wavelengths)

    @property
    def rows(self) -> Floats:
        """The values as (M, L), also of one spectrum."""
        return np.atleast_2d(self.values)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, key: str | int) -> Spectrum:
        """One of several spectra, by name or place."""
        if isinstance(key, str):
            if key not in self.names:
                known = ", ".join(self.names[:20]) or "the spectra have none"
                raise Error(f"no spectrum is named `{key}`", f"names: {known}")
            key = self.names.index(key)
        names = (self.names[key],) if self.names else ()
        return Spectrum(self.wavelengths, self.rows[key], names)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self.values, dtype=dtype, copy=bool(copy) or dtype is not None)

    def __repr__(self) -> str:
        first, step, count = self.grid
        many = "1 spectrum" if len(self) == 1 else f"{len(self)} spectra"
        return f"<impasto.Spectrum: {many}, {first:g} to {first + step * (count - 1):g} nm in {step:g} nm>"

    def _repr_html_(self) -> str:
        from impasto import color

        rows = color.display(self)
        names = self.names or tuple(str(index) for index in range(len(self)))
        return table(["", "name", "sRGB"], [[swatch(c), n, c] for n, c in zip(names, rows)][:200])

    def to_colour(self) -> colour.SpectralDistribution | colour.MultiSpectralDistributions:
        """The spectrum as colour-science's `SpectralDistribution`, several as `MultiSpectralDistributions`."""
        import colour

        if len(self) == 0:
            raise Error("colour-science has no distributions of no spectrum")
        if self.values.ndim == 1:
            name = self.names[0] if self.names else "impasto"
            return colour.SpectralDistribution(
                dict(zip(self.wavelengths.tolist(), self.values.tolist())), name=name
            )
        labels = list(self.names) or [str(index) for index in range(len(self))]
        return colour.MultiSpectralDistributions(
            self.values.T, domain=self.wavelengths, labels=labels
        )

    def to_dataframe(self) -> pd.DataFrame:
        """A table with a row a spectrum and a column a wavelength."""
        import pandas as pd

        return pd.DataFrame(self.rows, columns=self.wavelengths, index=list(self.names) or None)


def spectrum(value: Any, wavelengths: ArrayLike | None = None) -> Spectrum:
    """Makes a `Spectrum` of a Spectrum, a DataFrame or Series whose labels are wavelengths, a spectral
    distribution of colour-science, or an array with `wavelengths`."""
    if isinstance(value, Spectrum):
        return value
    kind = type(value).__module__.partition(".")[0]
    if kind == "pandas":
        return _of_pandas(value)
    if hasattr(value, "wavelengths") and hasattr(value, "values"):
        values = np.asarray(value.values)
        names = getattr(value, "labels", None) or [str(getattr(value, "name", ""))]
        return Spectrum(value.wavelengths, values.T if values.ndim == 2 else values, list(names))
    if wavelengths is None:
        raise Error(
            "an array of reflectances needs its wavelengths",
            "give wavelengths=numpy.arange(400, 701, 10), or a Spectrum",
        )
    return Spectrum(wavelengths, value)


def _of_pandas(value: Any) -> Spectrum:
    labels = value.columns if value.ndim == 2 else value.index
    try:
        nm = [float(str(label).strip().removesuffix("nm")) for label in labels]
    except ValueError as error:
        raise Error(f"a label is not a wavelength: {error}", "keep the columns of wavelengths only") from None
    names = [str(name) for name in value.index] if value.ndim == 2 else [str(value.name or "")]
    values = value.to_numpy()
    if values.dtype == object:
        # Columns of several kinds, or with pandas.NA.
        try:
            values = value.to_numpy(dtype=np.float64, na_value=np.nan)
        except (TypeError, ValueError, OverflowError) as error:
            raise Error(f"values cannot be read as numbers: {error}") from None
    return Spectrum(nm, values, names)


def _listed(names: Any) -> list[Any]:
    try:
        return list(names)
    except TypeError as error:
        raise Error(f"names are a list of text: {error}", "give one name a spectrum") from None


def floats(value: ArrayLike, name: str, dimensions: tuple[int, ...]) -> Floats:
    """The array in order of rows, unchanged if it is one already; an error names the argument."""
    try:
        given = np.asarray(value)
        if given.dtype.kind == "c":
            raise TypeError("they are complex")
        array = np.ascontiguousarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise Error(f"{name} cannot be read as numbers: {error}") from None
    if given.ndim not in dimensions:
        wanted = " or ".join(str(n) for n in dimensions)
        raise Error(f"{name} has shape {given.shape}, expected {wanted} dimensions")
    return array


def frozen(array: Floats) -> Floats:
    """A read-only view, or a copy where the caller could still write."""
    kept = array.copy() if array.flags.writeable else array
    kept.flags.writeable = False
    return kept


def grid_of(wavelengths: Floats) -> tuple[float, float, int]:
    """First wavelength, step and count of regular wavelengths."""
    if wavelengths.size < 2 or not np.isfinite(wavelengths).all():
        raise Error("a spectrum has two wavelengths or more, all finite")
    step = (wavelengths[-1] - wavelengths[0]) / (wavelengths.size - 1)
    if not (step > 0 and np.allclose(np.diff(wavelengths), step, rtol=0, atol=1e-6 * abs(step))):
        raise Error(
            "wavelengths must rise in equal steps",
            "resample first, or let impasto.read bring a file to a regular grid",
        )
    return float(wavelengths[0]), float(step), int(wavelengths.size)


def wavelengths_of(grid: tuple[float, float, int]) -> Floats:
    """Wavelengths of a first wavelength, a step and a count."""
    first, step, count = grid
    return first + step * np.arange(count, dtype=np.float64)
