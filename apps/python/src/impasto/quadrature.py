"""A few wavelengths that reproduce colour under a light."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from impasto import _native
from impasto.errors import Error
from impasto.library import Library
from impasto.light import Light, light_of
from impasto.spectrum import Floats, floats


@dataclass(frozen=True)
class Quadrature:
    """Wavelengths, and weights that turn reflectance there into XYZ."""

    nodes: Floats
    """Wavelengths in nm, (n,)."""
    weights: Floats
    """Weights of X, Y and Z at each, (n, 3)."""
    about: dict[str, Any]
    """Everything, with the keys of `impasto quadrature --json`: also the colour error over mixtures."""

    @classmethod
    def of(
        cls,
        library: Library | None = None,
        illuminant: str | Light = "D65",
        observer: str = "1931-2",
        *,
        nodes: int = 8,
        method: str | None = None,
        mixtures: int = 1000,
        seed: int = 1,
    ) -> Quadrature:
        """Chooses wavelengths by `gauss`, `moments` (the default without a library), `library` or
        `effective` (the default with a library), and tests them on random mixtures of the library. `about`
        holds K and S of the pigments at the wavelengths of `effective`."""
        native = None if library is None else library._native
        request = {"method": method, "nodes": nodes, "mixtures": mixtures, "seed": seed}
        text = _native.quadrature(native, json.dumps(request), light_of(illuminant), observer)
        about = json.loads(text)
        return cls(np.array(about["nodes_nm"]), np.array(about["weights"]), about)

    def xyz(self, reflectance: ArrayLike) -> Floats:
        """XYZ of reflectance at the nodes, (n,) or (M, n)."""
        values = floats(reflectance, "reflectance", (1, 2))
        if values.shape[-1] != len(self.nodes):
            raise Error(f"reflectance has shape {values.shape}, but there are {len(self.nodes)} nodes")
        result: Floats = values @ self.weights
        return result
