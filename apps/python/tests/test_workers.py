"""Tasks of maps on Dask workers, and what a client tells of workers that die."""

from __future__ import annotations

import os
import signal
import threading
from pathlib import Path
from typing import Any

import pytest
from conftest import OILS_JSON
from test_maps import PIGMENTS, digest, envi, finished_shards, painted

import impasto as im

distributed = pytest.importorskip("distributed", reason="the extra maps needs Python 3.11")
import dask.config

from impasto import workers


def test_small_neighbours_are_one_task() -> None:
    large = workers.PIXELS_A_TASK
    assert list(workers.tasks_of([large] * 3, 1)) == [[0], [1], [2]]
    few = large // 4
    assert list(workers.tasks_of([few, few, 0, few, few, few], 1)) == [[0, 1, 3, 4], [5]]
    # Workers share what is left: four tasks for eight shards, however small.
    assert list(workers.tasks_of([1] * 8, 4)) == [[0, 1], [2, 3], [4, 5], [6, 7]]
    assert list(workers.tasks_of([1] * 3, 8)) == [[0], [1], [2]]
    assert list(workers.tasks_of([0, 0], 8)) == []


def test_a_job_holds_all_that_a_survey_depends_on(oils: im.Library, tmp_path: Path) -> None:
    values, _ = painted(oils, 12, 96)
    cube = im.Cube.open(envi(tmp_path / "scan.hdr", values, oils.wavelengths))
    # Another name, since the oils that ship have residuals that need not be given.
    others = im.Library.from_json(oils.to_json().replace("Van Gogh's oils", "others"))
    usual = im.survey(cube, others)
    linen = im.Spectrum(oils.wavelengths, 0.3 + 0.001 * (oils.wavelengths - 400))
    for number, settings in enumerate[dict[str, Any]](
        [
            {"palette": PIGMENTS, "groups": {"green": ["Viridian", "Emerald Green"]}},
            {"ground": linen, "at_most": 2, "penalty": 3.0},
            {"ground": (slice(0, 4), slice(10, 30)), "noise": 0.01, "group_alike": False},
            {"region": (slice(2, 9), slice(5, 60)), "model_error": 0.2},
            {"residuals": OILS_JSON.with_name("van-gogh-oils.residuals.json")},
        ]
    ):
        found = im.survey(cube, others, **settings)
        job = workers.Job.written(found, tmp_path / f"maps-{number}.zarr")
        again, out = workers.prepared(job.file, job.sha256)
        assert again.about == found.about and again.to_json() == found.to_json(), settings
        assert out == str(tmp_path / f"maps-{number}.zarr")
        # Maps of another region would be refused.
        assert found._native.begin(out, False) == again._native.begin(out, True)
        assert found.to_json() != usual.to_json(), "the settings change nothing"
    job = workers.Job.written(usual, tmp_path / "usual.zarr")
    Path(job.file).write_text("{}\n{}")
    with pytest.raises(im.Error, match="not the job of this run"):
        workers.prepared(job.file, job.sha256)


def test_maps_of_one_name_and_dead_workers_on_one_cluster(
    oils: im.Library, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Four of six tasks wait at first.
    monkeypatch.setattr(workers, "TASKS_A_WORKER", 2)
    monkeypatch.setattr(workers, "PIXELS_A_TASK", 1)
    scans = []
    for name in ("left", "right"):
        folder = tmp_path / name
        folder.mkdir()
        values, _ = painted(oils, 2, 2048 * 6)
        values = values if name == "left" else values[:, ::-1]
        cube = im.Cube.open(envi(folder / "scan.hdr", values, oils.wavelengths))
        survey = im.survey(cube, oils)
        im.pigment_map(cube, oils, folder / "one.zarr", survey=survey)
        scans.append((folder, cube, survey))
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=2, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):

        def run(scan: tuple[Path, im.Cube, im.Survey]) -> None:
            folder, cube, survey = scan
            im.pigment_map(cube, oils, folder / "maps.zarr", survey=survey, client=client)

        threads = [threading.Thread(target=run, args=(scan,)) for scan in scans]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for folder, _, _ in scans:
            assert digest(folder / "maps.zarr") == digest(folder / "one.zarr")

        folder, cube, survey = scans[0]
        killed: list[int] = []

        def kill(_: str) -> None:
            (nanny,) = cluster.workers.values()
            if not killed and nanny.process and nanny.process.pid:
                killed.append(nanny.process.pid)
                os.kill(killed[0], signal.SIGKILL)

        out = folder / "killed.zarr"
        with pytest.raises(im.Error, match="workers died at . of 6 shards .rows 0 to 1 and") as error:
            im.pigment_map(cube, oils, out, survey=survey, client=client, progress=kill)
        assert "allowed-failures" in str(error.value.hint)
        # Only those that were on the worker failed, and the rest went on.
        assert 1 <= finished_shards(out) < 6, finished_shards(out)
        im.pigment_map(cube, oils, out, survey=survey, client=client, resume=True)
        assert digest(out) == digest(folder / "one.zarr")
        assert not list(folder.glob("*.job.json*")), "the file of the job is removed"
