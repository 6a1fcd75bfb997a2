"""Two sets of measurements compared sample by sample."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from impasto import _native
from impasto.display import table
from impasto.errors import warn, warnings_of
from impasto.light import Light, light_of
from impasto.readings import Readings

if TYPE_CHECKING:
    import pandas as pd


class Comparison:
    """Two sets of measurements, compared by the names of their samples."""

    def __init__(self, about: dict[str, Any]) -> None:
        self.about = about
        """The comparison with the keys of `impasto color --against --json`: mean, p95, max, shift, failed,
        only_first, only_second and others."""

    @property
    def samples(self) -> list[dict[str, Any]]:
        """Each sample: sample, ciede2000, cie1976, dl, da, db, passes (None without a tolerance)."""
        result: list[dict[str, Any]] = self.about["samples"]
        return result

    @property
    def passed(self) -> bool | None:
        """Whether every sample is within the tolerance; None without one."""
        return None if self.about["tolerance"] is None else self.about["failed"] == 0

    def to_dataframe(self) -> pd.DataFrame:
        """The samples as a table; needs pandas."""
        import pandas as pd

        return pd.DataFrame(self.samples).set_index("sample")

    def __repr__(self) -> str:
        mean, largest = self.about["mean"], self.about["max"]
        return f"<impasto.Comparison: {len(self.samples)} samples, mean {mean:.2f}, largest {largest:.2f}>"

    def _repr_html_(self) -> str:
        worst = sorted(self.samples, key=lambda entry: -entry["ciede2000"])[:200]
        rows = [[entry["sample"], f"{entry['ciede2000']:.2f}"] for entry in worst]
        return table(["sample", "CIEDE2000"], rows, repr(self).strip("<>"))


def compare(
    readings: Readings,
    against: Readings,
    *,
    tolerance: float | None = None,
    illuminant: str | Light = "D65",
    observer: str = "1931-2",
) -> Comparison:
    """Compares the samples of `readings` with the samples of the same names in `against`, the standard.

    `tolerance` is the largest CIEDE2000 that passes. Samples that only one set has are told as
    `FindingWarning`.
    """
    request = json.dumps({"tolerance": tolerance})
    light = light_of(illuminant)
    about, remarks = _native.compare(readings._native, against._native, request, light, observer)
    warn(warnings_of(remarks))
    return Comparison(json.loads(about))
