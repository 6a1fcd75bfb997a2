"""The report on a library: figures and one HTML page."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from html import escape
from pathlib import Path

from impasto import _native
from impasto.library import Library
from impasto.light import Light, light_of
from impasto.readings import Readings

_PAGE = "report.html"


class Report:
    """A page with its figures."""

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self.files = files
        """Path inside the report's folder, and content, of each file."""

    @property
    def page(self) -> str:
        """The HTML page, which holds its figures."""
        return self.files[_PAGE].decode()

    def save(self, folder: str | os.PathLike[str]) -> Path:
        """Writes the page and its figures, and returns the path of the page."""
        folder = Path(folder)
        for name, content in self.files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            part = path.with_name(path.name + ".part")
            part.write_bytes(content)
            part.replace(path)
        return folder / _PAGE

    def __repr__(self) -> str:
        return f"<impasto.Report: {len(self.files)} files>"

    def _repr_html_(self) -> str:
        page = escape(self.page, quote=True)
        return f'<iframe srcdoc="{page}" style="width:100%;height:40em;border:0"></iframe>'


def report(
    library: Library,
    readings: Readings | None = None,
    *,
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
    pair: tuple[str, str] | None = None,
    validate: bool = True,
    progress: Callable[[str], object] | None = None,
) -> Report:
    """Draws a report on a library, as `impasto report` does; with readings also measured against
    predicted films and, if `validate`, errors of left-out mixtures."""
    native = None if readings is None else readings._native
    request = json.dumps({"pair": pair, "no_validation": not validate})
    files = _native.report(
        library._native, native, request, light_of(illuminant), observer, progress
    )
    return Report({path: bytes(content) for path, content in files})
