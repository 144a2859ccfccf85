"""Drives of inverse design where matrices are singular, inputs dead or alike, and drives long."""

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource.inverse.drives_in_time import Cost
from skinsource.inverse.focusing import energy_of, loaded
from skinsource.inverse.responses import gram_of, loading, responses_of
from tests.core.conftest import refused

BETAS = (1e-6, 0.3, 1e6)


@pytest.fixture(scope="module")
def limb():
    return ss.load_limb("synthetic-1")


def drawn(seed, *shape):
    rng = np.random.default_rng(seed)
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


def error(found, exact):
    return np.abs(found - exact).max() / np.abs(exact).max()


#: Rows of a target and of what is quiet: many, one, none that differs from the target, and none.
ROWS = {
    "full": (drawn(1, 1, 6), drawn(2, 1, 30, 6)),
    "rank 1": (drawn(1, 1, 6), drawn(2, 1, 1, 6)),
    "the target's": (drawn(1, 1, 6), drawn(1, 1, 1, 6)),
    "nothing": (drawn(1, 1, 6), np.zeros((1, 1, 6))),
    "one input": (drawn(1, 1, 1), drawn(2, 1, 30, 1)),
}


@pytest.mark.parametrize("kind", ROWS)
@pytest.mark.parametrize("beta", BETAS)
def test_the_response_of_the_target_is_1(noted, kind, beta):
    row, quiet = ROWS[kind]
    drives, _ = loaded(row, gram_of(quiet), beta=beta)
    noted("k target", abs((row * drives).sum() - 1.0))


@pytest.mark.parametrize("beta", BETAS)
def test_drives_solve_their_equations(noted, beta):
    row, quiet = ROWS["full"]
    gram = gram_of(quiet)
    drives, _ = loaded(row, gram, beta=beta)
    x = (gram[0] + beta * loading(gram)[0] * np.eye(6)) @ drives[0]
    noted("k equations", error(x / x[0], row[0].conj() / row[0, 0].conj()))


def test_dead_inputs_are_still_and_the_same_ones_share(noted):
    row, quiet = ROWS["full"]
    for beta in BETAS:
        dead = [np.concatenate([each, 0.0 * each[..., :2]], axis=-1) for each in (row, quiet)]
        drives, _ = loaded(dead[0], gram_of(dead[1]), beta=beta)
        noted("k dead", np.abs(drives[0, 6:]).max() / np.abs(drives).max())
    for beta in (0.01, 0.3):
        twice = [np.concatenate([each, each[..., :2]], axis=-1) for each in (row, quiet)]
        drives, _ = loaded(twice[0], gram_of(twice[1]), beta=beta)
        noted("k same", np.abs(drives[0, :2] - drives[0, 6:]).max() / np.abs(drives).max())


@pytest.mark.parametrize("power", [-400, -100, 100, 400])
def test_sizes_of_responses_do_not_matter(noted, power):
    row, quiet = ROWS["full"]
    drives, _ = loaded(row, gram_of(quiet))
    size = 2.0**power
    scaled, _ = loaded(size * row, gram_of(size * quiet))
    noted("k sizes", error(size * scaled, drives))


@pytest.mark.parametrize("most_db", [0.01, 0.1])
def test_a_bound_of_effort_is_spent(noted, most_db):
    row, quiet = drawn(6, 100, 6), drawn(7, 100, 8, 6)
    drives, _ = loaded(row, gram_of(quiet), effort_db=most_db)
    energies = [np.square(np.abs(each)).sum(axis=1) for each in (drives, row)]
    noted("k effort", np.abs(10 * np.log10(np.prod(energies, axis=0)) - most_db).max())


@pytest.mark.parametrize("axes", ["z", "xyz"])
def test_unseen_contrast_is_that_of_new_designs(noted, limb, axes):
    quiet = [output for output in range(1, 43) if output != 30]
    at_hz = np.arange(50.0, 301.0, 25.0)
    focus = ss.inverse.focus(limb, 30, axes=axes, frequencies_hz=at_hz)
    responses = responses_of(limb, axes=axes, frequencies_hz=at_hz)
    load = (0.3 * loading(focus.gram))[:, None, None] * np.eye(15)
    ratios = []
    for output in quiet:
        gram = gram_of(responses.rows([each for each in quiet if each != output]))
        drives = np.linalg.solve(gram + load, focus.row.conj()[..., None])[..., 0]
        energy = energy_of(responses, drives)
        ratios.append(energy[:, output - 1] / energy[:, 29])
    expected_db = -10 * np.log10(np.mean(ratios, axis=0))
    noted("k unseen", np.abs(expected_db - focus.unseen_contrast_db).max())


@pytest.mark.parametrize("n_inputs", [1, 3])
@pytest.mark.parametrize("load", [1e-3, 1.0])
def test_exact_drives_are_those_of_the_dense_matrix(noted, n_inputs, load):
    rng = np.random.default_rng(5)
    taps = rng.normal(size=(4, n_inputs, 60)) * np.exp(-np.arange(60) / 12.0)
    wanted = rng.normal(size=(4, 139))
    rows = np.moveaxis(scipy.fft.rfft(taps, 139), 2, 0)
    cost = Cost(normal=gram_of(rows) + load * np.eye(n_inputs), n_fft=139, n_times=80)
    b = np.einsum("fri,rf->fi", rows.conj(), scipy.fft.rfft(wanted))
    dense = np.block([[scipy.linalg.convolution_matrix(h, 80) for h in row] for row in taps])
    stacked = np.vstack([dense, np.sqrt(load) * np.eye(80 * n_inputs)])
    exact = np.linalg.lstsq(stacked, np.append(wanted.ravel(), np.zeros(80 * n_inputs)))[0]
    noted("k dense", error(cost.exact(b).ravel(), exact))


def test_ten_seconds_are_as_exact_as_short_ones(noted, limb):
    burst = ss.sinusoid(100.0, 9.8, window_name="tukey")
    found = ss.inverse.reproduce(
        limb, {30: burst}, quiet=[9, 14, 20], inputs=[7, 12, 13], length_s=10.0
    )
    drives = found.waveforms[[6, 11, 12]]
    seen = ss.predict(limb, drives, [7, 12, 13], scaling="relative")[29, 2]
    wanted = np.zeros(seen.size)
    first = round(found.delay_s * 1300.0)
    wanted[first : first + burst.size] = burst
    error_db = 10 * np.log10(np.square(seen - wanted).sum() / np.square(burst).sum())
    noted("k long", abs(error_db - found.nmse_db[30]))


def test_silence_is_exactly_0(noted, limb):
    for exact in (True, False):
        found = ss.inverse.reproduce(limb, {30: np.zeros(65), 9: np.zeros(9)}, exact=exact)
        noted("k silence", np.count_nonzero(found.waveforms))


def test_what_has_no_answer_is_refused(noted, limb, limb_of):
    deaf = limb_of(lambda place: np.zeros((72, 3, 522)), name="of-a-lab", synthetic=True)
    still = refused(lambda: ss.inverse.focus(deaf, 30), "does not respond")
    still += refused(lambda: ss.inverse.reproduce(deaf, {30: np.ones(9)}), "does not respond")
    still += refused(lambda: ss.inverse.place(deaf, [30], 2), "does not respond")
    nothing = np.zeros((1, 2)), np.eye(2)[None]
    still += refused(lambda: loaded(*nothing), "does not respond")
    still += refused(lambda: ss.inverse.focus(limb, 30, quiet=[30]), "strong and quiet")
    still += refused(lambda: ss.inverse.reproduce(limb, {30: [np.inf]}), "wanted", "finite")
    noted("k refused", still)
