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


class MadeUpStream:
    """Opened, begun and closed as a stream of sounddevice; works in a thread of its own."""

    def __init__(self, library, asked) -> None:
        self.library, self.asked, self.active = library, asked, False
        self.closed = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self) -> None:
        if isinstance(self, self.library.busy):
            raise PortAudioError("Device unavailable", -9985)
        self.active = True
        self._thread.start()

    def close(self, ignore_errors=True) -> None:
        self.library.before_closing()
        self.closed.set()
        if self._thread.ident is not None:
            self._thread.join(10)


class SyntheticStream(MadeUpStream):
    """Asks for a block every other millisecond."""

    latency = INSIDE_S

    def __init__(self, library, asked) -> None:
        super().__init__(library, asked)
        self.heard: list[np.ndarray] = []
        self.underflows = 0
        self._pulled = threading.Event()

    @property
    def time(self) -> float:
        """A device that is stuck keeps whoever asks."""
        raise AssertionError("nobody may ask a device what time it is")

    @property
    def samples(self) -> np.ndarray:
        """What was heard so far, (n_outputs, n_times)."""
        return np.concatenate([np.zeros((0, self.asked["channels"])), *self.heard]).T

    def pull_out(self) -> None:
        """As when the cable is pulled."""
        self._pulled.set()

    def _run(self) -> None:
        n, channels = self.asked["blocksize"], self.asked["channels"]
        while not (self.closed.wait(0.002) or self._pulled.is_set()):
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


class SoundLibrary:
    """Answers as sounddevice does; a row is name, host, outputs, inputs, usual rate of a device."""

    PortAudioError, CallbackStop = PortAudioError, CallbackStop
    hosts: tuple[str, ...] = ("Made up",)
    rows: tuple = ()
    #: Words and number of what it raises where a stream is opened.
    refusal: tuple = ()
    #: Rates that it takes; none: all.
    rates: tuple[int, ...] = ()

    def __init__(self, default_output=0, default_input=0) -> None:
        self.default = SimpleNamespace(device={"input": default_input, "output": default_output})
        self.streams: list = []
        # Streams of this kind do not begin.
        self.busy: tuple | type = ()
        self.before_closing = lambda: None

    def query_hostapis(self):
        usual = {f"default_{way}_device": row for way, row in self.default.device.items()}
        return tuple({"name": name, **usual} for name in self.hosts)

    def query_devices(self):
        names = "name", "hostapi", "max_output_channels", "max_input_channels", "default_samplerate"
        return [dict(zip(names, row, strict=True)) for row in self.rows]

    def check_output_settings(self, *, device, channels, dtype, samplerate):
        assert channels <= self.rows[device][2]
        if self.rates and samplerate not in self.rates:
            raise PortAudioError("Invalid sample rate", -9997)

    def open(self, stream):
        if self.refusal:
            raise PortAudioError(*self.refusal)
        self.streams.append(stream)
        return stream

    def _terminate(self):
        assert not any(stream.active for stream in self.streams)

    def _initialize(self):
        """Nothing is to be done."""


class SyntheticSoundLibrary(SoundLibrary):
    """Devices by name, with their outputs; the first is what the system plays on.

    One that ``is_stuck`` asks for nothing any more, and tells nobody.
    """

    rates = (44_100, 48_000)

    def __init__(self, **outputs) -> None:
        super().__init__(0 if outputs else -1)
        self.outputs = outputs
        self.is_stuck = False

    @property
    def rows(self):
        return tuple((name, 0, n, 0, 48_000.0) for name, n in self.outputs.items())

    def OutputStream(self, **asked):
        if asked["samplerate"] not in self.rates:
            raise PortAudioError("Invalid sample rate", -9997)
        return self.open(SyntheticStream(self, asked))


def use(monkeypatch, library, modules=("playing.devices", "playing.stream")):
    """Let all that plays use ``library``."""
    for module in modules:
        monkeypatch.setattr(f"skinsource.lab.{module}.sound_library", lambda: library)
    return library
