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
from test_maps import envi, painted

import impasto as im


def assert_nothing_computes() -> None:
    """The process uses no processor for a while."""
    start = time.process_time()
    time.sleep(0.3)
    assert time.process_time() - start < 0.1, "a thread still computes"


def interrupted(work: Callable[[], object]) -> float:
    """Seconds that `work`, which takes longer, needs to end after SIGINT."""
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.4, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
    finally:
        timer.cancel()
    ended = time.monotonic()
    assert_nothing_computes()
    return ended - sent[0]


def test_ctrl_c_ends_a_quadrature(oils: im.Library) -> None:
    assert interrupted(lambda: im.Quadrature.of(oils, method="effective", nodes=24)) < 10.0


def test_ctrl_c_ends_a_search_of_recipes(oils: im.Library) -> None:
    targets = oils.mix(np.random.default_rng(3).dirichlet(np.ones(len(oils)), size=50))
    assert interrupted(lambda: oils.match(targets, at_most=5)) < 10.0


def test_ctrl_c_ends_a_validation(readings: im.Readings) -> None:
    assert interrupted(lambda: im.validate(readings, reference="Zinc White")) < 10.0


def test_ctrl_c_ends_a_survey_and_a_map(oils: im.Library, tmp_path: Path) -> None:
    values, _ = painted(oils, 256, 1024)
    cube = im.Cube.open(envi(tmp_path / "scan.hdr", values, oils.wavelengths))
    assert interrupted(lambda: im.survey(cube, oils)) < 10.0
    few = im.survey(cube, oils, region=(slice(4), slice(64)))
    whole = im.survey(cube, oils, book=few.to_json())
    out = tmp_path / "maps.zarr"
    assert interrupted(lambda: im.pigment_map(cube, oils, out, survey=whole)) < 10.0


@pytest.mark.parametrize("stage", ["quadratic", "spectra", "colours", "deviations"])
def test_an_exception_of_progress_ends_a_fit(readings: im.Readings, stage: str) -> None:
    def stop(told: str) -> None:
        if stage in told:
            raise RuntimeError(told)

    with pytest.raises(RuntimeError, match=stage):
        im.fit(readings, reference="Zinc White", progress=stop)
    assert_nothing_computes()
