"""The package builds and works where nothing else of ours is installed."""

from __future__ import annotations

import os
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest
from conftest import ROOT

import sinew

HERE = ROOT / "clients" / "python"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("dist")
    build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(out), str(HERE)]
    subprocess.run(build, check=True, capture_output=True)
    (made,) = out.glob("*.whl")
    return made


def test_the_wheel_holds_types_and_stubs_and_no_tests(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {"sinew/__init__.py", "sinew/py.typed", "sinew/v1/state_pb2.py", "sinew/v1/state_pb2_grpc.pyi"} <= set(names)
    assert all(n.startswith(("sinew/", "sinew-")) for n in names)
    assert f"sinew-{sinew.__version__}" in wheel.name


def test_its_version_is_the_servers(server: sinew.Client) -> None:
    assert server.info().version == sinew.__version__


def test_it_works_in_an_environment_of_its_own(wheel: Path, server: sinew.Client, tmp_path: Path) -> None:
    venv.create(tmp_path / "venv", with_pip=False)
    python = tmp_path / "venv" / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    # From the registry as a user would, so that a forgotten dependency is seen.
    install = [
        sys.executable,
        "-m",
        "pip",
        "--python",
        str(python),
        "install",
        "--quiet",
        "--disable-pip-version-check",
        str(wheel),
    ]
    subprocess.run(install, check=True, timeout=300)
    code = (
        "import sys, matplotlib; matplotlib.use('Agg'); import sinew\n"
        "r = sinew.Client(sys.argv[1]).simulate('wave', duration_s=0.5)\n"
        "r.plot_torques(); r.strip(2); print(r)\n"
    )
    clean = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    done = subprocess.run(
        [python, "-c", code, server.address], cwd=tmp_path, env=clean, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "30 ticks" in done.stdout
