"""Another program, which solves by interior points, finds the same drives."""

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource.inverse.drives_in_time import Cost
from skinsource.inverse.focusing import energy_of, loaded
from skinsource.inverse.responses import gram_of, loading, responses_of

cvxpy = pytest.importorskip("cvxpy", reason="cvxpy is not installed")

PROBLEMS = range(50)


def drawn(rng, *shape):
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


def db(one, other):
    return abs(10 * np.log10(one / other))


@pytest.mark.parametrize("seed", PROBLEMS)
def test_it_finds_the_same_focus(seed):
    rng = np.random.default_rng(seed)
    n_used, n_rows = int(rng.integers(2, 9)), int(rng.integers(1, 20))
    row, rows, beta = drawn(rng, 1, n_used), drawn(rng, 1, n_rows, n_used), 10 ** rng.uniform(-3, 1)
    gram = gram_of(rows)
    load = beta * loading(gram)[0]
    drives = cvxpy.Variable(n_used, complex=True)
    cost = cvxpy.sum_squares(rows[0] @ drives) + load * cvxpy.sum_squares(drives)
    problem = cvxpy.Problem(cvxpy.Minimize(cost), [row[0] @ drives == 1])
    problem.solve(solver=cvxpy.CLARABEL)
    found = loaded(row, gram, beta=beta)[0][0]
    own = np.sum(np.abs(rows[0] @ found) ** 2) + load * np.sum(np.abs(found) ** 2)
    assert db(own, problem.value) < 1e-3


@pytest.mark.parametrize("seed", PROBLEMS)
def test_it_finds_the_same_drives_within_a_peak(seed):
    rng = np.random.default_rng(seed)
    n_used, n_times, n_taps, n_rows = int(rng.integers(1, 4)), 24, 10, int(rng.integers(1, 4))
    taps = rng.normal(size=(n_rows, n_used, n_taps)) * np.exp(-np.arange(n_taps) / 3.0)
    n_fft, load = n_times + n_taps - 1, 0.1 * n_taps
    rows = np.moveaxis(scipy.fft.rfft(taps, n_fft), 2, 0)
    wanted = rng.normal(size=(n_rows, n_fft))
    cost = Cost(normal=gram_of(rows) + load * np.eye(n_used), n_fft=n_fft, n_times=n_times)
    b = np.einsum("fri,rf->fi", rows.conj(), scipy.fft.rfft(wanted))
    free = cost.exact(b)
    peak = rng.uniform(0.2, 0.8) * np.abs(free).max()
    own = cost.within(peak, cost.cut(b), free)
    dense = np.block(
        [[scipy.linalg.convolution_matrix(each, n_times) for each in row] for row in taps]
    )
    drives = cvxpy.Variable(n_used * n_times)
    error = cvxpy.sum_squares(dense @ drives - wanted.ravel())
    objective = error + load * cvxpy.sum_squares(drives)
    problem = cvxpy.Problem(cvxpy.Minimize(objective), [cvxpy.abs(drives) <= peak])
    problem.solve(solver=cvxpy.CLARABEL)
    reached = np.square(dense @ own.ravel() - wanted.ravel()).sum() + load * np.square(own).sum()
    assert np.abs(own).max() <= peak
    assert db(reached, problem.value) < 1e-3


@pytest.mark.parametrize("seed", PROBLEMS)
def test_it_finds_the_same_loudest_quiet_output(limb, seed):
    rng = np.random.default_rng(seed)
    target, at_hz = int(rng.integers(1, 43)), [rng.uniform(50.0, 300.0)]
    inputs = [int(place) for place in rng.choice(np.arange(6, 21), 6, replace=False)]
    quiet = [output for output in range(1, 43) if output != target]
    effort_db = rng.uniform(0.1, 6.0)
    found = ss.inverse.quietest(
        limb, target, inputs=inputs, effort_db=effort_db, frequencies_hz=at_hz
    )
    responses = responses_of(limb, inputs=inputs, frequencies_hz=at_hz)
    loudest = energy_of(responses, found.used_drives)[0, np.array(quiet) - 1].max()
    size = np.linalg.norm(found.row)
    drives, amplitude = cvxpy.Variable(6, complex=True), cvxpy.Variable()
    limits = [
        cvxpy.abs(responses.rows(quiet)[0] / size @ drives) <= amplitude,
        found.row[0] / size @ drives == 1,
        cvxpy.norm(drives) <= 10 ** (effort_db / 20),
    ]
    cvxpy.Problem(cvxpy.Minimize(amplitude), limits).solve(solver=cvxpy.CLARABEL)
    assert found.effort_db[0] <= effort_db + 1e-9
    assert db(loudest, amplitude.value**2) < 0.2
