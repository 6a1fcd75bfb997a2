"""Random arrays into every function that takes arrays: a result or an error, and inputs that stay."""

from __future__ import annotations

import contextlib
import functools
import json
import math
import os
import tempfile
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from conftest import OILS_JSON
from test_maps import envi

import impasto as im

NM = np.arange(400.0, 701.0, 10.0)
OILS = im.Library.load(OILS_JSON)
PIGMENTS = len(OILS)
# As many nodes as the quadrature of the calls below.
NODES = 8
KINDS: list[Any] = [
    *(np.float64,) * 6,
    *(np.float32, np.float16, np.dtype(">f8"), np.int16, np.uint8),
    *(np.bool_, np.complex128, object, "U8", "M8[s]"),
]


def _array(random: np.random.Generator, width: int) -> np.ndarray[Any, Any]:
    """An array that somebody may pass: any shape, order and kind, with NaN and infinities; often with rows of
    `width` numbers from 0 to 1."""
    shape = tuple(random.integers(0, 34, random.integers(0, 4)))
    if random.random() < 0.7:
        shape = ((int(random.integers(0, 5)), width), (width,))[int(random.integers(2))]
    array = np.array(random.random(shape))
    if random.random() < 0.4:
        array = np.array(random.standard_normal(shape) * 10.0 ** random.integers(-3, 9))
    if random.random() < 0.1:
        array = np.array(400 + 10.0 * np.arange(array.size).reshape(shape))
    if random.random() < 0.2 and array.size:
        odd = [np.nan, np.inf, -np.inf, 1e308, -1e308, 5e-324, -0.0]
        array.flat[int(random.integers(array.size))] = random.choice(odd)
    array = array.astype(KINDS[int(random.integers(len(KINDS)))])
    if random.random() < 0.3:
        array = np.asfortranarray(array)
    if random.random() < 0.2 and array.ndim:
        array = array[::-1]
    array.flags.writeable = bool(random.random() < 0.5)
    return array


def _form(random: np.random.Generator, array: np.ndarray[Any, Any]) -> Any:
    """The array, or its numbers as lists."""
    return array.tolist() if random.random() < 0.15 else array


def _state(value: Any) -> object:
    """Everything of an input that a call could change."""
    if isinstance(value, np.ndarray):
        return value.dtype, value.shape, value.strides, value.flags.writeable, value.tobytes()
    return repr(value)


def _numbers(value: Any, count: int) -> list[float]:
    """The first numbers of an input, as many as are asked for."""
    numbers: list[float] = []
    with contextlib.suppress(TypeError, ValueError):
        numbers = np.asarray(value).ravel()[:count].astype(np.float64).tolist()
    return numbers + [0.5] * (count - len(numbers))


def _table(value: Any) -> Any:
    """A DataFrame of an input, with one column a wavelength."""
    pd = pytest.importorskip("pandas")
    array = np.atleast_2d(np.asarray(value))
    array = array.reshape(len(array), math.prod(array.shape[1:]))
    if array.dtype.kind == "M":
        array = array.astype(object)
    if array.dtype == np.float16:
        array = array.astype(np.float32)
    if array.dtype.kind == "f" and not array.dtype.isnative:
        array = array.astype(np.float64)
    frame = pd.DataFrame(array, columns=400 + 10 * np.arange(array.shape[1]))
    # Nullable columns, with pandas.NA where a number is missing.
    return frame if array.flags.writeable else frame.convert_dtypes()


