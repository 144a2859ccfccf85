"""A sound card that is a file: what it "records" is what an actuator would have done.

To be run as a script in a process of its own: ``file_duplex.py FOLDER`` measures, and prints what
was found as JSON.
"""

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy

from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.lab.playing.devices import Output
from skinsource.lab.playing.mix import factor_of, fade_samples
from skinsource.lab.rig_measuring import measurement
from skinsource.lab.rig_measuring.duplex import Duplex

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.core.playing.file_card import configure
from tests.core.rig_measuring.bench_top import COIL, SETUP, VOLTS, relative_error, sensed

RATE_HZ, DELAY_S = 48_000, 0.0123


def answered(played: np.ndarray) -> np.ndarray:
    """Samples of the sensor, (n_times,), to samples that are played."""
    n = scipy.fft.next_fast_len(2 * played.size, real=True)
    hz = np.fft.rfftfreq(n, 1.0 / RATE_HZ)
    late = np.exp(-2j * np.pi * hz * DELAY_S)
    return scipy.fft.irfft(scipy.fft.rfft(played, n) * sensed(COIL)(hz) * late, n)[: played.size]


def main(folder: Path) -> dict:
    """Measure the actuator of the file."""
    came = folder / "came.raw"
    came.write_bytes(b"")
    configure(folder, folder / "heard.raw", came)

    class Prepared(Duplex):
        """Puts into the file what will be recorded, before the device opens it."""

        def __init__(self, queue, card, n_samples) -> None:
            played = np.zeros(n_samples)
            fade = fade_samples(RATE_HZ)
            mix = queue.swap.mix
            played[fade:] = mix.samples[0] * factor_of(queue.gain_db)
            noise = 1e-5 * np.random.default_rng(1).standard_normal((n_samples, card.n_inputs))
            noise[:, 0] += answered(played)
            noise.astype(np.float32).tofile(came)
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
    sys.stdout.write(json.dumps(main(Path(sys.argv[1]))))
