"""Libraries and mixtures."""

from __future__ import annotations

import pickle
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import OILS_JSON

import impasto as im


def test_a_library_is_saved_as_it_was(oils: im.Library, tmp_path: Path) -> None:
    oils.save(tmp_path / "oils.json")
    assert (tmp_path / "oils.json").read_bytes() == OILS_JSON.read_bytes()
    assert pickle.loads(pickle.dumps(oils)) == oils == im.Library.van_gogh_oils()


def test_a_pigment_has_read_only_curves(oils: im.Library) -> None:
    viridian = oils["viri"]
    assert viridian.name == "Viridian" and viridian.absorption.shape == (31,)
    assert (oils.K[oils.names.index("Viridian")] == viridian.absorption).all()
    with pytest.raises(ValueError):
        viridian.absorption[0] = 1.0


def test_names_that_are_not_there_are_told(oils: im.Library) -> None:
    with pytest.raises(im.RecipeError, match="Virridian") as error:
        oils["Virridian"]
    assert "Viridian" in str(error.value)


def test_a_mixture_is_that_of_the_readme(oils: im.Library) -> None:
    color = oils.color({"Zinc White": 9, "Cobalt Blue": 1})
    assert color["hex"] == "#5798e3"
    mixed = oils.mix({"Zinc White": 9, "Cobalt Blue": 1})
    assert im.color.display(mixed) == ["#5798e3"]
    assert np.array_equal(mixed.values, color["reflectance"])


def test_rows_of_parts_are_mixed_as_one_by_one(oils: im.Library) -> None:
    random = np.random.default_rng(1)
    parts = random.random((500, len(oils))) * (random.random((500, len(oils))) < 0.2)
    parts[:, 0] += 1e-3
    mixed = oils.mix(parts)
    assert mixed.values.shape == (500, 31)
    for row in (0, 250, 499):
        named = {name: part for name, part in zip(oils.names, parts[row]) if part}
        assert np.array_equal(oils.mix(named).values, mixed.values[row])
    thin = oils.mix(parts, thickness=0.05, over="black")
    assert (thin.values <= oils.mix(parts, thickness=0.05, over=0.9).values + 1e-12).all()


def test_a_row_that_cannot_be_mixed_is_named(oils: im.Library) -> None:
    parts = np.ones((3, len(oils)))
    parts[1, 2] = np.nan
    with pytest.raises(im.RecipeError, match="row 1"):
        oils.mix(parts)
    with pytest.raises(im.Error, match="20 pigments"):
        oils.mix(np.ones((3, 4)))


def test_recipes_are_those_of_the_program(oils: im.Library) -> None:
    match = oils.match("#4a7d8c", at_most=4, lights={"D65": 1, "A": 0.5})
    assert isinstance(match, im.Match) and len(match) == 5
    best = match[0]
    assert set(best.delta_e) == {"D65", "A"} and abs(sum(best.shares.values()) - 1) < 1e-9
    assert np.allclose(oils.mix(best.shares).values, best.reflectance.values, atol=1e-12)
    measured = oils.match(oils.mix({"Viridian": 1, "Zinc White": 3}), by="spectrum")
    assert isinstance(measured, im.Match)
    assert measured[0].distance < 0.2 and set(measured[0].shares) == {"Viridian", "Zinc White"}
    several = oils.match(oils.mix(np.eye(len(oils))[:3]), count=1)
    assert isinstance(several, list)
    assert [m[0].distance < 0.1 for m in several] == [True] * 3


def test_colours_of_a_book_are_targets(oils: im.Library, tmp_path: Path) -> None:
    path = tmp_path / "book.csv"
    path.write_text("Number;L*;a*;b*\nRAL 5012;55,1;-15,3;-31,9\nRAL 9010;94,6;-0,8;6,9\n")
    book = im.ColorBook(path)
    assert book.names == ("RAL 5012", "RAL 9010") and "D65" in book.remarks[0]
    one = oils.match(book["ral 9010"], at_most=2, count=1)
    assert isinstance(one, im.Match) and one.target == "RAL 9010"
    assert np.allclose(list(one.about["lab"].values())[0], [94.6, -0.8, 6.9])
    every = oils.match(book, at_most=1, count=1)
    assert isinstance(every, list) and [match.target for match in every] == list(book.names)
    assert im.ColorBook(path, light="D50").remarks == ()
    with pytest.raises(im.ReadingError, match="no colour is called `RAL 1`"):
        book["RAL 1"]
    path.write_text("name,L,a,b\nSky,60,x,-30\n")
    with pytest.raises(im.ReadingError, match="row 2, column `a`") as error:
        im.ColorBook(path)
    place = error.value.place
    assert place is not None and (place.file, place.row, place.column) == (str(path), 2, "a")
    path.write_text("pigment,price\nZinc White,3\n")
    with pytest.raises(im.Error, match="not a book"):
        im.ColorBook(path)


def test_numbers_of_numpy_are_numbers(oils: im.Library) -> None:
    half: Any = np.float32(0.5)
    film = oils.mix({"Viridian": 1}, thickness=0.1, over=half)
    assert np.array_equal(film.values, oils.mix({"Viridian": 1}, thickness=0.1, over=0.5).values)
    for wrong in (np.array([50, 3j, 2]), ["L", "a", "b"], [[1, 2], [3]]):
        with pytest.raises(im.Error, match="cannot be read as numbers"):
            oils.match(wrong)


def test_a_target_that_is_no_colour_is_told(oils: im.Library) -> None:
    with pytest.raises(im.RecipeError, match="teal") as error:
        oils.match("teal")
    assert error.value.hint
    with pytest.raises(im.RecipeError, match="unknown word `eye`"):
        oils.match("#4a7d8c", by="eye")
    with pytest.raises(im.Error, match="list of names"):
        oils.match("#4a7d8c", only="Viridian")


def test_two_threads_mix_at_once(oils: im.Library) -> None:
    parts = np.random.default_rng(2).random((20_000, len(oils)))
    results: list[im.Spectrum] = []
    threads = [threading.Thread(target=lambda: results.append(oils.mix(parts))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert np.array_equal(results[0].values, results[1].values)


def test_few_wavelengths_give_the_colour_of_many(oils: im.Library) -> None:
    rule = im.Quadrature.of(oils, illuminant="D65", nodes=8)
    assert rule.nodes.shape == (8,) and rule.weights.shape == (8, 3)
    assert rule.about["error"]["mean"] < 0.1
    assert rule.about["error_over_grounds"]["mean"] < 0.15
    assert np.allclose(rule.xyz(np.ones(8))[1], 100.0, atol=0.5)
    for wrong in (np.ones(7), np.float64(1.0), np.ones(8) * 1j, ["a"] * 8):
        with pytest.raises(im.Error, match="reflectance"):
            rule.xyz(wrong)
    with pytest.raises(im.Error, match="needs a pigment library"):
        im.Quadrature.of(method="effective")


def test_a_notebook_shows_swatches(oils: im.Library) -> None:
    html = oils._repr_html_()
    assert html.count("background:#") == 39, "a masstone each, and a tint of all but the white"
    assert "5798e3" in oils.mix({"Zinc White": 9, "Cobalt Blue": 1})._repr_html_()
    assert "Viridian" in oils.match("#4a7d8c")._repr_html_() + html
