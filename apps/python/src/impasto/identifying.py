"""Which pigments of a library explain spectra that were measured at points."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np

from impasto import _native
from impasto.display import listed, table
from impasto.errors import Error, notes_of, warn, warnings_of
from impasto.library import Library
from impasto.residuals import Residuals
from impasto.spectrum import Spectrum


@dataclass(frozen=True)
class FoundPigment:
    """A pigment, or a group of pigments that count as one, in a spectrum."""

    name: str
    share: float
    """Share of the paint, 0 to 1."""
    share_sd: float
    """Standard deviation of the share."""
    presence: float
    """Probability that it is there, 0 to 1."""


@dataclass(frozen=True)
class PigmentSet:
    """A set of pigments that explains a spectrum."""

    shares: Mapping[str, float]
    """Share of each pigment or group, the greatest first."""
    probability: float
    """Probability that these are the pigments, 0 to 1."""
    chi2: float
    """Chi-square per degree of freedom."""


@dataclass(frozen=True)
class Spot:
    """Pigments of one spectrum."""

    name: str
    result: str
    """`mapped`, or why there are no pigments: one of `impasto.cube.MASKS`."""
    pigments: list[FoundPigment]
    """Pigments and groups, the most probable first."""
    sets: list[PigmentSet]
    """Sets of pigments, the most probable first."""
    chi2: float | None
    """Chi-square of the best set per degree of freedom: how badly it explains the spectrum."""
    rms: float | None
    """Root mean square difference in reflectance from the best set."""
    measured: Spectrum
    """The spectrum as it was measured."""
    mapped: Spectrum | None
    """Reflectance of the best set."""

    def __str__(self) -> str:
        if not self.pigments:
            return f"{self.name}: {self.result}"
        parts = (f"{p.name} {100 * p.share:.0f} +- {100 * p.share_sd:.0f} %" for p in self.pigments)
        return f"{self.name}: {', '.join(parts)}"


class Identified(Sequence[Spot]):
    """Pigments of spectra, in their order."""

    def __init__(self, about: dict[str, Any], remarks: list[tuple[bool, str, str | None]]) -> None:
        self.about = about
        """Everything that was found, with the keys of `impasto identify --json`."""
        self.warnings = warnings_of(remarks)
        """Warnings about the pigments that take part."""
        self.notes = notes_of(remarks)
        """Pigments that take no part, and assumed errors of the library."""
        self._spots = [_spot(entry, about) for entry in about["spectra"]]

    @property
    def groups(self) -> dict[str, list[str]]:
        """Pigments that count as one, by the name of the group."""
        result: dict[str, list[str]] = self.about["groups"]
        return result

    @property
    def left_out(self) -> list[str]:
        """Pigments that take no part because their S was not measured: others stand in for them."""
        result: list[str] = self.about["left_out"]
        return result

    def __len__(self) -> int:
        return len(self._spots)

    @overload
    def __getitem__(self, index: int) -> Spot: ...

    @overload
    def __getitem__(self, index: slice) -> list[Spot]: ...

    def __getitem__(self, index: int | slice) -> Spot | list[Spot]:
        return self._spots[index]

    def __repr__(self) -> str:
        return f"<impasto.Identified: {len(self)} spectra>"

    def _repr_html_(self) -> str:
        rows = [
            [s.name, f"{100 * p.share:.0f} +- {100 * p.share_sd:.0f} %", p.name, f"{100 * p.presence:.0f} %"]
            for s in self
            for p in s.pigments
        ]
        rows += [[spot.name, "", spot.result, ""] for spot in self if not spot.pigments]
        heads = ["spectrum", "share", "pigment", "there"]
        return table(heads, rows, repr(self).strip("<>")) + listed("Notes", self.notes)


def _spot(entry: dict[str, Any], about: dict[str, Any]) -> Spot:
    pigments = [
        FoundPigment(p["pigment"], p["share"], p["share_sd"], p["presence"])
        for p in entry["pigments"]
    ]
    sets = [
        PigmentSet(
            {p["pigment"]: p["share"] for p in one["pigments"]}, one["probability"], one["chi2"]
        )
        for one in entry["sets"]
    ]
    mapped = Spectrum(about["mapped_nm"], entry["mapped"]) if entry["mapped"] else None
    return Spot(
        entry["spectrum"],
        entry["result"],
        pigments,
        sets,
        entry["chi2"],
        entry["rms"],
        Spectrum(about["measured_nm"], entry["measured"]),
        mapped,
    )


def identify(
    spectra: Spectrum,
    library: Library,
    *,
    at_most: int = 3,
    palette: Sequence[str] = (),
    groups: Mapping[str, Sequence[str]] | None = None,
    group_alike: bool = True,
    noise: float | None = None,
    model_error: float | None = None,
    residuals: Residuals | str | os.PathLike[str] | None = None,
    penalty: float = 2.0,
    sets: int = 5,
) -> Identified:
    """Identifies the pigments of each spectrum, as `impasto identify` does.

    `spectra` are those of spots, such as `impasto.read("spots.csv", spectra_only=True).spectra`. Every spectrum
    is compared with all sets of pigments and stands for itself. `at_most` pigments of one spectrum, 1 to 4;
    `palette` names those that may take part; `groups` count as one, and with `group_alike` also pigments that
    the wavelengths cannot tell apart. `noise`, `model_error`, `residuals` and `penalty` are those of
    `impasto.survey`. `sets` is the greatest number of sets that are listed.
    """
    if residuals is not None and model_error is not None:
        raise Error("residuals and model_error exclude each other", "leave one of them out")
    if residuals is not None and not isinstance(residuals, Residuals):
        residuals = Residuals.load(residuals)
    if isinstance(palette, str):
        raise Error(f"palette is a list of names, found `{palette}`", f"try [{palette!r}]")
    request = {
        "at_most": operator.index(at_most),
        "palette": list(palette),
        "groups": [{"name": n, "pigments": list(names)} for n, names in (groups or {}).items()],
        "apart": not group_alike,
        "noise": None if noise is None else float(noise),
        "model_error": None if model_error is None else float(model_error),
        "penalty": float(penalty),
        "sets": operator.index(sets),
    }
    names = list(spectra.names) or [f"spectrum {place + 1}" for place in range(len(spectra))]
    about, remarks = _native.identify(
        library._native,
        names,
        spectra.grid,
        np.ascontiguousarray(spectra.rows),
        json.dumps(request),
        None if residuals is None else residuals._native,
    )
    found = Identified(json.loads(about), remarks)
    warn(found.warnings)
    return found
