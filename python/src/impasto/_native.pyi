"""The native part: arrays, names and JSON. Private; the modules beside it are the public face."""

import os
from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from impasto.spectrum import Floats

__all__ = [
    "Cube",
    "Fit",
    "Library",
    "Light",
    "Readings",
    "Survey",
    "Validation",
    "__version__",
    "delta_e",
    "fit",
    "plan",
    "quadrature",
    "recipes_for",
    "report",
    "rgb",
    "validate",
    "xyz",
]

__version__: str

_Grid = tuple[float, float, int]
_Remarks = list[tuple[bool, str, str | None]]
_Progress = Callable[[str], object] | None
_Path = str | os.PathLike[str]

@final
class Light:
    def __new__(cls, text: str) -> Light: ...
    @property
    def name(self) -> str: ...
    @property
    def wavelengths(self) -> Floats: ...
    @property
    def power(self) -> Floats: ...

@final
class Library:
    @staticmethod
    def open(path: _Path) -> Library: ...
    @staticmethod
    def from_json(name: str, text: str) -> Library: ...
    @staticmethod
    def van_gogh_oils() -> Library: ...
    def to_json(self) -> str: ...
    def save(self, path: _Path) -> None: ...
    @property
    def names(self) -> list[str]: ...
    def find(self, name: str) -> int: ...
    @property
    def grid(self) -> _Grid: ...
    @property
    def wavelengths(self) -> Floats: ...
    def curves(self, curve: str) -> Floats: ...
    def about(self) -> str: ...
    def mix(
        self, parts: Floats, thickness: float | None = None, ground: Any = None
    ) -> tuple[Floats, _Remarks]: ...
    def color(
        self,
        parts: list[tuple[str, float]],
        light: Light,
        observer: str,
        thickness: float | None = None,
        ground: Any = None,
    ) -> tuple[str, _Remarks]: ...

@final
class Readings:
    @staticmethod
    def open(
        paths: list[str],
        recipes: str | None,
        pigments: list[str] | None,
        format: str | None,
        percent: bool | None,
        transmittance: bool,
        references: tuple[str, list[str], str | None] | None,
        spectra_only: bool,
    ) -> Readings: ...
    @staticmethod
    def from_csv(
        name: str, bytes: bytes, pigments: list[str] | None, percent: bool | None
    ) -> Readings: ...
    @property
    def pigments(self) -> list[str]: ...
    @property
    def grid(self) -> _Grid: ...
    @property
    def samples(self) -> list[str]: ...
    @property
    def backings(self) -> list[str]: ...
    @property
    def bare(self) -> list[bool]: ...
    @property
    def amounts(self) -> Floats: ...
    @property
    def reflectance(self) -> Floats: ...
    def averaged(self) -> tuple[list[str], list[bool], Floats]: ...
    @property
    def inputs(self) -> list[tuple[str, str]]: ...
    @property
    def remarks(self) -> _Remarks: ...

@final
class Fit:
    @property
    def library(self) -> Library: ...
    @property
    def remarks(self) -> _Remarks: ...
    @property
    def warnings(self) -> list[str]: ...
    def errors(self) -> str: ...
    def text(self) -> str: ...

@final
class Validation:
    @property
    def fit(self) -> Fit: ...
    @property
    def warnings(self) -> list[str]: ...
    def errors(self) -> str: ...
    def text(self) -> str: ...

def xyz(
    reflectance: Floats, grid_numbers: _Grid, light: Light, observer: str
) -> tuple[Floats, tuple[float, float, float]]: ...
def rgb(xyz: Floats, white: tuple[float, float, float]) -> tuple[Floats, Floats]: ...
def delta_e(first: Floats, second: Floats, cie1976: bool) -> Floats: ...
def fit(readings: Readings, options: dict[str, Any], progress: _Progress) -> Fit: ...
def validate(
    readings: Readings,
    options: dict[str, Any],
    folds: int | None,
    using: list[str],
    progress: _Progress,
) -> Validation: ...
def recipes_for(
    library: Library, targets: list[Any], options: dict[str, Any], progress: _Progress
) -> list[tuple[str, _Remarks]]: ...
def plan(pigments: list[str], white: str, options: dict[str, Any]) -> tuple[str, bytes, _Remarks]: ...
def quadrature(
    library: Library | None,
    method: str,
    nodes: int,
    light: Light,
    observer: str,
    mixtures: int,
    seed: int,
) -> str: ...
def report(
    library: Library,
    readings: Readings | None,
    light: Light,
    observer: str,
    pair: tuple[str, str] | None,
    validate: bool,
    progress: _Progress,
) -> list[tuple[str, bytes]]: ...

@final
class Cube:
    @staticmethod
    def open(path: _Path, options: dict[str, Any]) -> Cube: ...
    @property
    def shape(self) -> tuple[int, int, int]: ...
    @property
    def wavelengths(self) -> Floats: ...
    @property
    def remarks(self) -> list[str]: ...
    def read(
        self, rows: tuple[int, int], columns: tuple[int, int]
    ) -> tuple[NDArray[np.float32], NDArray[np.uint8]]: ...

@final
class Survey:
    def __new__(
        cls,
        cube: Cube,
        library: Library,
        settings: dict[str, Any],
        book: str | None,
        progress: _Progress,
    ) -> Survey: ...
    def book(self) -> str: ...
    def about(self) -> str: ...
    def begin(self, path: _Path, resume: bool) -> list[bool]: ...
    def map(self, path: _Path, progress: _Progress) -> None: ...
    def map_shard(self, path: _Path, place: int) -> int: ...
