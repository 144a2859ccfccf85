from dataclasses import dataclass
from typing import ClassVar

import pytest

from skinsource import fields, waveforms
from skinsource.errors import InvalidInputError
from skinsource.fields import ChoiceSpec, NumberSpec
from tests.gui.inspector.bench import Bench, design_of


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep:
    """A kind of waveform that the panel has never seen, whose numbers depend on each other."""

    title: ClassVar[str] = "Sweep"

    low_hz: float = fields.number(
        50.0, NumberSpec(label="Start", unit="Hz", minimum=1, maximum=600)
    )
    high_hz: float = fields.number(90.0, NumberSpec(label="End", unit="Hz", minimum=1, maximum=600))
    law: str = fields.choice("a", ChoiceSpec(label="Law", options=(("a", "Line"), ("b", "Bow"))))
    duration_s: float = fields.number(
        0.5, NumberSpec(label="Duration", unit="s", minimum=0.1, maximum=9)
    )

    def __post_init__(self):
        if self.low_hz >= self.high_hz:
            raise InvalidInputError("a sweep goes from a lower to a higher frequency")


@pytest.fixture(autouse=True)
def _designs_may_hold_it(monkeypatch):
    monkeypatch.setattr(waveforms, "KINDS", (*waveforms.KINDS, Sweep))


def test_a_new_kind_of_waveform_is_edited_without_a_change_of_the_panel(qtbot):
    bench = Bench(qtbot, design_of(Sweep()))
    bench.type("high_hz", "120")
    bench.choose("law", "Bow")
    assert bench.one.waveform == Sweep(high_hz=120.0, law="b")
    assert bench.labels == [f"Change {one} of input at 7 (II pad)" for one in ("end", "law")]


def test_numbers_that_do_not_go_together_are_refused_with_the_reason(qtbot):
    bench = Bench(qtbot, design_of(Sweep()))
    bench.type("low_hz", "95")
    assert bench.edits == []
    assert bench.number("low_hz").value_si == 50.0
    assert bench.words("low_hz_note").text() == "a sweep goes from a lower to a higher frequency."
