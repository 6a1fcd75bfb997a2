"""Which pigments of a library are where in a scan, how much, and how sure."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from impasto import _native
from impasto.cube import Cube
from impasto.display import listed, table
from impasto.errors import Error, notes_of, warn, warnings_of
from impasto.library import Library
from impasto.residuals import Residuals
from impasto.spectrum import Spectrum

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


class Survey:
    """About 20,000 pixels of a scan, searched whole: the palette found, and all that maps depend on."""

    def __init__(
        self, cube: Cube, library: Library, settings: dict[str, Any], book: str | None, progress: Any
    ) -> None:
        """`settings` holds the request with the keys of `MapRequest` in docs/schema/requests.json, the JSON of
        residuals, and wavelengths and reflectances of the ground."""
        residuals, ground = settings["residuals"], settings["ground"]
        native = _native.Survey(
            cube._native,
            library._native,
            json.dumps(settings["request"]),
            None if residuals is None else _native.Residuals.from_json(residuals),
            # A job of a worker holds it as a list.
            None if ground is None else tuple(ground),
            book,
            progress,
        )
        self._native = native
        self.cube = cube
        """The scan."""
        self.library = library
        """The library."""
        self._settings = settings
        self.about: dict[str, Any] = json.loads(native.about())
        """Palette, groups, hashes and settings, with the keys of `impasto map --json`."""
        warn(self.warnings)

    @property
    def left_out(self) -> list[str]:
        """Pigments that take no part because their S was not measured: others stand in for them."""
        result: list[str] = self.about["left_out"]
        return result

    @property
    def warnings(self) -> list[str]:
        """Warnings about the pigments that take part."""
        return warnings_of(self._native.remarks)

    @property
    def notes(self) -> list[str]:
        """Pigments that take no part, and why."""
        return notes_of(self._native.remarks)

    @property
    def palette(self) -> dict[str, float]:
        """Pigments and groups with the part of the surveyed pixels that hold them, the greatest first."""
        return {found["pigment"]: found["survey_part"] for found in self.about["palette"]}

    @property
    def groups(self) -> dict[str, list[str]]:
        """Pigments that are mapped as one, by the name of the group."""
        result: dict[str, list[str]] = self.about["groups"]
        return result

    def to_json(self) -> str:
        """The survey as JSON, for `survey(.., book=)` and `impasto map --survey`."""
        return self._native.book()

    def __repr__(self) -> str:
        found = sum(part > 0.001 for part in self.palette.values())
        return f"<impasto.Survey: {found} pigments or groups found in {self.cube!r}>"

    def _repr_html_(self) -> str:
        rows = [[n, f"{100 * part:.1f} %"] for n, part in self.palette.items() if part > 0.001]
        alike = [", ".join(names) for names in self.groups.values()]
        whole = table(["pigment", "part of the pixels"], rows, repr(self).strip("<>"))
        whole += listed("Mapped as one, since the bands cannot tell them apart", alike)
        return whole + listed("Notes", self.notes)


@dataclass(frozen=True)
class PigmentMaps:
    """Finished maps on the disk: a Zarr group."""

    path: Path
    """The folder."""

    def to_xarray(self) -> xr.Dataset:
        """The maps as a Dataset: share, share_sd and presence (y, x, pigment), chi2, rms, second, mask (y, x);
        needs xarray and zarr."""
        import xarray as xr

        return xr.open_zarr(self.path)

    def plot(self, pigment: str, what: str = "presence") -> Any:
        """Draws one map of a pigment; needs matplotlib."""
        shown: Any = self.to_xarray()[what].sel(pigment=pigment)
        return shown.plot(yincrease=False, vmin=0, vmax=1)


def survey(
    cube: Cube,
    library: Library,
    *,
    at_most: int = 4,
    palette: Sequence[str] = (),
    groups: Mapping[str, Sequence[str]] | None = None,
    group_alike: bool = True,
    noise: float | None = None,
    model_error: float | None = None,
    residuals: Residuals | str | os.PathLike[str] | None = None,
    penalty: float = 2.0,
    ground: Spectrum | tuple[slice, slice] | None = None,
    region: tuple[slice, slice] | None = None,
    book: str | None = None,
    progress: Callable[[str], object] | None = None,
) -> Survey:
    """Searches about 20,000 pixels of a scan whole, as `impasto map` does before it maps.

    `at_most` pigments of one pixel, 1 to 4; `palette` names those that may take part; `groups` are mapped as
    one, and with `group_alike` also pigments that the bands cannot tell apart. `noise` is the standard
    deviation of a band as a fraction (default: the noise of the white reading, else 0.003). `residuals` are the
    errors of mixtures that the library had not seen, `validate(..).residuals` or their file, or `model_error`
    is the standard deviation of K and S relative to their values (default: the residuals of the oils that
    ship, else 0.1). `ground` is the bare ground, a spectrum or rows and columns of the scan that show it: its
    pixels are told by the mask and not mapped. `region` is rows and columns. `book` takes the JSON of an earlier survey.
    """
    if residuals is not None and model_error is not None:
        raise Error("residuals and model_error exclude each other", "leave one of them out")
    if residuals is not None and not isinstance(residuals, Residuals):
        residuals = Residuals.load(residuals)
    if isinstance(palette, str):
        raise Error(f"palette is a list of names, found `{palette}`", f"try [{palette!r}]")
    if isinstance(ground, Spectrum) and len(ground) != 1:
        raise Error(f"the ground is one spectrum, found {len(ground)}", "choose one: spectra[0]")
    request = {
        "at_most": operator.index(at_most),
        "palette": list(palette),
        "groups": [{"name": n, "pigments": list(names)} for n, names in (groups or {}).items()],
        "apart": not group_alike,
        "noise": None if noise is None else float(noise),
        "model_error": None if model_error is None else float(model_error),
        "penalty": float(penalty),
        "ground": None,
        "region": None if region is None else _text(region, cube),
    }
    settings: dict[str, Any] = {
        "request": request,
        "residuals": None if residuals is None else residuals.to_json(),
        "ground": None,
    }
    if isinstance(ground, Spectrum):
        settings["ground"] = (ground.wavelengths.tolist(), ground.rows[0].tolist())
    elif ground is not None:
        request["ground"] = _text(ground, cube)
    return Survey(cube, library, settings, book, progress)


# A parameter of `pigment_map` has the name of the function.
_surveyed = survey


def _text(region: tuple[slice, slice], cube: Cube) -> str:
    """Rows and columns of a region of a scan as text: the first, and the one after the last."""
    rows, columns = (part.indices(n)[:2] for part, n in zip(region, cube.shape))
    return f"{rows[0]}..{rows[1]},{columns[0]}..{columns[1]}"


def pigment_map(
    cube: Cube,
    library: Library,
    out: str | os.PathLike[str],
    *,
    survey: Survey | None = None,
    resume: bool = False,
    client: Client | None = None,
    progress: Callable[[str], object] | None = None,
    **settings: Any,
) -> PigmentMaps:
    """Maps every pixel of a scan into the Zarr group `out`.

    Works on all cores of this machine, in bounded memory; with a Dask `client` on its workers, which must see
    the scan and `out` under the same paths. One task maps one shard, or some if they are small, and writes
    each; nothing travels but numbers of shards. Shards that workers died of again and again are named by an
    error, once the others are mapped. A shard that exists is finished: `resume` continues a run that was
    ended, and refuses maps of another scan, library or settings. Machines, workers and resumed runs give the
    same bytes. `settings` are those of `survey`.
    """
    found = survey or _surveyed(cube, library, progress=progress, **settings)
    if survey is not None and settings:
        raise Error(f"settings belong to the survey: {', '.join(settings)}", "give them to survey")
    path = Path(out)
    shards = found._native.begin(os.fspath(path), resume)
    if client is None:
        found._native.map(os.fspath(path), progress)
    else:
        from impasto import workers

        workers.map_on_workers(found, path, shards, client, progress)
    return PigmentMaps(path)