def _readings(value: Any) -> im.Readings:
    """Readings of a white, a blue, and mixtures, the first of which are those of the input."""
    frame = _table(value)
    recipes = np.array([[1, 0], [0, 1], [4, 1], [1, 1], [9, 1]])
    names = ["Zinc White", "Cobalt Blue"]
    parts = np.zeros((5, PIGMENTS))
    parts[:, [OILS.names.index(name) for name in names]] = recipes
    pd = pytest.importorskip("pandas")
    whole = pd.DataFrame(OILS.mix(parts).values, columns=400 + 10 * np.arange(31))
    rows, columns = min(5, len(frame)), min(31, frame.shape[1])
    whole = whole.astype(object)
    whole.iloc[:rows, :columns] = frame.iloc[:rows, :columns].to_numpy(dtype=object)
    for place, name in enumerate(names):
        whole.insert(place, name, recipes[:, place])
    whole.insert(0, "sample", list("abcde"))
    return im.Readings.from_dataframe(whole, names)


@functools.cache
def _two() -> im.Library:
    """A library of the white and the blue."""
    return im.fit(_readings(np.zeros((0, 31)))).library


def _scan(value: Any, folder: str) -> im.Cube:
    """A scan whose first pixels are those of the input."""
    pixels = np.empty((4, 6, 31))
    pixels.flat[:] = _numbers(value, pixels.size)
    return im.Cube.open(envi(Path(folder) / "scan.hdr", pixels, NM))


def _mapped(value: Any) -> object:
    with tempfile.TemporaryDirectory() as folder:
        cube = _scan(value, folder)
        cube.read()
        return im.pigment_map(cube, OILS, Path(folder) / "maps.zarr", palette=OILS.names[:4])


def _ground(value: Any) -> object:
    ground = im.Spectrum(NM, value)
    with tempfile.TemporaryDirectory() as folder:
        return im.survey(_scan(0.4, folder), OILS, ground=ground, palette=OILS.names[:3])


def _planned(first: float, span: float, step: float) -> object:
    return im.plan(["Viridian"], "Zinc White", grid=(400 + first, 700 + span, step))


def _planned_with_noise(constant: float, even: float) -> object:
    return im.plan(["Viridian"], "Zinc White", prior=OILS, noise=(constant, even))


def _json_of(file: str, value: Any, *place: Any) -> str:
    """The text of a file that ships, with the input's numbers at a place."""
    whole = json.loads(OILS_JSON.with_name(file).read_text())
    found = whole
    for key in place[:-1]:
        found = found[key]
    array = np.asarray(value)
    found[place[-1]] = _numbers(value, 31) if array.size == 31 else array.astype(str).tolist()
    return json.dumps(whole)


def _looked_at(value: im.Spectrum) -> object:
    """Everything that a spectrum shows."""
    pytest.importorskip("pandas")
    pytest.importorskip("colour")
    tables = value.to_dataframe(), value.to_colour()
    return tables, repr(value), value._repr_html_(), np.asarray(value), value[0] if len(value) else 0


@dataclass(frozen=True)
class _Call:
    """A call of a function with an array."""

    call: Callable[[Any], object]
    width: int = 31
    """Numbers of a row that fit."""
    part: float = 1.0
    """Arrays of this call, as a part of those of the fastest."""


