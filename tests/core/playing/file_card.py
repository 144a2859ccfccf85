"""Sound cards that are files: what a process plays there can be read, sample by sample.

To be run as a script in a process of its own, as ALSA reads its configuration once:
``file_card.py SCENE FOLDER`` prints what was seen as JSON, and leaves ``heard.raw`` in the folder.
"""

import fcntl
import json
import os
import select
import sys
import threading
from pathlib import Path
from time import perf_counter, sleep

import numpy as np
import pytest

from skinsource.base.errors import SkinSourceError
from skinsource.lab.playing.devices import sound_library

RATE_HZ = 48_000
N_OUTPUTS = 3
#: A loop that does not come to its end in a test.
LONG, LONG_S = 480_000, 10.0
_SET_PIPE_SIZE = 1031
#: What comes with ALSA.
ALSA_SETTINGS = Path("/usr/share/alsa/alsa.conf")


def rows(seed: int, n: int) -> np.ndarray:
    """Noise that fills the range, and whose first and last samples are not silent."""
    noise = np.random.default_rng(seed).uniform(-1.0, 1.0, (N_OUTPUTS, n)).astype(np.float32)
    noise[:, [0, -1]] = 0.5
    return noise


def first_sounding(recorded: np.ndarray) -> int:
    """Sample before which all outputs are silent."""
    return int(np.flatnonzero(np.any(recorded != 0.0, axis=0))[0])


def read_heard(folder: Path) -> np.ndarray:
    """What arrived, (n_outputs, n_times)."""
    raw = np.fromfile(folder / "heard.raw", np.float32)
    return raw[: raw.size // N_OUTPUTS * N_OUTPUTS].reshape(-1, N_OUTPUTS).T


def skip_where_there_is_none() -> None:
    """Skip the tests of a machine without such cards, saying why."""
    if not sys.platform.startswith("linux"):
        pytest.skip("sound cards that are files are a thing of ALSA, on Linux")
    try:
        sound_library()
    except SkinSourceError as missing:
        pytest.skip(str(missing))
    if not ALSA_SETTINGS.is_file():
        pytest.skip(f"{ALSA_SETTINGS} is not there: the settings of ALSA are not installed")


def configure(folder: Path, file: Path, infile: Path | None = None) -> None:
    """Make ``card`` the one device: it plays to ``file`` and records ``infile``, if any."""
    recorded = f'infile "{infile}" ' if infile else ""
    own = folder / "asound.conf"
    own.write_text(
        f'pcm.card {{ type file slave.pcm {{ type null }} file "{file}" {recorded}format raw }}\n'
    )
    os.environ["ALSA_CONFIG_PATH"] = f"{ALSA_SETTINGS}:{own}"


class PacedCard:
    """Takes samples out of a pipe as fast as they would be heard."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        os.mkfifo(folder / "pipe")
        # Open at both ends: PortAudio opens and closes the other one when it looks for devices.
        self._pipe = os.open(folder / "pipe", os.O_RDWR)
        fcntl.fcntl(self._pipe, _SET_PIPE_SIZE, 4096)
        self.frames = 0
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Take what is left, and end."""
        self._over.set()
        self._thread.join(30)

    def _listen(self) -> None:
        frame = 4 * N_OUTPUTS
        begun_s, n_taken = None, 0
        with (self._folder / "heard.raw").open("wb") as file:
            while True:
                if not select.select([self._pipe], [], [], 0.05)[0]:
                    if self._over.is_set():
                        break
                    continue
                data = os.read(self._pipe, 240 * frame)
                begun_s = perf_counter() if begun_s is None else begun_s
                file.write(data)
                n_taken += len(data)
                self.frames = n_taken // frame
                ahead_s = self.frames / RATE_HZ - (perf_counter() - begun_s)
                if ahead_s > 0:
                    sleep(ahead_s)
        os.close(self._pipe)


def opened(of_mix, at, gain_db=0.0):
    """A stream on the card, and what tells that it has finished."""
    from skinsource.lab.playing.devices import Output, device_of, devices
    from skinsource.lab.playing.mix import PlayQueue as Deck
    from skinsource.lab.playing.stream import Stream

    device = device_of(Output(device="card"), devices())
    queue, finished = Deck(N_OUTPUTS, RATE_HZ, gain_db), threading.Event()
    queue.play(of_mix, at)
    return Stream(queue, device, 0.02, finished.set), finished


def mix(samples, loop_s=None):
    """All rows, one output each."""
    from skinsource.lab.playing.mix import mix_of

    numbers = range(1, N_OUTPUTS + 1)
    titles = [f"place {number}" for number in numbers]
    return mix_of(
        samples, RATE_HZ, outputs=numbers, titles=titles, n_outputs=N_OUTPUTS, loop_s=loop_s
    )


def once(folder: Path) -> dict:
    """Play noise once, as fast as it is taken."""
    configure(folder, folder / "heard.raw")
    stream, finished = opened(mix(rows(1, 20_011)), 0)
    stream.start()
    done = finished.wait(30)
    stream.close()
    return {"done": done, "reason": stream.queue.ending.reason}


def live(folder: Path) -> dict:
    """Change what is looped while it is heard; then stop."""
    configure(folder, folder / "pipe")
    card = PacedCard(folder)
    stream, finished = opened(mix(rows(1, LONG), (0.0, LONG_S)), 0)
    stream.start()
    sleep(0.15)
    stream.queue.play(mix(rows(2, LONG), (0.0, LONG_S)))
    seen_at = []
    for _ in range(15):
        sleep(0.01)
        seen_at.append((stream.position_s(), card.frames))
    report = {
        "seen_at": seen_at,
        "total_s": stream.delay(0.0).total_s,
        "gone": stream.unresponsive,
        "peak_db": stream.queue.levels().peak_db.tolist(),
    }
    stream.queue.stop()
    report |= {"done": finished.wait(30), "reason": stream.queue.ending.reason}
    stream.close()
    card.close()
    return report


if __name__ == "__main__":
    scenes = {"once": once, "live": live}
    sys.stdout.write(json.dumps(scenes[sys.argv[1]](Path(sys.argv[2]))))
