"""A formula is followed while it is typed, and what cannot be played keeps the last one."""

import pytest
from PySide6.QtTest import QTest

from skinsource.design.waveforms.samples import Formula
from skinsource_gui.fields.editors import FieldCell
from skinsource_gui.fields.text_field import LiveText
from tests.gui.inspector.bench import Bench, design_of


class FormulaBench(Bench):
    """The panel, and the line of the formula in it."""

    @property
    def line(self):
        return self.panel.findChild(LiveText, "text_field")

    @property
    def note(self):
        cells = self.panel.findChildren(FieldCell)
        return next(cell for cell in cells if cell.name == "text").note

    @property
    def formula(self):
        return self.track.clips[0].waveform.text

    def write(self, text):
        self.line.setFocus()
        self.line.selectAll()
        QTest.keyClicks(self.line, text)


@pytest.fixture
def bench(qtbot):
    return FormulaBench(qtbot, design_of(Formula(text="sin(2*pi*80*t)")))


def test_each_text_that_can_be_read_plays_at_once_in_one_gesture(bench):
    bench.write("2*t")
    assert bench.formula == "2*t"
    assert bench.labels == ["Change formula of input at 7 (II pad)"] * 2
    assert len({gesture for _, _, gesture in bench.edits}) == 1


def test_while_the_text_cannot_be_read_the_last_formula_plays_and_the_reason_is_said(bench):
    bench.write("2*t + si(3)")
    assert bench.formula == "2*t "
    assert bench.line.text() == "2*t + si(3)"
    assert bench.note.startswith('formula "2*t + si(3)", column 7: found si, expected s')
    assert bench.refusals == []
    assert len(bench.line.extraSelections()) == 1


def test_what_is_not_finite_is_refused_and_stays_as_it_is_typed(bench):
    bench.write("1/t")
    assert bench.formula == "1"
    assert bench.line.text() == "1/t"
    assert "column 2: / is infinite at 0 s" in bench.note
    assert len(bench.line.extraSelections()) == 1
    QTest.keyClicks(bench.line, "*0 + 0.5*t")
    assert "column 2: / is infinite at 0 s" in bench.note
    bench.write("3*t")
    assert (bench.formula, bench.note, bench.line.extraSelections()) == ("3*t", "", [])


def test_another_design_replaces_what_was_typed(bench):
    bench.write("2*t + (")
    bench.show(design_of(Formula(text="tanh(t)")))
    assert bench.line.text() == "tanh(t)"
    assert bench.note == ""
