"""Scans, surveys and maps, on one machine and on Dask workers that are killed."""

from __future__ import annotations

import hashlib
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import OILS_JSON

import impasto as im
from impasto.cube import MASKS

PIGMENTS = ("Lead White", "Ultramarine", "Viridian", "Chrome Yellow", "Vermilion")


def envi(path: Path, values: np.ndarray, nm: np.ndarray) -> Path:
    """Writes (rows, columns, bands) as ENVI, band interleaved by line."""
    rows, columns, bands = values.shape
    path.with_suffix(".bil").write_bytes(values.transpose(0, 2, 1).astype("<f4").tobytes())
    path.write_text(
        f"ENVI\nsamples = {columns}\nlines = {rows}\nbands = {bands}\nheader offset = 0\n"
        "data type = 4\ninterleave = bil\nbyte order = 0\nwavelength units = Nanometers\n"
        f"wavelength = {{{', '.join(str(n) for n in nm)}}}\n"
    )
    return path


def painted(oils: im.Library, rows: int, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Patches of two or three pigments with noise, and the shares of each pixel."""
    random = np.random.default_rng(7)
    places = [oils.names.index(name) for name in PIGMENTS]
    recipes = np.zeros((40, len(oils)))
    for recipe in recipes:
        chosen = random.choice(places, size=random.integers(1, 4), replace=False)
        recipe[chosen] = random.dirichlet(np.full(len(chosen), 2.0))
    index = random.integers(0, 40, (rows, columns // 8 + 1)).repeat(8, axis=1)[:, :columns]
    shares = recipes[index]
    values = oils.mix(shares.reshape(-1, len(oils))).values.reshape(rows, columns, -1)
    return values + 0.002 * random.standard_normal(values.shape), shares


@pytest.fixture(scope="module")
def scan(oils: im.Library, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, np.ndarray]:
    values, shares = painted(oils, 32, 96)
    return envi(tmp_path_factory.mktemp("scan") / "scan.hdr", values, oils.wavelengths), shares


@pytest.fixture(scope="module")
def wide(oils: im.Library, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A scan of eight shards."""
    values, _ = painted(oils, 4, 2048 * 7 + 100)
    return envi(tmp_path_factory.mktemp("wide") / "wide.hdr", values, oils.wavelengths)


def digest(folder: Path) -> str:
    """SHA-256 of all files below a folder, with their names."""
    whole = hashlib.sha256()
    for file in sorted(folder.rglob("*")):
        if file.is_file():
            whole.update(str(file.relative_to(folder)).encode())
            whole.update(file.read_bytes())
    return whole.hexdigest()


def finished_shards(maps: Path) -> int:
    """Shards of maps on the disk that have a mask, which is written last."""
    return len([file for file in (maps / "mask" / "c").rglob("*") if file.is_file()])


def test_a_scan_is_read_as_it_was_written(scan: tuple[Path, np.ndarray], oils: im.Library) -> None:
    cube = im.Cube.open(scan[0])
    assert cube.shape == (32, 96, 31) and np.array_equal(cube.wavelengths, oils.wavelengths)
    whole, mask = cube.read()
    raw = np.fromfile(scan[0].with_suffix(".bil"), "<f4").reshape(32, 31, 96).transpose(0, 2, 1)
    assert np.array_equal(whole, raw) and not mask.any()
    part, _ = cube.read(slice(3, 5), slice(10, 14))
    assert np.array_equal(part, raw[3:5, 10:14])


def test_bare_ground_is_told_by_the_mask(oils: im.Library, tmp_path: Path) -> None:
    pytest.importorskip("zarr", reason="zarr 3 needs Python 3.11")
    values, _ = painted(oils, 24, 48)
    linen = 0.35 + 0.2 * np.sqrt((oils.wavelengths - 400) / 300)
    noise = 0.002 * np.random.default_rng(3).standard_normal((8, 48, 31))
    values[:8] = linen + noise
    cube = im.Cube.open(envi(tmp_path / "scan.hdr", values, oils.wavelengths))
    ground = MASKS.index("bare ground")
    for number, given in enumerate(
        (im.Spectrum(oils.wavelengths, linen), (slice(0, 4), slice(10, 30)))
    ):
        out = tmp_path / f"maps-{number}.zarr"
        mask = im.pigment_map(cube, oils, out, ground=given).to_xarray().mask.values
        assert (mask[:8] == ground).all() and (mask[8:] == 0).all(), mask
    with pytest.raises(im.Error, match="400 nm"):
        im.survey(cube, oils, ground=im.Spectrum(oils.wavelengths[2:], linen[2:]))
    with pytest.raises(im.Error, match="one spectrum"):
        im.survey(cube, oils, ground=im.Spectrum(oils.wavelengths, [linen, linen]))
    with pytest.raises(im.Error, match="rows"):
        im.survey(cube, oils, ground=(slice(30, 40), slice(0, 5)))


def test_header_and_data_that_disagree_are_told(scan: tuple[Path, np.ndarray], tmp_path: Path) -> None:
    header = scan[0].read_text().replace("lines = 32", "lines = 33")
    (tmp_path / "long.hdr").write_text(header)
    (tmp_path / "long.bil").write_bytes(scan[0].with_suffix(".bil").read_bytes())
    with pytest.raises(im.Error, match="long") as error:
        im.Cube.open(tmp_path / "long.hdr")
    assert error.value.hint


def test_pigments_are_found_with_their_shares(
    scan: tuple[Path, np.ndarray], oils: im.Library, tmp_path: Path
) -> None:
    pytest.importorskip("zarr", reason="zarr 3 needs Python 3.11")
    cube = im.Cube.open(scan[0])
    # The scan is made of the library's own pigments. With so small an error a masstone looks like none of them.
    with pytest.warns(im.FindingWarning, match="off by a factor of 4"):
        survey = im.survey(cube, oils, model_error=0.05)
    assert set(list(survey.palette)[:5]) == set(PIGMENTS), survey.palette
    maps = im.pigment_map(cube, oils, tmp_path / "maps.zarr", survey=survey)
    data = maps.to_xarray()
    assert data.attrs["library_sha256"] and dict(data.sizes)["pigment"] == len(survey.palette)
    truth = scan[1]
    for name in PIGMENTS[1:]:
        share = data.share.sel(pigment=name).values
        error = np.abs(share - truth[:, :, oils.names.index(name)])
        assert error.mean() < 0.03, (name, error.mean())
        present = data.presence.sel(pigment=name).values > 0.5
        assert (present == (truth[:, :, oils.names.index(name)] > 0)).mean() > 0.95, name
    usual = im.survey(cube, oils)
    assert any("Lead White" in names for names in usual.groups.values()), usual.groups
    assert "Mapped as one" in usual._repr_html_()


def test_maps_of_another_run_are_refused(
    scan: tuple[Path, np.ndarray], oils: im.Library, tmp_path: Path
) -> None:
    cube, out = im.Cube.open(scan[0]), tmp_path / "maps.zarr"
    survey = im.survey(cube, oils)
    im.pigment_map(cube, oils, out, survey=survey)
    before = digest(out)
    with pytest.raises(im.Error, match="holds maps"):
        im.pigment_map(cube, oils, out, survey=survey)
    with pytest.raises(im.Error):
        im.pigment_map(cube, oils, out, resume=True, at_most=2)
    im.pigment_map(cube, oils, out, survey=survey, resume=True)
    assert digest(out) == before


def test_a_survey_is_kept_as_json(scan: tuple[Path, np.ndarray], oils: im.Library) -> None:
    cube = im.Cube.open(scan[0])
    first = im.survey(cube, oils)
    again = im.survey(cube, oils, book=first.to_json())
    assert again.about == first.about
    with pytest.raises(im.Error):
        im.survey(cube, oils, at_most=2, book=first.to_json())


def test_a_palette_and_groups_are_kept_to(scan: tuple[Path, np.ndarray], oils: im.Library) -> None:
    cube = im.Cube.open(scan[0])
    found = im.survey(cube, oils, palette=PIGMENTS, group_alike=False)
    assert set(found.palette) == set(PIGMENTS) and not found.groups
    assert im.survey(cube, oils).groups and not im.survey(cube, oils, group_alike=False).groups
    cool = ["Viridian", "Ultramarine"]
    found = im.survey(cube, oils, palette=PIGMENTS, groups={"cool": cool}, group_alike=False)
    assert found.groups == {"cool": cool} and len(found.palette) == 4
    with pytest.raises(im.Error, match="list of names") as error:
        im.survey(cube, oils, palette="Viridian")
    assert error.value.hint == "try ['Viridian']"
    with pytest.raises(im.Error, match="Virridian"):
        im.survey(cube, oils, palette=["Virridian"])


def test_books_of_other_versions_are_refused(
    scan: tuple[Path, np.ndarray], oils: im.Library
) -> None:
    cube = im.Cube.open(scan[0])
    book = json.loads(im.survey(cube, oils).to_json())
    assert im.survey(cube, oils, book=json.dumps(book)).palette
    for change in ({"version": book["version"] - 2}, {"format": "other"}, {"palette": [0.5]}):
        with pytest.raises(im.ReadingError, match="of version|palette"):
            im.survey(cube, oils, book=json.dumps(book | change))


def test_residuals_of_a_library_reach_its_maps(
    scan: tuple[Path, np.ndarray], oils: im.Library, tmp_path: Path
) -> None:
    cube = im.Cube.open(scan[0])
    file = OILS_JSON.with_name("van-gogh-oils.residuals.json")
    told = {"left_out_mixtures": 65, "residuals_sha256": im.Residuals.load(file).sha256}
    assert im.survey(cube, oils).about["settings"]["model_error"] == told, "the oils that ship"
    other = im.Library.from_json(oils.to_json().replace("Van Gogh's oils", "others"))
    assert im.survey(cube, other).about["settings"]["model_error"] == 0.1
    by_path = im.survey(cube, other, residuals=file)
    assert by_path.about["settings"]["model_error"] == told
    given = im.survey(cube, other, residuals=im.Residuals.load(file))
    assert given.to_json() == by_path.to_json()
    with pytest.raises(im.Error, match="left-out mixtures"):
        im.survey(cube, other, book=given.to_json())
    with pytest.raises(im.Error, match="exclude each other"):
        im.survey(cube, other, residuals=file, model_error=0.1)


def test_killed_workers_and_clients_leave_the_maps_of_one_machine(
    wide: Path, oils: im.Library, tmp_path: Path
) -> None:
    distributed = pytest.importorskip("distributed")
    import dask.config

    cube = im.Cube.open(wide)
    residuals = OILS_JSON.with_name("van-gogh-oils.residuals.json")
    survey = im.survey(cube, oils, residuals=residuals)
    im.pigment_map(cube, oils, tmp_path / "one.zarr", survey=survey)
    expected = digest(tmp_path / "one.zarr")
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 20}),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        killed: list[int] = []

        def kill(stage: str) -> None:
            pids = [nanny.process.pid for nanny in cluster.workers.values() if nanny.process]
            pid = pids[len(killed) % len(pids)]
            if len(killed) < 3 and pid is not None and pid not in killed:
                killed.append(pid)
                os.kill(pid, signal.SIGKILL)

        im.pigment_map(
            cube, oils, tmp_path / "many.zarr", survey=survey, client=client, progress=kill
        )
        # A worker that starts again is slower than some machines map what is left.
        assert len(killed) >= 2
    assert digest(tmp_path / "many.zarr") == expected


