"""Pigment libraries: K and S of calibrated pigments, and their mixtures."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from impasto import _native, matching
from impasto.display import Html, listed, swatch, table
from impasto.errors import Error, warn, warnings_of
from impasto.light import Light, light_of
from impasto.spectrum import Floats, Spectrum, floats, frozen, spectrum

if TYPE_CHECKING:
    from impasto._native import BookColor
    from impasto.matching import Match


@dataclass(frozen=True)
class Pigment:
    """One pigment of a library. Curves have shape (L,); deviations are NaN where they are unknown."""

    name: str
    wavelengths: Floats
    absorption: Floats
    scattering: Floats
    absorption_sd: Floats
    scattering_sd: Floats
    identified: bool
    """Whether S is known. If not, it is 1 at every wavelength."""
    guessed: bool
    """Whether K and S were guessed from a colour rather than measured."""
    notes: tuple[str, ...]


class Library:
    """Calibrated pigments on one grid of wavelengths, with their sources and the evidence of the fit."""

    def __init__(self, native: _native.Library) -> None:
        self._native = native
        self._about: dict[str, Any] | None = None

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Library:
        """Reads a library from its JSON file."""
        return cls(_native.Library.open(os.fspath(path)))

    @classmethod
    def from_json(cls, text: str, name: str = "library") -> Library:
        """Reads a library from JSON text; `name` stands in errors."""
        return cls(_native.Library.from_json(name, text))

    @classmethod
    def van_gogh_oils(cls) -> Library:
        """The 18 oils of Van Gogh's palette that ship with impasto."""
        return cls(_native.Library.van_gogh_oils())

    def to_json(self) -> str:
        """The JSON text of the library's file: equal libraries give equal bytes."""
        return self._native.to_json()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the JSON file, completely or not at all."""
        self._native.save(os.fspath(path))

    @property
    def about(self) -> dict[str, Any]:
        """All but the curves: title, licence, source, amounts, reference, surface, inputs, evidence."""
        about = self._about
        if about is None:
            about = self._about = json.loads(self._native.about())
        return about

    @property
    def names(self) -> list[str]:
        """Names of the pigments, in order of the rows of K and S."""
        return self._native.names

    @property
    def wavelengths(self) -> Floats:
        """Wavelengths in nm, (L,)."""
        return self._native.wavelengths

    @property
    def K(self) -> Floats:
        """Absorption of every pigment, (N, L)."""
        return frozen(self._native.curves("absorption"))

    @property
    def S(self) -> Floats:
        """Scattering of every pigment, (N, L)."""
        return frozen(self._native.curves("scattering"))

    def __len__(self) -> int:
        return len(self.names)

    def __iter__(self) -> Iterator[Pigment]:
        return (self[name] for name in self.names)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __getitem__(self, name: str) -> Pigment:
        """A pigment by name, in any letter case, or by the beginning of its name."""
        index = self._native.find(name)
        about = self.about["pigments"][index]
        curve = {
            kind: frozen(self._native.curves(kind)[index])
            for kind in ("absorption", "scattering", "absorption_sd", "scattering_sd")
        }
        return Pigment(
            name=about["name"],
            wavelengths=frozen(self.wavelengths),
            identified=about["identified"],
            guessed=about["guessed"],
            notes=tuple(about["notes"]),
            **curve,
        )

    def mix(
        self,
        parts: Mapping[str, float] | Sequence[Mapping[str, float]] | ArrayLike,
        *,
        thickness: float | None = None,
        over: float | str | Spectrum | None = None,
    ) -> Spectrum:
        """Reflectance of mixtures: of one recipe or several by names, or of rows of parts, (N,) or (M, N) in
        the order of `names`, all in one call.

        A library of relative parts gives films that hide, or of `thickness` over the ground `over`: a
        reflectance from 0 to 1, `"white"`, `"black"` or a `Spectrum`. Thickness 1 is that at which the
        reference white has S d = 1; of absolute amounts it is the recipe as given.
        """
        named = _by_name(parts)
        names: tuple[str, ...] = ()
        if named is not None:
            rows, single = np.zeros((len(named), len(self))), isinstance(parts, Mapping)
            for row, recipe in zip(rows, named):
                for name, part in recipe.items():
                    row[self._native.find(name)] += part
            names = tuple(" + ".join(f"{part:g} {n}" for n, part in r.items()) for r in named)
        else:
            array = floats(cast(Any, parts), "parts", (1, 2))
            rows, single = np.atleast_2d(array), array.ndim == 1
        if rows.shape[1] != len(self):
            raise Error(
                f"parts has shape {rows.shape}, but the library has {len(self)} pigments",
                "give one column a pigment, in the order of library.names",
            )
        values, remarks = self._native.mix(rows, thickness, ground_of(over))
        warn(warnings_of(remarks))
        return Spectrum(self.wavelengths, values[0] if single else values, names)

    def color(
        self,
        parts: Mapping[str, float],
        illuminant: str | Light = "D65",
        observer: str = "1931-2",
        *,
        thickness: float | None = None,
        over: float | str | Spectrum | None = None,
    ) -> dict[str, Any]:
        """Colour of one recipe: reflectance, xyz, lab, srgb, hex, in_gamut, as `impasto mix --json`."""
        text, remarks = self._native.color(
            list(parts.items()), light_of(illuminant), observer, thickness, ground_of(over)
        )
        warn(warnings_of(remarks))
        result: dict[str, Any] = json.loads(text)
        return result

    @overload
    def match(
        self,
        target: str | tuple[float, float, float] | BookColor,
        *,
        wavelengths: ArrayLike | None = ...,
        by: str = ...,
        lights: Mapping[str | Light, float] | Sequence[str | Light] | str | Light = ...,
        observer: str = ...,
        only: Sequence[str] = ...,
        using: Mapping[str, float | None] | Sequence[str] = ...,
        without: Sequence[str] = ...,
        at_most: int = ...,
        least_share: float | None = ...,
        whole_parts: int | None = ...,
        prices: Mapping[str, float] | None = ...,
        tolerance: float | None = ...,
        thickness: float | tuple[float, float] | None = ...,
        over: float | str | Spectrum | None = ...,
        beyond_measured: bool = ...,
        count: int = ...,
        progress: Any = ...,
    ) -> Match: ...

    @overload
    def match(
        self,
        target: Any,
        *,
        wavelengths: ArrayLike | None = ...,
        by: str = ...,
        lights: Mapping[str | Light, float] | Sequence[str | Light] | str | Light = ...,
        observer: str = ...,
        only: Sequence[str] = ...,
        using: Mapping[str, float | None] | Sequence[str] = ...,
        without: Sequence[str] = ...,
        at_most: int = ...,
        least_share: float | None = ...,
        whole_parts: int | None = ...,
        prices: Mapping[str, float] | None = ...,
        tolerance: float | None = ...,
        thickness: float | tuple[float, float] | None = ...,
        over: float | str | Spectrum | None = ...,
        beyond_measured: bool = ...,
        count: int = ...,
        progress: Any = ...,
    ) -> Match | list[Match]: ...

    def match(
        self,
        target: Any,
        *,
        wavelengths: ArrayLike | None = None,
        by: str = "color",
        lights: Mapping[str | Light, float] | Sequence[str | Light] | str | Light = "D65",
        observer: str = "1931-2",
        only: Sequence[str] = (),
        using: Mapping[str, float | None] | Sequence[str] = (),
        without: Sequence[str] = (),
        at_most: int = 4,
        least_share: float | None = None,
        whole_parts: int | None = None,
        prices: Mapping[str, float] | None = None,
        tolerance: float | None = None,
        thickness: float | tuple[float, float] | None = None,
        over: float | str | Spectrum | None = None,
        beyond_measured: bool = False,
        count: int = 5,
        progress: Any = None,
    ) -> Match | list[Match]:
        """Recipes for a target colour: `"#4a7d8c"`, `(L, a, b)`, a colour of a `ColorBook`, or a measured spectrum
        in any form that `impasto.color` takes. Several spectra, or a whole book, give a list.

        `by` is `color`, `cie1976`, `spectrum` or `weighted-spectrum`. `lights` judge each recipe, with
        weights. `using` names pigments that must take part, with a fixed share if one is given.
        No share is below `least_share`, by default 0.02. If only this keeps a target from being reached,
        `below_least` of the result holds a recipe with smaller shares.
        """
        return matching.match(
            self,
            target,
            wavelengths=wavelengths,
            by=by,
            lights=lights,
            observer=observer,
            only=only,
            using=using,
            without=without,
            at_most=at_most,
            least_share=least_share,
            whole_parts=whole_parts,
            prices=prices,
            tolerance=tolerance,
            thickness=thickness,
            over=over,
            beyond_measured=beyond_measured,
            count=count,
            progress=progress,
        )

    def _code(self, parts: Mapping[str, float]) -> str:
        """Colour of a recipe as `#rrggbb`, without warnings."""
        text, _ = self._native.color(list(parts.items()), light_of("D65"), "1931-2", None, None)
        return str(json.loads(text)["hex"])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Library) and self.to_json() == other.to_json()

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return Library.from_json, (self.to_json(),)

    def __repr__(self) -> str:
        nm = self.wavelengths
        return f"<impasto.Library: {self.about['title']}, {len(self)} pigments, {nm[0]:g} to {nm[-1]:g} nm>"

    def _repr_html_(self) -> str:
        evidence = self.about["evidence"]
        return self._table() + listed("Warnings", evidence["warnings"] if evidence else [])

    def _table(self) -> str:
        """Swatches of all pigments."""
        rows = []
        reference = self.about["reference"]
        for pigment in self.about["pigments"]:
            name = pigment["name"]
            others = {} if reference in (None, name) else {reference: 9.0, name: 1.0}
            codes = [self._code(parts) for parts in ({name: 1.0}, others) if parts]
            patches = Html("".join(swatch(code) for code in codes))
            rows.append([patches, name, codes[0], "; ".join(pigment["notes"])])
        evidence = self.about["evidence"]
        errors = f", CIEDE2000 mean {evidence['delta_e']['mean']:.2f}" if evidence else ""
        headings = ["masstone, 1:9 tint", "pigment", "sRGB", "notes"]
        return table(headings, rows, self.about["title"] + errors)


def _by_name(parts: Any) -> Sequence[Mapping[str, float]] | None:
    """Recipes whose parts have names; none where parts are numbers in the order of the pigments."""
    if isinstance(parts, Mapping):
        return [parts]
    several = isinstance(parts, (list, tuple)) and parts and isinstance(parts[0], Mapping)
    return parts if several else None


def ground_of(over: float | str | Any | None) -> Any:
    """A ground as the native part takes it."""
    if over is None:
        return None
    if isinstance(over, (int, float, np.floating, np.integer)):
        return float(over)
    if isinstance(over, str):
        known = {"white": 1.0, "black": 0.0}
        if over not in known:
            raise Error(f"unknown ground `{over}`", "give white, black, a reflectance or a Spectrum")
        return known[over]
    found = spectrum(over)
    if len(found) != 1:
        raise Error(f"a ground is one spectrum, found {len(found)}")
    return found.grid, frozen(found.rows[0])
