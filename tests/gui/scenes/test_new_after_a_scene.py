"""File > New after a scene: an empty design in the panels as the person had them."""

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QApplication

from skinsource.design.design import Design
from skinsource.design.edits.setup import change_limb
from skinsource.design.panel_settings import with_settings
from skinsource.limbs.catalog import default_limb
from skinsource_gui.pages.files import file_actions
from skinsource_gui.panels.skin.settings import SkinSettings
from skinsource_gui.state.document import NEW_VIEW

#: On limb 4, in the workspace Analyse.
SCENE = "1C"


def in_sight(window):
    QApplication.processEvents()
    QApplication.processEvents()
    return {panel.name for panel in window.panels if panel.isVisible()}


def moved(window):
    """What is in sight where the person has moved something."""
    window.docks["spectra"].hide()
    window.docks["compare"].bring_forward()
    return in_sight(window)


def test_new_is_empty_on_the_limb_and_in_the_view_of_a_start_in_ones_own_panels(window):
    own = moved(window)
    window.scenes.open(SCENE)
    document = window.document
    assert document.design.limb.endswith("-4")
    locked = SkinSettings(map_range_db=(-30.0, 0.0))
    document.look(replace(with_settings(document.view, "skin", locked), delay_removed=False))
    assert in_sight(window) != own
    window.do("new_design")
    assert document.design == Design(limb=default_limb())
    assert document.view == replace(NEW_VIEW, selected_inputs=())
    assert in_sight(window) == own
    # Once it is left there is nothing to go back to.
    window.docks["compare"].bring_forward()
    now = in_sight(window)
    window.do("new_design")
    assert in_sight(window) == now


def test_the_next_session_begins_in_the_panels_before_they_were_presented(
    preferences, make_window, monkeypatch
):
    window = make_window()
    own = moved(window)
    window.do("present")
    # What is new is presented too.
    window.scenes.open(SCENE)
    presented = in_sight(window)
    window.do("new_design")
    assert in_sight(window) == presented
    window.close()
    assert preferences.arrangement == "design"
    monkeypatch.setattr(type(window), "do", lambda *_: None)
    again = make_window()
    assert in_sight(again) == own
    assert not again.isFullScreen()


@pytest.mark.parametrize("missing", [False, True])
def test_new_stays_on_the_limb_that_the_person_chose_unless_it_is_not_here(
    window, monkeypatch, missing
):
    window.document.apply(change_limb(window.document.design, window.document.view, "synthetic-3"))
    if missing:
        monkeypatch.setattr(file_actions, "available_limbs", lambda: ("synthetic-1",))
    window.document.mark_saved(None)
    window.do("new_design")
    assert window.document.design == Design(limb=default_limb() if missing else "synthetic-3")
