"""Rules that turn the inputs of a scene into parts: the selected input, and all others.

The selected input is the one that is being edited.  It is kept at amplitude 1, apart from the sum
of the others, so that a change of its amplitude transforms nothing, and a change of its waveform or
onset leaves the others alone.  What comes out is a function of design and view.
"""

from collections.abc import Callable
from typing import Any
from weakref import ref

import numpy as np

from skinsource.design import Input
from skinsource.job import Stop, never, stop_if
from skinsource.limb import N_TAPS, Limb
from skinsource.projection import Axes, axis_numbers
from skinsource.rendering.check import Heard, TraceError, exact_gains, trace_error_of
from skinsource.rendering.drives import Booleans, Drive, Drives, Source, delayed, reach, source_of
from skinsource.rendering.exact_spectra import ExactSpectra
from skinsource.rendering.gains import Gains
from skinsource.rendering.part import Part, rows_of
from skinsource.rendering.response_spectra import ResponseSpectra, ResponseSpectrum
from skinsource.rendering.segments import BLOCK_FFT, Played
from skinsource.rendering.streaming import StreamedField
from skinsource.rendering.sums import sum_of_fields
from skinsource.rendering.transforms import Complexes, Floats
from skinsource.response_scaling import Scaling
from skinsource.signals import sample_count


