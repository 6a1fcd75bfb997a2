"""Threads of Python compute beside each other, also where a process shares work among one thread only."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from test_maps import envi, painted

import impasto as im

PROGRAM = """
import sys, threading, time
from pathlib import Path
import numpy as np
import impasto as im

oils = im.Library.van_gogh_oils()
recipes = np.random.default_rng(2).dirichlet(np.ones(len(oils)), size=50_000)
colours = np.full((200_000, 31), 0.5)

def own_part(work):
    '''Part of the processors' time of this work that its own thread took.'''
    found = []
    def measured():
        before, all_before = time.thread_time(), time.process_time()
        work()
        found.append((time.thread_time() - before) / (time.process_time() - all_before))
    thread = threading.Thread(target=measured)
    thread.start()
    thread.join()
    return found[0]

print("mix", own_part(lambda: oils.mix(recipes)))
print("xyz", own_part(lambda: im.color.xyz(colours, wavelengths=oils.wavelengths)))

def ticks(file):
    fields = file.read_text().rsplit(") ", 1)[1].split()
    return int(fields[11]) + int(fields[12])

cube = im.Cube.open(sys.argv[1])
survey = im.survey(cube, oils)
own, start = [0], ticks(Path("/proc/self/stat"))
def progress(_):
    for task in Path("/proc/self/task").iterdir():
        if (task / "comm").read_text().strip() == "impasto-work":
            own.append(ticks(task / "stat"))
im.pigment_map(cube, oils, sys.argv[2], survey=survey, progress=progress)
print("map", max(own) / (ticks(Path("/proc/self/stat")) - start))
"""


def test_a_thread_does_its_own_work(oils: im.Library, tmp_path: Path) -> None:
    values, _ = painted(oils, 8, 2048 * 8)
    scan = envi(tmp_path / "scan.hdr", values, oils.wavelengths)
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(scan), str(tmp_path / "maps.zarr")],
        env={**os.environ, "RAYON_NUM_THREADS": "1"},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    parts = {name: float(part) for name, part in map(str.split, run.stdout.splitlines())}
    assert set(parts) == {"mix", "xyz", "map"}
    assert min(parts.values()) > 0.5, parts
