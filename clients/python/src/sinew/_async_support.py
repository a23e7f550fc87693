"""What differs between the two clients, for asyncio; `_sync_support` has the same names without."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from types import TracebackType
from typing import Generic, TypeVar

import grpc
import grpc.aio
from typing_extensions import Self

from sinew.errors import from_rpc

Request = TypeVar("Request")
Response = TypeVar("Response")

Channel = grpc.aio.Channel
# The type of a unary call of a stub.
Method = grpc.aio.UnaryUnaryMultiCallable

_LONG_S = 3600.0


def open_channel(address: str, options: list[tuple[str, int]], credentials: grpc.ChannelCredentials | None) -> Channel:
    """A channel, without encryption if there are no credentials."""
    if credentials is None:
        return grpc.aio.insecure_channel(address, options=options)
    return grpc.aio.secure_channel(address, credentials, options=options)


async def call(method: Method[Request, Response], request: Request, timeout_s: float) -> Response:
    """One call; refusals become exceptions of `sinew.errors`."""
    try:
        return await method(request, timeout=timeout_s)
    except grpc.aio.AioRpcError as e:
        raise from_rpc(e) from None


async def call_all(
    method: grpc.aio.UnaryUnaryMultiCallable[Request, Response], requests: Sequence[Request], timeout_s: float
) -> list[Response]:
    """Calls in flight together; answers in order."""
    return list(await asyncio.gather(*(call(method, r, timeout_s) for r in requests)))


async def pause(seconds: float) -> None:
    """Waits."""
    await asyncio.sleep(seconds)


class Stream(Generic[Request, Response]):
    """Messages of a server stream. Iterate over it; leaving its `with` block, or `close`, ends the stream."""

    def __init__(
        self,
        method: grpc.aio.UnaryStreamMultiCallable[Request, Response],
        request: Request,
    ) -> None:
        self._call = method(request)
        # A read that `within` gave up waiting for: cancelling it would end the call.
        self._reading: asyncio.Task[Response] | None = None

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> Response:
        while (message := await self.within(_LONG_S)) is None:
            pass
        return message

    async def within(self, seconds: float) -> Response | None:
        """The next message, or `None` if none comes within `seconds`; it is not lost."""
        if self._reading is None:
            self._reading = asyncio.ensure_future(self._read())
        done, _ = await asyncio.wait({self._reading}, timeout=seconds)
        if not done:
            return None
        reading, self._reading = self._reading, None
        try:
            message = reading.result()
        except grpc.aio.AioRpcError as e:
            raise from_rpc(e) from None
        if message is grpc.aio.EOF:
            raise StopAsyncIteration
        return message

    async def _read(self) -> Response:
        return await self._call.read()  # type: ignore[return-value]

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self.close()

    async def close(self) -> None:
        """Ends the stream."""
        self._call.cancel()
        if self._reading is not None:
            reading, self._reading = self._reading, None
            await asyncio.wait({reading})
            if not reading.cancelled():
                reading.exception()  # of no interest, but asyncio complains about one that was not looked at


class Duplex(Generic[Request, Response]):
    """A stream in both directions; what comes back is kept, newest only."""

    def __init__(self, method: grpc.aio.StreamStreamMultiCallable[Request, Response]) -> None:
        self._call = method()
        self._newest: Response | None = None
        self._failure: BaseException | None = None
        self._came = asyncio.Event()
        self._reader = asyncio.ensure_future(self._read())

    async def _read(self) -> None:
        try:
            while (message := await self._call.read()) is not grpc.aio.EOF:
                self._newest = message  # type: ignore[assignment]
                self._came.set()
        except grpc.aio.AioRpcError as e:
            self._failure = from_rpc(e)
        except asyncio.CancelledError:
            pass
        finally:
            self._came.set()

    async def first(self, timeout_s: float) -> Response | None:
        """Waits for the first answer."""
        await asyncio.wait_for(self._came.wait(), timeout_s)
        self.check()
        return self._newest

    def check(self) -> None:
        """Raises what ended the stream, if anything did."""
        if self._failure is not None:
            raise self._failure

    @property
    def newest(self) -> Response | None:
        """The newest answer."""
        return self._newest

    async def send(self, request: Request) -> None:
        """Sends one message; raises if the server has ended the stream."""
        self.check()
        try:
            await self._call.write(request)
        except (grpc.aio.AioRpcError, asyncio.InvalidStateError):
            await self._reader
            self.check()
            raise

    async def close(self) -> None:
        """Ends the stream in order and waits until the server has."""
        if self._failure is None:
            try:
                await self._call.done_writing()
            except (grpc.aio.AioRpcError, asyncio.InvalidStateError):
                pass
        await self._reader
        self._call.cancel()
