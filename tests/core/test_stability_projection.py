"""Projections against sums and singular vectors; main axes where there is hardly one, or none."""

import json

import numpy as np
import pytest

from skinsource.base.conventions import AXES, axis_numbers
from skinsource.base.errors import InvalidInputError
from skinsource.engine.moments import directions_of, energies, moments_of, without_main_axis
from skinsource.engine.transforms import forward, transform_length
from skinsource.signals.projection import (
    METHODS,
    SMALLEST_GAP,
    main_axis_gap,
    no_main_axis,
    principal_axis,
    principal_axis_of,
    project_axes,
)

SEED = 20240607
TIME_S = np.arange(1300) / 1300


def turned_frame(seed: int) -> np.ndarray:
    """A random rotation."""
    frame, _ = np.linalg.qr(np.random.default_rng((SEED, seed)).standard_normal((3, 3)))
    return frame


def ellipse(excess: float, frame: np.ndarray) -> np.ndarray:
    """Motion on an ellipse with half-axes 1 + excess and 1, (1 output, 3, n_times)."""
    phase = 2 * np.pi * 250 * TIME_S
    return (frame[:, :2] @ np.array([(1 + excess) * np.cos(phase), np.sin(phase)]))[None]


def isotropic_noise() -> np.ndarray:
    """Noise with exactly equal energy along any axis."""
    noise = np.random.default_rng(SEED).standard_normal((3, 1300))
    noise -= noise.mean(axis=1, keepdims=True)
    axes, _, shapes = np.linalg.svd(noise, full_matrices=False)
    return (axes @ shapes)[None]


def covariance(data: np.ndarray) -> np.ndarray:
    centred = data - data.mean(axis=-1, keepdims=True)
    return centred @ centred.transpose(0, 2, 1)


def degrees_between(a: np.ndarray, b: np.ndarray) -> float:
    """Angle between two directions, whatever their signs."""
    return float(np.degrees(np.arcsin(min(1.0, np.linalg.norm(np.cross(a, b))))))


def stored(references) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rows = json.loads((references / "axes.json").read_text(encoding="utf-8"))
    number = np.vectorize(float.fromhex)
    return tuple(number([row[name] for row in rows]) for name in ("covariance", "gap", "axis"))


def test_axes_and_gaps_of_fifty_digits_are_met(references, noted):
    matrices, gaps, axes = stored(references)
    wrong = np.abs(main_axis_gap(matrices) - gaps)
    noted("f gap", wrong[gaps < 0.9].max())
    # Covariances know squares: a second singular value of 1e-8 is lost in them.
    assert wrong.max() < 1e-8
    assert SMALLEST_GAP < np.sort(gaps)[1] < 3 * SMALLEST_GAP
    for axis_found, gap, axis in zip(principal_axis_of(matrices), gaps, axes, strict=True):
        if gap >= SMALLEST_GAP:
            noted("f axis", degrees_between(axis_found, axis))
            assert axis_found @ axis > 0


@pytest.mark.parametrize("gap", [1.0001e-3, 3e-3, 0.03, 0.5])
@pytest.mark.parametrize("seed", range(5))
def test_a_main_axis_above_the_gap_is_repeatable(noted, gap, seed):
    data = ellipse(gap / (1 - gap), turned_frame(seed))
    main_gap = main_axis_gap(covariance(data))[0]
    assert main_gap == pytest.approx(gap, rel=1e-9)
    axis = principal_axis(data)[0]
    random = np.random.default_rng((SEED, seed, 1))
    for _ in range(20):
        noise = random.standard_normal(data.shape)
        noise *= 1e-6 * np.linalg.norm(data) / np.linalg.norm(noise)
        noted("f repeatable", degrees_between(axis, principal_axis(data + noise)[0]))
    left, sizes, right = np.linalg.svd(data[0], full_matrices=False)
    worst = np.outer(left[:, 0], right[1]) + np.outer(left[:, 1], right[0])
    noisy = data + 1e-6 * sizes[0] * worst
    noted("f repeatable", degrees_between(axis, principal_axis(noisy)[0]))


