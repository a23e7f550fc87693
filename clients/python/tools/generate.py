"""Makes the modules of `sinew.v1` from `proto/sinew/v1`. `tests/test_generated.py` runs this and compares.

Needs grpcio-tools and mypy-protobuf in the versions of `clients/python/requirements-dev.txt`.
"""

from __future__ import annotations

import sys
from pathlib import Path

from grpc_tools import protoc

ROOT = Path(__file__).resolve().parents[3]
PACKAGE = Path(__file__).resolve().parents[1] / "src"


def generate(out: Path) -> list[Path]:
    """Writes them below `out`; returns their paths relative to it."""
    protos = sorted((ROOT / "proto" / "sinew" / "v1").glob("*.proto"))
    services = [p for p in protos if "\nservice " in p.read_text()]
    programs = Path(sys.executable).parent
    include = [f"-I{ROOT / 'proto'}", f"-I{Path(protoc.__file__).parent / '_proto'}"]
    messages = [
        f"--plugin=protoc-gen-mypy={programs / 'protoc-gen-mypy'}",
        f"--python_out={out}",
        f"--mypy_out=quiet:{out}",
    ]
    stubs = [
        f"--plugin=protoc-gen-mypy_grpc={programs / 'protoc-gen-mypy_grpc'}",
        f"--grpc_python_out={out}",
        f"--mypy_grpc_out=quiet:{out}",
    ]
    for options, files in ((messages, protos), (stubs, services)):
        if protoc.main(["protoc", *include, *options, *map(str, files)]) != 0:
            raise RuntimeError("protoc failed")
    return sorted(p.relative_to(out) for p in out.glob("sinew/v1/*_pb2*"))


if __name__ == "__main__":
    for path in generate(PACKAGE):
        print(path)
