"""The oils that ship, as the tests of the program know them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import impasto as im

ROOT = Path(__file__).parents[3]
OILS_CSV = ROOT / "measurements/van-gogh-oils.csv"
OILS_JSON = ROOT / "measurements/van-gogh-oils.pigments.json"


@pytest.fixture(scope="session")
def oils() -> im.Library:
    return im.Library.load(OILS_JSON)


@pytest.fixture(scope="session")
def readings() -> im.Readings:
    return im.read(OILS_CSV)


@pytest.fixture(scope="session")
def golden() -> Any:
    return lambda name: json.loads((ROOT / f"tests/golden/{name}.json").read_text())
