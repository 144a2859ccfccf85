"""One place of the skin strong, others quiet: drives that do it, and what is to be expected.

At each frequency the drives q minimise the energy at the quiet outputs plus λ times their own, with
the response g q of the target held at 1: q = x / (g x), x = (R + λ)⁻¹ conj(g).  R is the sum of
conj(G) G over the rows G of the quiet outputs, and λ = β tr(R) / n for n inputs.  Much β is strong,
little is sharp.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from skinsource.base.arguments import checking, real_number
from skinsource.base.conventions import Axes, Complexes, Floats, Integers
from skinsource.base.errors import InvalidInputError
from skinsource.inverse.responses import Responses, responses_of
from skinsource.limbs.catalog import limb_of
from skinsource.limbs.limb import Limb, LimbFacts
from skinsource.limbs.scaling import pulse_spectrum

LEAST_BETA, MOST_BETA = 1e-6, 1e9
# Halvings of a range of 15 decades: to 1e-13.
_HALVINGS = 48


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Focus:
    """Drives that make one place strong, at each frequency.

    Drives are in units of the measuring pulse, those of own limbs in the unit of their drive.

    Attributes
    ----------
    limb
        Whose responses were used.
    target
        Output, from 1; 0: several are painted.
    inputs
        Places in use, from 1.
    frequencies_hz : (n_bins,)
        Where it was solved.
    drives : (n_bins, limb.n_inputs)
        With them the target's response is 1; 0 for inputs not in use.
    beta : (n_bins,)
        Regularisation: much is strong, little is sharp.
    row : (n_bins, n_used)
        Responses of the target, along its strongest direction where there are several axes.
    gram : (n_bins, n_used, n_used)
        Sum of conj(G) G over the rows G of what is quiet.
    mean_contrast_db : (n_bins,)
        Energy at the target over the mean of the quiet outputs.
    unseen_contrast_db : (n_bins,)
        The same at quiet outputs that the design never saw, each left out in turn.
    loudest_other_db : (n_bins,)
        Energy at the target over that of the loudest other output.
    loudest_other : (n_bins,)
        That output, from 1.
    """

    limb: LimbFacts
    target: int
    inputs: tuple[int, ...]
    frequencies_hz: Floats
    drives: Complexes
    beta: Floats
    row: Complexes
    gram: Complexes
    mean_contrast_db: Floats
    unseen_contrast_db: Floats
    loudest_other_db: Floats
    loudest_other: Integers

    def __repr__(self) -> str:
        f = self.frequencies_hz
        return f"<Focus on output {self.target} of {self.limb.name}, {f[0]:.4g} to {f[-1]:.4g} Hz>"

    @property
    def used_drives(self) -> Complexes:
        """Drives of the inputs in use, (n_bins, n_used)."""
        return self.drives[:, np.array(self.inputs) - 1]

    @property
    def effort_db(self) -> Floats:
        """Energy of the drives over the least that gives the same at the target, (n_bins,)."""
        return effort_db(self.used_drives, self.row)

    @property
    def contact_db(self) -> Floats:
        """Acceleration at the target over that of the strongest contact, (n_bins,).

        NaN for own limbs, whose drives have no known unit.
        """
        limb = self.limb
        if limb.per_unit_drive:
            return np.full(len(self.drives), np.nan)
        pulse = pulse_spectrum(self.frequencies_hz, limb.sample_rate_hz)
        at_target = np.abs((self.row * self.used_drives).sum(axis=1))
        return power_db(at_target**2, np.square(np.abs(self.drives).max(axis=1) * pulse))


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
    responses = responses_of(limb_of(limb), axes=axes, inputs=inputs, frequencies_hz=frequencies_hz)
    target = responses.check_target(target)
    return _focus(
        responses,
        target,
        quiet_of(responses, (target,), quiet),
        beta=_checked_beta(beta),
        most_effort_db=None if effort_db is None else _checked_effort(effort_db),
    )


def _focus(
    responses: Responses,
    target: int,
    quiet: tuple[int, ...],
    *,
    beta: float,
    most_effort_db: float | None = None,
) -> Focus:
    row, gram = target_row(responses, target), gram_of(responses.rows(quiet))
    drives, betas = loaded(row, gram, beta=beta, effort_db=most_effort_db)
    unseen = _unseen_contrast_db(responses, target, quiet, row, gram, betas)
    return judged(responses, target, quiet, drives, betas, row, gram, unseen)


@checking
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
    row = row / size
    values, vectors = np.linalg.eigh(gram)
    values = np.maximum(values, 0.0)
    within = np.einsum("fji,fj->fi", vectors.conj(), row.conj())
    shares = np.square(np.abs(within))

    def effort(betas: Floats) -> Floats:
        weights = 1.0 / (values + loading(gram, betas)[:, None])
        weights /= weights.max(axis=1, keepdims=True)
        return (shares * weights**2).sum(axis=1) / (shares * weights).sum(axis=1) ** 2

    betas = np.full(len(row), beta)
    if effort_db is not None:
        betas = _least_beta(effort, 10.0 ** (effort_db / 10.0), len(row))
    weights = 1.0 / (values + loading(gram, betas)[:, None])
    x = np.einsum("fij,fj->fi", vectors, within * weights)
    return x / ((row * x).sum(axis=1, keepdims=True) * size), betas


def _least_beta(effort: Callable[[Floats], Floats], most: float, n_bins: int) -> Floats:
    low, high = (np.full(n_bins, np.log(limit)) for limit in (LEAST_BETA, MOST_BETA))
    # Where the least of all is allowed, it stays.
    allowed = effort(np.exp(low)) <= most
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        enough = effort(np.exp(middle)) <= most
        low, high = np.where(enough, low, middle), np.where(enough, middle, high)
    return np.where(allowed, LEAST_BETA, np.exp(high))


def loading(gram: Complexes, beta: Floats) -> Floats:
    """Return λ = β tr(R) / n, (n_bins,); 1 where R is 0."""
    mean = np.trace(gram, axis1=1, axis2=2).real / gram.shape[-1]
    return np.multiply(beta, mean, out=np.ones(len(gram)), where=mean > 0.0)


def gram_of(rows: Complexes) -> Complexes:
    """Return the sum of conj(G) G over rows, (n_bins, n_used, n_used), of (n_bins, n, n_used)."""
    return rows.conj().swapaxes(1, 2) @ rows


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
        There is none, or one of them is to be strong.
    """
    if quiet is None:
        return tuple(output for output in responses.others if output not in strong)
    checked = tuple(dict.fromkeys(responses.check_output(output) for output in quiet))
    if not checked:
        raise InvalidInputError("quiet names no output. Name one, or take time reversal.")
    both = [output for output in checked if output in strong]
    if both:
        raise InvalidInputError(
            f"output {both[0]} is to be strong and quiet. Leave it out of one of them."
        )
    return checked


