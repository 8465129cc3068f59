"""HTTP by hand: bytes out, one response in."""

import dataclasses
import socket
import time


@dataclasses.dataclass
class Reply:
    status: int | None  # None: the connection ended without an answer
    headers: dict
    body: bytes
    seconds: float


def connect(port, timeout=15):
    return socket.create_connection(("127.0.0.1", port), timeout=timeout)


def read_reply(sock, started):
    """One response; of a connection that is reset, what came before."""
    data = b""

    def more():
        nonlocal data
        try:
            part = sock.recv(65536)
        except ConnectionError:
            part = b""
        data += part
        return bool(part)

    while b"\r\n\r\n" not in data:
        if not more():
            return Reply(None, {}, data, time.monotonic() - started)
    head, _, body = data.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    headers = {name.lower(): value.strip() for name, value in (line.split(":", 1) for line in lines[1:])}
    length = int(headers.get("content-length", 0))
    start = len(head) + 4
    while len(data) < start + length and more():
        pass
    return Reply(int(lines[0].split()[1]), headers, data[start:start + length], time.monotonic() - started)


def exchange(port, data):
    """Sends `data` on a connection of its own; a server that refuses may stop reading before its end."""
    started = time.monotonic()
    with connect(port) as sock:
        try:
            sock.sendall(data)
        except ConnectionError:
            pass
        return read_reply(sock, started)
