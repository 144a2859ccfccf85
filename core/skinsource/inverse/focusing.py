"""One place of the skin strong, others quiet: drives that do it, and what is to be expected.

At each frequency the drives q minimise the energy at the quiet outputs plus λ times their own, with
the response g q of the target held at 1: q = x / (g x), x = (R + λ)⁻¹ conj(g).  R is the sum of
conj(G) G over the rows G of the quiet outputs, and λ = β tr(R) / n for n inputs.  Much β is strong,
little is sharp.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import checking, real_number
from skinsource.base.conventions import Axes, Complexes, Floats
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.designing import Focus
from skinsource.inverse.responses import (
    Responses,
    gram_of,
    inverse_of,
    loading,
    power_db,
    responses_of,
)
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb

LEAST_BETA, MOST_BETA = 1e-6, 1e9
# How often a range of 15 decades is searched, and in how many steps each time: to 1e-12.
_REFINEMENTS, _TRIED = 9, 33
# Of the weights of `quietest`, and of the phases of `paint`.
_REWEIGHTINGS, _ITERATIONS = 50, 60


@checking
def focus(
    limb: Limb | str,
    target: int,
    *,
    axes: Axes = "z",
    quiet: Sequence[int] | None = None,
    inputs: Sequence[int] | None = None,
    effort_db: float | None = None,
    beta: float = 0.3,
    frequencies_hz: ArrayLike | None = None,
) -> Focus:
    """Return the drives that make one output strong and others quiet.

    Parameters
    ----------
    limb
        From `load_limb`, or its name.
    target
        Output, from 1.
    axes
        Along which outputs count: ``"z"``, or ``"xyz"`` for all; the target then moves along the
        direction in which it is strongest.
    quiet
        Outputs; None: all others on the hand (1 to 42), of own limbs all others that are 6 dB above
        their noise.
    inputs
        Places in use; None: the 15 perpendicular ones, of own limbs all.
    effort_db
        Largest energy of the drives over the least that gives the same at the target; ``beta`` is
        then as little as it allows.
    beta
        From 1e-6, sharp, to 1e9, strong.
    frequencies_hz : (n_bins,), optional
        None: 25 to 400 Hz in steps of 1.27 Hz; they can reach up to 600 Hz.

    Raises
    ------
    InvalidInputError
        There is no such place or output, or the target is mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> found = ss.inverse.focus("synthetic-1", 9, frequencies_hz=[100.0, 200.0])
    >>> bool((found.mean_contrast_db > 3.0).all())
    True
    """
    wish = Wish.of(limb, [target], quiet, axes, inputs, frequencies_hz)
    most_db = None if effort_db is None else _checked_effort(effort_db)
    return wish.focused(checked_beta(beta), most_db)


@checking
def quietest(
    limb: Limb | str,
    target: int,
    *,
    axes: Axes = "z",
    quiet: Sequence[int] | None = None,
    inputs: Sequence[int] | None = None,
    effort_db: float = 3.0,
    frequencies_hz: ArrayLike | None = None,
) -> Focus:
    """Return the drives that keep the loudest quiet output as low as the effort allows.

    It is a focus whose quiet outputs are weighted again and again, the louder the more.

    Parameters
    ----------
    limb, target, axes, quiet, inputs, effort_db, frequencies_hz
        As of `focus`.

    Raises
    ------
    InvalidInputError
        There is no such place or output, or the target is mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> even, mean = (
    ...     find("synthetic-1", 9, effort_db=0.2, frequencies_hz=[100.0])
    ...     for find in (ss.inverse.quietest, ss.inverse.focus)
    ... )
    >>> bool(even.loudest_other_db > mean.loudest_other_db)
    True
    """
    wish = Wish.of(limb, [target], quiet, axes, inputs, frequencies_hz)
    most_db = _checked_effort(effort_db)
    lowest, best = np.full(len(wish.row), np.inf), wish.weights
    for _ in range(_REWEIGHTINGS):
        drives, _ = loaded(wish.row, wish.gram, effort_db=most_db)
        energy = energy_of(wish.responses, drives)[:, np.array(wish.quiet) - 1]
        loudest = energy.max(axis=1)
        best = np.where((loudest < lowest)[:, None], wish.weights, best)
        lowest = np.minimum(loudest, lowest)
        weights = wish.weights * np.sqrt(energy / loudest[:, None])
        wish = replace(wish, weights=weights / weights.mean(axis=1, keepdims=True))
    return replace(wish, weights=best).focused(effort_db=most_db)


@checking
def best_single(
    limb: Limb | str,
    target: int,
    *,
    axes: Axes = "z",
    quiet: Sequence[int] | None = None,
    inputs: Sequence[int] | None = None,
    frequencies_hz: ArrayLike | None = None,
) -> Focus:
    """Return the drives of one input alone: that of most contrast with equal drives at all bins.

    Parameters
    ----------
    limb, target, axes, quiet, inputs, frequencies_hz
        As of `focus`.

    Raises
    ------
    InvalidInputError
        There is no such place or output, or the target is mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> ss.inverse.best_single("synthetic-1", 30, frequencies_hz=[100.0]).inputs
    (12,)
    """
    wish = Wish.of(limb, [target], quiet, axes, inputs, frequencies_hz)
    every = wish.responses
    energy = np.square(np.abs(every.values)).sum(axis=(0, 2))
    contrast_db = power_db(energy[wish.strong[0] - 1], energy[np.array(wish.quiet) - 1].sum(axis=0))
    place = every.inputs[int(np.nanargmax(contrast_db))]
    alone = replace(every, inputs=(place,), values=every.values[..., [every.inputs.index(place)]])
    return replace(wish, responses=alone).reversed_in_time()


@checking
def time_reversal(
    limb: Limb | str,
    target: int,
    *,
    axes: Axes = "z",
    quiet: Sequence[int] | None = None,
    inputs: Sequence[int] | None = None,
    frequencies_hz: ArrayLike | None = None,
) -> Focus:
    """Return the drives of least effort; they need only the responses of the target itself.

    Parameters
    ----------
    limb, target, axes, inputs, frequencies_hz
        As of `focus`.
    quiet
        As of `focus`; contrasts are told with them, drives do not know them.

    Raises
    ------
    InvalidInputError
        There is no such place or output, or the target is mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> found = ss.inverse.time_reversal("synthetic-1", 30, frequencies_hz=[100.0])
    >>> print(f"{abs(found.effort_db[0]):.1f} dB")
    0.0 dB
    """
    return Wish.of(limb, [target], quiet, axes, inputs, frequencies_hz).reversed_in_time()


@checking
def paint(
    limb: Limb | str,
    strong: Mapping[int, float],
    quiet: Mapping[int, float],
    *,
    axes: Axes = "z",
    inputs: Sequence[int] | None = None,
    beta: float = 0.1,
    frequencies_hz: ArrayLike | None = None,
) -> Focus:
    """Return the drives that make several outputs equally strong, in whatever phases.

    Parameters
    ----------
    limb, axes, inputs, frequencies_hz
        As of `focus`.
    strong
        Weight of each output that is to be strong; the response of the first one is 1.
    quiet
        Weight of each output that is to be quiet.  Outputs not named may be loud.
    beta
        From 1e-6, sharp, to 1e9, strong.

    Raises
    ------
    InvalidInputError
        There is no such place or output, one is to be strong and quiet, or mostly noise.

    Examples
    --------
    >>> import skinsource as ss
    >>> strong, quiet = {28: 1.0, 29: 1.0}, {19: 1.0, 20: 1.0, 10: 1.0, 11: 1.0}
    >>> painted = ss.inverse.paint("synthetic-1", strong, quiet, frequencies_hz=[100.0])
    >>> bool(painted.spread_db < 1.0)
    True
    """
    wish = Wish.of(limb, list(strong), list(quiet), axes, inputs, frequencies_hz)
    of_strong, of_quiet = (
        np.array([real_number("weight", each, "a number above 0", least=1e-9) for each in weights])
        for weights in (strong.values(), quiet.values())
    )
    # Few strong outputs count as much as many quiet ones.
    roots = np.sqrt(of_strong * of_quiet.sum() / of_strong.sum())
    wish = replace(wish, weights=np.broadcast_to(of_quiet, wish.weights.shape))
    betas = np.full(len(wish.row), checked_beta(beta))
    rows = np.stack([target_row(wish.responses, output) for output in wish.strong], axis=1)
    rows = roots[:, None] * rows
    inverse = wish.inverse(betas, gram_of(rows))
    back = inverse @ rows.conj().swapaxes(1, 2)
    onward = rows @ back
    phases = _phases(np.linalg.eigh(onward).eigenvectors[..., -1])
    for _ in range(_ITERATIONS):
        phases = _phases(np.einsum("fst,t,ft->fs", onward, roots, phases))
    drives = np.einsum("fis,s,fs->fi", back, roots, phases)
    painted = wish.solved(drives, betas, lambda: inverse)
    return replace(painted, gram=painted.gram + gram_of(rows[:, 1:]))


def _phases(values: Complexes) -> Complexes:
    return np.exp(1j * np.angle(values))


@dataclass(frozen=True, kw_only=True, eq=False)
class Wish:
    """What is to be strong and quiet on a limb.

    Attributes
    ----------
    responses
        Of the inputs in use.
    strong, quiet
        Outputs, from 1.
    weights : (n_bins, n_quiet)
        Of the energies of quiet outputs.
    """

    responses: Responses
    strong: tuple[int, ...]
    quiet: tuple[int, ...]
    weights: Floats

    @staticmethod
    def of(
        limb: Limb | str,
        strong: Sequence[int],
        quiet: Sequence[int] | None,
        axes: Axes,
        inputs: Sequence[int] | None,
        frequencies_hz: ArrayLike | None,
    ) -> Wish:
        """Return the wish for these outputs; None: all others on the hand are quiet.

        Raises
        ------
        InvalidInputError
            There is no such output, one is both, a strong one is mostly noise, or one kind lacks.
        """
        responses = responses_of(
            limb_of(limb), axes=axes, inputs=inputs, frequencies_hz=frequencies_hz
        )
        checked = tuple(responses.check_target(output) for output in strong)
        silent = quiet_of(responses, checked, quiet)
        if not checked or not silent:
            kind = "strong" if silent else "quiet"
            raise InvalidInputError(f"No output is to be {kind}. Name one.")
        weights = np.ones((len(responses.values), len(silent)))
        return Wish(responses=responses, strong=checked, quiet=silent, weights=weights)

    @cached_property
    def row(self) -> Complexes:
        """Responses of the first strong output, (n_bins, n_used)."""
        return target_row(self.responses, self.strong[0])

    @cached_property
    def gram(self) -> Complexes:
        """Weighted sum of conj(G) G over the quiet rows, (n_bins, n_used, n_used)."""
        n_axes = self.responses.values.shape[2]
        factors = np.sqrt(np.repeat(self.weights, n_axes, axis=1))
        return gram_of(factors[..., None] * self.responses.rows(self.quiet))

    def inverse(self, beta: Floats, kept: Complexes | float = 0.0) -> Complexes:
        """Return (R + λ)⁻¹, (n_bins, n_used, n_used), with another Gram matrix beside R."""
        load = (beta * loading(self.gram))[:, None, None] * np.eye(self.gram.shape[-1])
        return inverse_of(self.gram + kept + load)

    def focused(self, beta: float = 0.3, effort_db: float | None = None) -> Focus:
        """Return the focus of `loaded`."""
        drives, betas = loaded(self.row, self.gram, beta=beta, effort_db=effort_db)
        return self.solved(drives, betas, lambda: self.inverse(betas))

    def reversed_in_time(self) -> Focus:
        """Return the focus of drives that do not know what is quiet."""
        nothing = np.zeros_like(self.gram)
        drives, _ = loaded(self.row, nothing)
        seen = self.solved(drives, np.full(len(drives), np.inf), lambda: nothing)
        return replace(seen, gram=nothing)

    def solved(self, drives: Complexes, beta: Floats, inverse: Callable[[], Complexes]) -> Focus:
        """Return the focus of drives of the inputs in use, (n_bins, n_used), and their inverse."""
        drives = drives / (self.row * drives).sum(axis=1, keepdims=True)
        energy = energy_of(self.responses, drives)
        strong, quiet = (energy[:, np.array(which) - 1] for which in (self.strong, self.quiet))
        others = np.array(sorted({*self.quiet, *self.responses.others} - {*self.strong}))
        bright, of_others = strong.mean(axis=1), energy[:, others - 1]
        return Focus(
            limb=self.responses.limb,
            target=self.strong[0],
            inputs=self.responses.inputs,
            frequencies_hz=self.responses.frequencies_hz,
            used_drives=drives,
            beta=beta,
            row=self.row,
            gram=self.gram,
            mean_contrast_db=power_db(bright, quiet.mean(axis=1)),
            loudest_other_db=power_db(bright, of_others.max(axis=1)),
            loudest_other=others[of_others.argmax(axis=1)],
            spread_db=power_db(strong.max(axis=1), strong.min(axis=1)),
            unseen=lambda: self.unseen_contrast_db(drives, inverse()),
        )

    def unseen_contrast_db(self, drives: Complexes, inverse: Complexes) -> Floats:
        """Return the contrast at quiet outputs, each left out of the design with the same λ."""
        # Matrices of all rows at a frequency: threads make many small products far longer.
        n_bins, _, n_axes, n_used = self.responses.values.shape
        rows, of_strong = (self.responses.rows(which) for which in (self.quiet, self.strong))
        by_place = (n_bins, len(self.quiet), n_axes)
        passed = (rows @ inverse).reshape(*by_place, n_used)
        seen = np.einsum("fri,fi->fr", rows, drives).reshape(*by_place, 1)
        rows = rows.reshape(*by_place, n_used)
        weights = self.weights[:, :, None, None]
        hidden = weights * np.einsum("foai,fobi->foab", passed, rows.conj())
        unseen = np.linalg.solve(np.eye(n_axes) - hidden, seen)
        back = np.einsum("foai,foac->foi", passed.conj(), weights * unseen)
        at_strong = np.einsum("fri,foi->fro", of_strong, drives[:, None] + back)
        bright = np.square(np.abs(at_strong)).sum(axis=1) / len(self.strong)
        ratio = np.square(np.abs(unseen)).sum(axis=(2, 3)) / bright
        return -power_db(ratio.mean(axis=1))


def loaded(
    row: Complexes, gram: Complexes, *, beta: float = 0.3, effort_db: float | None = None
) -> tuple[Complexes, Floats]:
    """Return the drives with which the target's response is 1, and β: what `focus` solves.

    Row and Gram matrix may come from different people.

    Parameters
    ----------
    row : (n_bins, n_used)
        Responses of the target.
    gram : (n_bins, n_used, n_used)
        Sum of conj(G) G over the rows G of what is quiet; 0: nothing is, and the drives are those
        of time reversal.
    beta, effort_db
        As of `focus`.

    Returns
    -------
    (n_bins, n_used) and (n_bins,).

    Raises
    ------
    InvalidInputError
        The row is 0 at some frequency.

    Examples
    --------
    >>> import numpy as np
    >>> drives, beta = loaded(np.array([[2.0, 0.0]]), np.eye(2)[None], beta=0.1)
    >>> print(drives.real, beta)
    [[0.5 0. ]] [0.1]
    """
    size = np.sqrt(np.square(np.abs(row)).sum(axis=1, keepdims=True))
    if not size.all():
        raise InvalidInputError(
            "the target does not respond at some frequency. Choose other inputs or frequencies."
        )
    # Of a row of length 1, no square leaves the range of floats.
    row, unit, betas = row / size, loading(gram), np.full(len(row), beta)
    if effort_db is not None:
        values, vectors = np.linalg.eigh(gram)
        values = np.maximum(values, 0.0)
        shares = np.square(np.abs(np.einsum("fji,fj->fi", vectors.conj(), row.conj())))
        betas = _least_beta(values / unit[:, None], shares, 10.0 ** (effort_db / 10.0))
    # A tenth of the time that eigenvalues take.
    loaded_gram = gram + (betas * unit)[:, None, None] * np.eye(gram.shape[-1])
    x = np.linalg.solve(loaded_gram, row.conj()[..., None])[..., 0]
    return x / ((row * x).sum(axis=1, keepdims=True) * size), betas


def _least_beta(values: Floats, shares: Floats, most: float) -> Floats:
    """Return the least β whose effort is at most ``most``, (n_bins,).

    Of the matrix in units of λ at β = 1: eigenvalues, and the row's energy along each vector.
    """
    bins = np.arange(len(values))
    lowest, highest = (np.full(len(values), np.log(limit)) for limit in (LEAST_BETA, MOST_BETA))
    for _ in range(_REFINEMENTS):
        tried = np.linspace(lowest, highest, _TRIED, axis=1)
        weights = 1.0 / (values[:, None] + np.exp(tried)[..., None])
        effort = np.vecdot(weights**2, shares[:, None]) / np.vecdot(weights, shares[:, None]) ** 2
        first = (effort <= most).argmax(axis=1)
        lowest, highest = tried[bins, np.maximum(first - 1, 0)], tried[bins, first]
    return np.exp(highest)


def target_row(responses: Responses, target: int) -> Complexes:
    """Return the responses of a target, (n_bins, n_used), along its strongest direction.

    It is the strongest left singular vector of the responses, the last axis, z, real and positive.
    """
    rows = responses.rows([target])
    if rows.shape[1] == 1:
        return rows[:, 0]
    direction = np.linalg.svd(rows, full_matrices=False).U[:, :, 0]
    last = direction[:, -1:]
    turn = np.where(last == 0.0, 1.0, last.conj()) / np.where(last == 0.0, 1.0, np.abs(last))
    return np.einsum("fa,fai->fi", (direction * turn).conj(), rows)


def quiet_of(
    responses: Responses, strong: Sequence[int], quiet: Sequence[int] | None
) -> tuple[int, ...]:
    """Return the outputs that are to be quiet.

    Raises
    ------
    InvalidInputError
        There is no such output, or it is to be strong.
    """
    if quiet is None:
        return tuple(output for output in responses.others if output not in strong)
    checked = tuple(dict.fromkeys(responses.check_output(output) for output in quiet))
    both = [output for output in checked if output in strong]
    if both:
        raise InvalidInputError(
            f"output {both[0]} is to be strong and quiet. Leave it out of one of them."
        )
    return checked


def energy_of(responses: Responses, drives: Complexes) -> Floats:
    """Return the energy at all outputs over their axes, (n_bins, n_outputs)."""
    field = np.einsum("foai,fi->foa", responses.values, drives)
    return np.square(np.abs(field)).sum(axis=2)


def checked_beta(beta: float) -> float:
    """Return β as a number; refuse what is out of its limits."""
    expected = f"a number from {LEAST_BETA:g} to {MOST_BETA:g}"
    return real_number("beta", beta, expected, least=LEAST_BETA, most=MOST_BETA)


def _checked_effort(value: float) -> float:
    return real_number("effort_db", value, "a number of 0 dB or more", least=0.0)
