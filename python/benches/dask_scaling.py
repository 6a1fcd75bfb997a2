"""What Dask costs a map, and how it scales: `python benches/dask_scaling.py [WORKERS..]`.

Prints the time of a task that has nothing to do, and that of one map in one process and on each number of
workers (default: 1 and 2), of one thread each. Needs the extra `maps`, and a machine that does nothing else.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

# One thread a process, so that workers are compared with each other.
os.environ["RAYON_NUM_THREADS"] = "1"

import numpy as np
from distributed import Client, LocalCluster

import impasto as im
from impasto import maps

SHARD = 2048
"""Rows and columns of a shard."""
ROUNDS = 4
"""Measurements of which the least counts."""


def scan(oils: im.Library, folder: Path, rows: int, columns: int) -> im.Cube:
    """Patches of mixtures with noise, as ENVI."""
    random = np.random.default_rng(1)
    recipes = random.dirichlet(np.full(len(oils), 0.15), size=64)
    pixels = oils.mix(recipes).values[random.integers(0, 64, rows * columns // 8).repeat(8)]
    values = pixels + 0.002 * random.standard_normal(pixels.shape)
    nm = ", ".join(str(n) for n in oils.wavelengths)
    path = folder / f"{rows}x{columns}.hdr"
    path.with_suffix(".bip").write_bytes(values.astype("<f4").tobytes())
    path.write_text(
        f"ENVI\nsamples = {columns}\nlines = {rows}\nbands = {len(oils.wavelengths)}\n"
        f"header offset = 0\ndata type = 4\ninterleave = bip\nbyte order = 0\n"
        f"wavelength units = Nanometers\nwavelength = {{{nm}}}\n"
    )
    return im.Cube.open(path)


class Run:
    """Maps of one scan, each into a folder of its own."""

    def __init__(self, oils: im.Library, folder: Path, rows: int, shards: int) -> None:
        self.cube, self.oils, self.folder = scan(oils, folder, rows, SHARD * shards), oils, folder
        self.survey = im.survey(self.cube, oils, model_error=0.05)
        self.shards = shards
        self.pixels = rows * SHARD * shards
        self.count = 0

    def out(self) -> Path:
        self.count += 1
        return self.folder / f"maps-{self.shards}-{self.count}.zarr"

    def alone(self) -> float:
        """Seconds in this process."""
        out = self.out()
        start = time.perf_counter()
        im.pigment_map(self.cube, self.oils, out, survey=self.survey)
        return time.perf_counter() - start

    def finished(self, client: Client | None) -> float:
        """Seconds a shard of going once more through finished maps, where only the way there takes time."""
        out = self.out()
        im.pigment_map(self.cube, self.oils, out, survey=self.survey)

        def again() -> float:
            start = time.perf_counter()
            if client is None:
                for place in range(self.shards):
                    self.survey._native.map_shard(os.fspath(out), place)
            else:
                maps._on_workers(self.survey, out, [False] * self.shards, client, None)
            return time.perf_counter() - start

        return least(again) / self.shards

    def tasks(self, client: Client) -> float:
        """Seconds on the workers of a client."""
        out = self.out()
        start = time.perf_counter()
        im.pigment_map(self.cube, self.oils, out, survey=self.survey, client=client)
        return time.perf_counter() - start


def least(measured: Callable[[], float]) -> float:
    return min(measured() for _ in range(ROUNDS))


def on_workers(count: int, warm: Run, work: Callable[[Client], float]) -> float:
    """What `work` measures on a cluster whose workers have mapped before."""
    with (
        LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        # Workers import the package and prepare a survey when their first task comes.
        warm.tasks(client)
        return work(client)


def main() -> None:
    workers = [int(word) for word in sys.argv[1:]] or [1, 2]
    oils = im.Library.van_gogh_oils()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        small, large = Run(oils, folder, 1, 100), Run(oils, folder, 16, 16)
        loop = 1e3 * small.finished(None)
        task = 1e3 * on_workers(1, small, small.finished)
        print(f"a finished shard: {loop:.2f} ms in a loop, {task:.2f} ms as a task of one worker")
        alone = least(large.alone)
        print(f"{large.pixels} pixels in {large.shards} shards: one process {alone:.2f} s")
        first = None
        for count in workers:
            seconds = on_workers(count, small, lambda client: least(lambda: large.tasks(client)))
            first = first or seconds * count
            print(
                f"{count} workers: {seconds:.2f} s, {large.pixels / seconds / count:.0f} pixels/s a worker, "
                f"{100 * first / seconds / count:.0f} % of linear"
            )


if __name__ == "__main__":
    main()
