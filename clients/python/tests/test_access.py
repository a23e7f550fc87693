"""A server with TLS and tokens: who says who they are gets in, and others learn why they do not."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import binary

import sinew
from sinew.v1 import access_pb2, control_pb2


@pytest.fixture
def guarded(tmp_path: Path) -> Iterator[tuple[str, Path]]:
    """The address of such a server, and the directory with its files."""
    made = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes"]
    made += ["-subj", "/CN=sinew", "-addext", "basicConstraints=critical,CA:FALSE"]
    made += ["-addext", "subjectAltName=IP:127.0.0.1", "-keyout", "server.key", "-out", "server.pem"]
    subprocess.run(made, cwd=tmp_path, check=True, capture_output=True)
    subprocess.run([binary(), "token", "--key", "key", "--new-key"], cwd=tmp_path, check=True, capture_output=True)
    settings = ["tls_cert=server.pem", "tls_key=server.key", "jwt_secret_file=key"]
    command = [str(binary()), "serve", "--no-demo", "--listen", "127.0.0.1:0"]
    command += [part for s in settings for part in ("--set", s)]
    server = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert server.stdout is not None
    found = re.search(r"https://[0-9.]+:\d+", server.stdout.readline())
    assert found is not None
    yield found.group(0), tmp_path
    server.terminate()
    server.communicate()


def token(directory: Path, *arguments: str) -> str:
    """A token of the server's secret."""
    command = [binary(), "token", "--key", "key", *arguments]
    return subprocess.run(command, cwd=directory, check=True, capture_output=True, text=True).stdout.strip()


def test_a_token_opens_what_it_is_for(guarded: tuple[str, Path]) -> None:
    address, directory = guarded
    ca = directory / "server.pem"
    ada = token(directory, "--for", "ada", "--role", "creator")
    with sinew.Client(address, token=ada, ca=ca) as client, client.create_world("stage") as world:
        caller = client.access_stub.GetCaller(access_pb2.GetCallerRequest(world="worlds/stage"))
        assert caller.principal == "user:ada"
        world.add_figure("anna")
        asked = control_pb2.AcquireControlRequest(figure="worlds/stage/figures/anna")
        lease = client.control_stub.AcquireControl(asked)
        assert lease.control_token and lease.lease.holder == "user:ada"
        with sinew.Client(address, token=token(directory, "--for", "eve"), ca=ca) as stranger:
            assert stranger.worlds() == []
            with pytest.raises(sinew.PermissionDeniedError) as denied:
                stranger.world("stage").pause()
            assert denied.value.facts["required_role"] in {"viewer", "director"}
        with sinew.Client(address, ca=ca) as nobody, pytest.raises(sinew.UnauthenticatedError):
            nobody.worlds()


def test_a_token_is_not_sent_in_the_clear() -> None:
    with pytest.raises(ValueError, match="https://"):
        sinew.Client("127.0.0.1:1", token="secret")