def test_a_killed_client_is_followed_by_another(
    wide: Path, oils: im.Library, tmp_path: Path
) -> None:
    distributed = pytest.importorskip("distributed")
    cube, out = im.Cube.open(wide), tmp_path / "maps.zarr"
    survey = im.survey(cube, oils)
    im.pigment_map(cube, oils, tmp_path / "one.zarr", survey=survey)
    program = (
        "import impasto as im, sys; from distributed import Client;"
        "cube = im.Cube.open(sys.argv[1]); oils = im.Library.from_json(open(sys.argv[4]).read());"
        "im.pigment_map(cube, oils, sys.argv[2], client=Client(sys.argv[3]))"
    )
    oils.save(tmp_path / "oils.json")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        words = [str(wide), str(out), cluster.scheduler_address, str(tmp_path / "oils.json")]
        run = subprocess.Popen([sys.executable, "-c", program, *words])
        while run.poll() is None and finished_shards(out) < 2:
            time.sleep(0.005)
        run.kill()
        assert run.wait() == -signal.SIGKILL, "it was killed before its end"
        assert finished_shards(out) < 8, "the killed client left no work"
        with distributed.Client(cluster) as client:
            im.pigment_map(cube, oils, out, survey=survey, resume=True, client=client)
    assert digest(out) == digest(tmp_path / "one.zarr")
    assert not list(tmp_path.glob("*.job.json*")), "the file of the job is removed"


