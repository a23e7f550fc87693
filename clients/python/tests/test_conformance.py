"""The vectors of `tests/conformance`, as Rust and TypeScript read them too. `SINEW_REWRITE=1` fills in their `wire`."""

from __future__ import annotations

import importlib
import json
import math
import os
from pathlib import Path
from typing import Any

import grpc
import pytest
from conftest import ROOT
from google.protobuf import json_format

import sinew
from sinew.errors import from_rpc
from sinew.v1 import (
    body_pb2,
    figure_pb2,
    motion_pb2,
    obstacle_pb2,
    operation_pb2,
    perturbation_pb2,
    server_pb2,
    simulation_pb2,
    state_pb2,
    world_pb2,
)

FILES = sorted((ROOT / "tests" / "conformance").glob("*.json"))
MODULES = (
    body_pb2,
    figure_pb2,
    motion_pb2,
    obstacle_pb2,
    operation_pb2,
    perturbation_pb2,
    server_pb2,
    simulation_pb2,
    state_pb2,
    world_pb2,
)
SERVICES = {s.full_name: s for m in MODULES for s in m.DESCRIPTOR.services_by_name.values()}
DEFAULTS: tuple[Any, ...] = (0, "0", "", False, [])


def message_class(descriptor: Any) -> Any:
    module = importlib.import_module(descriptor.file.name.removesuffix(".proto").replace("/", ".") + "_pb2")
    return getattr(module, descriptor.name)


def method_of(vector: dict[str, Any]) -> Any:
    service, name = vector["method"].split("/")
    return SERVICES[service].methods_by_name[name]


def request_of(vector: dict[str, Any]) -> Any:
    kind = message_class(method_of(vector).input_type)
    return json_format.ParseDict(vector["request"], kind())


def differences(wanted: Any, got: Any, at: str) -> list[str]:
    """Where `wanted` is not part of `got`."""
    if isinstance(wanted, dict) and isinstance(got, dict):
        out = []
        for name, value in wanted.items():
            if name in got:
                out += differences(value, got[name], f"{at}.{name}")
            elif value not in DEFAULTS:
                out.append(f"{at}.{name}: absent instead of {value!r}")
        return out
    if isinstance(wanted, list) and isinstance(got, list) and len(wanted) == len(got):
        return [d for i, (w, g) in enumerate(zip(wanted, got)) for d in differences(w, g, f"{at}[{i}]")]
    both = (wanted, got)
    if all(isinstance(x, (int, float)) and not isinstance(x, bool) for x in both):
        return [] if math.isclose(wanted, got, rel_tol=1e-9) else [f"{at}: {got} instead of {wanted}"]
    return [] if wanted == got else [f"{at}: {got!r} instead of {wanted!r}"]


def outcome(error: grpc.RpcError) -> dict[str, str]:
    refusal = from_rpc(error)
    parts = {
        "code": refusal.code.name,
        "reason": refusal.reason,
        "field": getattr(refusal, "field", ""),
        "resource": getattr(refusal, "resource", ""),
    }
    return {k: v for k, v in parts.items() if v}


@pytest.fixture(scope="module")
def channel() -> Any:
    """A server that no other test uses."""
    with sinew.serve() as client:
        yield client._channel


@pytest.mark.usefixtures("server")
@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_every_vector_has_the_outcome_it_names(path: Path, channel: grpc.Channel) -> None:
    scenario = json.loads(path.read_text())
    names = [v["name"] for v in scenario["vectors"]]
    assert names and len(set(names)) == len(names)
    failures = []
    for vector in scenario["vectors"]:
        method, request = method_of(vector), request_of(vector)
        name = f"/{method.containing_service.full_name}/{method.name}"
        kind = message_class(method.output_type)
        wanted = dict(vector["outcome"])
        response = wanted.pop("response", {})
        try:
            if method.server_streaming:
                call = channel.unary_stream(name, type(request).SerializeToString, kind.FromString)(request, timeout=60)
                answer = next(call)
                call.cancel()
            else:
                answer = channel.unary_unary(name, type(request).SerializeToString, kind.FromString)(
                    request, timeout=60
                )
            got, wrong = {"code": "OK"}, differences(response, json_format.MessageToDict(answer), "response")
        except grpc.RpcError as e:
            got, wrong = outcome(e), []
        if "resource" not in wanted:
            got.pop("resource", None)
        if got != wanted:
            wrong.append(f"{got} instead of {wanted}")
        failures += [f"{vector['name']}: {w}" for w in wrong]
    assert not failures, "\n".join(failures)


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_requests_are_written_as_the_vectors_say(path: Path) -> None:
    text = path.read_text()
    scenario = json.loads(text)
    for vector in scenario["vectors"]:
        wire = request_of(vector).SerializeToString(deterministic=True).hex()
        if os.environ.get("SINEW_REWRITE"):
            begin = text.index(f'"name": {json.dumps(vector["name"], ensure_ascii=False)}')
            old = f'"wire": "{vector["wire"]}"'
            at = text.index(old, begin)
            text = text[:at] + f'"wire": "{wire}"' + text[at + len(old) :]
            continue
        assert wire == vector["wire"], vector["name"]
        read = message_class(method_of(vector).input_type).FromString(bytes.fromhex(wire))
        assert read.SerializeToString(deterministic=True).hex() == wire, vector["name"]
    if os.environ.get("SINEW_REWRITE"):
        path.write_text(text)
