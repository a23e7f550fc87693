"""A package that is not there is named, with the extra that brings it."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
from conftest import ROOT

# In a process of its own, where the package cannot be imported.
CODE = """
import sys

class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] == {package!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Hidden())
import numpy as np
import sinew
from sinew._progress import Progress
from sinew.v1 import body_pb2

none = np.zeros(0)
r = sinew.Recording("anna", sinew.Body(body_pb2.Body()), 60.0, none.astype(np.int64), none, [])
both = sinew.Recordings({{"anna": r}})
with Progress(1.0, "quietly", "s", None):
    pass
try:
    {call}
except ImportError as e:
    print(e)
else:
    print("no error")
"""
CASES = [
    ("matplotlib", "plot", "r.plot_torques()"),
    ("matplotlib", "plot", "r.strip()"),
    ("matplotlib", "plot", "both.plot_torques()"),
    ("matplotlib", "plot", "both.strip()"),
    ("pandas", "pandas", "r.to_pandas()"),
    ("pandas", "pandas", "both.to_pandas()"),
    ("tqdm", "progress", "Progress(1.0, 'bar', 's', True)"),
]


@pytest.mark.parametrize(("package", "extra", "call"), CASES)
def test_the_error_names_package_and_extra(package: str, extra: str, call: str) -> None:
    code = CODE.format(package=package, call=call)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    assert f"needs the package {package}" in done.stdout and f"sinew[{extra}]" in done.stdout, done.stdout
    # The extra is there and brings it.
    project = (ROOT / "clients" / "python" / "pyproject.toml").read_text()
    assert re.search(rf'^{extra} = \["{package}[>=]', project, re.MULTILINE)


def test_an_error_within_the_package_is_not_hidden() -> None:
    from sinew._optional import needed

    with pytest.raises(ModuleNotFoundError, match="something_else"), needed("matplotlib", "plot", "plotting"):
        raise ModuleNotFoundError("No module named 'something_else'", name="something_else")
