"""The part of a recording that is taken is never longer than what is left."""

import numpy as np
import pytest
import soundfile


@pytest.fixture
def form(page_on, qtbot, tmp_path):
    """Fields of a recording of 2 s."""
    soundfile.write(tmp_path / "two.wav", 0.5 * np.sin(np.arange(16_000) * 0.1), 8000)
    page = page_on(tmp_path / "two.wav")
    qtbot.waitUntil(lambda: page.ready, timeout=60_000)
    return page.form


def type_in(field, seconds):
    field.set_value(seconds)
    field.edited.emit(seconds, None)


def test_a_later_start_leaves_what_is_left_and_comes_back(form):
    assert form.choice.duration_s == 2.0
    type_in(form._start, 0.4)
    assert form._duration.value_si == pytest.approx(1.6)
    assert form.choice.start_s == 0.4
    assert form.choice.duration_s == pytest.approx(1.6)
    # A drag that goes on to an earlier start takes as much again.
    type_in(form._start, 0.1)
    assert form.choice.duration_s == pytest.approx(1.9)
    type_in(form._start, 0.0)
    assert form.choice.duration_s == 2.0


def test_a_length_that_was_chosen_stays_where_there_is_room_for_it(form):
    type_in(form._duration, 0.5)
    type_in(form._start, 1.8)
    assert form.choice.duration_s == pytest.approx(0.2)
    type_in(form._start, 1.0)
    assert form.choice.duration_s == 0.5


def test_another_rate_makes_another_length(page_on, qtbot, tmp_path):
    np.save(tmp_path / "plain.npy", np.sin(np.arange(2600) * 0.1))
    page = page_on(tmp_path / "plain.npy")
    qtbot.waitUntil(lambda: page.ready, timeout=60_000)
    form = page.form
    assert form.choice.duration_s == pytest.approx(2.0)
    type_in(form._rate, 2600.0)
    assert form.choice.duration_s == pytest.approx(1.0)
