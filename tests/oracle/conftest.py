"""Builds the programs the tests look at, and finds things from any working directory."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(__file__).resolve().parent))


def target() -> Path:
    """Cargo's target directory."""
    given = os.environ.get("CARGO_TARGET_DIR")
    return (ROOT / given if given else ROOT / "target") / "debug"


def build() -> None:
    """Builds the programs with the profile of the tests; nothing to do when `make` has done so."""
    subprocess.run([ROOT / "tests" / "programs.sh"], check=True, stdout=subprocess.DEVNULL)


@pytest.fixture(scope="session")
def dump(tmp_path_factory: pytest.TempPathFactory):
    """Random states of several bodies with what our dynamics says about them."""
    from engines import Dump

    build()
    directory = tmp_path_factory.mktemp("dynamics")
    subprocess.run([target() / "dump_dynamics", directory, "120"], check=True)
    return Dump(directory)
