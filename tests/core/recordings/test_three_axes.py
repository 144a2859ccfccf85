"""Three axes of one acceleration as one signal."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from skinsource.base.errors import RecordingError
from skinsource.design.recordings import suggested, take
from skinsource.readers.reader import Found, Series, dft321, other_axes

WORDS = "(DFT321, Landin et al. 2010)"


def test_axes_in_step_become_the_length_of_their_vector():
    wave = np.cos(2 * np.pi * 5 * np.arange(200) / 200 + 0.3)
    together = dft321(np.stack([2.0 * wave, 3.0 * wave, 6.0 * wave]))
    np.testing.assert_allclose(together, 7.0 * wave, rtol=0, atol=1e-12)


@given(
    axes=arrays(np.float64, st.tuples(st.just(3), st.integers(1, 40)), elements=st.floats(-9, 9))
)
def test_no_energy_is_lost_and_no_axis_comes_first(axes):
    together = dft321(axes)
    assert np.sum(together**2) == pytest.approx(np.sum(axes**2), rel=1e-9, abs=1e-12)
    reversed_energy = np.sum(dft321(axes[::-1]) ** 2)
    assert reversed_energy == pytest.approx(np.sum(together**2), rel=1e-9, abs=1e-12)


def file_with(*names, n=100, **more):
    series = [
        Series(key=str(k), name=name, n_samples=n, dtype="f8", **more)
        for k, name in enumerate(names)
    ]
    return Found(format="CSV", series=tuple(series))


@pytest.mark.parametrize(
    ("names", "first", "expected"),
    [
        (("acc_x", "acc_y", "acc_z", "gyr_x", "gyr_y", "gyr_z"), 1, "02"),
        (("acc_x", "acc_y", "acc_z", "gyr_x", "gyr_y", "gyr_z"), 3, "45"),
        (("force", "X", "Y", "Z"), 3, "12"),
        (("channel 1", "channel 2", "channel 3"), 0, "12"),
        (("channel 1", "channel 2"), 0, ""),
        (("force", "x", "y", "z"), 0, ""),
        (("x", "x", "y", "z"), 0, ""),
        (("max", "a", "b"), 0, "12"),
    ],
)
def test_axes_that_belong_together_are_found_by_name_or_number(names, first, expected):
    file = file_with(*names)
    others = other_axes(file, file.series[first])
    assert "".join(series.key for series in others) == expected


def test_three_columns_of_a_file_are_taken_as_one(tmp_path, process):
    rng = np.random.default_rng(7)
    axes = rng.normal(size=(3, 400)) + np.array([[0.0], [1.0], [9.81]])
    rows = "\n".join(",".join(f"{x:.17g}" for x in row) for row in axes.T)
    (tmp_path / "a.csv").write_text(f"ax [m/s^2],ay [m/s^2],az [m/s^2]\n{rows}\n")
    file = process.look(tmp_path / "a.csv")
    others = tuple(axis.key for axis in other_axes(file, file.series[0]))
    assert others == ("1", "2")
    choice = replace(suggested(file), rate_hz=1300.0, scale="keep", others=others)
    whole = take(tmp_path / "a.csv", choice, process=process)
    expected = dft321(axes - axes.mean(axis=1, keepdims=True))
    np.testing.assert_allclose(whole.samples.values, expected, rtol=0, atol=1e-12)
    assert whole.name == "a.csv, ax, ay, az"
    assert whole.samples.unit == "m/s²"
    assert any(note.endswith(f"{WORDS}.") for note in whole.notes)
    assert sum("offset" in note for note in whole.notes) == 3
    with pytest.raises(RecordingError, match="no signal 'gone'"):
        take(tmp_path / "a.csv", replace(choice, others=("1", "gone")), process=process)
