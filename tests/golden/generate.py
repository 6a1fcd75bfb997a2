"""Remake the golden values and the data tables.

    python tests/golden/generate.py            writes them
    python tests/golden/generate.py --check    makes them in memory, exits with 1
                                               and names the files that differ

Every JSON file says how its numbers were made and how close a test must come.
"""

import argparse
import json
import pathlib
import sys

import tables
from colours import adaptation, difference, lab, luv, rgb, sharma, whiteness
from common import rounded
from films import km
from rendering import rendering
from segmentation import segmentation
from spectral import blackbody, daylight, metamerism, resampling, xyz

COMMAND = "python tests/golden/generate.py"
HERE = "tests/golden"

# Function and number of decimals: a tenth of the tolerance and no finer, because further
# digits differ between machines. km.json is rounded once, to doubles.
GOLDEN = {
    "xyz.json": (xyz, 10),
    "sprague.json": (resampling, 12),
    "lab.json": (lab, 10),
    "luv.json": (luv, 10),
    "whiteness.json": (whiteness, 9),
    "difference.json": (difference, 10),
    "sharma.json": (sharma, 10),
    "daylight.json": (daylight, 10),
    "blackbody.json": (blackbody, 10),
    "adaptation.json": (adaptation, 10),
    "rgb.json": (rgb, 11),
    "metamerism.json": (metamerism, 9),
    "rendering.json": (rendering, 4),
    "km.json": (km, None),
    "segmentation.json": (segmentation, 6),
}


def lines(value, depth):
    """JSON with each object of a list on a line, so that a changed case is one line."""
    pad = " " * depth
    if isinstance(value, list) and value and isinstance(value[0], dict):
        rows = [f"{pad} {json.dumps(v, ensure_ascii=True)}" for v in value]
        return "[\n" + ",\n".join(rows) + f"\n{pad}]"
    if isinstance(value, dict) and depth < 2:
        rows = [f"{pad} {json.dumps(k)}: {lines(v, depth + 1)}" for k, v in value.items()]
        return "{\n" + ",\n".join(rows) + f"\n{pad}}}"
    return json.dumps(value, ensure_ascii=True)


def golden_files():
    out = {}
    for name, (function, places) in GOLDEN.items():
        made = function()
        if places is not None:
            parts = {k: v for k, v in made.items() if k != "tolerance"}
            made = {**made, **rounded(parts, places)}
        record = {
            "command": COMMAND,
            "package": f"colour-science {tables.VERSION}",
            "method": "",
            "tolerance": 0.0,
            # Data that the cases share come before the cases.
            **{k: v for k, v in made.items() if k != "cases"},
            "cases": made["cases"],
        }
        out[f"{HERE}/{name}"] = lines(record, 0) + "\n"
    return out


def alike(old, new, slack):
    """Whether two records are equal, with floats within slack of each other."""
    if type(old) is not type(new):
        return False
    if isinstance(new, dict):
        return list(old) == list(new) and all(alike(old[k], new[k], slack) for k in new)
    if isinstance(new, list):
        return len(old) == len(new) and all(alike(o, n, slack) for o, n in zip(old, new))
    if isinstance(new, float):
        return abs(old - new) <= slack
    return old == new


def current(path, text):
    """Whether a file is up to date.

    Files are compared to the byte, with one exception: a value close to the edge between
    two roundings can be rounded differently on another machine. So the last decimal of a
    golden value may differ by one, and the older file is then kept.
    """
    at = tables.ROOT / path
    if not at.is_file():
        return False
    old = at.read_bytes()
    if old == text.encode("ascii"):
        return True
    _, places = GOLDEN.get(pathlib.PurePosixPath(path).name, (None, None))
    if places is None:
        return False
    try:
        old = json.loads(old)
    except ValueError:
        return False
    # The old file must have the layout that this program writes.
    if (lines(old, 0) + "\n").encode("ascii") != at.read_bytes():
        return False
    new = json.loads(text)
    return old["tolerance"] == new["tolerance"] and alike(old, new, 1.5 * 10.0**-places)


def main():
    parser = argparse.ArgumentParser(description="Remake golden values and data tables.")
    parser.add_argument("--check", action="store_true", help="write nothing, compare")
    wanted = parser.parse_args()
    tables.check_version()
    texts = {**tables.files(), **golden_files()}
    stale = {path: text for path, text in texts.items() if not current(path, text)}
    if wanted.check:
        for path in sorted(stale):
            print(f"differs: {path}")
        sys.exit(1 if stale else 0)
    tables.write(tables.ROOT, stale)


if __name__ == "__main__":
    main()
