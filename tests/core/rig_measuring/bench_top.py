"""A sound card that is made up, with an actuator on its outputs and a sensor on its inputs."""

from types import SimpleNamespace

import numpy as np
import scipy

# Not in the thread that plays the card: it takes seconds where all processors are busy.
from scipy.signal import fftconvolve

import skinsource as ss
from skinsource.lab.rig_measuring.measurement import MeasuringSetup
from tests.core.playing import synthetic_sound
from tests.core.playing.synthetic_sound import CallbackStop, MadeUpStream, SoundLibrary

RATE_HZ = 8_000
COIL = ss.actuators.load("example-voice-coil")
#: What the rig and the sensor are said to be.
VOLTS, SENSITIVITY, INPUT_VOLTS = 3.0, 0.01, 2.0
DELAY_S = 0.0312345
SETUP = MeasuringSetup(
    sensitivity_v_per_m_per_s2=SENSITIVITY,
    input_full_scale_v=INPUT_VOLTS,
    level_db=-20.0,
    sweep_s=1.5,
    repeats=3,
)
#: Where what was measured is compared.
HZ = np.geomspace(25.0, 800.0, 60)
#: What is played in a block is answered from the next one on.
BLOCK_S = 0.01
_TAPS = 8192


def ears(path, *, delay_s=DELAY_S, n_taps=_TAPS):
    """Impulse response, (n_taps,), of a path with this response over frequency, so late."""
    hz = np.fft.rfftfreq(n_taps, 1.0 / RATE_HZ)
    return scipy.fft.irfft(path(hz) * np.exp(-2j * np.pi * hz * delay_s), n_taps)


def sensed(model, volts=VOLTS):
    """From a sample that is played to the sample that the sensor makes of it."""
    return lambda hz: model.response(hz) * volts * SENSITIVITY / INPUT_VOLTS


def relative_error(measured):
    """Largest relative distance from the formula of the actuator, delay and sign included."""
    return float(np.abs(measured.response.response(HZ) / COIL.response(HZ) - 1.0).max())


#: What the card tells of a block: it was recorded 10 ms before it is played.
TIMES = SimpleNamespace(inputBufferAdcTime=5.0, outputBufferDacTime=5.010)


class Duplex(MadeUpStream):
    """Asks for block after block, and answers with what the actuator did."""

    def __init__(self, card, asked) -> None:
        super().__init__(card, asked)
        self.played: list[np.ndarray] = []

    @property
    def samples(self):
        """What was played, (n_outputs, n_times)."""
        return np.concatenate(self.played).T

    def _run(self) -> None:
        n, (n_in, n_out) = self.asked["blocksize"], self.asked["channels"]
        card, coming = self.library, np.zeros((self.asked["channels"][0], _TAPS + 2 * n))
        rng = np.random.default_rng(len(card.streams))
        for number in range(card.pulled_after):
            if self.closed.is_set():
                break
            out = np.full((n, n_out), np.nan, np.float32)
            came = coming[:, :n].T + card.offset + card.noise * rng.standard_normal((n, n_in))
            lost = number == card.loses_at
            status = SimpleNamespace(output_underflow=lost, input_overflow=False)
            over = False
            try:
                self.asked["callback"](np.clip(came, -1, 1).astype("f4"), out, n, TIMES, status)
            except CallbackStop:
                over = True
            self.played.append(out)
            coming = np.concatenate((coming[:, n:], np.zeros((n_in, n))), axis=1)
            for row, path in zip(coming, card.paths, strict=False):
                row[: _TAPS + n - 1] += fftconvolve(out[:, card.output - 1], path)
            if over:
                break
        self.active = False
        self.asked["finished_callback"]()


class Card(SoundLibrary):
    """One card of 4 outputs and 2 inputs; ``paths``: impulse responses to its inputs."""

    n_inputs, n_outputs = 2, 4

    def __init__(self, *paths, noise=1e-5, output=3) -> None:
        super().__init__()
        self.paths, self.noise, self.output = paths, noise, output
        self.offset, self.pulled_after, self.loses_at = 0.01, 100_000, -1

    @property
    def rows(self):
        return (("Bench card", 0, self.n_outputs, self.n_inputs, 48_000.0),)

    def Stream(self, **asked):  # as sounddevice calls it
        return self.open(Duplex(self, asked))


def use(monkeypatch, card):
    """Let all that measures use ``card``."""
    return synthetic_sound.use(monkeypatch, card, ("playing.devices", "rig_measuring.duplex"))
