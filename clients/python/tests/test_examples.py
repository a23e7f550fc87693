"""Every example runs, as a notebook and as a script of the same cells; so do the small clients of each language."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from conftest import ROOT, binary
from nbclient import NotebookClient

import sinew

EXAMPLES = ROOT / "clients" / "python" / "examples"
NAMES = sorted(p.stem for p in EXAMPLES.glob("*.py"))


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch, corpus: Path, server: sinew.Client) -> None:
    """Examples at a size for tests, on the server that is there."""
    settings = {
        "SINEW_EXAMPLE_S": "2.5",
        "SINEW_EXAMPLE_DIRECTIONS": "4",
        "SINEW_BVH": str(corpus / "wave.vrm.bvh"),
        "SINEW_SERVER": server.address,
        "MPLBACKEND": "Agg",
    }
    for name, value in settings.items():
        monkeypatch.setenv(name, value)


def test_there_are_examples() -> None:
    assert NAMES == ["audit_with_pinocchio", "lift_the_same_crate", "own_mocap", "push_recovery_map"]


@pytest.mark.nightly
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", NAMES)
def test_notebook(name: str, small: None, tmp_path: Path) -> None:
    notebook = nbformat.read(EXAMPLES / f"{name}.ipynb", as_version=4)
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    printed = [o.text for c in notebook.cells if c.cell_type == "code" for o in c.outputs if o.output_type == "stream"]
    assert printed


@pytest.mark.parametrize("name", NAMES)
def test_script(name: str, small: None, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, EXAMPLES / f"{name}.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip()


def test_the_ten_lines_of_the_readme(small: None, tmp_path: Path) -> None:
    text = (ROOT / "clients" / "python" / "README.md").read_text()
    code = text.split("```python\n")[1].split("```")[0]
    assert len(code.strip().splitlines()) <= 10
    script = tmp_path / "ten.py"
    script.write_text(code)
    subprocess.run([sys.executable, script], cwd=tmp_path, check=True, timeout=120)
    assert (tmp_path / "torques.png").stat().st_size > 10_000


def test_the_small_clients_say_the_same(server: sinew.Client) -> None:
    rust = binary().parent / "examples" / "client"
    assert rust.is_file(), "run `cargo build -p sinew-client --example client`"
    python = [sys.executable, ROOT / "clients" / "examples" / "python" / "client.py"]
    said = [
        subprocess.run(
            [*command, server.address], capture_output=True, text=True, check=True, timeout=60, env=dict(os.environ)
        ).stdout
        for command in ([rust], python)
    ]
    assert said[0] == said[1] and said[0].count("right shoulder") == 8 and "state " in said[0]
