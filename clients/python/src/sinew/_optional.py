"""Packages that are imported where they are used, and what to say when one is not there."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def needed(package: str, extra: str, purpose: str) -> Iterator[None]:
    """Around an import of `package`: an `ImportError` then names it and the extra of `sinew` that installs it."""
    try:
        yield
    except ModuleNotFoundError as e:
        if (e.name or "").split(".", 1)[0] != package:
            raise
        raise ImportError(
            f"{purpose} needs the package {package}, which is not installed: "
            f"pip install 'sinew[{extra}]' (or pip install {package})",
            name=package,
        ) from e
