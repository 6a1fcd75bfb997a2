"""Fits of K and S, and their validation."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from impasto import _native
from impasto.display import listed, table
from impasto.errors import notes_of, warn, warnings_of
from impasto.library import Library
from impasto.light import Light, light_of
from impasto.readings import Readings
from impasto.residuals import Residuals

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Surface:
    """Reflection of a film's surface (Saunderson 1942): k1 of the light outside, k2 of that inside."""

    k1: float = 0.03
    k2: float = 0.6


class _Errors:
    """Errors by sample."""

    _errors: dict[str, Any]

    @property
    def delta_e(self) -> dict[str, float]:
        """Mean, median, 95th percentile and largest error in CIEDE2000."""
        result: dict[str, float] = self._errors["delta_e"]
        return result

    @property
    def rms(self) -> float:
        """Root mean square error of reflectance."""
        return float(self._errors["rms"])

    @property
    def samples(self) -> list[tuple[str, float]]:
        """Each sample with its CIEDE2000 error."""
        return [(entry["sample"], entry["delta_e"]) for entry in self._errors["per_sample"]]

    @property
    def per_sample(self) -> pd.DataFrame:
        """The errors as a table with the columns `sample` and `delta_e`; needs pandas."""
        import pandas as pd

        return pd.DataFrame(self.samples, columns=["sample", "delta_e"])

    def _table(self, title: str) -> str:
        worst = sorted(self.samples, key=lambda entry: -entry[1])[:12]
        rows = [[name, f"{error:.2f}"] for name, error in worst]
        figures = ", ".join(f"{key} {value:.2f}" for key, value in self.delta_e.items())
        return table(["sample", "CIEDE2000"], rows, f"{title}; CIEDE2000 of all: {figures}")


class Fit(_Errors):
    """A fitted library, with what a user should know about the fit."""

    def __init__(self, native: _native.Fit) -> None:
        self._native = native
        self._errors = json.loads(native.errors())
        self.library = Library(native.library)
        """The library, with the evidence of its fit."""

    @property
    def warnings(self) -> list[str]:
        """Pigments that the data do not identify, and contradictions."""
        return warnings_of(self._native.remarks) + self._native.warnings

    @property
    def notes(self) -> list[str]:
        """Choices that were made, and what the films and equations show."""
        return notes_of(self._native.remarks)

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        return f"<impasto.Fit: {self._native.text().splitlines()[0]}>"

    def _repr_html_(self) -> str:
        tables = self.library._table() + self._table("Worst samples")
        return tables + listed("Notes", self.notes) + listed("Warnings", self.warnings)


class Validation(_Errors):
    """Errors of mixtures that were predicted without their own measurement."""

    def __init__(self, native: _native.Validation) -> None:
        self._native = native
        self._errors = json.loads(native.errors())

    @property
    def fit(self) -> Fit:
        """The fit of all samples."""
        return Fit(self._native.fit)

    @property
    def by_pigment(self) -> list[dict[str, Any]]:
        """Pigments by their part of the error, the greatest first: pigment, mixtures, share."""
        result: list[dict[str, Any]] = self._errors["by_pigment"]
        return result

    @property
    def strengths(self) -> list[dict[str, Any]]:
        """Factors of the strength that the mixtures of a file have in common: pigment (None for all beside the
        white), file, mixtures, sizes (least and greatest number of pigments), factor, deviation (its
        relative standard error), delta_e (before, after)."""
        result: list[dict[str, Any]] = self._errors["strengths"]
        return result

    @property
    def warnings(self) -> list[str]:
        """Mixtures that could not be left out."""
        return self._native.warnings

    @property
    def residuals(self) -> Residuals:
        """Measured and predicted reflectances of the mixtures, for `survey`; `FitError` for absolute amounts,
        whose films do not hide."""
        return Residuals(self._native.residuals())

    def __str__(self) -> str:
        return self._native.text()

    def __repr__(self) -> str:
        return f"<impasto.Validation: {self._native.text().splitlines()[0]}>"

    def _repr_html_(self) -> str:
        return self._table("Worst mixtures, left out") + listed("Warnings", self.warnings)


def fit(
    readings: Readings,
    *,
    reference: str | None = None,
    surface: Surface | Library | None = None,
    specular: bool | None = None,
    amounts: str = "relative",
    method: str = "refined",
    smoothness: float | None = None,
    unevenness: float | None = None,
    below_surface: str | None = None,
    exclude: Sequence[str] = (),
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
    title: str | None = None,
    licence: str | None = None,
    source: str | None = None,
    progress: Callable[[str], object] | None = None,
) -> Fit:
    """Fits K and S of every pigment, as `impasto fit` does.

    `reference` is the white whose S is 1 (default: the commonest white). `surface` is chosen if none is
    given; a library gives its own, so that both can be merged. `specular` says whether the readings
    include the specular reflection (default: as the files say, else yes). `amounts` is `relative` or
    `absolute`, `method` `refined`, `weighted` or `qp`. Light and
    observer set the colour errors only. `progress` is called with each stage as text. Ctrl-C ends the fit.

    Raises `FitError`; findings about the data are told as `FindingWarning`.
    """
    request = json.dumps(_request(locals()))
    light = light_of(illuminant)
    result = Fit(_native.fit(readings._native, request, _surface_of(surface), light, observer, progress))
    warn(result.warnings)
    return result


def validate(
    readings: Readings,
    *,
    leave_out: str | None = None,
    folds: int | None = None,
    using: Sequence[str] = (),
    reference: str | None = None,
    surface: Surface | Library | None = None,
    specular: bool | None = None,
    amounts: str = "relative",
    method: str = "refined",
    smoothness: float | None = None,
    unevenness: float | None = None,
    below_surface: str | None = None,
    exclude: Sequence[str] = (),
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
    progress: Callable[[str], object] | None = None,
) -> Validation:
    """Leaves each mixture out in turn, fits the rest, and predicts it, as `impasto validate` does.

    `leave_out` is "mixture" (the default), "sample" (masstones too), "ground" (all films over a ground),
    "pigment" (all samples of one pigment) or "file".
    `folds` deals the mixtures at random into this many groups (the same every time) and leaves out one
    group at a time; `using` names pigments, only mixtures with one of them are left out. `progress` is
    called with each stage of the fit, and after each mixture.
    """
    request = json.dumps(
        {"fit": _request(locals()), "leave_out": leave_out, "folds": folds, "with": list(using)}
    )
    light = light_of(illuminant)
    native = readings._native
    result = Validation(
        _native.validate(native, request, _surface_of(surface), light, observer, progress)
    )
    warn(result.warnings)
    return result


def _surface_of(surface: Surface | Library | None) -> _native.Library | None:
    """The library whose surface a fit takes."""
    return surface._native if isinstance(surface, Library) else None


def _request(given: dict[str, Any]) -> dict[str, Any]:
    """The keys of `FitRequest` (docs/schema/requests.json) for the arguments of `fit`."""
    surface = given["surface"]
    keys = ["amounts", "method", "reference", "below_surface"]
    request = {key: given[key] for key in keys} | {
        "surface": f"{surface.k1},{surface.k2}" if isinstance(surface, Surface) else None,
        "specular": {None: None, True: "included", False: "excluded"}[given["specular"]],
        "exclude": list(given["exclude"]),
        "provenance": {key: given.get(key) for key in ["title", "licence", "source"]},
    }
    for key in ["smoothness", "unevenness"]:
        request[key] = None if given[key] is None else str(given[key])
    return request
