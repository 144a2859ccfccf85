"""How the report is to be read: how was measured, and what each figure means."""

from textwrap import dedent

from skinsource.decibels import decibels
from skinsource.method_comparison.accuracy import QUIETEST
from skinsource.method_comparison.compared_limb import MADE_UP, ComparedLimb
from skinsource.method_comparison.direct_sums import (
    EXACT_NAME,
    MOST_LOOKED_AT,
    MOST_WINDOWS,
    SAMPLES_PER_WINDOW,
)
from skinsource.method_comparison.measure import Effort
from skinsource.method_comparison.timing import ONCE_FROM_S

_LAST = """\
    Rows in **bold** are those that nothing else beats in both time and worst window.
    Settings that trade error for time (*cut*, *rank*) promise nothing."""


def how_to_read(effort: Effort, limb: ComparedLimb, bound: float | None) -> str:
    """Return it as paragraphs.

    Parameters
    ----------
    effort, limb
        How it was measured, and on what.
    bound
        How far the exact values of a limb may be off, over the channel's peak; None: unknown.
    """
    made_up = limb == MADE_UP
    about = _about_made_up() if made_up else _about_limb(limb, bound)
    parts = [_times(effort, made_up=made_up), *about, _LAST]
    return "\n\n".join(dedent(part) for part in parts)


def _times(effort: Effort, *, made_up: bool) -> str:
    of_some = " those of scenes S5, A and R\n        in one," if made_up else "\n       "
    return f"""\
        Every row was measured in {effort.processes} fresh process(es),{of_some} \
all rows of a round in random order; in each process at most {effort.most_runs} runs
        or {effort.longest_s:g} s, after up to {effort.warm_ups} runs that do not count. What runs
        for {ONCE_FROM_S:g} s or longer is run once.
        *fastest* is the least disturbed figure; the median stands with its median absolute
        deviation; *first* is preparation and first run together. A row is *unstable* where 95 %
        of the runs took up to more than three times the fastest. *memory* is what the process
        held above idle, without drives that the program would have drawn itself."""


def _about_made_up() -> tuple[str, ...]:
    n = MADE_UP.n_channels
    return (
        f"""\
        All rows but *map and 6 traces* give all {n} channels in time. Between two runs the
        drives change, so nothing but the spectra of the responses can be kept. *predict()* is one
        call of the library, which keeps nothing. Responses and drives are made up in whole
        numbers, without the normalisation of inputs.""",
        f"""\
        Errors are against exact values, computed in fractions without rounding, at 8 samples of
        each of up to 24 windows of 100 ms, the largest sample of each window among them, in 12
        channels. *worst window*: largest error in a window over that window's own peak, for
        windows down to {_quietest_db()} dB below the channel's peak. *of the peak*: over the
        channel's peak. *ratio*: error over eps log2(n) sum ||x|| ||h||.""",
        """\
        Scenes A are actuators after a step of the voltage: acceleration, velocity, displacement
        and current, each over its own peak. Scenes R are signals at another sample rate. There
        all samples are compared, with exact values from elsewhere, and there is no *ratio*.""",
    )


def _about_limb(limb: ComparedLimb, bound: float | None) -> tuple[str, ...]:
    outputs = ", ".join(map(str, limb.visible_outputs))
    axes = " and ".join(limb.axes[k] for k in limb.checked_axes)
    # Rounded up: it is a bound.
    off = "" if bound is None else f", off by at most {1.05 * bound:.1e} of the channel's peak"
    n, windows, quietest_db = limb.n_channels, f"{MOST_WINDOWS} windows of 100 ms", _quietest_db()
    return (
        f"""\
        All rows but *map and 6 traces* give all {n} channels in time; that one gives the
        RMS of every output, and traces of the outputs {outputs}.
        Between two runs the drives change, so nothing but the spectra of the responses can be kept.
        *predict()* is one call of the library, which keeps nothing. Responses are those of the
        limb, without the normalisation of inputs; drives are made up in whole numbers.""",
        f"""\
        Errors are against exact values that no engine has computed: each is the sum of products of
        drives and responses itself, in whole numbers and fractions{off}.
        They are in {EXACT_NAME}, at {SAMPLES_PER_WINDOW} samples of each of up to {windows},
        along {axes} of the outputs named above; among them is the largest of up to
        {MOST_LOOKED_AT} samples of each window, evenly spread.

        *worst window*: largest error in a window over that window's own peak, for windows down to
        {quietest_db} dB below the channel's peak. *of the peak*: over the channel's peak.
        *ratio*: error over eps log2(n) sum ||x|| ||h||.""",
        """\
        Left out are scenes that do not depend on the limb, which are measured where none is named:
        actuators (A) and resampling (R). So is the scene of ten minutes (S5), whose time and memory
        are promised in the shape of the published limbs alone.""",
    )


def _quietest_db() -> str:
    return f"{-float(decibels(QUIETEST)):.0f}"
