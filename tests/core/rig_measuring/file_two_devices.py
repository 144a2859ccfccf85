"""Two devices that are pipes: what is played on one moves a made-up actuator, another records it.

To be run as a script in a process of its own: ``file_two_devices.py FOLDER`` measures through
PortAudio, and prints what was found as JSON.
"""

import fcntl
import json
import os
import select
import sys
import threading
from dataclasses import replace
from pathlib import Path
from time import sleep

import numpy as np
from scipy.signal import fftconvolve

from skinsource.actuators.rigs import Rig, RigChannel
from skinsource.lab.playing.devices import Output
from skinsource.lab.rig_measuring.measurement import measure

sys.path.insert(0, str(Path(__file__).parents[3]))
from tests.core.playing.file_card import ALSA_SETTINGS
from tests.core.rig_measuring.bench_top import (
    COIL,
    RATE_HZ,
    SETUP,
    VOLTS,
    ears,
    relative_error,
    sensed,
)

PPM, LATE = 120.0, 400.3
_BLOCK, _CHANNELS, _TAPS = 80, 2, 64
_FRAME = 4 * _CHANNELS
#: A pipe that says nothing for so long has nothing to say until it is opened again.
_SILENT_S = 0.5
_SET_PIPE_SIZE = 1031


class Room:
    """Between the pipes: an actuator, and a clock that is ``PPM`` millionths quicker."""

    def __init__(self, folder: Path) -> None:
        for name in ("out", "in"):
            os.mkfifo(folder / name)
        # Open at both ends: PortAudio opens and closes the others when it looks for devices.
        self._out, self._in = (os.open(folder / name, os.O_RDWR) for name in ("out", "in"))
        for pipe in (self._out, self._in):
            fcntl.fcntl(pipe, _SET_PIPE_SIZE, 4096)
        self._path = ears(sensed(COIL))
        self._rng = np.random.default_rng(3)
        # What the sensor does, by the clock that plays; the first LATE samples are silence.
        self._moved, self._n_moved = np.zeros(2**18), 0
        self._n_recorded = 0
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self) -> None:
        playing = False
        while True:
            if select.select([self._out], [], [], _SILENT_S if playing else 0.0)[0]:
                playing = True
                self._move(os.read(self._out, _BLOCK * _FRAME))
            else:
                playing = False
                self._move(bytes(_BLOCK * _FRAME))
                # Before anything is played there is no hurry.
                sleep(0.002)
            self._record()

    def _move(self, played: bytes) -> None:
        samples = np.frombuffer(played, np.float32).reshape(-1, _CHANNELS)[:, 0]
        answer = fftconvolve(samples, self._path)
        begin = self._n_moved
        if begin + answer.size > self._moved.size:
            self._moved = np.concatenate((self._moved, np.zeros(2**18)))
        self._moved[begin : begin + answer.size] += answer
        self._n_moved += samples.size

    def _record(self) -> None:
        """Hand on whole blocks of what has happened by now."""
        ratio = 1.0 + 1e-6 * PPM
        while True:
            at = (self._n_recorded + np.arange(_BLOCK)) / ratio - LATE
            if at[-1] + _TAPS >= self._n_moved:
                return
            came = 1e-5 * self._rng.standard_normal((_BLOCK, _CHANNELS))
            if at[0] > _TAPS:
                near = np.floor(at).astype(int)[:, np.newaxis] + np.arange(_TAPS) - _TAPS // 2 + 1
                off = at[:, np.newaxis] - near
                taper = np.i0(8.0 * np.sqrt(np.clip(1.0 - (2.0 * off / _TAPS) ** 2, 0.0, 1.0)))
                weight = np.sinc(off) * taper / np.i0(8.0)
                came[:, 0] += (self._moved[near] * weight).sum(axis=1)
            os.write(self._in, came.astype(np.float32).tobytes())
            self._n_recorded += _BLOCK


def configure(folder: Path) -> None:
    """``speaker`` is played on, and ``sensor`` is recorded from."""
    own = folder / "asound.conf"
    own.write_text(
        f'pcm.speaker {{ type file slave.pcm {{ type null }} file "{folder}/out" format raw }}\n'
        'pcm.sensor { type file slave.pcm { type null } file "/dev/null" '
        f'infile "{folder}/in" format raw }}\n'
    )
    os.environ["ALSA_CONFIG_PATH"] = f"{ALSA_SETTINGS}:{own}"


def main(folder: Path) -> dict:
    """Measure the actuator between the pipes."""
    Room(folder)
    configure(folder)
    rig = Rig(channels=(RigChannel(place=7, device="speaker", full_scale_v=VOLTS),))
    setup = replace(SETUP, input_device="sensor", repeats=2)
    measured = measure(rig, 7, setup, output=Output(sample_rate_hz=RATE_HZ))
    return {
        "off": relative_error(measured),
        "clock_ppm": measured.clock_ppm,
        "lines": measured.lines,
    }


if __name__ == "__main__":
    sys.stdout.write(json.dumps(main(Path(sys.argv[1]))))
    sys.stdout.flush()
    # The room stays open in its thread.
    os._exit(0)
