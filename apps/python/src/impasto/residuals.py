"""Errors of a library's predictions for mixtures that its fit had not seen."""

from __future__ import annotations

import os

from impasto import _native
from impasto.spectrum import Floats, frozen


class Residuals:
    """Measured and predicted reflectances of mixtures that were left out of a fit in turn.

    Films that hide. By these, `survey` knows how far the library errs.
    """

    def __init__(self, native: _native.Residuals) -> None:
        self._native = native

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Residuals:
        """Reads the JSON file that `save` or `impasto validate --residuals` wrote."""
        return cls(_native.Residuals.open(os.fspath(path)))

    @classmethod
    def from_json(cls, text: str) -> Residuals:
        """Reads the text of such a file."""
        return cls(_native.Residuals.from_json(text))

    def to_json(self) -> str:
        """The text of the file: equal residuals give equal bytes."""
        return self._native.to_json()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the JSON file, completely or not at all."""
        self._native.save(os.fspath(path))

    @property
    def sha256(self) -> str:
        """SHA-256 of the file, which maps and surveys tell."""
        return self._native.sha256()

    @property
    def samples(self) -> list[str]:
        """Names of the mixtures, in order of the rows."""
        return self._native.samples()

    @property
    def wavelengths(self) -> Floats:
        """Wavelengths in nm, (L,)."""
        return frozen(self._native.wavelengths())

    @property
    def measured(self) -> Floats:
        """Measured reflectances, fractions, (M, L)."""
        return frozen(self._native.measured())

    @property
    def predicted(self) -> Floats:
        """Reflectances that the fit without the mixture predicts, fractions, (M, L)."""
        return frozen(self._native.predicted())

    def __repr__(self) -> str:
        ends = self.wavelengths[[0, -1]]
        return f"<impasto.Residuals: {len(self.samples)} mixtures, {ends[0]:g} to {ends[1]:g} nm>"
