"""Recipes for target colours."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from impasto import _native
from impasto.books import ColorBook
from impasto.display import Html, swatch, table
from impasto.errors import Error, warn, warnings_of
from impasto.light import light_of
from impasto.spectrum import Spectrum, floats, frozen, spectrum

if TYPE_CHECKING:
    from impasto.library import Library


@dataclass(frozen=True)
class Recipe:
    """A recipe that was found for a target."""

    shares: Mapping[str, float]
    """Share of each pigment, sum 1, the greatest first."""
    parts: Mapping[str, int] | None
    """The shares as whole parts, where these were asked for."""
    delta_e: Mapping[str, float]
    """CIEDE2000 from the target under each light."""
    distance: float
    """Difference from the target in the measure of the search."""
    hex: str
    """Nearest displayable colour."""
    in_gamut: bool
    """Whether sRGB can show the colour."""
    reflectance: Spectrum
    """Predicted reflectance."""
    thickness: float | None
    """Thickness of a film that does not hide."""
    about: Mapping[str, Any]
    """All figures of the recipe, with the keys of `impasto match --json`."""

    def __str__(self) -> str:
        return ", ".join(f"{100 * share:.2f} % {name}" for name, share in self.shares.items())


class Match(Sequence[Recipe]):
    """Recipes for one target, the best first."""

    def __init__(self, about: dict[str, Any], library: Library) -> None:
        self.about = about
        """Everything that was found, with the keys of `impasto match --json`."""
        self._recipes = [_recipe(entry, library) for entry in about["recipes"]]
        self.below_least = [_recipe(entry, library) for entry in about["below_least"]]
        """The plainest recipe with shares below `least_share`, if all others miss the target by more than the
        tolerance; else empty."""

    @property
    def target(self) -> str:
        """Name of the target."""
        return str(self.about["target"])

    @property
    def nearest(self) -> float:
        """Least difference of any recipe, in `unit`."""
        return float(self.about["nearest"])

    @property
    def unit(self) -> str:
        """Unit of the differences."""
        return str(self.about["unit"])

    def __len__(self) -> int:
        return len(self._recipes)

    @overload
    def __getitem__(self, index: int) -> Recipe: ...

    @overload
    def __getitem__(self, index: slice) -> list[Recipe]: ...

    def __getitem__(self, index: int | slice) -> Recipe | list[Recipe]:
        return self._recipes[index]

    def __repr__(self) -> str:
        return f"<impasto.Match: {self.target}, {len(self)} recipes, nearest {self.nearest:.2f} {self.unit}>"

    def _repr_html_(self) -> str:
        rows: list[list[object]] = [[swatch(self.about["hex"]), "target", self.target, ""]]
        for recipe in self._recipes:
            errors = ", ".join(f"{light} {error:.2f}" for light, error in recipe.delta_e.items())
            rows.append([swatch(recipe.hex), Html(""), str(recipe), errors])
        return table(["", "", "recipe", "CIEDE2000"], rows)


def _recipe(entry: dict[str, Any], library: Library) -> Recipe:
    pigments = entry["pigments"]
    has_parts = all("parts" in pigment for pigment in pigments)
    return Recipe(
        shares={pigment["name"]: pigment["share"] for pigment in pigments},
        parts={p["name"]: p["parts"] for p in pigments} if has_parts else None,
        delta_e=entry["delta_e"],
        distance=entry["distance"],
        hex=entry["hex"],
        in_gamut=entry["in_gamut"],
        reflectance=Spectrum(library.wavelengths, entry["reflectance"]),
        thickness=entry.get("thickness"),
        about=entry,
    )


def match(library: Library, target: Any, **options: Any) -> Match | list[Match]:
    """Searches recipes; `Library.match` says how."""
    from impasto.library import ground_of

    lights = options["lights"]
    if not isinstance(lights, Mapping):
        lights = dict.fromkeys(lights if isinstance(lights, (list, tuple)) else [lights], 1.0)
    using = options["using"]
    if not isinstance(using, Mapping):
        using = dict.fromkeys(using)
    targets, single = _targets(target, options["wavelengths"])
    thickness = options["thickness"]
    prices = options["prices"] or {}
    request = {
        key: options[key]
        for key in ["by", "at_most", "least_share", "whole_parts", "tolerance", "beyond_measured", "count"]
    } | {
        "thickness": thickness if thickness is None else _range(thickness),
        "only": _names("only", options["only"]),
        "with": [{"name": name, "share": share} for name, share in using.items()],
        "without": _names("without", options["without"]),
        "prices": [f"{name}={price}" for name, price in prices.items()],
    }
    found = _native.recipes_for(
        library._native,
        targets,
        json.dumps(request),
        [(light_of(light), float(weight)) for light, weight in lights.items()],
        options["observer"],
        ground_of(options["over"]),
        options["progress"],
    )
    matches = []
    for text, remarks in found:
        warn(warnings_of(remarks))
        matches.append(Match(json.loads(text), library))
    return matches[0] if single else matches


def _range(thickness: float | tuple[float, float]) -> str:
    ends = thickness if isinstance(thickness, (tuple, list)) else (thickness, thickness)
    least, most = (str(float(end)) for end in ends)
    return least if least == most else f"{least}:{most}"


def _names(setting: str, names: Sequence[str]) -> list[str]:
    if isinstance(names, str):
        raise Error(f"{setting} is a list of names, found `{names}`", f"try [{names!r}]")
    return list(names)


def _targets(target: Any, wavelengths: Any) -> tuple[list[Any], bool]:
    if isinstance(target, (str, _native.BookColor)):
        return [target], True
    if isinstance(target, ColorBook):
        return list(target), False
    if wavelengths is None and isinstance(target, (tuple, list, np.ndarray)):
        lab = floats(target, "target", (0, 1, 2))
        if lab.shape == (3,):
            return [",".join(repr(value) for value in lab.tolist())], True
    found = spectrum(target, wavelengths)
    names = found.names or tuple(f"spectrum {n}" for n in range(len(found)))
    single = found.values.ndim == 1
    return [(name, found.grid, frozen(row)) for name, row in zip(names, found.rows)], single
