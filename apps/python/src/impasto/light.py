"""Lights."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from impasto import _native

if TYPE_CHECKING:
    from impasto.spectrum import Floats


class Light:
    """A light: relative power from 360 to 830 nm at 1 nm.

    `Light("D65")` is a CIE illuminant, `Light("5600K")` a black body, `Light("D5600K")` CIE daylight,
    `Light.read("lamp.spdx")` a measured lamp.
    """

    def __init__(self, name: str) -> None:
        self._native = _native.Light(name)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Light:
        """A lamp from the file of an instrument; `FILE#NAME` chooses one of several."""
        return cls(os.fspath(path))

    @property
    def name(self) -> str:
        """Name of the light."""
        return self._native.name

    @property
    def remarks(self) -> list[str]:
        """How the file of a lamp was read: its interpolation, and photons that became power."""
        return self._native.remarks

    @property
    def wavelengths(self) -> Floats:
        """360 to 830 nm."""
        return self._native.wavelengths

    @property
    def power(self) -> Floats:
        """Relative power at each wavelength."""
        return self._native.power

    def __repr__(self) -> str:
        return f"<impasto.Light: {self.name}>"


def light_of(light: str | Light) -> _native.Light:
    """The native light of a name or a `Light`."""
    return (light if isinstance(light, Light) else Light(light))._native
