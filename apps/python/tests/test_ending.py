"""Ctrl-C and exceptions of `progress` end the work itself, not only the call."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from test_maps import envi, finished_shards, painted

import impasto as im


@pytest.fixture(autouse=True, scope="module")
def shared_threads() -> None:
    """Starts the threads that share work here, as they take the name of the thread that starts them."""
    im.color.xyz(np.full((100_000, 31), 0.5), wavelengths=np.arange(400.0, 701.0, 10.0))


def interrupt(_: object = None) -> None:
    os.kill(os.getpid(), signal.SIGINT)


def assert_nothing_computes() -> None:
    """The thread of the work has ended, and the process uses no processor for a while."""
    threads = Path("/proc/self/task")
    names = [file.read_text().strip() for file in threads.glob("*/comm")]
    assert "impasto-work" not in names, names
    start = time.process_time()
    time.sleep(0.3)
    assert time.process_time() - start < 0.1, "a thread still computes"


def interrupted_after(seconds: float, work: Callable[[], object]) -> None:
    """Sends SIGINT to `work`, which takes many times 20 seconds by itself."""
    timer = threading.Timer(seconds, interrupt)
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work()
    assert time.monotonic() - start < 20.0
    assert_nothing_computes()


def interrupted_at(stage: str, work: Callable[[Callable[[str], object]], object]) -> None:
    """Sends SIGINT to `work` when it first tells `stage`."""
    told: list[str] = []

    def progress(text: str) -> None:
        if stage in text and not told:
            told.append(text)
            interrupt()

    with pytest.raises(KeyboardInterrupt):
        work(progress)
    assert_nothing_computes()


def test_ctrl_c_ends_a_quadrature(oils: im.Library) -> None:
    interrupted_after(0.3, lambda: im.Quadrature.of(oils, method="effective", nodes=32))


def test_ctrl_c_ends_a_search_of_recipes(oils: im.Library) -> None:
    targets = oils.mix(np.random.default_rng(3).dirichlet(np.ones(len(oils)), size=500))
    interrupted_after(0.3, lambda: oils.match(targets, at_most=5))


def test_ctrl_c_ends_a_validation(readings: im.Readings) -> None:
    interrupted_at(
        "mixture left out",
        lambda progress: im.validate(readings, reference="Zinc White", progress=progress),
    )


def test_ctrl_c_ends_a_survey_and_a_map(oils: im.Library, tmp_path: Path) -> None:
    values, _ = painted(oils, 8, 12 * 2048)
    cube = im.Cube.open(envi(tmp_path / "scan.hdr", values, oils.wavelengths))
    interrupted_at("pixel", lambda progress: im.survey(cube, oils, progress=progress))
    few = im.survey(cube, oils, region=(slice(1), slice(64)))
    whole = im.survey(cube, oils, book=few.to_json())
    out = tmp_path / "maps.zarr"
    interrupted_at(
        "pixels",
        lambda progress: im.pigment_map(cube, oils, out, survey=whole, progress=progress),
    )
    assert 1 <= finished_shards(out) < 12, "the rest was mapped without anybody"
    im.pigment_map(cube, oils, out, survey=whole, resume=True)
    assert finished_shards(out) == 12


@pytest.mark.parametrize("stage", ["quadratic", "spectra", "colours", "deviations"])
def test_an_exception_of_progress_ends_a_fit(readings: im.Readings, stage: str) -> None:
    def stop(told: str) -> None:
        if stage in told:
            raise RuntimeError(told)

    with pytest.raises(RuntimeError, match=stage):
        im.fit(readings, reference="Zinc White", progress=stop)
    assert_nothing_computes()