class Renderer:
    """The rules that need memory: spectra of responses and drives, gains.

    Each method is a rule of the graph: its name is what it computes.
    """

    def __init__(self) -> None:
        self._responses = ResponseSpectra()
        self._drives = Drives()
        self._gains = Gains(self._drives)
        self._exact_spectra = ExactSpectra()
        self._shown: list[Drive] = []

    def rules(self) -> tuple[Callable[..., Any], ...]:
        """The methods that are rules."""
        return (
            self.input_waveforms,
            self.stimulus_samples,
            self.others_spectrum,
            self.pivot_response,
            self.pivot_drive,
            self.others_felt,
            self.pivot_felt,
            self.pivot_part,
            self.pivot_gain,
            self.streamed_field,
            self.trace_error,
        )

    def input_waveforms(
        self, inputs: tuple[Input, ...], sample_rate_hz: float, stop: Stop
    ) -> tuple[Floats, ...]:
        """What each input plays, muted or not: one (n_times,) each, of peak 1."""
        drives = [self._drawn(one, sample_rate_hz, stop) for one in inputs]
        # Where they exceed the memory of drives, the field would draw them again.
        self._shown = drives
        # Long ones are not held twice: most have a peak of exactly 1.
        return tuple(
            drive.samples if drive.factor in (0.0, 1.0) else drive.samples * drive.factor
            for drive in drives
        )

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

    def pivot_response(
        self,
        limb_data: Limb,
        pivot_source: Source | None,
        scaling: Scaling,
        n_fft: int | None,
    ) -> ResponseSpectrum | None:
        """Responses to the place of the selected input."""
        if pivot_source is None or n_fft is None:
            return None
        return self._responses.of(limb_data, pivot_source.location, scaling, n_fft)

    def pivot_drive(
        self, pivot_source: Source | None, sample_rate_hz: float, n_fft: int | None
    ) -> Complexes | None:
        """Spectrum of what the selected input plays, from time 0 on, (n_bins,); None: silence."""
        if pivot_source is None or n_fft is None:
            return None
        if self._drives.drawn(pivot_source, sample_rate_hz).silent:
            return None
        return self._drives.spectrum(pivot_source, sample_rate_hz, n_fft)

    def others_felt(
        self,
        others: tuple[Input, ...],
        response_samples: int,
        sample_rate_hz: float,
        n_fft: int | None,
    ) -> Booleans:
        """When any of the other inputs can be felt, (response_samples,); not for long scenes."""
        played = np.zeros(0 if n_fft is None else response_samples, bool)
        for one in others if played.size else ():
            samples = self._drives.drawn(one, sample_rate_hz).samples
            onset = sample_count(one.onset_s, sample_rate_hz)
            played[onset : onset + samples.size] |= samples != 0.0
        return reach(played, N_TAPS)

    def pivot_felt(
        self,
        pivot_source: Source | None,
        response_samples: int,
        sample_rate_hz: float,
        n_fft: int | None,
    ) -> Booleans:
        """When the selected input could be felt if it started at time 0, as `others_felt`."""
        played = np.zeros(0 if n_fft is None else response_samples, bool)
        if pivot_source is not None and played.size:
            samples = self._drives.drawn(pivot_source, sample_rate_hz).samples
            played[: samples.size] = samples != 0.0
        return reach(played, N_TAPS)

    def pivot_part(
        self,
        limb_data: Limb,
        pivot_source: Source | None,
        scaling: Scaling,
        pivot_response: ResponseSpectrum | None,
        pivot_drive: Complexes | None,
        pivot_felt: Booleans,
    ) -> Part | None:
        """Field of the selected input at amplitude 1 and onset 0, to be brought back to time."""
        if pivot_response is None or pivot_source is None or pivot_drive is None:
            return None
        values, taps = pivot_response.values, pivot_response.taps
        samples = self._drives.drawn(pivot_source, limb_data.sample_rate_hz).samples
        name = ref(limb_data), pivot_source.location, scaling == "probe"
        exact = self._exact_spectra.of(samples, taps, name, pivot_felt.size)
        return Part(
            lambda channels: rows_of(values, channels) * pivot_drive,
            pivot_response.n_fft,
            pivot_felt,
            exact,
        )

    def pivot_gain(
        self,
        limb_data: Limb,
        pivot_source: Source | None,
        scaling: Scaling,
        pivot_response: ResponseSpectrum | None,
    ) -> float:
        """What the field of the selected input is multiplied with at amplitude 1."""
        if pivot_source is None or pivot_response is None:
            return 0.0
        drive = self._drives.drawn(pivot_source, limb_data.sample_rate_hz)
        if drive.silent:
            return drive.factor
        return self._gains.of(limb_data, scaling, [pivot_source], [drive], [pivot_response])[0]

    def streamed_field(
        self,
        limb_data: Limb,
        audible: tuple[Input, ...],
        scaling: Scaling,
        response_samples: int,
        n_fft: int | None,
        stop: Stop,
    ) -> StreamedField | None:
        """Field of all audible inputs where the scene is too long to be transformed at once."""
        if n_fft is not None:
            return None
        rate = limb_data.sample_rate_hz
        heard = self._heard(audible, rate, stop)
        if not heard:
            return StreamedField([], None, response_samples)
        used = tuple(sorted({one.location for one, _ in heard}))
        stack = self._responses.stack(limb_data, used, scaling, BLOCK_FFT)
        sources = [source_of(one) for one, _ in heard]
        responses = [stack.responses[one.location] for one, _ in heard]
        drives = [drive for _, drive in heard]
        gains = self._gains.of(limb_data, scaling, sources, drives, responses, stop)
        played = [
            Played(
                drive=drive,
                start=sample_count(one.onset_s, rate),
                weight=one.amplitude * gain,
                location=one.location,
            )
            for (one, drive), gain in zip(heard, gains, strict=True)
        ]
        return StreamedField(played, stack, response_samples)

    def trace_error(
        self,
        limb_data: Limb,
        audible: tuple[Input, ...],
        scaling: Scaling,
        outputs: tuple[int, ...],
        axes: Axes,
        axis_traces: Floats,
        n_fft: int | None,
        stop: Stop,
    ) -> TraceError | None:
        """Error of the selected traces; None where there is nothing to check."""
        rate = limb_data.sample_rate_hz
        heard = self._heard(audible, rate, stop)
        responses = self._responses_to(limb_data, [one for one, _ in heard], scaling, n_fft)
        spectra = [self._drives.spectrum(one, rate, n_fft) for one, _ in heard if n_fft is not None]
        drives = [drive for _, drive in heard]
        factors = [drive.factor for drive in drives]
        if scaling == "upstream" and heard:
            factors = exact_gains(drives, spectra, responses, stop)
        checked = [
            Heard(
                drive=drive,
                delay_samples=sample_count(one.onset_s, rate),
                weight=one.amplitude * factor,
                response=response,
            )
            for (one, drive), response, factor in zip(heard, responses, factors, strict=True)
        ]
        return trace_error_of(axis_traces, outputs, axis_numbers(axes), checked)

    def _sum(
        self, limb: Limb, inputs: tuple[Input, ...], scaling: Scaling, n_fft: int
    ) -> Complexes | None:
        rate = limb.sample_rate_hz
        heard = self._heard(inputs, rate)
        if not heard:
            return None
        played, drives = [one for one, _ in heard], [drive for _, drive in heard]
        responses = self._responses_to(limb, played, scaling, n_fft)
        gains = self._gains.of(limb, scaling, [*map(source_of, played)], drives, responses)
        spectra = []
        for one, gain in zip(played, gains, strict=True):
            spectrum = self._drives.spectrum(one, rate, n_fft)
            onset = sample_count(one.onset_s, rate)
            spectra.append(delayed(spectrum, onset, n_fft) * (one.amplitude * gain))
        return sum_of_fields([response.values for response in responses], spectra)

    def _responses_to(
        self, limb: Limb, inputs: list[Input], scaling: Scaling, n_fft: int | None
    ) -> list[ResponseSpectrum]:
        """Responses to the places of inputs; without ``n_fft`` those for blocks."""
        if n_fft is not None:
            return [self._responses.of(limb, one.location, scaling, n_fft) for one in inputs]
        if not inputs:
            return []
        used = tuple(sorted({one.location for one in inputs}))
        stack = self._responses.stack(limb, used, scaling, BLOCK_FFT)
        return [stack.responses[one.location] for one in inputs]

    def _heard(
        self, inputs: tuple[Input, ...], sample_rate_hz: float, stop: Stop = never
    ) -> list[tuple[Input, Drive]]:
        """Inputs that can be felt, and what they play."""
        drawn = [(one, self._drawn(one, sample_rate_hz, stop)) for one in inputs]
        return [(one, drive) for one, drive in drawn if one.amplitude and not drive.silent]

    def _drawn(self, one: Input, sample_rate_hz: float, stop: Stop) -> Drive:
        stop_if(stop)
        return self._drives.drawn(one, sample_rate_hz)
