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
        From a problem to what computes it: what a user does once is done here.
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
    """What the window shows, levels of all outputs and traces of some, of a design of recordings.

    The waveform of the first input is another one at each run; the others are as they were where
    the design is ``edited``, and computed with all else where it is opened.
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

    if not edited:
        return lambda: show(new_graph())
    opened = new_graph()
    show(opened)
    return partial(show, opened)


def _fftconvolve(problem: Convolution) -> Run:
    drives, responses, convolve = problem.drives, problem.responses, scipy.signal.fftconvolve

    def run() -> Floats:
        total = convolve(responses[0], drives[:1], axes=-1)
        for response, drive in zip(responses[1:], drives[1:], strict=True):
            total += convolve(response, drive[None], axes=-1)
        return problem.asked_for(total)

    return run


def _direct_sums(problem: Convolution) -> Run:
    drives, responses = problem.drives, problem.responses

    def run() -> Floats:
        total = np.zeros((responses.shape[1], drives.shape[1] + responses.shape[2] - 1))
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


def _equations(problem: Actuation) -> tuple[Floats, Floats, Floats, Floats]:
    """A, b and what reads acceleration, velocity, displacement and current; times in s."""
    coil = problem.coil
    r, ind, bl = coil.resistance_ohm, coil.inductance_h, coil.force_factor_n_per_a
    m, c, k = coil.moving_mass_kg, coil.damping_n_s_per_m, coil.stiffness_n_per_m
    dynamics = np.array([[-r / ind, -bl / ind, 0.0], [bl / m, -c / m, -k / m], [0.0, 1.0, 0.0]])
    read = np.array([dynamics[1], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    time_s = np.arange(problem.voltage.size) / problem.sample_rate_hz
    return dynamics, np.array([1.0 / ind, 0.0, 0.0]), read, time_s


def _lsim(problem: Actuation) -> Run:
    dynamics, drive, read, time_s = _equations(problem)
    system = (dynamics, drive[:, None], read, np.zeros((4, 1)))
    return lambda: scipy.signal.lsim(system, problem.voltage, time_s, interp=False)[1].T


def _radau(problem: Actuation) -> Run:
    """Of a constant voltage."""
    dynamics, drive, read, time_s = _equations(problem)
    constant = drive * problem.voltage[0]

    def run() -> Floats:
        moved = scipy.integrate.solve_ivp(
            lambda _, state: dynamics @ state + constant,
            (0.0, float(time_s[-1])),
            np.zeros(3),
            method="Radau",
            t_eval=time_s,
            rtol=1e-6,
            atol=1e-12,
            jac=dynamics,
        )
        return read @ moved.y

    return run


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
    Way(name="SciPy solve_ivp, Radau", kind=Actuation, prepare=_radau),
)
