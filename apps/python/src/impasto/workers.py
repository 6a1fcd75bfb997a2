"""Maps on the workers of Dask: a task maps some neighbouring shards, and sends back none of their values."""

from __future__ import annotations

import hashlib
import json
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

from distributed import Client, KilledWorker, as_completed

from impasto.cube import Cube
from impasto.errors import Error
from impasto.library import Library
from impasto.maps import Survey

TASKS_A_WORKER = 4
"""Tasks that wait for each core, so that none is idle and a large scan needs little of the scheduler."""
PIXELS_A_TASK = 32_768
"""Pixels from which a task is large enough, some tenths of a second: Dask takes milliseconds for each."""
KILLED_TOLD = 3
"""Shards that killed their workers and are named in the error."""


def map_on_workers(
    found: Survey,
    out: Path,
    shards: Sequence[tuple[str, int]],
    client: Client,
    progress: Callable[[str], object] | None,
) -> None:
    """Maps the shards that have pixels left, each given as its name and the number of these."""
    job = Job.written(found, out)
    cores: Any = client.ncores()
    window = TASKS_A_WORKER * max(1, sum(cores.values()))
    total, done = len(shards), sum(not pixels for _, pixels in shards)
    tasks = tasks_of([pixels for _, pixels in shards], window)
    mapped: dict[str, list[int]] = {}
    killed: list[int] = []

    def submit(count: int) -> list[Any]:
        places = list(islice(tasks, count))
        if not places:
            return []
        # Another run with this cluster must not take these for its own.
        keys = [f"impasto-{out.name}-{job.sha256[:16]}-{p[0]}-{p[-1]}" for p in places]
        mapped.update(zip(keys, places))
        # All at once, since the scheduler takes as long for a message as for a task.
        futures: list[Any] = client.map(
            map_shards, places, file=job.file, sha256=job.sha256, pure=False, key=keys
        )
        return futures

    running = as_completed(submit(window))
    try:
        for finished in running.batches():
            for future in finished:
                places = mapped.pop(future.key)
                # The result would be asked of the worker, which takes as long as the task.
                if future.status != "finished":
                    error = future.exception()
                    if not isinstance(error, KilledWorker):
                        future.result()
                    killed += places
                    continue
                done += len(places)
                if progress is not None:
                    progress(f"{done} of {total} shards")
            if len(mapped) <= window // 2:
                running.update(submit(window - len(mapped)))
    except BaseException:
        client.cancel(list(running.futures))
        raise
    if killed:
        names = "; ".join(shards[place][0] for place in killed[:KILLED_TOLD])
        more = f"; {len(killed) - KILLED_TOLD} others" if len(killed) > KILLED_TOLD else ""
        raise Error(
            f"{out}: workers died at {len(killed)} of {total} shards ({names}{more})",
            "see that a worker has memory for a shard, and go on with resume=True; where machines come "
            "and go, raise distributed.scheduler.allowed-failures",
        )
    Path(job.file).unlink(missing_ok=True)


def tasks_of(pixels: Sequence[int], window: int) -> Iterator[list[int]]:
    """Places of the shards of each task: neighbours, until they have pixels enough or are too many for
    `window` tasks to have the same."""
    left = [place for place, count in enumerate(pixels) if count]
    most = max(1, len(left) // window)
    task: list[int] = []
    for place in left:
        task.append(place)
        if len(task) == most or sum(pixels[p] for p in task) >= PIXELS_A_TASK:
            yield task
            task = []
    if task:
        yield task


class Job:
    """What workers need to map a shard, as a file.

    The scheduler would copy library and survey with every task, and forgets data with the worker that holds it.
    """

    def __init__(self, file: str, sha256: str) -> None:
        self.file = file
        self.sha256 = sha256

    @classmethod
    def written(cls, found: Survey, out: Path) -> Job:
        """The job of mapping `found` into `out`, beside which its file is."""
        head = {
            "cube": os.path.abspath(found.cube.path),
            "options": found.cube._options,
            "library": found.library.to_json(),
            "settings": found._settings,
            "out": os.path.abspath(out),
        }
        # The book is megabytes of JSON, which is passed on as it is.
        job = f"{json.dumps(head)}\n{found.to_json()}".encode()
        file = Path(os.path.abspath(out.with_name(out.name + ".job.json")))
        if not file.exists() or file.read_bytes() != job:
            part = file.with_name(file.name + ".part")
            part.write_bytes(job)
            part.replace(file)
        return cls(os.fspath(file), hashlib.sha256(job).hexdigest())


def map_shards(places: list[int], file: str, sha256: str) -> int:
    """Maps shards on a worker, and returns the number of pixels that it mapped."""
    # Threads of one worker would prepare the same survey each.
    with _preparing:
        found, out = prepared(file, sha256)
    return found._native.map_shards(out, places)


_preparing = threading.Lock()


@lru_cache(maxsize=2)
def prepared(file: str, sha256: str) -> tuple[Survey, str]:
    """The survey of a job and the folder of its maps, prepared once for a worker."""
    job = Path(file).read_bytes()
    if hashlib.sha256(job).hexdigest() != sha256:
        raise Error(f"{file}: is not the job of this run", "start the run again with resume=True")
    head, book = job.decode().split("\n", 1)
    told = json.loads(head)
    cube = Cube._opened(told["cube"], told["options"])
    library = Library.from_json(told["library"])
    return Survey(cube, library, told["settings"], book, None), told["out"]
