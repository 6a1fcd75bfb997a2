"""Books of named colours: swatch files, and tables of names with L, a, b, with X, Y, Z or with codes."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import overload

from impasto import _native
from impasto._native import BookColor
from impasto.errors import Error, warn, warnings_of
from impasto.light import Light, light_of


class ColorBook(Sequence[BookColor]):
    """The named colours of a file, as targets of `Library.match`.

    Reads `.ase`, `.aco` and `.gpl`, or a table (`.csv`, `.xlsx`) whose headings name the colour. `light` and
    `observer` are those of a table of L, a, b or X, Y, Z; otherwise its headings may state them, else they are D65
    and 1931-2, and `remarks` say so.
    """

    def __init__(
        self, path: str | os.PathLike[str], *, light: str | Light | None = None, observer: str = "1931-2"
    ) -> None:
        self.path = os.fspath(path)
        self._light = None if light is None else light_of(light)
        self._observer = observer
        found = self._read(None)
        self._colors, remarks = found
        self.remarks = tuple(text for _, text, _ in remarks)
        """What was left out, and the light that was taken."""
        warn(warnings_of(remarks))

    def _read(self, name: str | None) -> tuple[list[BookColor], list[tuple[bool, str, str | None]]]:
        found = _native.color_book(self.path, name, self._light, self._observer)
        if found is None:
            raise Error(
                f"{self.path}: this is not a book of colours",
                "spectra are read by `impasto.read`",
            )
        return found

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the colours, in the order of the file."""
        return tuple(color.name for color in self._colors)

    def __len__(self) -> int:
        return len(self._colors)

    @overload
    def __getitem__(self, index: int | str) -> BookColor: ...

    @overload
    def __getitem__(self, index: slice) -> list[BookColor]: ...

    def __getitem__(self, index: int | str | slice) -> BookColor | list[BookColor]:
        """A colour by its place, or by its name, in any letter case or the start of it."""
        if isinstance(index, str):
            return self._read(index)[0][0]
        return self._colors[index]

    def __repr__(self) -> str:
        return f"<impasto.ColorBook: {len(self)} colours of {self.path}>"
