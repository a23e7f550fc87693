"""What is generated is what its generator makes now, and says nothing of the machine that made it."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

from conftest import ROOT

HERE = ROOT / "clients" / "python"
PACKAGE = HERE / "src"
sys.path.insert(0, str(HERE / "tools"))


def test_the_stubs_are_those_of_the_protos(tmp_path: Path) -> None:
    import generate

    made = generate.generate(tmp_path)
    there = sorted(p.relative_to(PACKAGE) for p in PACKAGE.glob("sinew/v1/*_pb2*") if p.suffix in (".py", ".pyi"))
    assert made == there, "run clients/python/tools/generate.py"
    for path in made:
        assert (tmp_path / path).read_text() == (PACKAGE / path).read_text(), (
            f"{path}: run clients/python/tools/generate.py"
        )


def test_the_plain_client_is_the_other_one_without_waiting() -> None:
    import unasync

    text = (PACKAGE / "sinew" / "_client.py").read_text()
    assert text == unasync.plain(), "run clients/python/tools/unasync.py"
    assert not re.search(r"\b(async|await|asyncio)\b", text.split("\n", 1)[1])


def test_the_notebooks_are_the_examples() -> None:
    import notebooks

    for script in notebooks.scripts():
        there = script.with_suffix(".ipynb").read_text()
        assert there == notebooks.notebook(script), "run clients/python/tools/notebooks.py"


def test_nothing_names_a_machine() -> None:
    strange = re.compile(r"/(home|root|tmp|work|Users)/|https?://(?!127\.0\.0\.1|protobuf\.dev|github\.com)\w")
    files = [
        p for p in HERE.rglob("*") if p.suffix in (".py", ".pyi", ".ipynb", ".toml", ".md", ".txt") and p.is_file()
    ]
    kept = subprocess.run(
        ["git", "ls-files", "--", str(HERE)], cwd=ROOT, capture_output=True, text=True, check=False
    ).stdout
    tracked = {ROOT / line for line in kept.splitlines()}
    for path in files:
        if path in tracked and path.name != "test_generated.py":
            assert not strange.search(path.read_text()), path


def test_types_are_strict() -> None:
    done = subprocess.run([sys.executable, "-m", "mypy"], cwd=HERE, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
