import pytest

from skinsource.lab.playing.session import SilentRun


class Clock:
    now_s = 50.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def clock():
    return Clock()


def test_it_runs_as_fast_as_the_clock_and_is_over_at_the_end(clock):
    run = SilentRun(2.0, None, 0.5, clock)
    clock.now_s += 1.0
    assert (run.position_s(), run.over) == (1.5, False)
    clock.now_s += 0.5
    assert run.over


def test_a_loop_is_never_over(clock):
    run = SilentRun(2.0, (0.5, 1.0), 0.75, clock)
    clock.now_s += 1.0
    assert run.position_s() == pytest.approx(0.75)
    clock.now_s += 100.1
    assert run.position_s() == pytest.approx(0.85)
    assert not run.over


def test_behind_the_loop_it_runs_to_the_end(clock):
    run = SilentRun(2.0, (0.5, 1.0), 1.25, clock)
    clock.now_s += 0.5
    assert (run.position_s(), run.over) == (1.75, False)
    clock.now_s += 0.5
    assert run.over


def test_a_change_goes_on_where_it_is_or_enters_the_new_loop(clock):
    run = SilentRun(2.0, None, 0.0, clock)
    clock.now_s += 1.0
    run.change(3.0, (0.5, 2.5))
    assert run.position_s() == 1.0
    run.change(3.0, (0.25, 0.75))
    assert run.position_s() == 0.25
    run.seek(0.5)
    assert run.position_s() == 0.5
