"""A sound card that is a file: it is played on through PortAudio, and measured with.

To be run as a script in a process of its own, as ALSA reads its configuration once:
``file_card.py SCENE FOLDER`` prints what was seen as JSON, and leaves ``heard.raw`` in the folder.
What it "records" is what an actuator would have done.
"""

import json
import os
import sys
import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy

from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.lab.playing.devices import Output, device_of, devices
from skinsource.lab.playing.stream import PlayQueue, Stream, factor_of, fade_samples, mix_of
from skinsource.lab.rig_measuring import measurement
from skinsource.lab.rig_measuring.duplex import Duplex

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.core.rig_measuring.bench_top import COIL, SETUP, VOLTS, relative_error, sensed

RATE_HZ, DELAY_S, N_OUTPUTS = 48_000, 0.0123, 3
#: What comes with ALSA.
ALSA_SETTINGS = Path("/usr/share/alsa/alsa.conf")


def configure(folder: Path, recorded: str = "") -> None:
    """Make ``card`` the one device there is; what is played on it goes to a file."""
    own = folder / "asound.conf"
    own.write_text(
        f'pcm.card {{ type file slave.pcm {{ type null }} file "{folder / "heard.raw"}" '
        f"{recorded} format raw }}\n"
    )
    os.environ["ALSA_CONFIG_PATH"] = f"{ALSA_SETTINGS}:{own}"


def noise(n: int = 20_011) -> np.ndarray:
    """Noise that fills the range, and whose first and last samples are not silent."""
    rows = np.random.default_rng(1).uniform(-1.0, 1.0, (N_OUTPUTS, n)).astype(np.float32)
    rows[:, [0, -1]] = 0.5
    return rows


def play(folder: Path) -> dict:
    """Play noise once, as fast as it is taken."""
    configure(folder)
    numbers = range(1, N_OUTPUTS + 1)
    titles = [f"place {number}" for number in numbers]
    mix = mix_of(noise(), RATE_HZ, outputs=numbers, titles=titles, n_outputs=N_OUTPUTS)
    device = device_of(Output(device="card"), devices())
    queue, finished = PlayQueue(N_OUTPUTS, RATE_HZ, 0.0), threading.Event()
    queue.play(mix, 0)
    stream = Stream(queue, device, 0.02, finished.set)
    stream.start()
    done = finished.wait(30)
    stream.close()
    return {"done": done, "reason": queue.ending.reason}


def answered(played: np.ndarray) -> np.ndarray:
    """Samples of the sensor, (n_times,), to samples that are played."""
    n = scipy.fft.next_fast_len(2 * played.size, real=True)
    hz = np.fft.rfftfreq(n, 1.0 / RATE_HZ)
    late = np.exp(-2j * np.pi * hz * DELAY_S)
    return scipy.fft.irfft(scipy.fft.rfft(played, n) * sensed(COIL)(hz) * late, n)[: played.size]


def measure(folder: Path) -> dict:
    """Measure the actuator of the file."""
    came = folder / "came.raw"
    came.write_bytes(b"")
    configure(folder, f'infile "{came}"')

    class Prepared(Duplex):
        """Puts into the file what will be recorded, before the device opens it."""

        def __init__(self, queue, card, n_samples) -> None:
            played = np.zeros(n_samples)
            fade = fade_samples(RATE_HZ)
            mix = queue.swap.mix
            played[fade:] = mix.samples[0] * factor_of(queue.gain_db)
            recorded = 1e-5 * np.random.default_rng(1).standard_normal((n_samples, card.n_inputs))
            recorded[:, 0] += answered(played)
            recorded.astype(np.float32).tofile(came)
            super().__init__(queue, card, n_samples)

    measurement.Duplex = Prepared
    rig = Rig(channels=(RigChannel(place=7, device="card", full_scale_v=VOLTS),))
    setup = replace(SETUP, repeats=2)
    measured = measurement.measure(rig, 7, setup, output=Output(sample_rate_hz=RATE_HZ))
    return {
        "off": relative_error(measured),
        "delay_s": measured.delay_s,
        "points": len(measured.response.points),
    }


if __name__ == "__main__":
    scenes = {"play": play, "measure": measure}
    sys.stdout.write(json.dumps(scenes[sys.argv[1]](Path(sys.argv[2]))))
