"""Colours of reflectances: XYZ with Y = 100 for the white, CIELAB, sRGB, differences.

Each function takes one spectrum or many: a `Spectrum`, an array with `wavelengths`, a pandas DataFrame or
Series whose labels are wavelengths, or a spectral distribution of colour-science.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from impasto import _native
from impasto.errors import Error
from impasto.light import Light, light_of
from impasto.spectrum import Floats, floats, grid_of, spectrum

__all__ = ["delta_e", "display", "lab", "srgb", "xyz"]


def _xyz(
    value: Any, wavelengths: ArrayLike | None, illuminant: str | Light, observer: str
) -> tuple[Floats, tuple[float, float, float], bool]:
    """XYZ as (M, 3), XYZ of the white, and whether there was one spectrum only."""
    if isinstance(value, np.ndarray) and wavelengths is not None:
        rows, grid = floats(value, "values", (1, 2)), grid_of(floats(wavelengths, "wavelengths", (1,)))
        if rows.shape[-1] != grid[2]:
            raise Error(f"values has shape {rows.shape}, but there are {grid[2]} wavelengths")
    else:
        found = spectrum(value, wavelengths)
        rows, grid = found.values, found.grid
    single = rows.ndim == 1
    result, white = _native.xyz(np.atleast_2d(rows), grid, light_of(illuminant), observer)
    return result, white, single


def xyz(
    reflectance: Any,
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
    *,
    wavelengths: ArrayLike | None = None,
) -> Floats:
    """XYZ, shape (3,) of one spectrum, (M, 3) of many (CIE 15:2018, section 7.1; 1 nm, Sprague
    interpolation, end values held). Observers: `1931-2`, `1964-10`."""
    result, _, single = _xyz(reflectance, wavelengths, illuminant, observer)
    return result[0] if single else result


def lab(
    reflectance: Any,
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
    *,
    wavelengths: ArrayLike | None = None,
) -> Floats:
    """CIELAB relative to the light's own white, shape (3,) or (M, 3)."""
    result, white, single = _xyz(reflectance, wavelengths, illuminant, observer)
    values, _ = _native.rgb(result, white)
    return values[0] if single else values


def srgb(
    reflectance: Any,
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
    *,
    wavelengths: ArrayLike | None = None,
) -> Floats:
    """Encoded sRGB, adapted from the light to the display (Bradford); outside 0 to 1 where sRGB cannot
    show the colour. Shape (3,) or (M, 3)."""
    result, white, single = _xyz(reflectance, wavelengths, illuminant, observer)
    _, values = _native.rgb(result, white)
    return values[0] if single else values


def display(
    reflectance: Any,
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
    *,
    wavelengths: ArrayLike | None = None,
) -> list[str]:
    """The nearest displayable colour of each spectrum as `#rrggbb`."""
    values = np.atleast_2d(srgb(reflectance, illuminant, observer, wavelengths=wavelengths))
    values = np.where(np.isfinite(values), values, 0.0)
    bytes_ = np.floor(np.clip(values, 0.0, 1.0) * 255.0 + 0.5).astype(int)
    return ["#%02x%02x%02x" % tuple(row) for row in bytes_]


def delta_e(first: ArrayLike, second: ArrayLike, method: str = "CIE 2000") -> Floats | float:
    """Difference of CIELAB colours, each (3,) or (M, 3): `CIE 2000` or `CIE 1976`."""
    if method not in ("CIE 2000", "CIE 1976"):
        raise Error(f"unknown method `{method}`", "methods are CIE 2000 and CIE 1976")
    a, b = floats(first, "first", (1, 2)), floats(second, "second", (1, 2))
    try:
        both = np.broadcast_arrays(np.atleast_2d(a), np.atleast_2d(b))
    except ValueError:
        raise Error(f"colours of shapes {a.shape} and {b.shape} do not fit together") from None
    if both[0].shape[-1] != 3:
        raise Error(f"a colour has L, a and b, found shape {a.shape}")
    one, two = (np.ascontiguousarray(c) for c in both)
    result = _native.delta_e(one, two, method == "CIE 1976")
    return float(result[0]) if a.ndim == b.ndim == 1 else result
