"""A sound library that is made up: it answers as sounddevice does, and what it hears is kept."""

import threading
from time import perf_counter
from types import SimpleNamespace

import numpy as np

INSIDE_S = 0.015


class PortAudioError(Exception):
    """As sounddevice has it: words, and a number."""


class CallbackStop(Exception):
    """As sounddevice has it: no more comes."""


class SyntheticStream:
    """Asks for a block every other millisecond, from a thread of its own."""

    latency = INSIDE_S

    def __init__(self, library, asked) -> None:
        self.library, self.asked = library, asked
        self.heard: list[np.ndarray] = []
        self.active = False
        self.underflows = 0
        self._pulled, self._stop = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    @property
    def time(self) -> float:
        """A device that is stuck keeps whoever asks."""
        raise AssertionError("nobody may ask a device what time it is")

    @property
    def samples(self) -> np.ndarray:
        """What was heard so far, (n_outputs, n_times)."""
        return np.concatenate([np.zeros((0, self.asked["channels"])), *self.heard]).T

    def start(self) -> None:
        if self.library.refuses_to_start:
            raise PortAudioError("Device unavailable", -9985)
        self.active = True
        self._thread.start()

    def close(self, ignore_errors=True) -> None:
        self._stop.set()
        if self._thread.ident is not None:
            self._thread.join(10)

    def pull_out(self) -> None:
        """As when the cable is pulled."""
        self._pulled.set()

    def _run(self) -> None:
        n, channels = self.asked["blocksize"], self.asked["channels"]
        while not (self._stop.wait(0.002) or self._pulled.is_set()):
            if self.library.is_stuck:
                continue
            out = np.full((n, channels), np.nan, np.float32)
            now_s = perf_counter()
            times = SimpleNamespace(currentTime=now_s, outputBufferDacTime=now_s + INSIDE_S)
            status = SimpleNamespace(output_underflow=self.underflows > 0)
            self.underflows = max(self.underflows - 1, 0)
            try:
                self.asked["callback"](out, n, times, status)
            except CallbackStop:
                self.heard.append(out)
                break
            self.heard.append(out)
        self.active = False
        self.asked["finished_callback"]()


class SyntheticSoundLibrary:
    """Devices by name, with their outputs; the first is what the system plays on.

    One that ``is_stuck`` asks for nothing any more, and tells nobody.
    """

    PortAudioError, CallbackStop = PortAudioError, CallbackStop

    def __init__(self, **outputs) -> None:
        self.outputs = outputs
        self.default = SimpleNamespace(device={"output": 0 if outputs else -1})
        self.streams: list[SyntheticStream] = []
        self.refuses_to_start = self.is_stuck = False
        self.rates = (44_100, 48_000)

    def query_hostapis(self):
        return ({"name": "Made up", "default_output_device": self.default.device["output"]},)

    def query_devices(self):
        return [
            {"name": name, "hostapi": 0, "max_output_channels": n, "default_samplerate": 48_000.0}
            for name, n in self.outputs.items()
        ]

    def check_output_settings(self, *, device, channels, dtype, samplerate):
        if samplerate not in self.rates:
            raise PortAudioError("Invalid sample rate", -9997)

    def OutputStream(self, **asked):
        if asked["samplerate"] not in self.rates:
            raise PortAudioError("Invalid sample rate", -9997)
        self.streams.append(SyntheticStream(self, asked))
        return self.streams[-1]

    def _terminate(self):
        assert not any(stream.active for stream in self.streams)

    def _initialize(self):
        pass


def use(monkeypatch, library) -> SyntheticSoundLibrary:
    """Let all that plays use ``library``."""
    for module in ("devices", "stream"):
        monkeypatch.setattr(f"skinsource.lab.playing.{module}.sound_library", lambda: library)
    return library