@pytest.mark.parametrize("noise", [0.0, 1e-16, 1e-14])
def test_a_circle_keeps_its_plane_and_its_level_though_not_its_axis(noted, noise):
    for seed in range(5):
        frame = turned_frame(seed)
        data = ellipse(0.0, frame)
        data = data + noise * np.random.default_rng(seed).standard_normal(data.shape)
        axis = principal_axis(data)[0]
        noted("f plane", abs(axis @ np.cross(frame[:, 0], frame[:, 1])))
        energy = np.sum(project_axes(data, "xyz", "pca") ** 2)
        noted("f levels", abs(energy / 650.0 - 1))


def test_what_has_no_main_axis_is_said_to_have_none(noted):
    frame = turned_frame(0)
    silence = np.zeros((1, 3, 1300))
    line = np.sin(2 * np.pi * 100 * TIME_S) * frame[:, :1]
    one_sample = np.array([[[0.3], [-0.2], [0.9]]])
    none = [ellipse(0.0, frame), isotropic_noise(), ellipse(1e-6, frame), silence, one_sample]
    some = [line[None], ellipse(1.102e-3, frame), ellipse(1.0, frame)]
    none.extend(data + 1e-16 * isotropic_noise() for data in none[:4])
    noted("f no axis", sum(not no_main_axis(covariance(data))[0] for data in none))
    noted("f no axis", sum(no_main_axis(covariance(data))[0] for data in some))


@pytest.mark.parametrize("scale", [1e-120, 1e-30, 1.0, 1e30, 1e120])
def test_the_gap_does_not_depend_on_the_size_of_the_motion(noted, scale):
    data = np.concatenate([ellipse(0.5, turned_frame(1)), ellipse(0.002, turned_frame(2))])
    gaps = main_axis_gap(covariance(data * scale))
    np.testing.assert_allclose(gaps, main_axis_gap(covariance(data)), rtol=1e-11)
    noted("f gap", np.abs(gaps - [0.5 / 1.5, 0.002 / 1.002]).max())


def test_signs_are_fixed_by_the_largest_coefficient_and_ties_by_the_first_axis(noted):
    tied = [(1, -1, 0), (-1, 1, 0), (-1, -1, -1), (1, 1, -1), (0, -1, 1), (-1, 0, 1)]
    untied = np.random.default_rng(SEED).standard_normal((50, 3))
    wrong = 0
    for direction in (*tied, *untied):
        for sign in (1.0, -1.0):
            for wobble in (0.0, 1e-15, -1e-15):
                line = sign * (np.add(direction, (wobble, 0.0, -wobble)))
                data = line[:, None] * np.sin(2 * np.pi * 7 * TIME_S)
                axis = principal_axis(data[None])[0]
                size = np.abs(direction)
                wrong += axis[np.argmax(size)] <= 0
    noted("f sign", wrong)


def test_silence_has_the_first_axis(noted):
    data = np.zeros((4, 3, 90))
    data[2] = np.random.default_rng(SEED).standard_normal((3, 90))
    axes = principal_axis(data)[[0, 1, 3]]
    noted("f silence", np.count_nonzero(axes != [1.0, 0.0, 0.0]))
    noted("f silence", np.count_nonzero(project_axes(data, "xyz", "pca")[[0, 1, 3]]))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_no_number_has_no_axis(noted, value):
    data = np.random.default_rng(SEED).standard_normal((4, 3, 90))
    data[2, 1, 33] = value
    with pytest.raises(InvalidInputError) as refused:
        project_axes(data, "xyz", "pca")
    noted("f bad", int("output 3, axis y, sample 33" not in str(refused.value)))


@pytest.mark.parametrize("axes", ["xy", "yz", "xyz"])
def test_moments_of_spectra_know_levels_along_axes_and_where_there_is_none(noted, axes):
    data = np.zeros((72, 3, 1300))
    data[:5] = [
        ellipse(excess, turned_frame(k))[0] for k, excess in enumerate([0, 1e-6, 0.01, 1, 9])
    ]
    data[5] = isotropic_noise()
    data[6:9] = np.random.default_rng(SEED).standard_normal((3, 3, 1300)) + 0.5
    n_fft = transform_length(1300)
    spectra = forward(data, n_fft)
    moments = moments_of(spectra, n_fft, products=True)
    numbers = axis_numbers(axes)
    expected = no_main_axis(covariance(data[:, list(numbers)]))
    np.testing.assert_array_equal(without_main_axis(moments, numbers, "pca", 1300), expected)
    computed = energies(moments, directions_of(moments, numbers, "pca", 1300), numbers)[0][:9]
    known = np.sum(project_axes(data[:9], axes, "pca") ** 2, axis=-1)
    noted("f engine", np.abs(np.sqrt(computed / known) - 1).max())
    assert not without_main_axis(moments, numbers, "rms", 1300).any()
    assert not without_main_axis(moments, (1,), "pca", 1300).any()
    if axes == "xyz":
        np.testing.assert_array_equal(expected[:6], [True, True, False, False, False, True])


