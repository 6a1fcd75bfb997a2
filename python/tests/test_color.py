"""Colours against colour-science and its golden figures, and whatever a user may pass."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import impasto as im

NM = np.arange(400.0, 701.0, 10.0)


def test_xyz_is_that_of_colour_science(golden: Any) -> None:
    file = golden("xyz")
    checked = 0
    for case in file["cases"]:
        if case["interpolation"] != "sprague":
            continue
        observer = case["observer"].removeprefix("cie-")
        for name, expected in case["samples"].items():
            sample = file["reflectances"][name]
            nm = sample["start_nm"] + sample["step_nm"] * np.arange(len(sample["values"]))
            value = im.Spectrum(nm, sample["values"])
            found = im.color.xyz(value, case["illuminant"], observer)
            assert np.allclose(found, expected, atol=1e-9, rtol=1e-9), (case["illuminant"], name)
            checked += 1
    assert checked > 100


def test_differences_are_those_of_sharma(golden: Any) -> None:
    cases = golden("sharma")["cases"]
    first = np.array([case["reference"] for case in cases])
    second = np.array([case["sample"] for case in cases])
    expected = [case["ciede2000"] for case in cases]
    assert np.allclose(im.color.delta_e(first, second), expected, atol=1e-9)
    assert im.color.delta_e([50, 0, 0], [50, 3, 4], method="CIE 1976") == 5.0


def test_one_and_many_agree() -> None:
    values = np.random.default_rng(3).random((7, 31))
    many = im.color.lab(values, wavelengths=NM)
    assert many.shape == (7, 3)
    for row, lab in zip(values, many):
        assert np.array_equal(im.color.lab(row, wavelengths=NM), lab)
    with pytest.raises(im.Error, match="needs its wavelengths"):
        im.color.xyz(values)


def test_colours_pass_to_colour_science_and_back() -> None:
    colour = pytest.importorskip("colour")
    foliage = colour.SDS_COLOURCHECKERS["BabelColor Average"]["foliage"]
    ours = im.color.xyz(foliage, observer="1931-2")
    assert ours.shape == (3,) and 10 < ours[1] < 20
    spectrum = im.Spectrum(NM, np.linspace(0.1, 0.9, 31), ["ramp"])
    assert np.array_equal(spectrum.to_colour().values, spectrum.values)
    several = im.Spectrum(NM, np.random.default_rng(4).random((3, 31)), ["a", "b", "c"])
    multi = several.to_colour()
    assert np.allclose(im.color.xyz(multi), im.color.xyz(several))


def test_colours_of_a_dataframe() -> None:
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame(np.full((2, 31), 0.2), columns=NM, index=["a", "b"])
    assert np.allclose(im.color.xyz(frame)[:, 1], 20.0)
    assert np.allclose(im.color.xyz(frame.loc["a"])[1], 20.0)
    with pytest.raises(im.Error, match="no wavelength"):
        im.color.xyz(frame.assign(note=1.0))


def test_lights_by_name_temperature_and_mistake() -> None:
    light = im.Light("5600K")
    assert light.name == "black body 5600 K" and light.power.shape == (471,)
    with pytest.raises(im.Error, match="F11") as error:
        im.Light("F11")
    assert "FL11" in str(error.value)


def _array(random: np.random.Generator) -> Any:
    """An array that somebody may pass: any shape, order and kind, with NaN and infinities."""
    shape = tuple(random.integers(0, 34, random.integers(0, 4)))
    if random.random() < 0.5:
        shape = (int(random.integers(0, 5)), 31)
    kinds = [np.float64, np.float32, np.int16, np.uint8, np.bool_, np.complex128, object]
    array = np.array(random.standard_normal(shape) * 10.0 ** random.integers(-3, 9))
    if random.random() < 0.3 and array.size:
        array.flat[int(random.integers(array.size))] = random.choice([np.nan, np.inf, -np.inf])
    with np.errstate(all="ignore"):
        array = array.astype(kinds[int(random.integers(len(kinds)))])
    if random.random() < 0.3:
        array = np.asfortranarray(array)
    if random.random() < 0.2 and array.ndim:
        array = array[::-1]
    array.flags.writeable = bool(random.random() < 0.5)
    return array


def test_any_array_gives_a_result_or_an_error(oils: im.Library) -> None:
    calls: list[Callable[[Any], object]] = [
        lambda a: im.color.xyz(a, wavelengths=NM),
        lambda a: im.color.srgb(a, wavelengths=NM),
        lambda a: im.color.display(a, wavelengths=NM),
        lambda a: im.color.delta_e(a, a),
        lambda a: im.Spectrum(NM, a),
        lambda a: im.Spectrum(a, a),
        lambda a: oils.mix(a),
        lambda a: oils.mix(a, thickness=0.5, over=0.5),
    ]
    random = np.random.default_rng(5)
    # 12500 arrays are 100,000 calls.
    arrays = int(os.environ.get("IMPASTO_FUZZ_ARRAYS", "400"))
    results = errors = 0
    with np.errstate(all="ignore"):
        for _ in range(arrays):
            array = _array(random)
            before = array.copy()
            for call in calls:
                try:
                    call(array)
                    results += 1
                except im.Error:
                    errors += 1
            assert array.tobytes() == before.tobytes(), "the input was changed"
    assert results > 200 and errors > 200


def test_odd_grids_are_refused() -> None:
    for nm in ([400, 410, 430], [700, 690, 680], [400], [math.nan, 410, 420]):
        with pytest.raises(im.Error):
            im.Spectrum(nm, np.full(len(nm), 0.5))