RULE = im.Quadrature.of(OILS, nodes=NODES, mixtures=0)
CALLS = {
    "xyz": _Call(lambda a: im.color.xyz(a, wavelengths=NM)),
    "xyz, wavelengths": _Call(lambda a: im.color.xyz(np.full(31, 0.5), wavelengths=a)),
    "xyz, DataFrame": _Call(lambda a: im.color.xyz(_table(a)), part=0.1),
    "xyz, Series": _Call(lambda a: im.color.xyz(_table(a).iloc[0] if np.size(a) else _table(a)), part=0.1),
    "xyz, distribution": _Call(
        lambda a: im.color.xyz(SimpleNamespace(wavelengths=NM, values=np.asarray(a).T, name="a"))
    ),
    "lab": _Call(lambda a: im.color.lab(a, "A", "1964-10", wavelengths=NM)),
    "srgb": _Call(lambda a: im.color.srgb(a, wavelengths=NM)),
    "display": _Call(lambda a: im.color.display(a, wavelengths=NM)),
    "delta_e": _Call(lambda a: im.color.delta_e(a, a), 3),
    "delta_e, CIE 1976": _Call(lambda a: im.color.delta_e([50, 3, 4], a, "CIE 1976"), 3),
    "Spectrum": _Call(lambda a: im.Spectrum(NM, a)),
    "Spectrum, wavelengths": _Call(lambda a: im.Spectrum(a, a)),
    "Spectrum, names": _Call(lambda a: im.Spectrum(NM, np.ones((3, 31)), a), 3),
    "Spectrum, shown": _Call(lambda a: _looked_at(im.Spectrum(NM, a)), part=0.05),
    "mix": _Call(lambda a: OILS.mix(a), PIGMENTS),
    "mix, film": _Call(lambda a: OILS.mix(a, thickness=0.5, over=0.5), PIGMENTS),
    "mix, ground": _Call(lambda a: OILS.mix(np.ones(PIGMENTS), over=im.Spectrum(NM, a))),
    "mix, names": _Call(lambda a: OILS.mix(dict(zip(OILS.names, _numbers(a, 3)))), 3),
    "mix, film of numbers": _Call(
        lambda a: OILS.mix(np.ones(PIGMENTS), thickness=_numbers(a, 1)[0], over=_numbers(a, 2)[1]), 2
    ),
    "color": _Call(lambda a: OILS.color(dict(zip(OILS.names, _numbers(a, 3)))), 3),
    "color, ground": _Call(lambda a: OILS.color({"Viridian": 1}, over=im.Spectrum(NM, a))),
    "match": _Call(lambda a: OILS.match(a, wavelengths=NM, at_most=1, count=1), part=0.05),
    "match, colour": _Call(lambda a: OILS.match(a, at_most=1, count=1), 3, 0.1),
    "match, ground": _Call(
        lambda a: OILS.match("#808080", over=im.Spectrum(NM, a), thickness=0.1, at_most=1, count=1),
        part=0.05,
    ),
    "Quadrature.xyz": _Call(lambda a: RULE.xyz(a), NODES),
    "from_dataframe": _Call(_readings, part=0.05),
    "fit": _Call(lambda a: im.fit(_readings(a)), part=0.02),
    "validate": _Call(lambda a: im.validate(_readings(a)), part=0.02),
    "report": _Call(lambda a: im.report(_two(), _readings(a), validate=False), part=0.0002),
    "plan": _Call(lambda a: _planned(*_numbers(a, 3)), 3, part=0.1),
    "plan, noise": _Call(lambda a: _planned_with_noise(*_numbers(a, 2)), 2, part=0.05),
    "survey, ground": _Call(_ground, part=0.02),
    "pigment_map": _Call(_mapped, part=0.01),
    "Library.from_json": _Call(
        lambda a: im.Library.from_json(
            _json_of("van-gogh-oils.pigments.json", a, "pigments", 3, "absorption")
        ),
        part=0.02,
    ),
    "Residuals.from_json": _Call(
        lambda a: im.Residuals.from_json(
            _json_of("van-gogh-oils.residuals.json", a, "mixtures", 0, "measured")
        ),
        part=0.02,
    ),
}


@pytest.mark.parametrize("name", CALLS)
def test_any_array_gives_a_result_or_an_error(name: str) -> None:
    call = CALLS[name]
    random = np.random.default_rng(list(CALLS).index(name))
    arrays = round(call.part * int(os.environ.get("IMPASTO_FUZZ_ARRAYS", "400")))
    if not arrays:
        pytest.skip("seconds an array: set IMPASTO_FUZZ_ARRAYS=100000")
    results = errors = 0
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for _ in range(arrays):
            value = _form(random, _array(random, call.width))
            before = _state(value)
            try:
                call.call(value)
                results += 1
            except im.Error:
                errors += 1
            assert _state(value) == before, "the input was changed"
    print(f"{name}: {results} results, {errors} errors")
    assert arrays < 20 or (results and errors), (results, errors)
