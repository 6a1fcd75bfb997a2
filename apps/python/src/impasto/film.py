"""Films of one paint on a white and a black card."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from impasto import _native
from impasto.display import table
from impasto.errors import warn, warnings_of
from impasto.fitting import Surface
from impasto.light import Light, light_of
from impasto.readings import Readings

if TYPE_CHECKING:
    import pandas as pd


class Film:
    """A film that was read over a white and a black card."""

    def __init__(self, about: dict[str, Any]) -> None:
        self.about = about
        """The film with the keys of `impasto film --json`."""

    @property
    def sample(self) -> str:
        """Name of the sample."""
        return str(self.about["sample"])

    @property
    def contrast_ratio(self) -> tuple[float, float]:
        """Y over the black card divided by Y over the white card, and its standard deviation."""
        found = self.about["contrast_ratio"]
        return found["value"], found["deviation"]

    @property
    def hiding(self) -> dict[str, Any] | None:
        """Thickness at which the film hides: factor, thickness_mm, spreading_rate (m2/l), each with value and
        deviation; the last two are None without a thickness. None if no thickness hides."""
        result: dict[str, Any] | None = self.about["hiding"]
        return result

    @property
    def powers(self) -> list[dict[str, Any]]:
        """K and S by wavelength: nm, k_d, k_d_sd, s_d, s_d_sd, k_over_s, and with a thickness k_per_mm,
        k_per_mm_sd, s_per_mm, s_per_mm_sd. Values are None where the film hides."""
        result: list[dict[str, Any]] = self.about["powers"]
        return result

    def to_dataframe(self) -> pd.DataFrame:
        """K and S by wavelength as a table; needs pandas."""
        import pandas as pd

        return pd.DataFrame(self.powers).set_index("nm")

    def __repr__(self) -> str:
        return f"<impasto.Film: {self.sample}, contrast ratio {self.contrast_ratio[0]:.4f}>"

    def _repr_html_(self) -> str:
        keys = ["nm", "k_d", "s_d", "k_over_s"]
        rows = [["" if row[key] is None else f"{row[key]:.4g}" for key in keys] for row in self.powers]
        return table(["nm", "K d", "S d", "K/S"], rows, repr(self).strip("<>"))


def film(
    readings: Readings,
    *,
    sample: str | None = None,
    over_white: str | None = None,
    over_black: str | None = None,
    white_card: str | None = None,
    black_card: str | None = None,
    surface: Surface | None = None,
    specular: bool = True,
    thickness_mm: float | None = None,
    solids: float = 1.0,
    contrast: float = 0.98,
    noise: float | None = None,
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
) -> list[Film]:
    """K d and S d, contrast ratio and hiding power of films on two cards, as `impasto film` computes them.

    The readings hold each film over a white and a black card, and both cards bare (`film` and `backing` of
    the measurement CSV). Without these columns the four names tell them. `thickness_mm` gives K and S by mm
    and the spreading rate, `solids` the film's share of the wet paint. `noise` is the standard deviation of
    one reading.

    Raises `FitError`; findings are told as `FindingWarning`.
    """
    request = {
        "sample": sample,
        "over_white": over_white,
        "over_black": over_black,
        "white_card": white_card,
        "black_card": black_card,
        "surface": None if surface is None else f"{surface.k1},{surface.k2}",
        "specular": "included" if specular else "excluded",
        "thickness_mm": thickness_mm,
        "solids": solids,
        "contrast": contrast,
        "noise": noise,
    }
    light = light_of(illuminant)
    about, remarks = _native.film(readings._native, json.dumps(request), light, observer)
    warn(warnings_of(remarks))
    return [Film(one) for one in json.loads(about)["films"]]