def test_a_killed_run_is_resumed(wide: Path, oils: im.Library, tmp_path: Path) -> None:
    cube, out = im.Cube.open(wide), tmp_path / "maps.zarr"
    survey = im.survey(cube, oils)
    im.pigment_map(cube, oils, tmp_path / "one.zarr", survey=survey)
    program = (
        "import impasto as im, sys; cube = im.Cube.open(sys.argv[1]);"
        "oils = im.Library.van_gogh_oils(); im.pigment_map(cube, oils, sys.argv[2])"
    )
    run = subprocess.Popen([sys.executable, "-c", program, str(wide), str(out)])
    while run.poll() is None and finished_shards(out) < 2:
        time.sleep(0.005)
    run.kill()
    assert run.wait() == -signal.SIGKILL, "it was killed before its end"
    im.pigment_map(cube, oils, out, survey=survey, resume=True)
    assert digest(out) == digest(tmp_path / "one.zarr")


def test_threads_give_the_same_bytes(wide: Path, oils: im.Library, tmp_path: Path) -> None:
    cube = im.Cube.open(wide)
    survey = im.survey(cube, oils)
    paths = [tmp_path / "a.zarr", tmp_path / "b.zarr"]
    threads = [
        threading.Thread(target=im.pigment_map, args=(cube, oils, path), kwargs={"survey": survey})
        for path in paths
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert digest(paths[0]) == digest(paths[1])
