"""Pigments of spectra that were measured at points."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import impasto as im


def test_pigments_of_known_mixtures_are_found(oils: im.Library) -> None:
    known = [{"Lead White": 0.9, "Ultramarine": 0.1}, {"Chrome Yellow": 1.0}]
    spectra = oils.mix(known)
    named = im.Spectrum(spectra.wavelengths, spectra.values, ["sky", "sun"])
    found = im.identify(named, oils)
    assert [spot.name for spot in found] == ["sky", "sun"]
    assert all(spot.result == "mapped" for spot in found)
    blue = next(p for p in found[0].pigments if "Ultramarine" in p.name)
    assert abs(blue.share - 0.1) < 0.05 and blue.presence > 0.5 and blue.share_sd > 0
    best = found[1].sets[0]
    assert "Chrome Yellow" in best.shares and 0 < best.probability <= 1
    assert found[1].mapped is not None and found[1].chi2 is not None and found[1].chi2 < 1
    assert np.abs(found[1].mapped.values - spectra.values[1]).max() < 0.03
    assert found.left_out == ["Zinc White (linseed)", "Chrome Yellow (poppyseed)"]
    assert "masstones only" in found.notes[0] and "`palette`" in found.notes[0]
    assert "sky" in str(found[0]) and "sky" in found._repr_html_()


def test_a_spectrum_unlike_paint_is_told(oils: im.Library) -> None:
    comb = np.where(np.arange(len(oils.wavelengths)) % 4 < 2, 0.05, 0.9)
    found = im.identify(im.Spectrum(oils.wavelengths, comb), oils)
    assert found[0].result == "out of gamut" and not found[0].pigments and not found[0].sets
    assert found[0].name == "spectrum 1" and found[0].rms is not None


def test_settings_are_checked(oils: im.Library) -> None:
    one = oils.mix({"Viridian": 1.0})
    with pytest.raises(im.Error, match="1 to 4"):
        im.identify(one, oils, at_most=7)
    with pytest.raises(im.Error, match="exclude"):
        im.identify(one, oils, model_error=0.1, residuals="residuals.json")
    with pytest.warns(im.FindingWarning, match="off by a factor of 4"):
        im.identify(one, oils, palette=["Viridian", "Zinc White (linseed)"])


def test_the_number_of_a_white_is_given_or_guessed(tmp_path: Path) -> None:
    values = np.full((2, 3, 4), 8000, "<u2")
    header = (
        "ENVI\nsamples = 3\nlines = 2\nbands = 4\ndata type = 12\ninterleave = bsq\n"
        "wavelength units = nm\nwavelength = {400, 500, 600, 700}\n"
    )
    (tmp_path / "scan.img").write_bytes(values.tobytes())
    (tmp_path / "scan.hdr").write_text(header)
    with pytest.raises(im.Error, match="not reflectances") as error:
        im.Cube.open(tmp_path / "scan.hdr")
    assert error.value.hint and "scale=10000" in error.value.hint
    cube = im.Cube.open(tmp_path / "scan.hdr", scale=16_000)
    assert np.allclose(cube.read()[0], 0.5) and "byte order" in cube.notes[0]
    with pytest.raises(im.Error, match="exclude"):
        im.Cube.open(tmp_path / "scan.hdr", scale=16_000, percent=True)
    (tmp_path / "scan.hdr").write_text(header + "data units = Reflectance\n")
    with pytest.warns(im.FindingWarning, match="read 10000"):
        guessed = im.Cube.open(tmp_path / "scan.hdr")
    assert np.allclose(guessed.read()[0], 0.8)
