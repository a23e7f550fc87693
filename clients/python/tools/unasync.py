"""Makes `_client.py` from `_async_client.py`: the same client without asyncio. `tests/test_generated.py` compares."""

from __future__ import annotations

import re
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "src" / "sinew"
DOCSTRING = (
    '"""The client for plain calls, made from `_async_client.py` by `clients/python/tools/unasync.py`: do not edit."""'
)
REPLACED = [
    (r'^""".*?"""', DOCSTRING),
    (r"\basync (def|with|for)\b", r"\1"),
    (r"\bawait \((.*)\)\.delete\(\)", r"\1.delete()"),
    (r"\bawait ", ""),
    (r"\b_async_support\b", "_sync_support"),
    (r"\b__a(enter|exit|iter|next)__\b", r"__\1__"),
    (r"\bStopAsyncIteration\b", "StopIteration"),
]


def plain() -> str:
    """Text of `_client.py`."""
    text = (PACKAGE / "_async_client.py").read_text()
    for pattern, by in REPLACED:
        text = re.sub(pattern, by, text, flags=re.MULTILINE)
    return text


if __name__ == "__main__":
    (PACKAGE / "_client.py").write_text(plain())
