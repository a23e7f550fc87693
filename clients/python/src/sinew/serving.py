"""A server of one's own for as long as a block runs: for examples, notebooks and tests."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sinew.client import Client
from sinew.errors import UnavailableError


def find() -> str:
    """The server program: `SINEW_SERVER`, `sinew` on the path, or the newest build of the clone around the working directory."""
    given = os.environ.get("SINEW_SERVER") or shutil.which("sinew")
    if given:
        return given
    here = Path.cwd()
    for folder in (here, *here.parents):
        if (folder / "proto" / "sinew" / "v1").is_dir():
            built = [p for kind in ("release", "debug") if (p := folder / "target" / kind / "sinew").is_file()]
            if built:
                return str(max(built, key=lambda p: p.stat().st_mtime))
    raise UnavailableError("no server program: set SINEW_SERVER, put `sinew` on the path, or run `cargo build --release` in a clone")


@contextmanager
def serve(program: str | os.PathLike[str] | None = None, *options: str) -> Iterator[Client]:
    """Starts a server on a free port of this machine and yields a client of it; both end with the block.

    `options` are those of `sinew serve`. The demo world is left out.
    """
    command = [os.fspath(program) if program else find(), "serve", "--listen", "127.0.0.1:0", "--no-demo", *options]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said: list[str] = []
    errors = threading.Thread(target=lambda: said.extend(process.stderr or ()), daemon=True)
    errors.start()
    try:
        address = None
        for line in process.stdout or ():
            found = re.search(r"http://(\S+:\d+)", line)
            if found:
                address = found.group(1)
                break
        if address is None:
            process.wait(timeout=20)
            errors.join(timeout=5)
            raise UnavailableError(f"the server did not start: {''.join(said).strip()}")
        drain = threading.Thread(target=lambda: process.stdout.read() if process.stdout else "", daemon=True)
        drain.start()
        with Client(address) as client:
            yield client
    finally:
        process.terminate()
        try:
            process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        for pipe in (process.stdout, process.stderr):
            if pipe is not None:
                pipe.close()
