"""Ways of moving an actuator and of resampling that stand beside this program's own."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import scipy

from skinsource.arrays import Floats
from skinsource.method_comparison.method import Method, Setting, Unfit
from skinsource.method_comparison.signal_scenes import N_STEPS, STEP_RATE_HZ, SignalScene, burst
from skinsource.resampling import resample
from skinsource.resampling.kernel import half_transition

#: Gives the signal, (n_rows, n_times); all that can be prepared is done.
Run = Callable[[], Floats]
#: More multiples of the exact peak than that are no approximation of it.
_DIVERGED = 1e3


@dataclass(frozen=True, slots=True, kw_only=True)
class SignalEngine:
    """A way of computing scenes of one family.

    Attributes
    ----------
    name, methods, is_ours, family
        As of `skinsource.method_comparison.engines.ComparedEngine`.
    prepare
        From a scene and the name of a setting to what computes it.
    """

    name: str
    family: str
    prepare: Callable[[SignalScene, str], Run]
    methods: tuple[Method, ...]
    is_ours: bool = False


def checked(values: Floats, exact: Floats) -> Floats:
    """Return what a method gave; raise `Unfit` where it diverged."""
    if not np.abs(values).max() <= _DIVERGED * np.abs(exact).max():
        raise Unfit("diverged")
    return values


def _state_space(scene: SignalScene) -> tuple[Floats, Floats, Floats]:
    """A, b and what gives acceleration, velocity, displacement and current, in doubles."""
    coil = scene.actuator
    if coil is None:
        raise Unfit("moves no actuator")
    r, ind, bl = coil.resistance_ohm, coil.inductance_h, coil.force_factor_n_per_a
    m, c, k = coil.moving_mass_kg, coil.damping_n_s_per_m, coil.stiffness_n_per_m
    dynamics = np.array([[-r / ind, -bl / ind, 0.0], [bl / m, -c / m, -k / m], [0.0, 1.0, 0.0]])
    read = np.array([dynamics[1], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    return dynamics, np.array([1.0 / ind, 0.0, 0.0]), read


def _ours(scene: SignalScene, _: str) -> Run:
    coil, voltage = scene.actuator, np.ones(N_STEPS + 1)
    if coil is None:
        raise Unfit("moves no actuator")

    def run() -> Floats:
        moved = coil.simulate(voltage, STEP_RATE_HZ)
        return np.stack((moved.acceleration, moved.velocity, moved.displacement, moved.current))

    return run


def _recursion(step: Floats, driven: Floats, read: Floats, every: int) -> Floats:
    """States after each ``every`` steps of a recursion from rest, read, (4, N_STEPS + 1)."""
    state, found = np.zeros(3), np.zeros((N_STEPS + 1, 3))
    with np.errstate(all="ignore"):
        for k in range(1, N_STEPS + 1):
            for _ in range(every):
                state = step @ state + driven
            found[k] = state
        return read @ found.T


def _euler(scene: SignalScene, setting: str) -> Run:
    dynamics, drive, read = _state_space(scene)
    every = int(setting.split()[0])
    step_s = 1.0 / STEP_RATE_HZ / every
    return partial(_recursion, np.eye(3) + step_s * dynamics, step_s * drive, read, every)


def _bilinear(scene: SignalScene, _: str) -> Run:
    dynamics, drive, read = _state_space(scene)
    half = 0.5 / STEP_RATE_HZ * dynamics
    solved = np.linalg.inv(np.eye(3) - half)
    return partial(_recursion, solved @ (np.eye(3) + half), solved @ drive / STEP_RATE_HZ, read, 1)


def _lsim(scene: SignalScene, _: str) -> Run:
    dynamics, drive, read = _state_space(scene)
    time_s = np.arange(N_STEPS + 1) / STEP_RATE_HZ
    system = (dynamics, drive[:, None], read, np.zeros((4, 1)))

    def run() -> Floats:
        moved = scipy.signal.lsim(system, np.ones(time_s.size), time_s, interp=False)
        return np.asarray(moved[1]).T

    return run


def _adaptive(name: str, scene: SignalScene, setting: str) -> Run:
    dynamics, drive, read = _state_space(scene)
    rtol = float(setting.split()[-1])
    time_s = np.arange(N_STEPS + 1) / STEP_RATE_HZ
    known: dict[str, Any] = {"jac": dynamics} if name == "Radau" else {}

    solve: Any = scipy.integrate.solve_ivp

    def run() -> Floats:
        moved = solve(
            lambda _, state: dynamics @ state + drive,
            (0.0, float(time_s[-1])),
            np.zeros(3),
            method=name,
            t_eval=time_s,
            rtol=rtol,
            atol=1e-12,
            **known,
        )
        if not moved.success or moved.y.shape[1] != time_s.size:
            raise Unfit(f"gave up: {moved.message}")
        return read @ moved.y

    return run


def _our_resampling(scene: SignalScene, _: str) -> Run:
    samples, (from_hz, to_hz) = burst(scene.rates_hz[0]), scene.rates_hz
    return lambda: resample(samples, from_hz, to_hz)[None]


def _linear(scene: SignalScene, _: str) -> Run:
    from_hz, to_hz = scene.rates_hz
    samples, own_s, time_s = burst(from_hz), np.arange(from_hz) / from_hz, np.arange(to_hz) / to_hz
    return lambda: np.interp(time_s, own_s, samples)[None]


def _polyphase(scene: SignalScene, setting: str) -> Run:
    from_hz, to_hz = scene.rates_hz
    samples, shared = burst(from_hz), int(np.gcd(from_hz, to_hz))
    up, down = to_hz // shared, from_hz // shared
    if setting == "default":
        return lambda: scipy.signal.resample_poly(samples, up, down)[None]
    # A Kaiser filter of so many dB whose transition is that of this program: 600 to 700 Hz.
    width = 2.0 * half_transition(min(scene.rates_hz)) / max(up, down)
    n_taps, beta = scipy.signal.kaiserord(float(setting.split()[0]), width)
    taps: Any = scipy.signal.firwin(n_taps | 1, 1.0 / max(up, down), window=("kaiser", beta))
    return lambda: scipy.signal.resample_poly(samples, up, down, window=taps)[None]


def _fourier(scene: SignalScene, _: str) -> Run:
    samples, to_hz = burst(scene.rates_hz[0]), scene.rates_hz[1]
    return lambda: np.asarray(scipy.signal.resample(samples, to_hz))[None]


def _settings(*names: str) -> tuple[Method, ...]:
    """Settings for which nothing is promised; the first is in the short run."""
    return tuple(
        Method(setting=Setting(name=name, promised=False), in_quick=name == names[0])
        for name in names
    )


_OWN = (Method(setting=Setting(name="exact step"), in_quick=True),)

SIGNAL_ENGINES = (
    SignalEngine(name="this program", family="actuator", prepare=_ours, methods=_OWN, is_ours=True),
    SignalEngine(
        name="forward Euler",
        family="actuator",
        prepare=_euler,
        methods=_settings("1 substep", "16 substeps", "256 substeps"),
    ),
    SignalEngine(
        name="bilinear", family="actuator", prepare=_bilinear, methods=_settings("1 substep")
    ),
    SignalEngine(
        name="scipy.signal.lsim", family="actuator", prepare=_lsim, methods=_settings("held")
    ),
    SignalEngine(
        name="RK45",
        family="actuator",
        prepare=partial(_adaptive, "RK45"),
        methods=_settings("rtol 1e-06", "rtol 1e-09"),
    ),
    SignalEngine(
        name="Radau",
        family="actuator",
        prepare=partial(_adaptive, "Radau"),
        methods=_settings("rtol 1e-06", "rtol 1e-09"),
    ),
    SignalEngine(
        name="this program",
        family="resampling",
        prepare=_our_resampling,
        methods=(Method(setting=Setting(name="resample()"), in_quick=True),),
        is_ours=True,
    ),
    SignalEngine(
        name="linear", family="resampling", prepare=_linear, methods=_settings("between neighbours")
    ),
    SignalEngine(
        name="resample_poly",
        family="resampling",
        prepare=_polyphase,
        methods=_settings("default", "80 dB", "120 dB", "140 dB"),
    ),
    SignalEngine(
        name="scipy.signal.resample",
        family="resampling",
        prepare=_fourier,
        methods=_settings("whole signal"),
    ),
)


def signal_engine_of(name: str, family: str) -> SignalEngine:
    """Return the engine called ``name`` of a family."""
    return next(one for one in SIGNAL_ENGINES if (one.name, one.family) == (name, family))
