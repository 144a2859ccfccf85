"""The cases: convolutions, resampled signals and actuators, each with its exact values.

Exact convolutions on any limb are sums of products in whole numbers, without an engine.
"""

import zlib
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import Any, cast
from zipfile import BadZipFile

import numpy as np
import scipy
from numpy.typing import NDArray

from skinsource.actuators.models import VoiceCoil
from skinsource.base.assets import data_folder
from skinsource.base.conventions import N_AXES, N_INPUTS, N_OUTPUTS, N_TAPS, Floats, Integers
from skinsource.base.errors import FileFormatError, printable, quoted
from skinsource.base.job import Progress, Stop, never, silent, stop_if
from skinsource.limbs.limb import Limb, LimbMap
from skinsource.signals.generators import sample_count

#: Made with mpmath by ``benchmarks/make_bench_references.py``.
FILE_NAME = "bench-references.npz"
#: Places at which errors are measured: outputs, each along all axes, and samples.
_N_OUTPUTS_CHECKED, _N_SAMPLES_CHECKED = 4, 32
#: Cases with larger responses are left out.
_LARGEST_RESPONSE_BYTES = 500e6
#: The signal to be resampled: tones under a bell, which ends before one second does.
TONES_HZ, BELL_S, MIDDLE_S = (30.0, 95.0, 210.0, 380.0, 570.0), 0.06, 0.5

_DAMAGE = (OSError, EOFError, KeyError, ValueError, BadZipFile, zlib.error)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Convolution:
    """Drives at places of a limb; the solution is the vibration at some outputs.

    Attributes
    ----------
    limb
        Limb with the responses.
    drives : (n_inputs, n_times)
        Drive of each input.
    locations, outputs
        Input place of each drive, and the outputs, both from 1.
    """

    limb: Limb
    drives: Floats
    locations: tuple[int, ...]
    outputs: tuple[int, ...]

    @property
    def responses(self) -> tuple[Floats, ...]:
        """Responses to each drive, (n_channels, n_taps)."""
        limb = self.limb
        return tuple(limb.response_to(place).reshape(-1, limb.n_taps) for place in self.locations)

    def solution(self, vibration: Floats) -> Floats:
        """Return the channels of the solution, (n_rows, n_times), of all in any shape."""
        by_output = vibration.reshape(self.limb.n_outputs, self.limb.n_axes, -1)
        rows = by_output[np.array(self.outputs) - 1]
        return rows.reshape(-1, rows.shape[-1])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Resampling:
    """A signal, (n_times,), and two sample rates."""

    signal: Floats
    from_hz: int
    to_hz: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Actuation:
    """A voltage, (n_times,), held from each sample to the next, that moves a coil from rest.

    The solution is acceleration, velocity, displacement and current, in this order.
    """

    coil: VoiceCoil
    voltage: Floats
    sample_rate_hz: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Inversion:
    """Waveforms that are wanted on the skin; the solution is the drives, (n_inputs, n_times).

    Its drives x are the least of |H x - wanted|² + load |x|².

    Attributes
    ----------
    taps : (n_rows, n_inputs, n_taps)
        Responses, of which H is the convolution.
    wanted : (n_rows, n_times + n_taps - 1)
        Waveforms.
    load
        What drives cost.
    """

    taps: Floats
    wanted: Floats
    load: float

    @property
    def n_times(self) -> int:
        """Length of the drives."""
        return self.wanted.shape[1] - self.taps.shape[2] + 1

    @property
    def convolution(self) -> Floats:
        """H as a matrix, (n_rows · n_wanted, n_inputs · n_times)."""
        return np.block(
            [
                [scipy.linalg.convolution_matrix(taps, self.n_times) for taps in row]
                for row in self.taps
            ]
        )


Problem = Convolution | Resampling | Actuation | Inversion


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Case:
    """A problem, and some samples of its exact solution.

    Attributes
    ----------
    name
        What it exercises, in short.
    samples : (n_samples,)
        Times at which errors are measured.
    reference : (n_rows, n_samples)
        Exact values, rounded once; empty: they are not yet known.
    quick
        Whether it is part of a short run.
    """

    name: str
    problem: Problem
    samples: Integers
    reference: Floats = field(default_factory=partial(np.empty, 0))
    quick: bool = True


