"""Readings of swatches, from files of any format or from tables."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from impasto import _native
from impasto.display import listed, swatch, table
from impasto.errors import Error, notes_of, warn, warnings_of
from impasto.spectrum import Floats, Spectrum, wavelengths_of

if TYPE_CHECKING:
    import pandas as pd

PathLike = str | os.PathLike[str]
"""A path, `FILE.xlsx#SHEET` for a sheet of a workbook, `-` for standard input."""


class Readings:
    """Readings of films of paint and of bare cards, on one grid of wavelengths."""

    def __init__(self, native: _native.Readings) -> None:
        self._native = native

    @classmethod
    def from_dataframe(
        cls,
        frame: pd.DataFrame,
        pigments: Sequence[str] | None = None,
        *,
        percent: bool | None = None,
        name: str = "DataFrame",
    ) -> Readings:
        """Readings from a table with the columns of the measurement CSV: `sample`, optionally `film` and
        `backing`, one column a pigment with its amounts, and one a wavelength in nm.

        Rows in errors count from 1 with the headings as row 1. `percent` says whether readings are in
        percent; by default their largest value decides.
        """
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        columns = list(frame.columns)
        if not any(str(column).strip().lower() in ("sample", "name") for column in columns):
            frame = frame.reset_index(names="sample")
            columns = list(frame.columns)
        writer.writerow([_heading(column) for column in columns])
        for row in frame.itertuples(index=False, name=None):
            writer.writerow([_cell(value) for value in row])
        bytes_ = text.getvalue().encode()
        native = _native.Readings.from_csv(name, bytes_, _names(pigments), percent)
        return cls(native)._told()

    def _told(self) -> Readings:
        warn(self.warnings)
        return self

    @property
    def pigments(self) -> list[str]:
        """Names of the pigments, in order of the columns of `amounts`."""
        return self._native.pigments

    @property
    def samples(self) -> list[str]:
        """Name of the sample of each reading."""
        return self._native.samples

    @property
    def backings(self) -> list[str]:
        """Backing of each reading."""
        return self._native.backings

    @property
    def bare(self) -> list[bool]:
        """Whether each reading is of a bare card."""
        return self._native.bare

    @property
    def wavelengths(self) -> Floats:
        """Wavelengths in nm, (L,)."""
        return self.reflectance.wavelengths

    @property
    def amounts(self) -> Floats:
        """Amount of each pigment in each reading, (M, N); NaN in bare cards."""
        return self._native.amounts

    @property
    def reflectance(self) -> Spectrum:
        """Reflectance of every reading."""
        return Spectrum(wavelengths_of(self._native.grid), self._native.reflectance, self.samples)

    @property
    def spectra(self) -> Spectrum:
        """Mean reflectance of each sample, over all its readings on the same backing."""
        names, _, values = self._native.averaged()
        return Spectrum(wavelengths_of(self._native.grid), values, names)

    @property
    def inputs(self) -> list[tuple[str, str]]:
        """Path and SHA-256 of each file that was read."""
        return self._native.inputs

    @property
    def warnings(self) -> list[str]:
        """Warnings about the files."""
        return warnings_of(self._native.remarks)

    @property
    def notes(self) -> list[str]:
        """Contents of the files, and choices that were made."""
        return notes_of(self._native.remarks)

    def __len__(self) -> int:
        return len(self.samples)

    def __getitem__(self, name: str) -> Spectrum:
        """Mean reflectance of a sample by name: one spectrum a backing, or one by its whole name, such as
        `07B on white`."""
        spectra = self.spectra
        if name in spectra.names:
            return spectra[name]
        places = [i for i, full in enumerate(spectra.names) if full.startswith(f"{name} on ")]
        if not places:
            return spectra[name]
        names = [spectra.names[place] for place in places]
        return Spectrum(spectra.wavelengths, spectra.rows[places], names)

    def to_dataframe(self) -> pd.DataFrame:
        """A table with a row a reading: sample, backing, amounts, wavelengths."""
        import pandas as pd

        head = pd.DataFrame({"sample": self.samples, "backing": self.backings})
        amounts = pd.DataFrame(self.amounts, columns=self.pigments)
        values = pd.DataFrame(self._native.reflectance, columns=self.wavelengths)
        return pd.concat([head, amounts, values], axis=1)

    def __repr__(self) -> str:
        return (
            f"<impasto.Readings: {len(self)} readings of {len(set(self.samples))} samples, "
            f"{len(self.pigments)} pigments>"
        )

    def _repr_html_(self) -> str:
        from impasto import color

        spectra = self.spectra
        codes = color.display(spectra)
        rows = [[swatch(code), name, code] for code, name in zip(codes, spectra.names)]
        return table(["", "sample", "sRGB"], rows[:200], repr(self)) + listed("Warnings", self.warnings)


def read(
    *paths: PathLike,
    recipes: PathLike | None = None,
    pigments: Sequence[str] | None = None,
    format: str | None = None,
    percent: bool | None = None,
    transmittance: bool = False,
    values: str | None = None,
    wavelengths: PathLike | Sequence[float] | None = None,
    white_reading: str | None = None,
    dark_reading: str | Sequence[str] = (),
    tile: str | float | None = None,
    spectra_only: bool = False,
) -> Readings:
    """Reads one or more files of an instrument or measurement CSVs.

    `recipes` is a file of recipes, where the readings have none. `pigments` names the columns that are
    pigments. `percent` states the unit of the readings. `values` states their quantity where headings
    mislead: reflectance, percent, fraction, absorbance, k/s or counts. `wavelengths` names those of files
    that hold values only: numbers in nm, "380..730:10", or a file of them. Counts need `white_reading`, and usually
    `dark_reading` (`"0"` where it is subtracted already); `tile` is the white's own reflectance.
    `spectra_only` reads spectra and ignores recipes.

    Raises `ReadingError` with file, row and column.
    """
    if not paths:
        raise Error("no file is named", 'try impasto.read("swatches.csv")')
    references = None
    if white_reading is not None:
        darks = [dark_reading] if isinstance(dark_reading, str) else list(dark_reading)
        references = (white_reading, darks, None if tile is None else str(tile))
    elif dark_reading or tile is not None:
        raise Error("a dark reading or a tile needs the white reading", "add `white_reading`")
    native = _native.Readings.open(
        [os.fspath(path) for path in paths],
        None if recipes is None else os.fspath(recipes),
        _names(pigments),
        format,
        percent,
        transmittance,
        values,
        _wavelengths(wavelengths),
        references,
        spectra_only,
    )
    return Readings(native)._told()


def _wavelengths(wavelengths: PathLike | Sequence[float] | None) -> str | list[float] | None:
    if wavelengths is None or isinstance(wavelengths, (str, os.PathLike)):
        return None if wavelengths is None else os.fspath(wavelengths)
    return [float(nm) for nm in wavelengths]


def _names(names: Sequence[str] | None) -> list[str] | None:
    if isinstance(names, str):
        raise Error(f"pigments is a list of names, found `{names}`", f"try [{names!r}]")
    return None if names is None else list(names)


def _heading(column: Any) -> str:
    return repr(float(column)).removesuffix(".0") if isinstance(column, (int, float)) else str(column)


def _cell(value: Any) -> str:
    # pandas.NA is neither equal to itself nor not.
    if value is None or type(value).__name__ == "NAType" or value != value:
        return ""
    is_complex = isinstance(value, (complex, np.complexfloating))
    return repr(float(value)) if hasattr(value, "__float__") and not is_complex else str(value)
