"""What goes wrong, as exceptions that say which field, which name or which limit it was.

Every refusal of the server becomes a `SinewError`; a refused request has changed nothing there.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import grpc
from google.protobuf import any_pb2
from google.rpc import error_details_pb2, status_pb2

__all__ = [
    "AbortedError",
    "AlreadyExistsError",
    "DeadlineError",
    "ExpiredError",
    "InvalidArgumentError",
    "LimitError",
    "NotFoundError",
    "PreconditionError",
    "SinewError",
    "UnavailableError",
    "UnimplementedError",
    "WorldPausedError",
]


class SinewError(Exception):
    """The server refused or failed.

    `code` is the gRPC code, `reason` the server's word for it in UPPER_SNAKE (empty if the answer did not come from
    Sinew), `facts` what else it said by name, for example `oldest_tick`.
    """

    code: grpc.StatusCode
    reason: str
    facts: Mapping[str, str]

    def __init__(
        self,
        message: str,
        *,
        code: grpc.StatusCode = grpc.StatusCode.UNKNOWN,
        reason: str = "",
        facts: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.reason = reason
        self.facts = dict(facts or {})


class InvalidArgumentError(SinewError, ValueError):
    """A field of the request holds something that is not allowed: `field` is its path, `problem` what was expected.

    Paths are those of the protos, for example `figure.profile.height_m` or `batch.frames[3].figures[0].velocity[7]`.
    """

    field: str = ""
    problem: str = ""


class NotFoundError(SinewError, LookupError):
    """There is no such resource: `resource` is its name, `kind` what it would be (`world`, `figure`, `obstacle`,
    `clip`, `body`).

    `valid` holds the names that there are of that kind, where they could be found out; the message lists them too.
    """

    resource: str = ""
    kind: str = ""
    valid: tuple[str, ...] = ()


class AlreadyExistsError(SinewError):
    """The name is taken: `resource` is the name."""

    resource: str = ""


class PreconditionError(SinewError):
    """The request does not fit the state of the resource; `reason` says why, for example `WORLD_NOT_PAUSED`."""


class WorldPausedError(PreconditionError):
    """The clock of the world is paused, so that no frame comes: `world` is its name, `tick` its current tick."""

    world: str = ""
    tick: int = 0


class LimitError(SinewError):
    """A limit of the server is reached: `limit` is its name, `retry_after_s` (or `None`) when to try again."""

    limit: str = ""
    retry_after_s: float | None = None


class ExpiredError(SinewError):
    """A tick is not held any more or not computed yet; `facts` has `oldest_tick` and `newest_tick`."""


class AbortedError(SinewError):
    """Something else took over meanwhile."""


class UnauthenticatedError(SinewError):
    """The server does not know who this is: a token or certificate is missing, wrong or over."""


class PermissionDeniedError(SinewError, PermissionError):
    """One may not do this; `facts` has the `required_role`."""


class UnimplementedError(SinewError, NotImplementedError):
    """This server cannot do it."""


class UnavailableError(SinewError, ConnectionError):
    """The server cannot be reached or is shutting down."""


class DeadlineError(SinewError, TimeoutError):
    """The server did not answer in time."""


_BY_CODE: Mapping[grpc.StatusCode, type[SinewError]] = {
    grpc.StatusCode.INVALID_ARGUMENT: InvalidArgumentError,
    grpc.StatusCode.NOT_FOUND: NotFoundError,
    grpc.StatusCode.ALREADY_EXISTS: AlreadyExistsError,
    grpc.StatusCode.FAILED_PRECONDITION: PreconditionError,
    grpc.StatusCode.RESOURCE_EXHAUSTED: LimitError,
    grpc.StatusCode.OUT_OF_RANGE: ExpiredError,
    grpc.StatusCode.ABORTED: AbortedError,
    grpc.StatusCode.UNAUTHENTICATED: UnauthenticatedError,
    grpc.StatusCode.PERMISSION_DENIED: PermissionDeniedError,
    grpc.StatusCode.UNIMPLEMENTED: UnimplementedError,
    grpc.StatusCode.UNAVAILABLE: UnavailableError,
    grpc.StatusCode.DEADLINE_EXCEEDED: DeadlineError,
}
_DETAILS = "grpc-status-details-bin"


def _details(error: grpc.RpcError) -> list[any_pb2.Any]:
    """The `google.rpc` details that came with a refusal."""
    metadata: Any = error.trailing_metadata() or ()
    for key, value in metadata:
        if key == _DETAILS:
            raw = value if isinstance(value, bytes) else value.encode("latin-1")
            status = status_pb2.Status()
            try:
                status.ParseFromString(raw)
            except ValueError:  # not ours
                return []
            return list(status.details)
    return []


def from_rpc(error: grpc.RpcError) -> SinewError:
    """The exception for a failed call.

    Both kinds of channel raise errors with `code`, `details` and `trailing_metadata`.
    """
    return _explained(error.code(), error.details() or "", _details(error))


def from_status(status: status_pb2.Status) -> SinewError:
    """The exception for a status in a message: that of an operation that has failed."""
    code = next((c for c in grpc.StatusCode if c.value[0] == status.code), grpc.StatusCode.UNKNOWN)
    return _explained(code, status.message, status.details)


def _explained(code: grpc.StatusCode, message: str, details: Iterable[any_pb2.Any]) -> SinewError:
    out = _BY_CODE.get(code, SinewError)(message or code.name, code=code)
    for detail in details:
        info = error_details_pb2.ErrorInfo()
        bad = error_details_pb2.BadRequest()
        resource = error_details_pb2.ResourceInfo()
        quota = error_details_pb2.QuotaFailure()
        retry = error_details_pb2.RetryInfo()
        if detail.Unpack(info):
            out.reason = info.reason
            out.facts = dict(info.metadata)
        elif detail.Unpack(bad) and isinstance(out, InvalidArgumentError) and bad.field_violations:
            out.field = bad.field_violations[0].field
            out.problem = bad.field_violations[0].description
        elif detail.Unpack(resource) and isinstance(out, (NotFoundError, AlreadyExistsError)):
            out.resource = resource.resource_name
            if isinstance(out, NotFoundError):
                out.kind = resource.resource_type.rsplit("/", 1)[-1].lower()
        elif detail.Unpack(quota) and isinstance(out, LimitError) and quota.violations:
            out.limit = quota.violations[0].subject
        elif detail.Unpack(retry) and isinstance(out, LimitError):
            out.retry_after_s = retry.retry_delay.ToNanoseconds() / 1e9
    return out


# Most names that a message lists.
_LISTED = 60


def named(names: Sequence[str]) -> str:
    """Names as a message lists them."""
    if not names:
        return "there are none"
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    return "there are " + ", ".join(names[:_LISTED]) + more


def with_names(error: NotFoundError, names: Sequence[str]) -> NotFoundError:
    """The same error with the names that there are."""
    out = type(error)(f"{error}; {named(names)}", code=error.code, reason=error.reason, facts=error.facts)
    out.resource, out.kind, out.valid = error.resource, error.kind, tuple(names)
    return out


def not_found(kind: str, resource: str, names: Sequence[str]) -> NotFoundError:
    """What the server says of a name that is not there, found out by the client, with the names that there are."""
    out = NotFoundError(
        f"{kind} {resource!r} does not exist; {named(names)}",
        code=grpc.StatusCode.NOT_FOUND,
        reason="RESOURCE_NOT_FOUND",
    )
    out.resource, out.kind, out.valid = resource, kind, tuple(names)
    return out


def paused(world: str, tick: int) -> WorldPausedError:
    """That a world sends no frames because it is paused at a tick."""
    out = WorldPausedError(
        f"world {world!r} is paused at tick {tick} and sends no frames: call world.resume(), "
        "or world.step() before the next frame, or watch it with frames(wait=True), which waits until the world moves",
        code=grpc.StatusCode.FAILED_PRECONDITION,
        reason="WORLD_PAUSED",
        facts={"tick": str(tick)},
    )
    out.world, out.tick = world, tick
    return out