def stored_cases() -> tuple[Case, ...]:
    """Return all cases, on the synthetic limb, with the stored reference.

    Raises
    ------
    FileFormatError
        The file of references is missing or damaged.
    """
    path, cases = data_folder() / FILE_NAME, []
    for case in cases_without_reference():
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
                cases.append(replace(case, reference=np.asarray(stored[case.name], np.float64)))
        except _DAMAGE as error:
            raise FileFormatError(
                f"{path}: the reference of {quoted(case.name)} cannot be read "
                f"({printable(error)}). Install SkinSource studio again."
            ) from error
    return tuple(cases)


def cases_without_reference() -> tuple[Case, ...]:
    """Return all cases on the synthetic limb, without reference."""
    limb = synthetic_limb()
    return (*convolutions(limb), *_resamplings(), *_actuations(), *_inversions(limb))


def convolutions(limb: Limb) -> tuple[Case, ...]:
    """Return short and extreme cases on a limb, without reference."""
    n_taps, rate_hz = limb.n_taps, limb.sample_rate_hz
    channel_bytes = limb.n_outputs * limb.n_axes * np.dtype(np.float64).itemsize
    longest = _LARGEST_RESPONSE_BYTES / channel_bytes - n_taps
    outputs = np.linspace(1, limb.n_outputs, min(limb.n_outputs, _N_OUTPUTS_CHECKED))

    def case(
        name: str,
        *drives: Floats,
        first: int = 0,
        last: int = 0,
        quick: bool = True,
    ) -> tuple[Case, ...]:
        n_times = drives[0].size
        if n_times > longest:
            return ()
        problem = Convolution(
            limb=limb,
            drives=np.stack(drives),
            locations=tuple(1 + k % limb.n_inputs for k in range(len(drives))),
            outputs=tuple(map(int, outputs)),
        )
        samples = np.linspace(first, last or n_times + n_taps - 2, _N_SAMPLES_CHECKED).astype(int)
        return (Case(name=name, problem=problem, samples=samples, quick=quick),)

    burst, half, two, minute = (
        noise(1, sample_count(duration_s, rate_hz)) for duration_s in (0.3, 0.5, 2.0, 60.0)
    )
    # The second burst begins once the response to the first is over.
    second = burst.size + n_taps
    bursts = np.concatenate((burst, np.zeros(n_taps), 1e-6 * burst))
    many = [noise(seed, two.size) for seed in range(20)]
    return (
        *case("1 input, 0.5 s", half),
        *case("20 inputs, 2 s", *many),
        *case("1 input, 60 s", minute, quick=False),
        *case("burst at -120 dB", bursts, first=second),
        # The synthetic limb does not respond to an offset.
        *case("offset of 1e8", two + 2.0**27, first=n_taps, last=two.size - 1),
        *case("peak of 1e30", half * 2.0**99),
        *case("peak of 1e-310", half * 2.0**-1030),
    )


def noise(seed: int, n_times: int) -> Floats:
    """Return noise between -1 and 1, (n_times,), of 40 bits: the same on every machine."""
    integers = np.random.PCG64(seed).random_raw(n_times) >> np.uint64(24)
    return np.ldexp(integers.astype(np.float64) - 2.0**39, -39)


def synthetic_limb() -> Limb:
    """Return a limb in the shape of the published ones, with responses that sum to zero.

    It has no map.  Its responses are integers times a power of two: the same on every machine.
    """
    nowhere = LimbMap(
        outline=np.zeros((0, 2)),
        output_positions=np.zeros((N_OUTPUTS, 2)),
        input_positions=np.zeros((N_INPUTS, 2)),
        hand_length_px=1.0,
    )
    return Limb(
        name="synthetic responses",
        hand_length_mm=1.0,
        synthetic=True,
        map=nowhere,
        read_response=_synthetic_response,
    )


