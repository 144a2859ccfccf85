"""Rules that turn the inputs of a scene into parts: the selected input, and all others.

The selected input is the one that is being edited.  Its field is kept at amplitude 1, apart from
the sum of the others, so that a change of its amplitude transforms nothing, and a change of its
waveform or onset leaves the others alone.  What comes out is a function of design and view.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from skinsource.design import Input
from skinsource.limb import N_TAPS, Limb
from skinsource.projection import Axes, axis_numbers
from skinsource.rendering.check import Heard, TraceError, exact_maximum, trace_error_of
from skinsource.rendering.drives import Booleans, Drives, delayed, reach
from skinsource.rendering.gains import unit_gain
from skinsource.rendering.memory import Memory
from skinsource.rendering.response_spectra import ResponseSpectra
from skinsource.rendering.segments import BLOCK_FFT, LONGEST_AT_ONCE, Played
from skinsource.rendering.streaming import StreamedField
from skinsource.rendering.transforms import Complexes, Floats
from skinsource.response_scaling import Scaling
from skinsource.signals import sample_count
from skinsource.waveforms import Waveform

_GAINS_BUDGET_BYTES = 2**20


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """An input without its amplitude and onset: what its unit field depends on."""

    waveform: Waveform
    location: int


def source_of(one: Input) -> Source:
    """Return ``one`` without its amplitude and onset."""
    return Source(waveform=one.waveform, location=one.location)


class Renderer:
    """The rules that need memory: spectra of responses and drives, gains.

    Each method is a rule of the graph: its name is what it computes.
    """

    def __init__(self) -> None:
        self._responses = ResponseSpectra()
        self._drives = Drives()
        # A key and a number: about a hundred bytes.
        self._gains = Memory[float](_GAINS_BUDGET_BYTES, lambda _: 100)

    def rules(self) -> tuple[Callable[..., Any], ...]:
        """The methods that are rules."""
        return (
            self.input_waveforms,
            self.stimulus_samples,
            self.others_spectrum,
            self.pivot_unit_spectrum,
            self.others_felt,
            self.pivot_felt,
            self.pivot_gain,
            self.streamed_field,
            self.trace_error,
        )

    def input_waveforms(
        self, inputs: tuple[Input, ...], sample_rate_hz: float
    ) -> tuple[Floats, ...]:
        """What each input plays, muted or not: one (n_times,) each, of peak 1."""
        drawn = [self._drives.drawn(one.waveform, sample_rate_hz) for one in inputs]
        return tuple(drive.samples * drive.factor for drive in drawn)

    def stimulus_samples(self, audible: tuple[Input, ...], sample_rate_hz: float) -> int:
        """Samples from time 0 to the end of the last input; 1 where nothing is heard."""
        return max(
            (
                sample_count(one.onset_s, sample_rate_hz)
                + sample_count(one.waveform.duration_s, sample_rate_hz)
                for one in audible
            ),
            default=1,
        )

    def others_spectrum(
        self,
        limb_data: Limb,
        others: tuple[Input, ...],
        scaling: Scaling,
        n_fft: int | None,
    ) -> Complexes | None:
        """Field of all audible inputs but the selected one, (72, 3, n_bins); None: silence."""
        return None if n_fft is None else self._sum(limb_data, others, scaling, n_fft)

    def pivot_unit_spectrum(
        self,
        limb_data: Limb,
        pivot_source: Source | None,
        scaling: Scaling,
        n_fft: int | None,
    ) -> Complexes | None:
        """Field of the selected input at amplitude 1 and onset 0, before any gain."""
        if pivot_source is None or n_fft is None:
            return None
        if self._drives.drawn(pivot_source.waveform, limb_data.sample_rate_hz).silent:
            return None
        drive = self._drives.spectrum(pivot_source.waveform, limb_data.sample_rate_hz, n_fft)
        return self._field(limb_data, pivot_source, scaling, n_fft, drive)

    def others_felt(
        self, others: tuple[Input, ...], response_samples: int, sample_rate_hz: float
    ) -> Booleans:
        """When any of the other inputs can be felt, (response_samples,)."""
        felt = np.zeros(response_samples, bool)
        for one in others:
            onset = sample_count(one.onset_s, sample_rate_hz)
            felt |= self._felt(one.waveform, onset, sample_rate_hz, response_samples)
        return felt

    def pivot_felt(
        self, pivot_source: Source | None, response_samples: int, sample_rate_hz: float
    ) -> Booleans:
        """When the selected input could be felt if it started at time 0, (response_samples,)."""
        if pivot_source is None:
            return np.zeros(response_samples, bool)
        return self._felt(pivot_source.waveform, 0, sample_rate_hz, response_samples)

    def pivot_gain(
        self,
        limb_data: Limb,
        pivot_source: Source | None,
        scaling: Scaling,
        n_fft: int | None,
    ) -> float:
        """What the field of the selected input is multiplied with at amplitude 1."""
        if pivot_source is None or n_fft is None:
            return 0.0
        return self._gain(limb_data, pivot_source, scaling, n_fft)

    def streamed_field(
        self,
        limb_data: Limb,
        audible: tuple[Input, ...],
        scaling: Scaling,
        response_samples: int,
        stop: Callable[[], bool],
    ) -> StreamedField | None:
        """Field of all audible inputs where the scene is too long to be transformed at once."""
        if response_samples <= LONGEST_AT_ONCE:
            return None
        rate = limb_data.sample_rate_hz
        played = []
        for one in audible:
            source = source_of(one)
            drive = self._drives.drawn(one.waveform, rate)
            weight = one.amplitude * self._gain(limb_data, source, scaling, BLOCK_FFT, stop)
            if weight != 0.0:
                played.append(
                    Played(
                        samples=drive.samples,
                        start=sample_count(one.onset_s, rate),
                        weight=weight,
                        response=self._responses.of(limb_data, one.location, scaling, BLOCK_FFT),
                    )
                )
        return StreamedField(played, response_samples, stop)

    def trace_error(
        self,
        limb_data: Limb,
        audible: tuple[Input, ...],
        scaling: Scaling,
        outputs: tuple[int, ...],
        axes: Axes,
        axis_traces: Floats,
        n_fft: int | None,
    ) -> TraceError | None:
        """Error of the selected traces; None where there is nothing, or too much, to check."""
        if n_fft is None:
            return None
        rate = limb_data.sample_rate_hz
        heard = []
        for one in audible:
            drive = self._drives.drawn(one.waveform, rate)
            if drive.silent or one.amplitude == 0.0:
                continue
            response = self._responses.of(limb_data, one.location, scaling, n_fft)
            gain = drive.factor
            if scaling == "upstream":
                spectrum = self._drives.spectrum(one.waveform, rate, n_fft)
                largest = exact_maximum(drive, spectrum, response)
                gain = 1.0 / largest if largest > 0 else gain
            heard.append(
                Heard(
                    drive=drive,
                    delay_samples=sample_count(one.onset_s, rate),
                    weight=one.amplitude * gain,
                    response=response,
                )
            )
        return trace_error_of(axis_traces, outputs, axis_numbers(axes), heard)

    def _sum(
        self, limb: Limb, inputs: tuple[Input, ...], scaling: Scaling, n_fft: int
    ) -> Complexes | None:
        total: Complexes | None = None
        rate = limb.sample_rate_hz
        # One buffer for all: new memory of this size costs more than what is written to it.
        field: Complexes | None = None
        for one in inputs:
            source = source_of(one)
            weight = one.amplitude * self._gain(limb, source, scaling, n_fft)
            if weight == 0.0:
                continue
            drive = self._drives.spectrum(one.waveform, rate, n_fft)
            drive = delayed(drive, sample_count(one.onset_s, rate), n_fft) * weight
            field = self._field(limb, source, scaling, n_fft, drive, field)
            if total is None:
                total, field = field, None
            else:
                total += field
        return total

    def _felt(
        self, waveform: Waveform, delay_samples: int, sample_rate_hz: float, n_times: int
    ) -> Booleans:
        drawn = self._drives.drawn(waveform, sample_rate_hz)
        return reach(drawn.samples, delay_samples, N_TAPS, n_times)

    def _field(
        self,
        limb: Limb,
        source: Source,
        scaling: Scaling,
        n_fft: int,
        drive: Complexes,
        buffer: Complexes | None = None,
    ) -> Complexes:
        response = self._responses.of(limb, source.location, scaling, n_fft)
        return np.multiply(response.values, drive, out=buffer)

    def _gain(
        self,
        limb: Limb,
        source: Source,
        scaling: Scaling,
        n_fft: int,
        stop: Callable[[], bool] = lambda: False,
    ) -> float:
        rate = limb.sample_rate_hz
        drive = self._drives.drawn(source.waveform, rate)
        if drive.silent or scaling != "upstream":
            return drive.factor

        def compute() -> float:
            response = self._responses.of(limb, source.location, scaling, n_fft)
            fits = drive.samples.size + N_TAPS - 1 <= n_fft
            spectrum = self._drives.spectrum(source.waveform, rate, n_fft) if fits else None
            return unit_gain(drive, spectrum, response, scaling, stop)

        return self._gains.get((limb, source.location, source.waveform, n_fft), compute)
