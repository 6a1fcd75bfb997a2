"""Plans of swatches to prepare."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

from impasto import _native
from impasto.display import table
from impasto.errors import Error, warn, warnings_of
from impasto.library import Library

if TYPE_CHECKING:
    import pandas as pd


class Plan:
    """Swatches to prepare, so that a fit identifies K and S of every pigment."""

    def __init__(self, about: dict[str, Any], form: bytes, recipes: bytes) -> None:
        self.about = about
        """The plan with the keys of `impasto plan --json`."""
        self.form = form
        """The empty measurement file (CSV) to be filled in."""
        self.recipes = recipes
        """Recipes of its readings (CSV), for files of an instrument; `reading` names each of them."""

    @property
    def swatches(self) -> list[dict[str, Any]]:
        """Each swatch: sample, purpose, parts, grams, why."""
        result: list[dict[str, Any]] = self.about["swatches"]
        return result

    @property
    def totals(self) -> dict[str, float]:
        """Grams of each paint that all swatches need."""
        result: dict[str, float] = self.about["totals_g"]
        return result

    @property
    def loss(self) -> dict[str, Any] | None:
        """Loss against the default number of swatches: full_swatches, spare_swatches, left_out,
        full_relative_deviations (with a prior). None if there is none."""
        result: dict[str, Any] | None = self.about["loss"]
        return result

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the measurement file; an existing file is not overwritten, since it may hold readings."""
        self._save(path, self.form)

    def save_recipes(self, path: str | os.PathLike[str]) -> None:
        """Writes the recipes, for `Readings.read(.., recipes=path)`; an existing file is not overwritten."""
        self._save(path, self.recipes)

    def _save(self, path: str | os.PathLike[str], content: bytes) -> None:
        try:
            with open(path, "xb") as file:
                file.write(content)
        except FileExistsError:
            message = f"{os.fspath(path)}: exists already and is not overwritten"
            raise Error(message, "give another name, or remove the file first") from None

    def to_dataframe(self) -> pd.DataFrame:
        """Grams of each paint in each swatch; needs pandas."""
        import pandas as pd

        rows = {swatch["sample"]: swatch["grams"] for swatch in self.swatches}
        return pd.DataFrame.from_dict(rows, orient="index", columns=list(self.totals)).fillna(0.0)

    def __repr__(self) -> str:
        return f"<impasto.Plan: {len(self.swatches)} swatches of {len(self.totals)} paints>"

    def _repr_html_(self) -> str:
        rows = [
            [s["sample"], " + ".join(f"{g:g} g {n}" for n, g in s["grams"].items()), s["why"]]
            for s in self.swatches
        ]
        return table(["swatch", "recipe", "why"], rows, repr(self).strip("<>"))


def plan(
    pigments: Sequence[str],
    white: str,
    *,
    black: str | None = None,
    prior: Library | None = None,
    swatches: int | Literal["fewest"] | None = None,
    minutes: float | None = None,
    minutes_each: float = 10.0,
    grams: float = 10.0,
    balance: float = 0.01,
    noise: tuple[float, float] | None = None,
    grid: tuple[float, float, float] = (400.0, 700.0, 10.0),
    replicates: int = 2,
) -> Plan:
    """Plans the swatches to prepare, as `impasto plan` does.

    With `prior`, a library of similar paint, they are chosen to determine K and S best (D-optimal).
    `swatches` is their number, or "fewest" for one per unknown; `minutes` plans as many as fit in this time, at
    `minutes_each`. A warning says what a short plan loses. `grams` is the paint in one swatch, `balance` the step of the balance, `noise` the standard deviations
    of instrument and mixing. `grid` (first, last, step in nm) and `replicates` shape the form.
    """
    if isinstance(pigments, str):
        raise Error(f"pigments is a list of names, found `{pigments}`", f"try [{pigments!r}]")
    first, last, step = grid
    steps = (last - first) / step if step > 0 and last > first else 0.0
    count = round(steps) + 1 if steps <= 5001 else 0
    if not 2 <= count <= 5001 or not 1 <= replicates <= 100:
        raise Error("a form has 2 to 5001 wavelengths and 1 to 100 readings of each film")
    request = {
        "black": black,
        "swatches": swatches,
        "minutes": minutes,
        "minutes_each": minutes_each,
        "grams": grams,
        "balance": balance,
        "noise": None if noise is None else ",".join(str(error) for error in noise),
    }
    native = None if prior is None else prior._native
    form_of = ((first, step, count), replicates)
    about, files, remarks = _native.plan(list(pigments), white, json.dumps(request), native, form_of)
    warn(warnings_of(remarks))
    return Plan(json.loads(about), *(bytes(file) for file in files))
