"""The native part: arrays, names and JSON. Private; the modules beside it are the public face."""

import os
from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from impasto.spectrum import Floats

__all__ = [
    "BookColor",
    "Cube",
    "Fit",
    "Library",
    "Light",
    "Readings",
    "Residuals",
    "Survey",
    "Validation",
    "__version__",
    "color_book",
    "delta_e",
    "compare",
    "film",
    "fit",
    "identify",
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
    def remarks(self) -> list[str]: ...
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
        values: str | None,
        wavelengths: str | list[float] | None,
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
    def residuals(self) -> Residuals: ...
    def errors(self) -> str: ...
    def text(self) -> str: ...

@final
class Residuals:
    @staticmethod
    def open(path: str) -> Residuals: ...
    @staticmethod
    def from_json(text: str) -> Residuals: ...
    def to_json(self) -> str: ...
    def save(self, path: str) -> None: ...
    def sha256(self) -> str: ...
    def samples(self) -> list[str]: ...
    def wavelengths(self) -> Floats: ...
    def measured(self) -> Floats: ...
    def predicted(self) -> Floats: ...

def xyz(
    reflectance: Floats, grid_numbers: _Grid, light: Light, observer: str
) -> tuple[Floats, tuple[float, float, float]]: ...
def rgb(xyz: Floats, white: tuple[float, float, float]) -> tuple[Floats, Floats]: ...
def delta_e(first: Floats, second: Floats, cie1976: bool) -> Floats: ...
def fit(
    readings: Readings, request: str,
    surface_of: Library | None, light: Light, observer: str, progress: _Progress
) -> Fit: ...
def validate(
    readings: Readings, request: str,
    surface_of: Library | None, light: Light, observer: str, progress: _Progress
) -> Validation: ...
@final
class BookColor:
    @property
    def name(self) -> str: ...

def color_book(
    path: _Path, name: str | None, light: Light | None, observer: str
) -> tuple[list[BookColor], _Remarks] | None: ...
def recipes_for(
    library: Library,
    targets: list[Any],
    request: str,
    lights: list[tuple[Light, float]],
    observer: str,
    over: Any,
    progress: _Progress,
) -> list[tuple[str, _Remarks]]: ...
def compare(
    readings: Readings,
    against: Readings,
    request: str,
    light: Light,
    observer: str,
) -> tuple[str, _Remarks]: ...
def film(
    readings: Readings,
    request: str,
    light: Light,
    observer: str,
) -> tuple[str, _Remarks]: ...
def identify(
    library: Library,
    names: list[str],
    grid_numbers: _Grid,
    values: Floats,
    request: str,
    residuals: Residuals | None,
) -> tuple[str, _Remarks]: ...
def plan(
    pigments: list[str],
    white: str,
    request: str,
    prior: Library | None,
    form: tuple[_Grid, int],
) -> tuple[str, list[bytes], _Remarks]: ...
def quadrature(library: Library | None, request: str, light: Light, observer: str) -> str: ...
def report(
    library: Library,
    readings: Readings | None,
    request: str,
    light: Light,
    observer: str,
    progress: _Progress,
) -> list[tuple[str, bytes]]: ...

@final
class Cube:
    @staticmethod
    def open(path: _Path, options: str) -> Cube: ...
    @property
    def shape(self) -> tuple[int, int, int]: ...
    @property
    def wavelengths(self) -> Floats: ...
    @property
    def remarks(self) -> _Remarks: ...
    def read(
        self, rows: tuple[int, int], columns: tuple[int, int]
    ) -> tuple[NDArray[np.float32], NDArray[np.uint8]]: ...

@final
class Survey:
    def __new__(
        cls,
        cube: Cube,
        library: Library,
        request: str,
        residuals: Residuals | None,
        ground: tuple[list[float], list[float]] | None,
        book: str | None,
        progress: _Progress,
    ) -> Survey: ...
    @property
    def remarks(self) -> _Remarks: ...
    def book(self) -> str: ...
    def about(self) -> str: ...
    def begin(self, path: _Path, resume: bool) -> list[tuple[str, int]]: ...
    def map(self, path: _Path, progress: _Progress) -> None: ...
    def map_shards(self, path: _Path, places: list[int]) -> int: ...
