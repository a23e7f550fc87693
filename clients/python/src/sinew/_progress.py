"""Progress bars: shown when someone looks (a terminal or a notebook), or as told."""

from __future__ import annotations

import sys
from types import TracebackType
from typing import Any

from sinew._optional import needed


def _watched() -> bool:
    return sys.stderr.isatty() or "ipykernel" in sys.modules


class Progress:
    """A bar over `total` units, or nothing. `show` `None`: if someone looks."""

    def __init__(self, total: float, what: str, unit: str, show: bool | None) -> None:
        self._bar: Any = None
        if show or (show is None and _watched()):
            # The plain bar also in notebooks: the other one wants widgets, which many do not have.
            try:
                with needed("tqdm", "progress", "a progress bar"):
                    from tqdm import tqdm
            except ImportError:
                if show:
                    raise
                return  # it was not asked for
            form = "{desc}: {percentage:3.0f}% |{bar}| {n:.1f}/{total:.1f} {unit} [{elapsed}<{remaining}]"
            self._bar = tqdm(total=total, desc=what, unit=unit, bar_format=form, leave=False)

    def __enter__(self) -> Progress:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.close()

    def add(self, amount: float) -> None:
        """So much more is done."""
        if self._bar is not None:
            self._bar.update(amount)
