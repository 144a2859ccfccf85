"""Ten minutes of playing in blocks of 5 ms, while the design is edited: underruns, delay, cost.

    python benchmarks/playing.py                 what the system plays on
    python benchmarks/playing.py --card          on a sound card that is a pipe (Linux)
    python benchmarks/playing.py --seconds 60

Four tracks of two seconds are looped; twice a second one of them is edited, rendered in another
thread and swapped, as the studio does.  The card is a process of its own that takes 5 ms every
5 ms out of a pipe of about 20 ms: what it does not find in time is an underrun.
"""

import argparse
import array
import fcntl
import json
import os
import subprocess
import sys
import tempfile
import termios
import threading
from contextlib import suppress
from pathlib import Path
from time import perf_counter, sleep

import numpy as np

import skinsource as ss
from skinsource.lab.playing import stream
from skinsource.lab.playing import stream as block
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.session import Session

RATE_HZ = 48_000
BLOCK = 240
CHANNELS = 4
EDITS_PER_S = 2
_ALSA = "/usr/share/alsa/alsa.conf"
_SET_PIPE_SIZE = 1031
_PIPE_BYTES = 16_384
_BLOCK_BYTES = BLOCK * CHANNELS * 4
_BLOCK_S = BLOCK / RATE_HZ
_STEADY = 3 * _BLOCK_BYTES


def main() -> int:
    """Play, and print what was seen; 1 where the device ran out of samples."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--card", action="store_true", help="play on a pipe")
    parser.add_argument("--pipe", type=Path, help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.pipe is not None:
        print(json.dumps(be_a_card(asked.pipe)))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        card = start_card(Path(folder)) if asked.card else None
        counts = play(asked.seconds)
        if card is not None:
            counts |= json.loads(card.communicate(timeout=60)[0])
    for name, value in counts.items():
        print(f"{name:>28}: {value}")
    lost = counts["underruns"] + counts.get("card found nothing", 0)
    return int(lost > 0)


def start_card(folder: Path) -> subprocess.Popen:
    """Make a pipe the one device there is."""
    pipe, settings = folder / "pipe", folder / "asound.conf"
    os.mkfifo(pipe)
    # Before anything is written to it, and open until the end: it is short for as long as it is.
    fcntl.fcntl(os.open(pipe, os.O_RDWR), _SET_PIPE_SIZE, _PIPE_BYTES)
    settings.write_text(
        f'pcm.card {{ type file slave.pcm {{ type null }} file "{pipe}" format raw }}\n'
    )
    os.environ["ALSA_CONFIG_PATH"] = f"{_ALSA}:{settings}"
    return subprocess.Popen(  # noqa: S603  this very file
        [sys.executable, __file__, "--pipe", str(pipe)], stdout=subprocess.PIPE, text=True
    )


def be_a_card(path: Path) -> dict[str, object]:
    """Take a block every 5 ms, and count those that are not there; until nothing comes any more."""
    pipe = os.open(path, os.O_RDWR)
    with suppress(PermissionError):
        # No sound card waits for other programs.
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(10))
    while _waiting(pipe) < _STEADY:
        sleep(0.001)
    due_s, n_read, missed, late, in_a_row = perf_counter(), 0, 0, 0, 0
    while in_a_row < 1000:
        due_s += _BLOCK_S
        sleep(max(due_s - perf_counter(), 0.0))
        if perf_counter() - due_s > _BLOCK_S:
            # This process was kept waiting itself, which no sound card is.
            late += 1
            due_s = perf_counter()
        if _waiting(pipe) >= _BLOCK_BYTES:
            os.read(pipe, _BLOCK_BYTES)
            n_read, missed, in_a_row = n_read + 1, missed + in_a_row, 0
        else:
            in_a_row += 1
    os.close(pipe)
    return {"card took blocks": n_read, "card found nothing": missed, "card was late": late}


def _waiting(pipe: int) -> int:
    held = array.array("i", [0])
    fcntl.ioctl(pipe, termios.FIONREAD, held)
    return held[0]


def play(seconds: float) -> dict[str, object]:
    """Loop, edit, and tell what happened."""
    took_s: list[float] = []

    def timed(queue: object, out: object) -> None:
        begun_s = perf_counter()
        block.next_block(queue, out)
        took_s.append(perf_counter() - begun_s)

    stream.next_block = timed
    tone = ss.waveforms.Tone(frequency_hz=100.0, duration_s=2.0)
    design = ss.Design(
        limb="synthetic-1",
        inputs=tuple(ss.track(place, tone, amplitude=0.9) for place in range(1, CHANNELS + 1)),
    )
    sys.setswitchinterval(0.0005)
    over = threading.Event()
    session = Session(lambda _stream: over.set())
    output = Output(sample_rate_hz=RATE_HZ)
    playing = session.play(design, output, loops=True, at_s=0.0, gain_db=-20.0)
    if playing.stream is None:
        raise SystemExit(playing.reason)
    delays_s, rendered_s, begun_s = [], [], perf_counter()
    while perf_counter() - begun_s < seconds and not over.is_set():
        edited_s = perf_counter()
        amplitude = 0.5 + 0.4 * (len(delays_s) % 2)
        edited = design.with_input(len(delays_s) % CHANNELS, amplitude=amplitude)
        session.change(playing, edited, output, loops=True)
        rendered_s.append(perf_counter() - edited_s)
        over.wait(1.0 / EDITS_PER_S)
        delays_s.append(playing.stream.delay(rendered_s[-1]).total_s)
    underruns, blocks = playing.stream.underruns, len(took_s)
    session.close()
    return {
        "seconds": round(perf_counter() - begun_s, 1),
        "blocks": blocks,
        "underruns": underruns,
        "edits": len(delays_s),
        "block, ms (50, 99 %, most)": _spread(took_s),
        "render, ms (50, 99 %, most)": _spread(rendered_s),
        "edit to output, ms": _spread(delays_s),
        "ended early": over.is_set() and perf_counter() - begun_s < seconds,
    }


def _spread(seconds: list[float]) -> str:
    spread_ms = np.percentile(np.array(seconds) * 1e3, [50, 99, 100])
    return ", ".join(f"{value_ms:.3g}" for value_ms in spread_ms)


if __name__ == "__main__":
    sys.exit(main())
