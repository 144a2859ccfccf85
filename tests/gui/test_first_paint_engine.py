import threading

import pytest
from PySide6.QtWidgets import QWidget

from skinsource.engine.graph import Graph
from skinsource_gui.state.engine import FirstPaintEngine, Request


@pytest.fixture
def engine(qtbot):
    window, evaluated = QWidget(), []
    qtbot.addWidget(window)

    def answer(question):
        evaluated.append(question)
        return question

    made = FirstPaintEngine(lambda: Graph(answer), window)
    made.evaluated = evaluated
    yield made
    made.close()


def ask(engine, question):
    engine.request(Request(frozenset({"answer"}), {"question": question}))


def test_nothing_is_evaluated_before_the_window_is_painted(qtbot, engine):
    finished = []
    engine.finished.connect(finished.append)
    ask(engine, 1)
    ask(engine, 2)
    assert engine.busy
    assert not [t for t in threading.enumerate() if t.name.startswith("skinsource-engine")]
    engine.parent().show()
    qtbot.waitUntil(lambda: not engine.busy)
    assert engine.evaluated == [2]
    assert [outcome.values["answer"] for outcome in finished] == [2]
    ask(engine, 3)
    qtbot.waitUntil(lambda: not engine.busy)
    assert engine.evaluated == [2, 3]


def test_a_window_that_closes_unpainted_evaluates_nothing(qtbot, engine):
    ask(engine, 1)
    engine.close()
    assert not engine.busy
    engine.parent().show()
    qtbot.waitExposed(engine.parent())
    ask(engine, 2)
    assert not engine.busy
    assert engine.evaluated == []
