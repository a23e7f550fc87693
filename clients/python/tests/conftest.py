"""A server for the tests: the debug build of this repository, on a free port."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import matplotlib
import pytest

import sinew

ROOT = Path(__file__).resolve().parents[3]
matplotlib.use("Agg")


def binary() -> Path:
    """The server under test; `make python` builds it."""
    given = os.environ.get("CARGO_TARGET_DIR")
    out = (ROOT / given if given else ROOT / "target") / "debug" / ("sinew.exe" if sys.platform == "win32" else "sinew")
    assert out.is_file(), f"no server at {out}: run `cargo build --bin sinew`"
    return out


@pytest.fixture(scope="session")
def server() -> Iterator[sinew.Client]:
    """A client of a server of its own."""
    os.environ.setdefault("SINEW_BIN", str(binary()))
    with sinew.serve() as client:
        yield client


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The synthesised motion capture of the repository."""
    return ROOT / "tests" / "corpus"
