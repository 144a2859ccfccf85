"""Long work tells how far it is, can be stopped, and ends with a result."""

from functools import partial

import pytest

from skinsource.base.errors import SkinSourceError, Stopped
from skinsource.base.job import Job, Progress, Stop, seconds_left, stop_if, time_left_text


def count(limit: int, *, progress: Progress, stop: Stop) -> int:
    for k in range(limit):
        stop_if(stop, "Counting was stopped.")
        progress(k + 1, limit, "Counting")
    return limit


def test_a_job_tells_how_far_it_is_and_gives_its_result():
    progress: list[tuple[int, int, str]] = []
    job = Job("Count to 3", partial(count, 3))
    assert job.run(lambda *report: progress.append(report)) == 3
    assert progress == [(1, 3, "Counting"), (2, 3, "Counting"), (3, 3, "Counting")]


def test_a_job_that_is_stopped_ends_with_the_one_error_for_that():
    progress: list[int] = []
    job = Job("Count to 9", partial(count, 9))
    with pytest.raises(Stopped, match="Counting was stopped") as caught:
        job.run(lambda done, total, text: progress.append(done), lambda: len(progress) == 2)
    assert progress == [1, 2]
    assert isinstance(caught.value, SkinSourceError)


def test_half_of_the_work_in_ten_seconds_leaves_ten():
    assert seconds_left(5, 10, 10.0) == 10.0
    assert seconds_left(10, 10, 7.0) == 0.0
    assert seconds_left(11, 10, 7.0) == 0.0  # more than was announced


@pytest.mark.parametrize(("done", "total", "elapsed_s"), [(0, 10, 9.0), (5, 0, 9.0), (5, 10, 0.5)])
def test_nothing_is_estimated_from_nothing(done: int, total: int, elapsed_s: float):
    assert seconds_left(done, total, elapsed_s) is None


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (None, ""),
        (0.0, "about 1 s left"),
        (9.2, "about 10 s left"),
        (10.1, "about 15 s left"),
        (55.0, "about 55 s left"),
        (56.0, "about 1 min left"),
        (61.0, "about 2 min left"),
        (3541.0, "about 1 h left"),
        (5401.0, "about 2 h left"),
        (4000.0, "about 1.5 h left"),
    ],
)
def test_time_left_is_said_in_round_numbers(seconds: float | None, text: str):
    assert time_left_text(seconds) == text
