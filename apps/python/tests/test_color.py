"""Colours against colour-science and its golden figures, and whatever a user may pass."""

from __future__ import annotations

import math
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
    with pytest.raises(im.Error, match="not a wavelength"):
        im.color.xyz(frame.assign(note=1.0))


def test_tables_with_gaps_and_names_of_tables() -> None:
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame(np.full((2, 31), 0.2), columns=NM, index=["a", "b"]).convert_dtypes()
    frame.iloc[0, 3] = pd.NA
    assert np.isnan(im.color.xyz(frame)).all(axis=1).tolist() == [True, False]
    assert im.Spectrum(NM, np.full((2, 31), 0.2), frame.index).names == ("a", "b")
    with pytest.raises(im.Error, match="complex"):
        im.color.xyz(pd.DataFrame(np.full((2, 31), 0.2j), columns=NM))


def test_lights_by_name_temperature_and_mistake() -> None:
    light = im.Light("5600K")
    assert light.name == "black body 5600 K" and light.power.shape == (471,)
    with pytest.raises(im.Error, match="F11") as error:
        im.Light("F11")
    assert "FL11" in str(error.value)


def test_odd_grids_are_refused() -> None:
    for nm in ([400, 410, 430], [700, 690, 680], [400], [math.nan, 410, 420]):
        with pytest.raises(im.Error):
            im.Spectrum(nm, np.full(len(nm), 0.5))
