"""What differs between the two clients, for plain calls; `_async_support` has the same names for asyncio."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Iterator, Sequence
from types import TracebackType
from typing import Generic, TypeVar

import grpc
from typing_extensions import Self

from sinew.errors import from_rpc

Request = TypeVar("Request")
Response = TypeVar("Response")

Channel = grpc.Channel
# The type of a unary call of a stub.
Method = grpc.UnaryUnaryMultiCallable

_LONG_S = 3600.0


def open_channel(address: str, options: list[tuple[str, int]], credentials: grpc.ChannelCredentials | None) -> Channel:
    """A channel, without encryption if there are no credentials."""
    if credentials is None:
        return grpc.insecure_channel(address, options=options)
    return grpc.secure_channel(address, credentials, options=options)


def call(method: Method[Request, Response], request: Request, timeout_s: float) -> Response:
    """One call; refusals become exceptions of `sinew.errors`."""
    try:
        return method(request, timeout=timeout_s)
    except grpc.RpcError as e:
        raise from_rpc(e) from None


def call_all(
    method: grpc.UnaryUnaryMultiCallable[Request, Response], requests: Sequence[Request], timeout_s: float
) -> list[Response]:
    """Calls in flight together; answers in order."""
    flying = [method.future(r, timeout=timeout_s) for r in requests]
    try:
        return [f.result() for f in flying]
    except grpc.RpcError as e:
        for f in flying:
            f.cancel()
        raise from_rpc(e) from None


def pause(seconds: float) -> None:
    """Waits."""
    time.sleep(seconds)


class Stream(Generic[Request, Response]):
    """Messages of a server stream. Iterate over it; leaving its `with` block, or `close`, ends the stream."""

    def __init__(
        self,
        method: grpc.UnaryStreamMultiCallable[Request, Response],
        request: Request,
    ) -> None:
        self._call = method(request)
        # Holds one message: a slow reader gets the latest, because the server sees that nothing is taken.
        self._came: queue.Queue[Response | BaseException] = queue.Queue(maxsize=1)
        self._closed = threading.Event()
        self._reader: threading.Thread | None = None
        self._end: BaseException | None = None

    def __iter__(self) -> Self:
        return self

    def __next__(self) -> Response:
        while (message := self.within(_LONG_S)) is None:
            pass
        return message

    def within(self, seconds: float) -> Response | None:
        """The next message, or `None` if none comes within `seconds`; it is not lost."""
        if self._end is not None or self._closed.is_set():
            raise StopIteration
        if self._reader is None:
            arguments = (self._call, self._came, self._closed)
            self._reader = threading.Thread(target=_pump, args=arguments, name="sinew-stream", daemon=True)
            self._reader.start()
        try:
            message = self._came.get(timeout=seconds)
        except queue.Empty:
            return None
        if isinstance(message, BaseException):
            self._end = message
            if isinstance(message, grpc.RpcError):
                raise from_rpc(message) from None
            raise message
        return message

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the stream."""
        self._closed.set()
        self._call.cancel()
        if self._reader is not None and self._reader is not threading.current_thread():
            self._reader.join()
            self._reader = None

    def __del__(self) -> None:
        # Without waiting for the reader, which does not hold this object.
        self._closed.set()
        self._call.cancel()


def _pump(call: Iterator[Response], came: queue.Queue[Response | BaseException], closed: threading.Event) -> None:
    """Hands on the messages of a call, then what ended it, until the stream is closed."""
    while not closed.is_set():
        message: Response | BaseException
        try:
            message = next(call)
        except Exception as e:  # how the call ended, for the reader
            message = e
        while not closed.is_set():
            try:
                came.put(message, timeout=0.1)
                break
            except queue.Full:
                continue
        if isinstance(message, BaseException):
            return
    # A reader in another thread that waits for a message learns that none will come.
    try:
        came.put_nowait(StopIteration())
    except queue.Full:
        pass


class Duplex(Generic[Request, Response]):
    """A stream in both directions; what comes back is kept, newest only."""

    # A driver that is faster than its connection waits here instead of filling memory.
    _DEPTH = 256

    def __init__(self, method: grpc.StreamStreamMultiCallable[Request, Response]) -> None:
        self._out: queue.Queue[Request | None] = queue.Queue(maxsize=self._DEPTH)
        self._newest: Response | None = None
        self._failure: BaseException | None = None
        self._came = threading.Event()
        self._over = threading.Event()
        self._call = method(self._requests())
        self._reader = threading.Thread(target=self._read, name="sinew-drive", daemon=True)
        self._reader.start()

    def _requests(self) -> Iterator[Request]:
        while (request := self._out.get()) is not None:
            yield request

    def _read(self) -> None:
        try:
            for message in self._call:
                self._newest = message
                self._came.set()
        except grpc.RpcError as e:
            self._failure = from_rpc(e)
        finally:
            self._over.set()
            self._came.set()

    def first(self, timeout_s: float) -> Response | None:
        """Waits for the first answer."""
        if not self._came.wait(timeout_s):
            raise TimeoutError("the server did not answer the header of the drive")
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

    def send(self, request: Request) -> None:
        """Sends one message; raises if the server has ended the stream."""
        while True:
            self.check()
            if self._over.is_set():
                raise ConnectionError("the server has ended the drive")
            try:
                self._out.put(request, timeout=0.1)
                return
            except queue.Full:
                continue

    def close(self) -> None:
        """Ends the stream in order and waits until the server has."""
        while not self._over.is_set():
            try:
                self._out.put(None, timeout=0.1)
                break
            except queue.Full:
                continue
        if not self._over.wait(5.0):
            self._call.cancel()
        else:
            # The thread that feeds requests still waits if the server ended first.
            try:
                self._out.put_nowait(None)
            except queue.Full:
                pass
        self._reader.join()
