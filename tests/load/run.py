"""Sends the calls of cases.json to a server with ghz, and prints a row for each; anything but OK fails.

run.sh starts the server and calls this: run.py GHZ ADDRESS [--scale N] [--table FILE]
"""

from __future__ import annotations

import argparse
import base64
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import grpc
from google.protobuf import json_format
from sinew.v1 import (
    access_pb2,
    body_pb2,
    checkpoint_pb2,
    control_pb2,
    figure_pb2,
    history_pb2,
    motion_pb2,
    obstacle_pb2,
    operation_pb2,
    perturbation_pb2,
    recording_pb2,
    server_pb2,
    simulation_pb2,
    state_pb2,
    world_pb2,
)

HERE = Path(__file__).parent
FILES = [
    access_pb2,
    body_pb2,
    checkpoint_pb2,
    control_pb2,
    figure_pb2,
    history_pb2,
    motion_pb2,
    obstacle_pb2,
    operation_pb2,
    perturbation_pb2,
    recording_pb2,
    server_pb2,
    simulation_pb2,
    state_pb2,
    world_pb2,
]
BEGIN, END = "<!-- load: begin -->", "<!-- load: end -->"


def filled(data: Any, known: dict[str, Any]) -> Any:
    """The request with `$name` replaced by what is known under that name."""
    if isinstance(data, dict):
        return {key: filled(value, known) for key, value in data.items()}
    if isinstance(data, list):
        return [filled(value, known) for value in data]
    if isinstance(data, str) and data.startswith("$"):
        return known[data[1:]]
    return data


def part(answer: Any, path: str) -> Any:
    """A field of an answer, by its path."""
    for name in path.split("."):
        answer = answer[name]
    return answer


def ask(channel: grpc.Channel, call: str, data: Any) -> dict[str, Any]:
    """One call, for what later cases need of its answer."""
    service, name = call.split("/")
    for file in FILES:
        if service in file.DESCRIPTOR.services_by_name:
            method = file.DESCRIPTOR.services_by_name[service].methods_by_name[name]
            request = json_format.ParseDict(data, getattr(file, method.input_type.name)())
            answer = channel.unary_unary(
                f"/{method.containing_service.full_name}/{name}",
                request_serializer=type(request).SerializeToString,
                response_deserializer=getattr(file, method.output_type.name).FromString,
            )(request)
            return json_format.MessageToDict(answer)
    raise SystemExit(f"load: there is no {call}")


def load(ghz: str, address: str, case: dict[str, Any], data: Any, total: int) -> dict[str, Any]:
    """Lets ghz send a case."""
    with tempfile.TemporaryDirectory() as folder:
        file, report = Path(folder) / "data.json", Path(folder) / "report.json"
        file.write_text(json.dumps(data))
        command = [
            *(ghz, "--insecure", "--call", f"sinew.v1.{case['call']}", "--data-file", str(file)),
            *("--total", str(total), "--concurrency", str(min(case["at_a_time"], total))),
            *("--connections", str(min(case.get("connections", 1), total))),
            *("--timeout", "120s", "--format", "json", "--output", str(report)),
        ]
        if "rps" in case:
            command += ["--rps", str(case["rps"])]
        if "messages" in case:
            command += ["--stream-call-count", str(case["messages"])]
        done = subprocess.run([*command, address], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"load: ghz: {case['call']}: {(done.stderr + done.stdout)[:1000]}")
        return json.loads(report.read_text())


def main() -> None:
    """Sends everything."""
    options = argparse.ArgumentParser()
    options.add_argument("ghz")
    options.add_argument("address")
    options.add_argument("--scale", type=int, default=1)
    options.add_argument("--table", type=Path)
    arguments = options.parse_args()
    wave = (HERE.parent / "corpus" / "wave.vrm.bvh").read_bytes()
    known: dict[str, Any] = {"wave": base64.b64encode(wave).decode(), "angles": [0.0] * 39}
    rows = ["| call | calls × at a time | per second | p50, ms | p99, ms |", "|---|---|---|---|---|"]
    failed = []
    with grpc.insecure_channel(arguments.address) as channel:
        for case in json.loads((HERE / "cases.json").read_text()):
            data = filled(case["data"], known)
            if "first" in case:
                answer = ask(channel, case["first"], data)
                known |= {name: part(answer, path) for name, path in case.get("keep", {}).items()}
                continue
            # What makes things by number makes as many as later cases name.
            repeats = case["total"] >= 100
            total = case["total"] * (arguments.scale if repeats else 1)
            report = load(arguments.ghz, arguments.address, case, data, total)
            codes = report["statusCodeDistribution"]
            at = {p["percentage"]: p["latency"] / 1e6 for p in report.get("latencyDistribution") or []}
            rate = report["rps"]
            # Streams that have no end are left after their messages. ghz calls that an error, and times none of them.
            expected = "Canceled" if "messages" in case else "OK"
            if expected == "OK":
                p50, p99 = (f"{at.get(p) or report['slowest'] / 1e6:.2f}" for p in (50, 99))
            else:
                p50, p99 = "–", "–"
            print(f"{case['call']:42} {report['count']:6} calls {rate:9.0f} /s  p50 {p50:>8} ms  p99 {p99:>8} ms")
            rows.append(f"| `{case['call']}` | {report['count']} × {case['at_a_time']} | {rate:.0f} | {p50} | {p99} |")
            if codes != {expected: total}:
                failed.append(case["call"])
                print(f"load: unexpected answers: {codes} {report.get('errorDistribution')}", file=sys.stderr)
    if failed:
        raise SystemExit(f"load: failed: {', '.join(failed)}")
    if arguments.table:
        text = arguments.table.read_text()
        before, after = text.split(BEGIN)[0], text.split(END)[1]
        arguments.table.write_text(f"{before}{BEGIN}\n\n" + "\n".join(rows) + f"\n\n{END}{after}")


if __name__ == "__main__":
    main()
