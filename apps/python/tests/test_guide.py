"""The guide's blocks run, and print what the guide says."""

from __future__ import annotations

import doctest
import shutil
import warnings
from pathlib import Path

import pytest
from conftest import OILS_CSV, ROOT


def test_the_guide_runs_as_printed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("zarr", reason="zarr 3 needs Python 3.11")
    shutil.copy(OILS_CSV, tmp_path)
    monkeypatch.chdir(tmp_path)
    guide = ROOT / "docs/guide/python.md"
    # The fences of Markdown are not part of the expected output.
    text = guide.read_text().replace("```python\n", "\n").replace("```\n", "\n")
    test = doctest.DocTestParser().get_doctest(text, {}, "python.md", str(guide), 0)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    with warnings.catch_warnings():
        runner.run(test)
    assert runner.tries > 30 and runner.failures == 0
    assert (tmp_path / "report/report.html").exists()
