"""Fits, validations, plans and reports are those of the program."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import OILS_CSV, OILS_JSON, ROOT

import impasto as im
from impasto import _native

SOURCE = (
    "Geldof, Proano Gaibor, Ligterink, Hendriks, Kirchner, Heritage Science 6:17 (2018), "
    "doi 10.1186/s40494-018-0181-6"
)


def shipped_fit(progress: Callable[[str], object] | None = None) -> im.Fit:
    name, table = "measurements/van-gogh-oils.csv", OILS_CSV.read_bytes()
    readings = im.Readings(_native.Readings.from_csv(name, table, None, None))
    return im.fit(
        readings,
        reference="Zinc White",
        surface=im.Surface(k1=0.03, k2=0.6),
        below_surface="floor",
        title="Van Gogh's oils",
        licence="CC0 1.0",
        source=SOURCE,
        progress=progress,
    )


def test_a_fit_is_the_shipped_library_byte_for_byte() -> None:
    with pytest.warns(im.FindingWarning):
        fit = shipped_fit()
    assert fit.library.to_json() == OILS_JSON.read_text()
    assert len(fit.samples) == fit._errors["samples"]


def test_a_fit_tells_its_stages_and_findings() -> None:
    stages: list[str] = []
    with pytest.warns(im.FindingWarning) as told:
        fit = shipped_fit(progress=stages.append)
    assert any("refinement" in stage for stage in stages), stages
    assert {str(warning.message) for warning in told} == set(fit.warnings)
    assert "Worst samples" in fit._repr_html_() and fit._repr_html_().count("Warnings") == 1
    assert round(fit.delta_e["mean"], 2) == 1.39, "as docs/guide/figures.md says"


def test_an_unknown_white_is_a_fit_error_with_a_hint(readings: im.Readings) -> None:
    with pytest.raises(im.FitError, match="Zink White") as error:
        im.fit(readings, reference="Zink White")
    assert error.value.hint and "Zinc White" in str(error.value)


def test_a_fault_in_a_file_has_its_place(tmp_path: Path) -> None:
    path = tmp_path / "bad.csv"
    path.write_text("sample,White,400,410,420\na,1,0.5,0.5,0.5\nb,1,0.5,wrong,0.5\n")
    with pytest.raises(im.ReadingError) as error:
        im.read(path)
    place = error.value.place
    assert place is not None and (place.file, place.row, place.column) == (str(path), 3, "410")


def test_values_without_their_quantity_or_wavelengths_are_stated(tmp_path: Path) -> None:
    path = tmp_path / "values.txt"
    path.write_text("Red\t1.0\t0.7\t0.2\t0.1\nBlue\t0.3\t0.4\t0.7\t1.0\n")
    ways: list[str | list[float]] = [[400, 500, 600, 700], "400..700:100"]
    for wavelengths in ways:
        with pytest.warns(im.FindingWarning) as told:
            found = im.read(path, values="absorbance", wavelengths=wavelengths, spectra_only=True)
        assert any("10^-A" in str(warning.message) for warning in told)
        assert found.spectra.names == ("Red", "Blue")
        assert np.allclose(found.spectra.rows[0], 10 ** -np.array([1.0, 0.7, 0.2, 0.1]))
    with pytest.raises(im.ReadingError, match="needed for each of 3 wavelengths"):
        im.read(path, wavelengths=[400, 500, 600])
    with pytest.raises(im.ReadingError, match="moonlight"):
        im.read(path, values="moonlight", wavelengths="400..700:100")


def test_a_lamp_tells_how_it_was_read(tmp_path: Path) -> None:
    path = tmp_path / "lamp.csv"
    rows = [f"{nm},{np.exp(-(((nm - 560) / 90) ** 2)):.6f}" for nm in range(380, 781, 10)]
    path.write_text("nm,QNTM\n" + "\n".join(rows) + "\n")
    remarks = im.Light.read(path).remarks
    assert any("divided by wavelength" in remark for remark in remarks)
    assert any("Sprague" in remark for remark in remarks)
    assert im.Light("D65").remarks == []


def test_a_missing_file_is_an_os_error(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="missing.csv") as error:
        im.read(tmp_path / "missing.csv")
    assert isinstance(error.value, im.FileError) and error.value.hint


def test_a_dataframe_reads_as_its_file(readings: im.Readings) -> None:
    pd = pytest.importorskip("pandas")
    frame = pd.read_csv(OILS_CSV)
    same = im.Readings.from_dataframe(frame)
    assert same.pigments == readings.pigments and same.samples == readings.samples
    assert (same.reflectance.values == readings.reflectance.values).all()
    assert readings.to_dataframe().shape == (len(readings), 2 + len(readings.pigments) + 31)


def test_a_dataframe_with_a_bad_cell_names_it() -> None:
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame({"sample": ["a"], "White": [1.0], 400: [0.5], 410: [-3.0], 420: [0.4]})
    with pytest.raises(im.ReadingError, match="DataFrame, row 2, column `410"):
        im.Readings.from_dataframe(frame)


def test_a_missing_or_complex_cell_is_told_as_such() -> None:
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame({"sample": ["a", "b"], "White": [1.0, pd.NA], "Blue": [pd.NA, 1.0]})
    for nm in (400, 410, 420):
        frame[nm] = [0.5, 0.4]
    assert im.Readings.from_dataframe(frame).amounts.tolist() == [[1.0, 0.0], [0.0, 1.0]]
    frame[410] = [0.5, 0.4 + 0.1j]
    with pytest.raises(im.ReadingError, match=r"column `410`.*j\)"):
        im.Readings.from_dataframe(frame)


def test_a_plan_with_impossible_numbers_is_refused(oils: im.Library) -> None:
    infinite = float("inf")
    with pytest.raises(im.Error, match="2 to 5001 wavelengths"):
        im.plan(["Viridian"], "Zinc White", grid=(400, infinite, 10))
    for noise in ((0.0, 0.0), (float("nan"), 0.01), (0.0, infinite), (-0.1, 0.2)):
        with pytest.raises(im.FitError, match="noise takes CONSTANT,EVEN") as error:
            im.plan(["Viridian"], "Zinc White", prior=oils, noise=noise)
        assert error.value.hint


def test_left_out_mixtures_are_those_of_the_program(readings: im.Readings) -> None:
    done: list[str] = []
    with pytest.warns(im.FindingWarning):
        validation = im.validate(
            readings,
            surface=im.Surface(),
            below_surface="floor",
            folds=3,
            progress=done.append,
        )
    left_out = done.count("mixture left out")
    assert left_out == len(validation.samples) + len(validation.warnings) > 50
    assert validation.by_pigment[0]["share"] >= validation.by_pigment[1]["share"]
    assert str(validation).startswith(f"{len(validation.samples)} mixtures, left out in 3 groups")


def test_masstones_are_left_out_pigment_by_pigment(readings: im.Readings) -> None:
    validation = im.validate(readings, leave_out="pigment", method="weighted")
    assert "left out pigment by pigment" in str(validation)
    assert len(validation.samples) > 10 and validation.strengths == []
    with pytest.raises(im.FitError, match="left out by themselves"):
        _ = validation.residuals
    with pytest.raises(im.FitError, match="ground"):
        im.validate(readings, leave_out="ground")


def test_residuals_are_those_of_the_program(readings: im.Readings, tmp_path: Path) -> None:
    validation = im.validate(readings, surface=im.Surface(), below_surface="floor")
    residuals = validation.residuals
    shipped = (ROOT / "measurements/van-gogh-oils.residuals.json").read_text()
    assert residuals.to_json().replace(str(OILS_CSV), "measurements/van-gogh-oils.csv") == shipped
    assert residuals.samples == [name for name, _ in validation.samples]
    assert residuals.measured.shape == residuals.predicted.shape == (65, 31)
    error = np.sqrt(np.mean((residuals.measured - residuals.predicted) ** 2))
    assert 0.5 * validation.rms < error < 1.5 * validation.rms
    residuals.save(tmp_path / "residuals.json")
    again = im.Residuals.load(tmp_path / "residuals.json")
    assert again.sha256 == residuals.sha256 and again.wavelengths[-1] == 700
    with pytest.raises(im.ReadingError, match="impasto-residuals") as caught:
        im.Residuals.load(ROOT / "measurements/van-gogh-oils.pigments.json")
    assert caught.value.hint


def test_a_plan_has_the_form_of_the_program(oils: im.Library, tmp_path: Path) -> None:
    plan = im.plan(["Cobalt Blue", "Viridian"], white="Zinc White", prior=oils, swatches=16)
    assert len(plan.swatches) == 16
    assert plan.form.startswith(b"sample,film,backing,replicate,Zinc White,Cobalt Blue,Viridian,400")
    plan.save(tmp_path / "form.csv")
    with pytest.raises(im.Error, match="exists already"):
        plan.save(tmp_path / "form.csv")
    assert abs(sum(plan.totals.values()) - 160.0) < 0.5, "ten grams a swatch"
    assert plan.loss is None
    plan.save_recipes(tmp_path / "recipes.csv")
    assert b"\n01 Zinc White masstone,paint,white,01 white 1,10,,\n" in plan.recipes


def test_a_short_plan_warns_of_its_loss() -> None:
    with pytest.warns(im.FindingWarning, match="5 swatches instead of 8"):
        plan = im.plan(["Cobalt Blue", "Viridian"], white="Zinc White", swatches="fewest")
    assert plan.loss is not None and plan.loss["spare_swatches"] == 0
    with pytest.warns(im.FindingWarning, match="7 swatches instead of 8"):
        im.plan(["Cobalt Blue", "Viridian"], white="Zinc White", minutes=79)


CARDS = """sample,film,backing,thickness_mm,400,500,600,700
card,none,white,,0.85,0.86,0.87,0.87
card,none,black,,0.05,0.05,0.05,0.05
ochre,paint,white,0.08,0.20,0.35,0.62,0.68
ochre,paint,black,0.08,0.17,0.28,0.50,0.52
"""


def test_a_film_on_two_cards_has_k_and_s_by_mm(tmp_path: Path) -> None:
    path = tmp_path / "cards.csv"
    path.write_text(CARDS)
    with pytest.warns(im.FindingWarning, match="steps of 100 nm"):
        [film] = im.film(im.read(path, spectra_only=True))
    ratio, deviation = film.contrast_ratio
    assert 0.79 < ratio < 0.81 and 0 < deviation < 0.01
    row = film.powers[1]
    assert abs(row["s_per_mm"] * 0.08 / row["s_d"] - 1) < 1e-4 and row["s_d_sd"] > 0
    assert film.hiding is not None and film.hiding["thickness_mm"]["value"] > 0.08
    with pytest.raises(im.FitError, match="four names"):
        im.film(im.read(path, spectra_only=True), over_white="ochre")


def test_a_fit_takes_the_surface_of_a_library(oils: im.Library) -> None:
    readings = im.read(ROOT / "measurements/van-gogh-oils.csv")
    with pytest.warns(im.FindingWarning) as told:
        fit = im.fit(readings, surface=oils, method="weighted", reference="Zinc White")
    assert any("read as black" in str(warning.message) for warning in told)
    assert fit.library.about["surface"] == oils.about["surface"]


def test_two_sets_are_compared_by_name(tmp_path: Path) -> None:
    names = ["batch.csv", "standard.csv"]
    for name, red in zip(names, ["0.50", "0.55"]):
        rows = f"sample,400,500,600,700\ngrey,0.3,0.3,0.3,0.3\nred,0.05,0.06,{red},0.6\n"
        (tmp_path / name).write_text(rows + ("x,0.1,0.1,0.1,0.1\n" if name == "batch.csv" else ""))
    batch, standard = (im.read(tmp_path / name, spectra_only=True) for name in names)
    with pytest.warns(im.FindingWarning) as told:
        found = im.compare(batch, standard, tolerance=1.0)
    words = " ".join(str(warning.message) for warning in told)
    assert "only in the first set: x" in words and "steps of 100 nm" in words
    assert [sample["passes"] for sample in found.samples] == [True, False]
    assert found.passed is False and found.about["shift"][0] < 0


def test_a_report_is_one_page_with_figures(oils: im.Library, tmp_path: Path) -> None:
    report = im.report(oils)
    page = report.save(tmp_path / "out")
    assert page.read_text().startswith("<!DOCTYPE html>")
    assert len(list((tmp_path / "out/figures").glob("*.png"))) > 3
    assert "iframe" in report._repr_html_()


def test_the_version_is_that_of_the_workspace() -> None:
    manifest = (ROOT / "Cargo.toml").read_text()
    assert f'version = "{im.__version__}"' in manifest
