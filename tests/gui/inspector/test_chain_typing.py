"""What is being typed in the field of an effect that goes."""

import pytest
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from skinsource.design import edits
from skinsource.design.clips import Clip
from skinsource.design.design import Design, Input
from skinsource.design.effects.level import Fade
from skinsource.design.waveforms.tones import Tone
from tests.gui.inspector.test_effect_chain import ChainBench


@pytest.fixture
def bench(qtbot):
    clip = Clip(id=1, waveform=Tone(), effects=(Fade(0.01, 0.01), Fade(0.02, 0.02)))
    return ChainBench(qtbot, Design(limb="synthetic-1", inputs=(Input(location=7, clips=(clip,)),)))


def test_what_was_typed_for_an_effect_that_is_removed_goes_to_no_other(bench):
    first = bench.chain.rows[0]
    first.set_open(True)
    field = first.cell("in_s").field
    field.setFocus()
    QTest.keyClicks(field, "77")
    bench.show(edits.remove_effect(bench.design, bench.view, 1, 0).design)
    QApplication.processEvents()
    assert bench.effects == (Fade(0.02, 0.02),)
    assert bench.edits == []