def _synthetic_response(location: int) -> Floats:
    """Return decaying noise, (72 outputs, 3 axes, 522 taps)."""
    n_taps = N_TAPS - 1
    raw = np.random.PCG64(1000 + location).random_raw(N_OUTPUTS * N_AXES * n_taps)
    integers = (raw >> np.uint64(40)).astype(np.int64).reshape(N_OUTPUTS, N_AXES, n_taps) - 2**23
    fading = integers >> (np.arange(n_taps) // 24)
    return np.ldexp(np.diff(fading, prepend=0, append=0).astype(np.float64), -23)


def tone_burst(rate_hz: int) -> Floats:
    """Return the signal to be resampled: one second, nothing above 600 Hz."""
    time_s = np.arange(rate_hz) / rate_hz - MIDDLE_S
    tones = sum(np.cos(2.0 * np.pi * tone * time_s) for tone in TONES_HZ)
    return np.exp(-0.5 * (time_s / BELL_S) ** 2) * tones


def _resamplings() -> tuple[Case, ...]:
    return tuple(
        Case(
            name=f"{from_hz} to {to_hz} Hz",
            problem=Resampling(signal=tone_burst(from_hz), from_hz=from_hz, to_hz=to_hz),
            samples=np.linspace(0, to_hz - 1, 4 * _N_SAMPLES_CHECKED).astype(int),
        )
        for from_hz, to_hz in ((1300, 48_000), (48_000, 1300), (44_100, 48_000))
    )


def _actuations() -> tuple[Case, ...]:
    coils = {
        # 175 Hz, Q 15.
        "resonant actuator": VoiceCoil(8.0, 8e-4, 0.8, 1e-3, 0.0733, 1209.03),
        "Q of 10 000": VoiceCoil(8.0, 8e-4, 1e-3, 1e-3, 1.1e-4, 1209.03),
        # A stiff system.
        "coil of 1 µs": VoiceCoil(8.0, 8e-6, 0.8, 1e-3, 0.0628, 0.98696),
        # Without eigenvectors.
        "three equal roots": VoiceCoil(8.0, 8e-3, 1e-9, 1e-3, 2.0, 1000.0),
    }
    voltage = np.ones(401)
    return tuple(
        Case(
            name=name,
            problem=Actuation(coil=coil, voltage=voltage, sample_rate_hz=1300.0),
            samples=np.linspace(0, voltage.size - 1, 2 * _N_SAMPLES_CHECKED).astype(int),
        )
        for name, coil in coils.items()
    )


def _inversions(limb: Limb) -> tuple[Case, ...]:
    n_times, n_taps, outputs, places = 50, 100, slice(4), (1, 2, 3)
    taps = np.stack([limb.response_to(place)[outputs, 0, :n_taps] for place in places], axis=1)
    wanted = np.zeros((len(taps), n_times + n_taps - 1))
    # At one output; the others are to be still.
    wanted[0, n_times : 2 * n_times] = noise(1, n_times)
    return tuple(
        Case(
            name=name,
            problem=Inversion(taps=taps, wanted=wanted, load=load),
            samples=np.arange(n_times),
        )
        for name, load in (("3 wanted drives", 0.5), ("3 drives, hardly a load", 2.0**-16))
    )


def cases_of(
    limb: Limb | None, *, quick: bool, progress: Progress = silent, stop: Stop = never
) -> tuple[Case, ...]:
    """Return the convolutions on a limb with their exact values; None: all stored cases.

    Parameters
    ----------
    quick
        Whether to return only the cases of a short run.
    progress, stop
        Called before each case.

    Raises
    ------
    FileFormatError
        The stored references cannot be read.
    InvalidInputError
        A response of the limb is not finite.
    Stopped
        ``stop`` said so.
    """
    chosen = [
        case
        for case in (stored_cases() if limb is None else convolutions(limb))
        if case.quick or not quick
    ]
    if limb is None:
        return tuple(chosen)
    cases = []
    for k, case in enumerate(chosen):
        stop_if(stop)
        progress(k, len(chosen), f"exact values of {case.name}")
        problem = cast(Convolution, case.problem)
        cases.append(replace(case, reference=exact_samples(problem, case.samples)))
    return tuple(cases)


def exact_samples(problem: Convolution, samples: Integers) -> Floats:
    """Return samples of the solution, (n_rows, n_samples), rounded once."""
    taps = np.stack([problem.solution(response) for response in problem.responses])
    n_taps = taps.shape[-1]
    integer_taps, taps_exponent = _integers(taps[..., ::-1])
    padding = (0, 0), (n_taps - 1, n_taps - 1)
    integer_drives, drives_exponent = _integers(np.pad(problem.drives, padding))
    unit = Fraction(2) ** (taps_exponent + drives_exponent)
    sums = [
        sum(
            response @ drive[sample : sample + n_taps]
            for response, drive in zip(integer_taps, integer_drives, strict=True)
        )
        for sample in samples
    ]
    return np.array([[float(value * unit) for value in row] for row in zip(*sums, strict=True)])


def _integers(values: Floats) -> tuple[NDArray[Any], int]:
    """Return values as integers of any size, and the exponent of their factor, a power of two."""
    mantissas, exponents = np.frexp(values)
    lowest = int(exponents.min())
    integers = np.ldexp(mantissas, 53).astype(np.int64).astype(object)
    return integers << (exponents - lowest).astype(object), lowest - 53
