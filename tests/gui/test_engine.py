from threading import Event, Timer

import numpy as np
import pytest

from skinsource.base.errors import Stopped
from skinsource.engine.graph import Graph
from skinsource_gui.state.engine import FIRST_SLOT, Engine, Purpose, Request, Slot


@pytest.fixture
def gate():
    return Event()


@pytest.fixture
def evaluated():
    return []


@pytest.fixture
def engine(qapp, gate, evaluated):
    def answer(x):
        assert gate.wait(5)
        evaluated.append(x)
        return 10 * x

    engine = Engine(lambda: Graph(answer))
    yield engine
    gate.set()
    engine.close()


def request(x, name="answer"):
    return Request(frozenset({name}), {"x": x})


def test_who_waits_is_told_as_soon_as_the_evaluation_has_ended(qtbot, engine, gate, evaluated):
    outcomes = []
    engine.finished.connect(outcomes.append)
    gate.set()
    engine.request(request(1))
    engine.wait(5)
    assert evaluated == [1]
    assert len(outcomes) == 1  # before any scene has itself painted
    assert not engine.busy
    qtbot.wait(0)
    assert len(outcomes) == 1


class Slow:
    """A rule that goes on until it is to stop; if nobody ever says so, for some seconds only."""

    def __init__(self):
        self.started, self.given_up, self.asked = Event(), Event(), []
        self.limit = Timer(5, self.given_up.set)
        self.limit.start()

    def rule(self):
        def slow(x, stop):
            self.started.set()
            while x == 1 and not self.given_up.wait(0.001):
                self.asked.append(stop())
                if self.asked[-1]:
                    raise Stopped
            return x

        return slow


@pytest.fixture
def slow():
    made = Slow()
    yield made
    made.limit.cancel()
    made.limit.join()


@pytest.fixture
def slow_engine(qapp, slow):
    engine = Engine(lambda: Graph(slow.rule()))
    yield engine
    slow.given_up.set()
    engine.close()


def test_a_long_evaluation_is_abandoned_for_a_newer_request(qtbot, slow, slow_engine):
    outcomes = []
    slow_engine.finished.connect(outcomes.append)
    slow_engine.request(request(1, "slow"))
    assert slow.started.wait(5)
    slow_engine.request(request(2, "slow"))
    qtbot.waitUntil(lambda: not slow_engine.busy, timeout=10_000)
    assert [outcome.values for outcome in outcomes] == [{"slow": 2}]
    assert slow.asked[-1]
    assert not slow.asked[0]


SECOND_SLOT, THIRD_SLOT = "B", "C"


def test_each_slot_and_purpose_has_a_place_to_wait_and_showing_goes_first(
    qtbot, engine, gate, evaluated
):
    def ask(x, purpose, slot):
        engine.request(Request(frozenset({"answer"}), {"x": x}, purpose=purpose, slot=slot))

    ask(0, Purpose.SHOW, FIRST_SLOT)
    ask(1, Purpose.EXPORT, FIRST_SLOT)
    ask(2, Purpose.CHECK, FIRST_SLOT)
    ask(3, Purpose.SHOW, FIRST_SLOT)
    ask(4, Purpose.SHOW, SECOND_SLOT)
    ask(5, Purpose.CHECK, THIRD_SLOT)
    ask(6, Purpose.SHOW, FIRST_SLOT)
    gate.set()
    qtbot.waitUntil(lambda: not engine.busy)
    assert evaluated == [0, 6, 4, 5, 1]


@pytest.mark.parametrize(
    ("purpose", "shown", "is_done"),
    [(Purpose.EXPORT, 2, True), (Purpose.CHECK, 2, False), (Purpose.CHECK, 1, True)],
)
def test_what_is_put_off_is_done_afterwards_unless_what_it_would_check_is_shown_no_more(
    qtbot, slow, purpose, shown, is_done
):
    def quick(x):
        return x

    engine, outcomes = Engine(lambda: Graph(slow.rule(), quick)), []
    engine.finished.connect(outcomes.append)
    engine.request(Request(frozenset({"slow"}), {"x": 1}, purpose=purpose))
    assert slow.started.wait(5)
    engine.request(request(shown, "quick"))
    qtbot.waitUntil(lambda: bool(outcomes), timeout=10_000)
    slow.given_up.set()
    qtbot.waitUntil(lambda: not engine.busy, timeout=10_000)
    engine.close()
    done = [Purpose.SHOW, purpose] if is_done else [Purpose.SHOW]
    assert [outcome.request.purpose for outcome in outcomes] == done


@pytest.mark.parametrize("purpose", [Purpose.CHECK, Purpose.JUDGE])
def test_nothing_is_computed_to_check_what_another_edit_has_replaced(
    qtbot, engine, gate, evaluated, purpose
):
    gate.set()
    engine.request(request(1))
    qtbot.waitUntil(lambda: not engine.busy)
    gate.clear()
    engine.request(request(2))
    # Edits had paused; the next one came before this, and is not shown yet.
    engine.request(Request(frozenset({"answer"}), {"x": 1}, purpose=purpose))
    gate.set()
    qtbot.waitUntil(lambda: not engine.busy)
    engine.request(request(2))
    qtbot.waitUntil(lambda: not engine.busy)
    assert evaluated == [1, 2]


def test_arrays_beside_the_design_of_the_window_stay_within_their_budget_and_limbs_stay(qtbot):
    def limb_data():
        return object()

    def numbers(x, limb_data):
        return np.full(2**21, float(x))  # 16 MiB

    engine = Engine(lambda: Graph(limb_data, numbers))
    slots = [FIRST_SLOT, *map(Slot, "BCDEF")]
    for slot in slots:
        engine.request(Request(frozenset({"numbers"}), {"x": 1}, slot=slot))
        qtbot.waitUntil(lambda: not engine.busy)
    held = {slot: graph.held_bytes // 2**20 for slot, graph in engine._graphs.items()}
    assert held == dict(zip(slots, (16, 0, 0, 16, 16, 16), strict=True))
    engine.request(Request(frozenset({"numbers"}), {"x": 2}, slot=slots[1]))
    qtbot.waitUntil(lambda: not engine.busy)
    assert engine._graphs[slots[1]].runs == {"limb_data": 1, "numbers": 2}
    engine.close()


def test_what_lands_after_closing_is_told_to_nobody_and_who_waited_goes_on(qapp, engine, gate):
    outcomes, rests = [], []
    engine.finished.connect(outcomes.append)
    engine.rested.connect(lambda: rests.append(engine.busy))
    engine.request(request(1))
    gate.set()
    engine.close()
    qapp.processEvents()
    assert outcomes == []
    assert rests == [False]