SEVERAL = [axes for axes in AXES if len(axes) > 1]


def moving(n_outputs: int, n_times: int, seed: int = SEED) -> np.ndarray:
    """Correlated three-axis noise with an offset, which tells centred from plain data."""
    random = np.random.default_rng(seed)
    mixing = random.standard_normal((n_outputs, 3, 3))
    noise = random.standard_normal((n_outputs, 3, n_times))
    return mixing @ noise + random.standard_normal((n_outputs, 3, 1))


def first_singular_vector(rows: np.ndarray) -> np.ndarray:
    """First principal axis of (n_axes, n_times), largest coefficient positive."""
    centred = rows.T - rows.T.mean(axis=0)
    axis = np.linalg.svd(centred, full_matrices=False)[2][0]
    return axis * np.sign(axis[np.argmax(np.abs(axis))])


def direct(data: np.ndarray, axes: str, method: str) -> np.ndarray:
    result = []
    for output in data:
        rows = output[["xyz".index(axis) for axis in axes]]
        sizes = np.sqrt(np.mean(rows**2, axis=1))
        weights = {
            "soc": np.ones(len(rows)),
            "rms": sizes / np.hypot.reduce(sizes),
            "pca": first_singular_vector(rows),
        }
        result.append(np.hypot.reduce(rows) if method == "mag" else weights[method] @ rows)
    return np.array(result)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("axes", SEVERAL)
@pytest.mark.parametrize(("n_outputs", "n_times"), [(1, 40), (2, 651), (7, 523), (72, 100)])
def test_projections_agree_with_a_direct_computation(axes, method, n_outputs, n_times):
    data = moving(n_outputs, n_times)
    expected = direct(data, axes, method)
    projected = project_axes(data, axes, method)
    assert projected.shape == (n_outputs, n_times)
    limit = 1e-12 * np.abs(expected).max()
    np.testing.assert_allclose(projected, expected, rtol=0, atol=limit, err_msg=f"{SEED=}")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("axis", "xyz")
def test_a_single_axis_is_itself_whatever_the_method(axis, method):
    data = moving(4, 30)
    projected = project_axes(data, axis, method)
    np.testing.assert_array_equal(projected, data[:, "xyz".index(axis)])
    assert not np.shares_memory(projected, data)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("axes", AXES)
def test_a_silent_output_stays_silent_beside_others(axes, method):
    data = moving(3, 100)
    data[1] = 0.0
    projected = project_axes(data, axes, method)
    assert not projected[1].any()
    assert projected[0].any()
    assert projected[2].any()
    assert not project_axes(np.zeros((1, 3, 50)), axes, method).any()


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("exponent", [-900, -500, 500, 900])
def test_doubling_doubles_bit_for_bit_far_beyond_where_squares_exist(method, exponent):
    data = moving(6, 80)
    projected = project_axes(np.ldexp(data, exponent), "xyz", method)
    np.testing.assert_array_equal(projected, np.ldexp(project_axes(data, "xyz", method), exponent))


@pytest.mark.parametrize("shape", [(72, 3), (72, 2, 100), (3,), (1, 72, 3, 5), (72, 100, 3)])
def test_a_wrong_shape_is_refused(shape):
    with pytest.raises(InvalidInputError, match=r"expected \(n_outputs, 3, n_times\)"):
        project_axes(np.zeros(shape))


def test_unknown_axes_and_methods_are_refused_with_the_known_ones():
    with pytest.raises(InvalidInputError, match="choose from x, y, z, xy"):
        project_axes(moving(1, 5), "yx")
    with pytest.raises(InvalidInputError, match="choose from mag, pca, rms, soc"):
        project_axes(moving(1, 5), "xyz", "norm")
