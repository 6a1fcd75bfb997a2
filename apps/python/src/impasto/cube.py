"""Spectral scans, read in blocks of any size."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from impasto import _native
from impasto.errors import Error, notes_of, warn, warnings_of

if TYPE_CHECKING:
    import xarray as xr

    from impasto.spectrum import Floats

MASKS = (
    "mapped",
    "ignored",
    "not finite",
    "too dark",
    "saturated",
    "out of range",
    "out of gamut",
    "bare ground",
)
"""Names of the numbers of a mask."""


class Cube:
    """A spectral scan: reflectance by row, column and band. Nothing is read until it is asked for."""

    def __init__(self, native: _native.Cube, path: str, options: dict[str, Any]) -> None:
        self._native = native
        self.path = path
        """Path as it was given."""
        self._options = options

    @classmethod
    def open(
        cls,
        path: str | os.PathLike[str],
        *,
        white_reading: str | os.PathLike[str] | None = None,
        dark_reading: str | os.PathLike[str] | None = None,
        tile: float = 1.0,
        percent: bool | None = None,
        scale: float | None = None,
        full_scale: float | None = None,
        wavelengths: str | os.PathLike[str] | None = None,
        variable: str | None = None,
    ) -> Cube:
        """Opens ENVI (the `.hdr` or the data), a folder of a Specim camera, Zarr 3, spectral OpenEXR, or a
        folder of one picture a band.

        Scans of raw counts need `white_reading` and `dark_reading` (`"0"` where it is subtracted already);
        `tile` is the white's own reflectance. `percent` states the unit; `scale` is the number that a white reads,
        such as 10000. `wavelengths` is a file of them
        for scans that name none, `variable` the array of a Zarr group that holds several.
        """
        scales = {None: None, True: "percent", False: "fraction"}
        options = {
            "white_reading": None if white_reading is None else os.fspath(white_reading),
            "dark_reading": None if dark_reading is None else os.fspath(dark_reading),
            "tile": float(tile),
            "scale": scales[percent] if scale is None else float(scale),
            "full_scale": None if full_scale is None else float(full_scale),
            "wavelengths": None if wavelengths is None else os.fspath(wavelengths),
            "variable": variable,
        }
        if percent is not None and scale is not None:
            raise Error("percent and scale exclude each other", "leave one of them out")
        if not 0 < tile <= 1.2:
            raise Error(f"tile is a reflectance above 0 and up to 1.2, found {tile}")
        return cls._opened(os.fspath(path), options)

    @classmethod
    def _opened(cls, path: str, options: dict[str, Any]) -> Cube:
        """Opens a scan with the keys of `CubeOptions` in docs/schema/requests.json."""
        cube = cls(_native.Cube.open(path, json.dumps(options)), path, options)
        warn(cube.warnings)
        return cube

    @property
    def shape(self) -> tuple[int, int, int]:
        """Rows, columns, bands."""
        return self._native.shape

    @property
    def wavelengths(self) -> Floats:
        """Wavelengths of the bands in nm, rising."""
        return self._native.wavelengths

    @property
    def notes(self) -> list[str]:
        """How the file was understood."""
        return notes_of(self._native.remarks)

    @property
    def warnings(self) -> list[str]:
        """Guesses about the file, and parts of it that are left out."""
        return warnings_of(self._native.remarks)

    def read(
        self, rows: slice = slice(None), columns: slice = slice(None)
    ) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
        """Reflectance (rows, columns, bands) and mask (rows, columns) of a rectangle; `MASKS` names the
        numbers of the mask, 0 is a pixel that can be mapped."""
        ends = []
        for part, count in zip((rows, columns), self.shape):
            start, stop, step = part.indices(count)
            if step != 1:
                raise Error(f"a rectangle has steps of 1, found {step}", "slice the array instead")
            ends.append((start, max(start, stop)))
        return self._native.read(ends[0], ends[1])

    def to_xarray(self, chunk: int = 256) -> xr.DataArray:
        """The scan as an array (y, x, wavelength) that reads blocks of `chunk` rows when they are asked for;
        needs xarray and dask."""
        import dask.array as da
        import xarray as xr
        from dask.delayed import delayed

        lines, samples, bands = self.shape

        def block(start: int, stop: int) -> NDArray[np.float32]:
            return self.read(slice(start, stop))[0]

        parts = []
        for start in range(0, lines, chunk):
            stop = min(start + chunk, lines)
            shape = (stop - start, samples, bands)
            parts.append(da.from_delayed(delayed(block)(start, stop), shape, np.float32))
        return xr.DataArray(
            da.concatenate(parts),
            dims=("y", "x", "wavelength"),
            coords={
                "y": np.arange(lines),
                "x": np.arange(samples),
                "wavelength": ("wavelength", self.wavelengths, {"units": "nm"}),
            },
            name="reflectance",
            attrs={"path": self.path},
        )

    def __reduce__(self) -> tuple[Any, tuple[str, dict[str, Any]]]:
        return Cube._opened, (self.path, self._options)

    def __repr__(self) -> str:
        lines, samples, bands = self.shape
        nm = self.wavelengths
        return f"<impasto.Cube: {lines} x {samples} pixels, {bands} bands, {nm[0]:g} to {nm[-1]:g} nm>"