def judged(
    responses: Responses,
    target: int,
    quiet: tuple[int, ...],
    drives: Complexes,
    beta: Floats,
    row: Complexes,
    gram: Complexes,
    unseen_contrast_db: Floats | None = None,
) -> Focus:
    """Return a `Focus` with these drives of the inputs in use, (n_bins, n_used).

    What it saw of quiet outputs is what it is on others, where it was not made with them.
    """
    energy = energy_of(responses, drives)
    of_target = energy[:, target - 1]
    mean_db = power_db(of_target, energy[:, np.array(quiet) - 1].mean(axis=1))
    others = np.array(sorted({*quiet, *responses.others} - {target}))
    loudest = energy[:, others - 1].argmax(axis=1)
    return Focus(
        limb=responses.limb,
        target=target,
        inputs=responses.inputs,
        frequencies_hz=responses.frequencies_hz,
        drives=on_all_inputs(responses, drives),
        beta=beta,
        row=row,
        gram=gram,
        mean_contrast_db=mean_db,
        unseen_contrast_db=mean_db if unseen_contrast_db is None else unseen_contrast_db,
        loudest_other_db=power_db(of_target, energy[:, others - 1].max(axis=1)),
        loudest_other=others[loudest],
    )


def energy_of(responses: Responses, drives: Complexes) -> Floats:
    """Return the energy at all outputs over their axes, (n_bins, n_outputs)."""
    field = np.einsum("foai,fi->foa", responses.values, drives, optimize=True)
    return np.square(np.abs(field)).sum(axis=2)


def on_all_inputs(responses: Responses, drives: Complexes) -> Complexes:
    """Return the drives of all inputs of the limb, (n_bins, n_inputs)."""
    everywhere = np.zeros((len(drives), responses.limb.n_inputs), complex)
    everywhere[:, np.array(responses.inputs) - 1] = drives
    return everywhere


def _unseen_contrast_db(
    responses: Responses,
    target: int,
    quiet: tuple[int, ...],
    row: Complexes,
    gram: Complexes,
    beta: Floats,
) -> Floats:
    """Return the contrast at quiet outputs, each left out of the design with the same λ."""
    n = gram.shape[-1]
    inverse = np.linalg.inv(gram + loading(gram, beta)[:, None, None] * np.eye(n))
    rows = responses.values[:, np.array(quiet) - 1]
    x = np.einsum("fij,fj->fi", inverse, row.conj())
    passed = rows @ inverse[:, None]
    hidden = passed @ rows.conj().swapaxes(2, 3)
    seen = np.einsum("foai,fi->foa", rows, x)
    unseen = np.linalg.solve(np.eye(hidden.shape[-1]) - hidden, seen[..., None])[..., 0]
    of_target = responses.values[:, target - 1]
    back = np.einsum("fbi,foai->foba", of_target, passed.conj(), optimize=True)
    at_target = np.einsum("fbi,fi->fb", of_target, x)[:, None]
    at_target = at_target + np.einsum("foba,foa->fob", back, unseen)
    ratio = np.square(np.abs(unseen)).sum(axis=2) / np.square(np.abs(at_target)).sum(axis=2)
    return -power_db(ratio.mean(axis=1), np.ones(len(ratio)))


def effort_db(drives: Complexes, row: Complexes) -> Floats:
    """Return the energy of drives over the least that gives 1 at the target, (n_bins,)."""
    energies = (np.square(np.abs(each)).sum(axis=1) for each in (drives, row))
    return power_db(np.prod(list(energies), axis=0), np.ones(len(row)))


def power_db(energy: Floats, reference: Floats) -> Floats:
    """Return 10 log10(energy / reference); infinite where the reference alone is 0."""
    with np.errstate(divide="ignore"):
        return 10.0 * (np.log10(energy) - np.log10(reference))


def _checked_beta(beta: float) -> float:
    return real_number(
        "beta",
        beta,
        f"a number from {LEAST_BETA:g} to {MOST_BETA:g}",
        least=LEAST_BETA,
        most=MOST_BETA,
    )


def _checked_effort(value: float) -> float:
    return real_number("effort_db", value, "a number of 0 dB or more", least=0.0)
