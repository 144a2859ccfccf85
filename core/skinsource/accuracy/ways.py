"""Ways of computing the cases: this program's own, and those that it is held against."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import count
from typing import Any

import numpy as np
import scipy

from skinsource.accuracy.cases import Actuation, Case, Convolution, Resampling
from skinsource.arrays import Floats
from skinsource.design import Design, track
from skinsource.graph import Graph
from skinsource.quantities import new_graph, sources
from skinsource.resampling import resample
from skinsource.response import predict
from skinsource.samples import Samples
from skinsource.view import View
from skinsource.waveforms import Recording

#: Computes a case, (n_rows, n_times); all that can be prepared is done.
Run = Callable[[], Floats]
#: More products than these take a personal computer more than ten seconds.
_MOST_PRODUCTS = 2e10


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """A way of computing problems of one kind.

    Attributes
    ----------
    name
        Whose it is, and what is called.
    kind
        Class of the problems.
    prepare
        From a problem to what computes it, again and again: its first run is not timed.
    fits
        Whether it computes a problem in reasonable time.
    """

    name: str
    kind: type
    prepare: Callable[[Any], Run]
    fits: Callable[[Any], bool] = lambda _: True

    def computes(self, case: Case) -> bool:
        """Whether a case is of its kind, and fits."""
        return isinstance(case.problem, self.kind) and self.fits(case.problem)


def _predict(problem: Convolution) -> Run:
    limb, drives, locations = problem.limb, problem.drives, problem.locations
    return lambda: problem.asked_for(predict(limb, drives, locations, scaling="relative"))


def _studio(problem: Convolution, *, edited: bool) -> Run:
    """What the window shows of a design of recordings: levels of all outputs, traces of some.

    At each run the waveform of the first input is another one.  Where the design is ``edited``,
    all else is known from the run before; where it is opened, nothing is.
    """
    limb, numbers = problem.limb, count()
    recordings = [
        Recording(Samples(values=drive, sample_rate_hz=limb.sample_rate_hz))
        for drive in problem.drives
    ]
    inputs = [track(*one) for one in zip(problem.locations, recordings, strict=True)]
    view = View(outputs=problem.outputs, axes="xyz", selected_inputs=(1,))

    def show(graph: Graph) -> Floats:
        another = replace(recordings[0], name=str(next(numbers)))
        inputs[0] = track(problem.locations[0], another)
        design = Design(limb=limb.name, inputs=tuple(inputs), scaling="relative")
        given = {**sources(design, view), "limb_data": limb}
        traces: Floats = graph.evaluate({"axis_traces", "output_rms"}, given)["axis_traces"]
        return traces.reshape(-1, traces.shape[-1])

    return partial(show, new_graph()) if edited else lambda: show(new_graph())


def _fftconvolve(problem: Convolution) -> Run:
    drives, responses = problem.drives, problem.responses

    def run() -> Floats:
        total = scipy.signal.fftconvolve(responses[0], drives[:1], axes=-1)
        for response, drive in zip(responses[1:], drives[1:], strict=True):
            total += scipy.signal.fftconvolve(response, drive[None], axes=-1)
        return problem.asked_for(total)

    return run


def _direct_sums(problem: Convolution) -> Run:
    drives, responses = problem.drives, problem.responses

    def run() -> Floats:
        n_channels, n_taps = responses[0].shape
        total = np.zeros((n_channels, drives.shape[1] + n_taps - 1))
        for response, drive in zip(responses, drives, strict=True):
            for channel, taps in zip(total, response, strict=True):
                channel += np.convolve(drive, taps)
        return problem.asked_for(total)

    return run


def _few_products(problem: Convolution) -> bool:
    limb = problem.limb
    per_sample = limb.n_outputs * limb.n_axes * limb.n_taps
    return float(per_sample) * problem.drives.size <= _MOST_PRODUCTS


def _resample(problem: Resampling) -> Run:
    return lambda: resample(problem.signal, problem.from_hz, problem.to_hz)[None]


def _resample_poly(problem: Resampling) -> Run:
    shared = math.gcd(problem.from_hz, problem.to_hz)
    up, down = problem.to_hz // shared, problem.from_hz // shared
    return lambda: scipy.signal.resample_poly(problem.signal, up, down)[None]


def _resample_fourier(problem: Resampling) -> Run:
    return lambda: np.asarray(scipy.signal.resample(problem.signal, problem.to_hz))[None]


def _simulate(problem: Actuation) -> Run:
    def run() -> Floats:
        moved = problem.coil.simulate(problem.voltage, problem.sample_rate_hz)
        return np.stack((moved.acceleration, moved.velocity, moved.displacement, moved.current))

    return run


def _lsim(problem: Actuation) -> Run:
    coil = problem.coil
    r, ind, bl = coil.resistance_ohm, coil.inductance_h, coil.force_factor_n_per_a
    m, c, k = coil.moving_mass_kg, coil.damping_n_s_per_m, coil.stiffness_n_per_m
    # Current, velocity and displacement of what moves.
    states = np.array([[-r / ind, -bl / ind, 0.0], [bl / m, -c / m, -k / m], [0.0, 1.0, 0.0]])
    drive = np.array([[1.0 / ind], [0.0], [0.0]])
    read = np.array([states[1], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    system = states, drive, read, np.zeros((4, 1))
    time_s = np.arange(problem.voltage.size) / problem.sample_rate_hz
    return lambda: scipy.signal.lsim(system, problem.voltage, time_s, interp=False)[1].T


WAYS = (
    Way(name="SkinSource predict", kind=Convolution, prepare=_predict),
    Way(name="SkinSource, opened", kind=Convolution, prepare=partial(_studio, edited=False)),
    Way(name="SkinSource, edited", kind=Convolution, prepare=partial(_studio, edited=True)),
    Way(name="SciPy fftconvolve", kind=Convolution, prepare=_fftconvolve),
    Way(name="direct sums", kind=Convolution, prepare=_direct_sums, fits=_few_products),
    Way(name="SkinSource resample", kind=Resampling, prepare=_resample),
    Way(name="SciPy resample_poly", kind=Resampling, prepare=_resample_poly),
    Way(name="SciPy resample", kind=Resampling, prepare=_resample_fourier),
    Way(name="SkinSource simulate", kind=Actuation, prepare=_simulate),
    Way(name="SciPy lsim", kind=Actuation, prepare=_lsim),
)
