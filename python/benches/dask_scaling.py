"""What Dask costs a map, and how it scales: `python benches/dask_scaling.py [WORKERS..]`.

Prints the time of a task that has nothing to do, without what a map takes whose only task that is, and that of one map in one process and on each number of
workers (default: 1 and 2), of one thread each. Needs the extra `maps`.

Seconds of the clock need a machine that does nothing else. Seconds of the processors, summed over all processes,
hardly depend on other work: they tell what the workers, the scheduler and the client spend beside the map itself.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

# One thread a process, so that workers are compared with each other.
os.environ["RAYON_NUM_THREADS"] = "1"

import numpy as np
from distributed import Client, LocalCluster

import impasto as im
from impasto import maps

SHARD = 2048
"""Rows and columns of a shard."""
ROUNDS = 3
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


class Spent(NamedTuple):
    """Seconds by the clock, and of the processors in this process and in all workers."""

    clock: float
    here: float
    workers: float

    @property
    def processors(self) -> float:
        """Seconds of the processors in all processes."""
        return self.here + self.workers


def spent(work: Callable[[], object], client: Client | None = None) -> Spent:
    """What `work` takes, here and on the workers of `client`."""

    def now() -> Spent:
        workers = 0.0 if client is None else sum(client.run(time.process_time).values())
        return Spent(time.perf_counter(), time.process_time(), workers)

    start = now()
    work()
    # Asking the workers is no part of the time.
    clock, here = time.perf_counter(), time.process_time()
    return Spent(clock - start.clock, here - start.here, now().workers - start.workers)


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

    def alone(self) -> Spent:
        """A map in this process."""
        out = self.out()
        return spent(lambda: im.pigment_map(self.cube, self.oils, out, survey=self.survey))

    def finished(self, client: Client | None) -> Spent:
        """A shard of going once more through finished maps, where only the way there takes time."""
        out = self.out()
        im.pigment_map(self.cube, self.oils, out, survey=self.survey)

        def again(shards: int) -> None:
            if client is None:
                for place in range(shards):
                    self.survey._native.map_shard(os.fspath(out), place)
            else:
                done = [place >= shards for place in range(self.shards)]
                maps._on_workers(self.survey, out, done, client, None)

        one, every = (
            least(lambda: spent(lambda: again(shards), client)) for shards in (1, self.shards)
        )
        return Spent(*((b - a) / (self.shards - 1) for a, b in zip(one, every, strict=True)))

    def tasks(self, client: Client) -> Spent:
        """A map on the workers of a client."""
        out = self.out()
        work = partial(im.pigment_map, self.cube, self.oils, out, survey=self.survey, client=client)
        return spent(work, client)


def least(measured: Callable[[], Spent]) -> Spent:
    """The least of several measurements, by clock and by processors."""
    found = [measured() for _ in range(ROUNDS)]
    least_work = min(found, key=lambda each: each.processors)
    return least_work._replace(clock=min(each.clock for each in found))


def on_workers(count: int, warm: Run, work: Callable[[Client], Spent]) -> Spent:
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
        small, large = Run(oils, folder, 1, 200), Run(oils, folder, 16, 16)
        loop, task = small.finished(None), on_workers(1, small, small.finished)
        print("a finished shard, ms by the clock (of the processors):")
        for words, each in [("in a loop", loop), ("as a task of one worker", task)]:
            print(f"  {words}: {1e3 * each.clock:.2f} ({1e3 * each.processors:.2f})")
        alone = least(large.alone)
        print(
            f"{large.pixels} pixels in {large.shards} shards: one process {alone.clock:.2f} s "
            f"({alone.processors:.2f} of the processors)"
        )
        first = None
        for count in workers:
            run = on_workers(count, small, lambda client: least(lambda: large.tasks(client)))
            first = first or run.clock * count
            print(
                f"{count} workers: {run.clock:.2f} s, {large.pixels / run.clock / count:.0f} pixels/s a worker, "
                f"{100 * first / run.clock / count:.0f} % of linear; of the processors {run.workers:.2f} s in workers, "
                f"{run.here:.2f} s here, {100 * alone.processors / run.processors:.0f} % of them for the map"
            )


if __name__ == "__main__":
    main()
