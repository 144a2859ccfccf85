"""Which conditions of the measurement figures and their tables tell."""

import pytest

import skinsource as ss
from skinsource.studies.figures.writing import about, draw_figure

SPACING = "where waves are too short for the spacing of the outputs"


def said_below(drawn):
    return " ".join(text.get_text() for text in drawn.figure.texts)


@pytest.mark.parametrize(
    ("name", "maps"), [("1C", True), ("2B", True), ("1D", False), ("2D", False), ("5F", False)]
)
def test_what_lies_between_outputs_is_told_below_maps_and_nowhere_else(name, maps):
    opened = ss.scenes.open_scene(name, available=())
    left = [
        finding.name
        for each in opened.conditions
        for finding in ss.evaluate(each.design, "validity", view=opened.view)["validity"]
        if finding.state == "left"
    ]
    assert "spacing" in left
    drawn = draw_figure(opened)
    assert drawn.sheet.maps == maps
    assert ("spacing" in said_below(drawn)) == maps
    assert any(SPACING in line for line in about(opened, maps=drawn.sheet.maps)) == maps
