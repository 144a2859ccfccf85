"""The right button on the timeline."""

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, QPointF
from PySide6.QtWidgets import QApplication, QInputDialog, QMenu

from tests.gui.timeline.lanes_bench import LanesBench


@pytest.fixture
def lanes(qtbot):
    return LanesBench(qtbot)


@pytest.fixture
def menu_at(lanes):
    """Open the menu of a place; its lines by their words."""

    def close():
        for menu in lanes.panel.findChildren(QMenu, "lanes_menu"):
            menu.close()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def open_menu(place):
        close()
        lanes.lanes.menu.open(QPoint(0, 0), place)
        (menu,) = lanes.panel.findChildren(QMenu, "lanes_menu")
        return {action.text().split("\t")[0]: action for action in menu.actions() if action.text()}

    yield open_menu
    close()


def test_on_a_clip_it_is_about_that_clip(lanes, menu_at):
    lines = menu_at(lanes.box(2).center())
    assert lanes.view.selected_clips == (2,)
    lines["Mute clip"].trigger()
    assert lanes.design.clip(2).muted
    menu_at(lanes.box(2).center())["Remove clip"].trigger()
    assert [clip.id for clip in lanes.design.clips] == [1, 3, 4]


def test_on_one_of_several_it_is_about_all_of_them(lanes, menu_at):
    lanes.drag(lanes.at(0.62), lanes.at(0.25, lane=1))
    menu_at(lanes.box(4).center())["Duplicate 2 clips"].trigger()
    assert len(lanes.design.clips) == 6


def test_clips_are_copied_and_pasted_at_the_playhead(lanes, menu_at):
    menu_at(lanes.box(3).center())["Copy"].trigger()
    lanes.lanes.set_snaps(False)
    lanes.click(lanes.at(0.6))
    menu_at(lanes.at(0.62))["Paste at playhead"].trigger()
    pasted = lanes.design.clip(lanes.view.selected_clips[-1])
    assert pasted.waveform == lanes.design.clip(3).waveform
    assert pasted.onset_s == pytest.approx(lanes.view.playhead_s)
    assert "skinsource clips" in QApplication.clipboard().text()


def test_a_clip_is_added_where_the_pointer_is(lanes, menu_at):
    menu_at(lanes.at(0.62, lane=1))["Add clip here"].trigger()
    assert lanes.design.inputs[1].clips[-1].onset_s == pytest.approx(0.62, abs=1e-3)


def test_markers_are_added_renamed_and_removed_on_the_ruler(lanes, menu_at, monkeypatch):
    place = QPointF(lanes.content.scale.x(0.5), 5)
    menu_at(place)["Add marker here"].trigger()
    assert lanes.design.markers[0].time_s == pytest.approx(0.5)
    monkeypatch.setattr(QInputDialog, "getText", lambda *args, **kwargs: ("touch", True))
    menu_at(place)["Rename marker…"].trigger()
    assert lanes.design.markers[0].name == "touch"
    menu_at(place)["Remove marker"].trigger()
    assert lanes.design.markers == ()


def test_a_loop_goes_round_the_selected_clips_and_its_time_can_be_taken_out(lanes, menu_at):
    lanes.click(lanes.box(2).center())
    place = QPointF(lanes.content.scale.x(0.9), 5)
    menu_at(place)["Loop the selected clips"].trigger()
    assert lanes.design.loop_s == pytest.approx((0.3, 0.5))
    menu_at(place)["Remove the loop's time"].trigger()
    assert lanes.design.clip(3).onset_s == pytest.approx(0.5)
    assert 2 not in [clip.id for clip in lanes.design.clips]
