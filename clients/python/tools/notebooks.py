"""Makes the notebooks in `examples` from the scripts beside them; `tests/test_generated.py` compares.

A script is a sequence of cells: `# %%` begins code, `# %% [markdown]` text, written as comments.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def scripts() -> list[Path]:
    """The examples."""
    return sorted(EXAMPLES.glob("*.py"))


def notebook(script: Path) -> str:
    """The notebook of one script."""
    cells = []
    for part in re.split(r"^# %%", script.read_text(), flags=re.MULTILINE)[1:]:
        kind, _, text = part.partition("\n")
        markdown = "[markdown]" in kind
        text = text.strip("\n")
        if markdown:
            text = re.sub(r"^# ?", "", text, flags=re.MULTILINE)
        lines = text.splitlines(keepends=True)
        cell: dict[str, object] = {
            "cell_type": "markdown" if markdown else "code",
            "id": f"cell-{len(cells)}",
            "metadata": {},
            "source": lines,
        }
        if not markdown:
            cell |= {"execution_count": None, "outputs": []}
        cells.append(cell)
    python = {"display_name": "Python 3", "language": "python", "name": "python3"}
    whole = {
        "cells": cells,
        "metadata": {"kernelspec": python, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    for path in scripts():
        path.with_suffix(".ipynb").write_text(notebook(path))
