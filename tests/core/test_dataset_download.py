"""Downloading from a server on this machine that can be told to misbehave."""

import hashlib
import http.server
import re
import socket
import sys
import threading
from dataclasses import replace

import pytest

from skinsource.base.errors import DownloadError, MissingExtraError, Stopped
from skinsource.base.extras import extra_line
from skinsource.limbs.dataset import install, published
from skinsource.limbs.dataset.install import fetch
from skinsource.limbs.dataset.store import load_measured_limb
from tests.core.misbehaving_server import RESPONSES, Handler, Served

for _package in ("requests", "matio"):
    pytest.importorskip(_package, reason=f"{_package} is not installed")

#: What arrives is kept in pieces of this many bytes.
PIECE = 2**16


@pytest.fixture
def served(synthetic_download, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    served = Served(
        content={path.name: path.read_bytes() for path in synthetic_download.rglob("*.mat")}
    )
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        server.served = served
        served.url = f"http://127.0.0.1:{server.server_port}"
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield served
        served.enough.set()
        server.shutdown()
        thread.join()


@pytest.fixture
def files(served):
    """Give the files to download: the published list with the made-up sizes and checksums."""
    return tuple(
        replace(
            file,
            size_bytes=len(body := served.content[file.name.rpartition("/")[2]]),
            checksum=f"{(algorithm := file.checksum.partition(':')[0])}:"
            f"{hashlib.new(algorithm, body, usedforsecurity=False).hexdigest()}",
        )
        for file in published.published_files(served.url, served.url)
    )


@pytest.fixture
def installed(monkeypatch):
    """Give the folders that were to be installed, and install none: that takes seconds."""
    folders = []
    monkeypatch.setattr(install, "install", lambda folder, **_: folders.append(folder))
    return folders


@pytest.fixture
def part(user_data):
    return user_data / "measured-download" / f"{RESPONSES}.part"


def _asked_for_responses(served):
    return [requested for name, requested in served.asked if name == RESPONSES]


def test_a_complete_download_is_installed(served, files, user_data):
    progress = []
    info = fetch(files=files, progress=lambda *report: progress.append(report))
    assert info.path == user_data / "measured.npz"
    assert load_measured_limb(2).response_to(3)[0, 0, 0] == 2.03
    assert len(served.asked) == 9
    total = sum(file.size_bytes for file in files)
    downloading = [done for done, of, text in progress if text.startswith("Download")]
    assert downloading == sorted(downloading)
    assert downloading[-1] == total
    left = {path.name for path in (user_data / "measured-download").rglob("*") if path.is_file()}
    assert left == set(served.content)


def test_a_damaged_file_from_an_earlier_download_is_downloaded_again(
    served, files, user_data, installed
):
    for _ in range(2):  # a complete download is not downloaded again
        fetch(files=files)
    assert len(served.asked) == 9
    path = user_data / "measured-download" / RESPONSES
    path.write_bytes(b"damaged")
    fetch(files=files)
    assert _asked_for_responses(served) == [None, None]
    assert path.read_bytes() == served.content[RESPONSES]


def test_a_cut_connection_is_taken_up_where_it_broke(served, files, installed):
    served.cuts = [2 * PIECE, 3 * PIECE]
    fetch(files=files)
    assert _asked_for_responses(served) == [None, f"bytes={2 * PIECE}-", f"bytes={5 * PIECE}-"]
    assert installed


def test_a_download_that_stops_coming_is_continued_the_next_time(served, files, part, installed):
    served.cuts = [2 * PIECE, 0]
    with pytest.raises(DownloadError, match=rf"{2 * PIECE} of \d+ bytes are downloaded"):
        fetch(files=files)
    assert not installed
    assert part.stat().st_size == 2 * PIECE

    fetch(files=files)
    assert _asked_for_responses(served)[-1] == f"bytes={2 * PIECE}-"
    assert installed
    assert not part.exists()


@pytest.mark.parametrize(
    ("trouble", "again"), [({"ranges": False}, []), ({"false_ranges": True}, [None])]
)
def test_a_server_that_cannot_continue_or_goes_on_elsewhere_is_asked_for_everything(
    served, files, installed, trouble, again
):
    served.cuts = [2 * PIECE]
    for name, value in trouble.items():
        setattr(served, name, value)
    fetch(files=files)
    assert _asked_for_responses(served) == [None, f"bytes={2 * PIECE}-", *again]
    assert installed


def test_a_range_the_server_refuses_is_asked_for_from_the_beginning(served, files, part):
    served.cuts = [5 * PIECE, 0]
    with pytest.raises(DownloadError):
        fetch(files=files)
    whole = served.content[RESPONSES]
    served.content[RESPONSES] = whole[:200_000]
    with pytest.raises(DownloadError, match=f"offers 200000 bytes, expected {len(whole)}"):
        fetch(files=files)
    assert _asked_for_responses(served)[-2:] == [f"bytes={5 * PIECE}-", None]


def test_a_wrong_checksum_is_an_error_and_the_bad_file_is_deleted(
    served, files, user_data, installed
):
    body = bytearray(served.content[RESPONSES])
    body[1000] ^= 1
    served.content[RESPONSES] = bytes(body)
    with pytest.raises(DownloadError, match=r"its md5 is \w{32}, expected \w{32}\. It was deleted"):
        fetch(files=files)
    assert not list(user_data.rglob(f"*{RESPONSES}*"))
    assert not list(user_data.rglob("tmp*"))
    assert not installed


def test_what_a_server_says_reaches_no_terminal_as_a_command(served, files, part):
    del served.content["surface.mat"]
    served.regret = "\x1b[2J" + "n" * 1000
    with pytest.raises(DownloadError, match=r"answered 404 \\x1b\[2Jnnn") as caught:
        fetch(files=files)
    assert str(caught.value).isprintable()
    assert "n" * 80 not in str(caught.value)


def test_a_server_that_is_down_is_an_error(monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    with socket.socket() as reserved:
        reserved.bind(("127.0.0.1", 0))  # never listens: every connection is refused
        url = f"http://127.0.0.1:{reserved.getsockname()[1]}"
        with pytest.raises(DownloadError, match=r"cannot be downloaded .*Check the connection"):
            fetch(files=published.published_files(url, url))


def test_a_cancel_keeps_what_has_arrived_and_installs_nothing(
    served, files, part, user_data, installed
):
    stop = threading.Event()

    def stop_midway(done, _total, text):
        if RESPONSES in text and part.exists() and part.stat().st_size > 100_000:
            stop.set()

    with pytest.raises(Stopped, match="continues where it stopped"):
        fetch(files=files, progress=stop_midway, stop=stop.is_set)
    assert not installed
    arrived = part.stat().st_size
    assert 100_000 < arrived < len(served.content[RESPONSES])
    assert not list(user_data.rglob("tmp*"))

    fetch(files=files)
    assert _asked_for_responses(served)[-1] == f"bytes={arrived}-"
    assert installed


@pytest.mark.parametrize("package", ["requests", "matio"])
def test_a_missing_package_is_found_out_before_anything_is_downloaded(
    served, files, monkeypatch, package
):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingExtraError, match=re.escape(extra_line("dataset"))):
        fetch(files=files)
    assert served.asked == []


def test_a_stop_is_heard_while_a_server_dribbles(served, files):
    served.dribbles = True
    asked = []

    def stop() -> bool:
        asked.append(None)
        return len(asked) > 20

    with pytest.raises(Stopped):
        fetch(files=files, stop=stop)
