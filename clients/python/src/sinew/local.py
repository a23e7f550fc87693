"""A server of one's own, for scripts and examples."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from sinew._client import Client

__all__ = ["serve"]

_GRACE_S = 15.0


def binary() -> str:
    """The `sinew` program: `$SINEW_BIN`, or the one on the path."""
    named = os.environ.get("SINEW_BIN")
    found = shutil.which(named or "sinew")
    if found is None:
        where = f"$SINEW_BIN is {named!r}, which" if named else "`sinew`"
        raise FileNotFoundError(f"{where} is not a program; `cargo install --path .` in the repository makes one")
    return found


@contextmanager
def serve(*, arguments: Sequence[str] = ()) -> Iterator[Client]:
    """Starts a server on a free port of this machine and gives a client; both end with the block.

    If `$SINEW_SERVER` names the address of a server, that one is used and left running. `arguments` are added to
    `sinew serve`.
    """
    there = os.environ.get("SINEW_SERVER")
    if there:
        with Client(there) as client:
            yield client
        return
    process = subprocess.Popen(
        [binary(), "serve", "--log", "warn", "--listen", "127.0.0.1:0", "--no-demo", *arguments],
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None, "it was asked for"
    reader: threading.Thread | None = None
    try:
        address = ""
        for line in process.stdout:
            found = re.search(r"http://([0-9.]+:\d+)", line)
            if found:
                address = found.group(1)
                break
        if not address:
            raise RuntimeError(f"the server ended with status {process.wait()} before it served")
        # A program whose output is not read stops when the pipe is full.
        reader = threading.Thread(target=process.stdout.read, name="sinew-serve", daemon=True)
        reader.start()
        with Client(address) as client:
            yield client
    finally:
        process.terminate()
        try:
            process.wait(_GRACE_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        if reader is not None:
            reader.join()
        process.stdout.close()
