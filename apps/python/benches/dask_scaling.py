"""What Dask costs a map, and how it scales: `python benches/dask_scaling.py [WORKERS..]`.

Needs the extra `maps`, and prints
- the time of a finished shard, in a loop and on a worker: there only the way to it takes time. It is measured on
  a map of 200 small shards, some of which are one task, less that of a map of one. A task is also measured by
  itself: one of Dask that returns its argument, and one of a single shard;
- the time of one map by threads of one process and by as many workers of one thread each (default: 1 and 2),
  first by workers that have not prepared the survey yet, then by those that have.

Seconds of the clock need a machine that does nothing else. Seconds of the processors, summed over all processes,
hardly depend on other work: they tell what the workers, the scheduler and the client spend beside the map itself.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

# One thread a process, so that workers are compared with each other.
os.environ.setdefault("RAYON_NUM_THREADS", "1")

import numpy as np
from distributed import Client, LocalCluster, as_completed

import impasto as im
from impasto import workers

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

    def to(self, more: Spent, count: int) -> Spent:
        """What one of the `count` costs that `more` has beyond this."""
        return Spent(*((b - a) / count for a, b in zip(self, more, strict=True)))


def spent(work: Callable[[], object], client: Client | None = None) -> Spent:
    """What `work` takes, here and on the workers of `client`."""

    def now() -> Spent:
        workers = 0.0 if client is None else sum(client.run(time.process_time).values())
        return Spent(time.perf_counter(), time.process_time(), workers)

    start = now()
    work()
    # Asking the workers is not part of the time.
    clock, here = time.perf_counter(), time.process_time()
    return Spent(clock - start.clock, here - start.here, now().workers - start.workers)


class Run:
    """Maps of one scan."""

    def __init__(self, oils: im.Library, folder: Path, rows: int, shards: int) -> None:
        self.cube, self.oils = scan(oils, folder, rows, SHARD * shards), oils
        self.survey = im.survey(self.cube, oils, model_error=0.05)
        self.out = folder / f"maps-{shards}.zarr"
        self.shards = shards
        self.pixels = rows * SHARD * shards

    def map(self, client: Client | None = None) -> Spent:
        """A map in this process, or on the workers of a client."""
        shutil.rmtree(self.out, ignore_errors=True)

        def work() -> None:
            im.pigment_map(self.cube, self.oils, self.out, survey=self.survey, client=client)

        return spent(work, client)

    def by_threads(self, threads: int) -> float:
        """Seconds by the clock of a map by threads of another process."""
        book = self.out.with_suffix(".json")
        book.write_text(self.survey.to_json())
        program = (
            "import sys, time; import impasto as im; cube = im.Cube.open(sys.argv[1]);"
            "oils = im.Library.van_gogh_oils(); book = open(sys.argv[3]).read();"
            "found = im.survey(cube, oils, model_error=0.05, book=book); start = time.perf_counter();"
            "im.pigment_map(cube, oils, sys.argv[2], survey=found); print(time.perf_counter() - start)"
        )

        def once() -> float:
            shutil.rmtree(self.out, ignore_errors=True)
            words = [sys.executable, "-c", program, str(self.cube.path), str(self.out), str(book)]
            environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
            run = subprocess.run(words, env=environment, check=True, stdout=subprocess.PIPE)
            return float(run.stdout)

        return min(once() for _ in range(ROUNDS))

    def finished(self, client: Client | None, one_a_task: bool = False) -> Spent:
        """A shard of going once more through finished maps, where only the way there takes time."""
        out = os.fspath(self.out)

        def again(shards: int) -> None:
            if client is None:
                for place in range(shards):
                    self.survey._native.map_shards(out, [place])
                return
            # As many pixels as a task may have make it one of a single shard.
            pixels = workers.PIXELS_A_TASK if one_a_task else SHARD
            left = [(str(place), pixels if place < shards else 0) for place in range(self.shards)]
            workers.map_on_workers(self.survey, self.out, left, client, None)

        one, every = (
            least(lambda shards=shards: spent(lambda: again(shards), client))
            for shards in (1, self.shards)
        )
        return one.to(every, self.shards - 1)


def bare(client: Client, tasks: int) -> Spent:
    """A task of Dask that has nothing to do, sent and received one by one."""

    def work(count: int) -> None:
        keys = iter(f"bare-{time.time_ns()}-{place}" for place in range(count))

        def submit() -> list[object]:
            return [client.submit(abs, 1, pure=False, key=key) for key in [next(keys, None)] if key]

        running = as_completed([each for _ in range(4) for each in submit()])
        for future in running:
            future.result()
            running.update(submit())

    one, every = (
        least(lambda count=count: spent(lambda: work(count), client)) for count in (1, tasks)
    )
    return one.to(every, tasks - 1)


def least(measured: Callable[[], Spent]) -> Spent:
    """The least of several measurements, by clock and by processors."""
    found = [measured() for _ in range(ROUNDS)]
    least_work = min(found, key=lambda each: each.processors)
    return least_work._replace(clock=min(each.clock for each in found))


def cluster_of(count: int) -> LocalCluster:
    """Workers of one thread each."""
    return LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=None)


def overhead(small: Run) -> None:
    """Prints what a shard and a task cost."""
    small.map()
    loop = small.finished(None)
    with cluster_of(1) as cluster, Client(cluster) as client:
        # The worker imports the package and prepares the survey.
        small.finished(client)
        shard, task = small.finished(client), small.finished(client, one_a_task=True)
        nothing = bare(client, small.shards)
    print("ms by the clock (of the processors):")
    for words, each in [
        ("a finished shard in a loop", loop),
        ("a finished shard on one worker", shard),
        ("a task of one finished shard", task),
        ("a task of Dask that does nothing", nothing),
    ]:
        print(f"  {words}: {1e3 * each.clock:.2f} ({1e3 * each.processors:.2f})", flush=True)


def scaling(large: Run, counts: list[int]) -> None:
    """Prints the time of a map by threads and by workers."""
    alone = least(large.map)
    print(
        f"{large.pixels} pixels in {large.shards} shards: {alone.clock:.2f} s in this process, "
        f"{alone.processors:.2f} of the processors",
        flush=True,
    )
    for count in counts:
        threads = large.by_threads(count)
        with cluster_of(count) as cluster, Client(cluster) as client:
            first, run = large.map(client), least(lambda: large.map(client))
        print(
            f"{count} threads {threads:.2f} s; {count} workers {run.clock:.2f} s, "
            f"{100 * alone.clock / run.clock / count:.0f} % of linear, "
            f"{100 * threads / run.clock:.0f} % of the threads; "
            f"{run.processors:.2f} s of the processors, {100 * alone.processors / run.processors:.0f} % of "
            f"them for the map; first map of these workers {first.clock:.2f} s, {first.processors:.2f} of "
            "the processors",
            flush=True,
        )


def main() -> None:
    counts = [int(word) for word in sys.argv[1:]] or [1, 2]
    oils = im.Library.van_gogh_oils()
    with tempfile.TemporaryDirectory() as name:
        overhead(Run(oils, Path(name), 1, 200))
        scaling(Run(oils, Path(name), 16, 16), counts)


if __name__ == "__main__":
    main()
