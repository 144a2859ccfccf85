"""A server that can be told to misbehave."""

import contextlib
import http.server
import threading
from dataclasses import dataclass, field

RESPONSES = "impulseResponses.mat"


@dataclass
class Served:
    """What the server offers and how it behaves; what it was asked for."""

    content: dict[str, bytes] = field(default_factory=dict)
    #: Bytes of body after which the connection is cut, one entry per answer; then no more cuts.
    cuts: list[int] = field(default_factory=list)
    ranges: bool = True
    false_ranges: bool = False
    asked: list[tuple[str, str | None]] = field(default_factory=list)
    #: What it says where it has nothing.
    regret: str = "Not Found"
    url: str = ""
    #: Whether the responses come a few bytes at a time.
    dribbles: bool = False
    enough: threading.Event = field(default_factory=threading.Event)


class Handler(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        served = self.server.served
        name = self.path.partition("?")[0].rpartition("/")[2]
        range_header = self.headers.get("Range")
        served.asked.append((name, range_header))
        if name not in served.content:
            self.send_error(404, served.regret, "")
            return
        body, first = served.content[name], 0
        if range_header and served.ranges:
            first = int(range_header.removeprefix("bytes=").partition("-")[0])
            if first >= len(body):
                self.send_error(416)
                return
            self.send_response(206)
            stated_first = first + 1 if served.false_ranges else first
            self.send_header("Content-Range", f"bytes {stated_first}-{len(body) - 1}/{len(body)}")
        else:
            self.send_response(200)
        self.send_header("Content-Length", str(len(body) - first))
        self.end_headers()
        end = first + served.cuts.pop(0) if served.cuts and name == RESPONSES else len(body)
        if served.dribbles and name == RESPONSES:
            with contextlib.suppress(OSError):  # the client has gone
                while not served.enough.wait(0.01):
                    self.wfile.write(body[first : first + 4])
                    first += 4
            return
        self.wfile.write(body[first:end])

    def log_message(self, *_):
        pass
