"""The gallery of scenes, on limbs of a lab as well; what the window shows of one, and then."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtWidgets import QDialogButtonBox, QScrollArea

import skinsource as ss
from benchmarks.gallery import MARK, mark_of, page_of, synthetic_scene
from skinsource.design.panel_settings import settings_of
from skinsource_gui.pages.scenes import picture_of
from skinsource_gui.qt.resources import resource_folder
from skinsource_gui.qt.theme import current_theme
from skinsource_gui.shell.appearance import LARGEST_TEXT
from skinsource_gui.shell.panels import PANELS
from skinsource_gui.shell.workspaces import WORKSPACES
from tests.core.own_limbs.lab_bench import installed


def test_each_picture_is_of_the_scene_as_it_is_now_on_a_synthetic_limb():
    for name in ss.scenes.names():
        picture = QImage(str(resource_folder() / "scenes" / f"{name}.png"))
        assert picture.text(MARK) == mark_of(synthetic_scene(name)), (
            f"picture {name} is out of date; draw all anew with "
            "'python benchmarks/gallery.py resources/scenes docs/scenes.md'"
        )


def test_the_page_of_the_documents_shows_every_scene():
    path = resource_folder().parent / "docs" / "scenes.md"
    assert path.read_text("utf-8") == page_of(ss.scenes.all_scenes(), "../resources/scenes"), (
        "docs/scenes.md is out of date; write it anew with "
        "'python benchmarks/gallery.py resources/scenes docs/scenes.md'"
    )


def test_each_names_a_workspace_and_panels_with_settings_that_there_are():
    panels = {spec.panel.name: spec for spec in PANELS}
    for scene in ss.scenes.all_scenes():
        assert scene.arrangement in {workspace.name for workspace in WORKSPACES}
        assert set(scene.panels) <= panels.keys()
        view = synthetic_scene(scene.name).view
        for panel, held in (panel for panel in view.panels if panel[0] in panels):
            settings = settings_of(view, panel, panels[panel].settings)
            for field, value in held:
                assert getattr(settings, field) == value, (scene.name, panel, field)


def test_the_gallery_lists_all_scenes_and_shows_the_selected_one(window):
    page = window.scenes.show()
    texts = [page.list.item(row).text() for row in range(page.list.count())]
    headings = [scene.heading for scene in ss.scenes.all_scenes()]
    # Panels that are no scenes follow, with the reason.
    missing = [f"{name} · no scene: {reason}" for name, reason in ss.scenes.missing_panels()]
    group = headings.index("I1 · One tip on, the next digit quiet")
    assert texts == [*headings[:group], "Inverse design", *headings[group:], *missing]
    assert not any(page.list.item(row).flags() for row in (group, len(headings) + 1))
    page.list.setCurrentRow(group + 1)
    assert "Source: SkinSource studio, inverse design." in page.text.text()
    page.list.setCurrentRow(headings.index("2F · Two inputs interfere"))
    text = page.text.text()
    assert ss.scenes.scene("2F").sentence in text
    assert "Fig. 2F" in text
    assert page.text.textFormat() == Qt.TextFormat.RichText
    assert "Opens on Synthetic 3 (185 mm)." in text
    assert "SYNTHETIC" in text
    page.list.setCurrentRow(headings.index("2H · A sensation that contracts or expands"))
    assert "Inferred: kind, frequencies" in page.text.text()
    page.reject()


def test_a_scene_is_opened_with_the_keyboard(window, qtbot, settle):
    page = window.scenes.show()
    qtbot.waitUntil(page.list.hasFocus)
    qtbot.keyClick(page.list, Qt.Key.Key_Home)
    for _ in range(6):
        qtbot.keyClick(page.list, Qt.Key.Key_Down)
    assert page.scene.name == "2B"
    qtbot.keyClick(page.list, Qt.Key.Key_Return)
    settle()
    opened = ss.scenes.open_scene("2B")
    assert window.document.design == opened.design
    assert window.document.view == replace(opened.view, slow_motion=0.0)
    assert window.docks["stage"].in_sight
    maps = window.panel("stage").maps
    qtbot.waitUntil(lambda: sum(cell.small is not None for cell in maps.content.cells) == 4)
    called = [cell.heading for cell in maps.content.cells]
    assert called == [f"Snapshot {k} · {hz} Hz" for k, hz in enumerate((50, 100, 200, 400), 1)]


def test_each_opens_with_the_panels_that_show_it_and_nothing_to_complain_of(window, settle):
    messages = []
    window.scenes.done.connect(messages.append)
    for scene in ss.scenes.all_scenes():
        window.scenes.open(scene.name)
        settle()
        assert not window.document.modified
        assert window.document.path is None
        assert window.windowTitle().startswith(scene.full_title), scene.name
        for panel in scene.panels:
            assert window.docks[panel].in_sight, (scene.name, panel)
        stage = window.panel("stage")
        assert scene.sentence in stage.sentence.text()
        assert scene.to_try in stage.sentence.text()
        assert stage.maps.content.cells, scene.name
        assert window.notice.text == "", scene.name
        assert messages[-1].startswith(f"Opened {scene.heading}, on a SYNTHETIC limb")


#: As high as 1920x1080 at scale 2, less the frame of a window.
SCREEN = QSize(780, 490)


def test_it_scrolls_inside_where_the_screen_is_small_and_letters_are_large(window, settle):
    try:
        window.appearance._scale_text(LARGEST_TEXT)
        settle()
        page = window.scenes.show()
        page.resize(SCREEN)
        settle()
        assert page.size() == SCREEN
        for button in page.buttons.buttons():
            place = QRect(button.mapTo(page, button.rect().topLeft()), button.size())
            assert page.rect().contains(place)
        # What is said of a scene is all there, in sight or scrolled to.
        area = page.findChild(QScrollArea, "scene_area")
        assert page.text.height() >= page.text.heightForWidth(page.text.width())
        hidden = area.widget().height() - area.viewport().height()
        assert area.verticalScrollBar().maximum() == max(hidden, 0)
        page.reject()
    finally:
        window.appearance.reset_text()


def test_in_the_dark_pictures_have_the_ground_of_the_theme_and_maps_their_colours(window):
    scene = next(scene for scene in ss.scenes.all_scenes() if scene.name == "1E")
    plain = picture_of(scene).toImage()
    window.appearance.use_theme("dark")
    dark = picture_of(scene).toImage()
    assert dark.pixelColor(0, 0) == QColor(current_theme().base)
    assert plain.pixelColor(0, 0) == QColor("white")
    places = [(x, y) for x in range(0, plain.width(), 7) for y in range(0, plain.height(), 7)]
    coloured = [at for at in places if plain.pixelColor(*at).hsvSaturationF() > 0.5]
    assert len(coloured) > 50
    for at in coloured:
        assert abs(dark.pixelColor(*at).green() - plain.pixelColor(*at).green()) <= 1


OPEN = QDialogButtonBox.StandardButton.Open


@pytest.fixture
def lab_window(user_data, open_window):
    installed()
    return open_window(ss.Design(limb="synthetic-1"))


def selected(page, name):
    page.list.setCurrentRow(ss.scenes.names().index(name))


def test_a_scene_is_opened_on_a_limb_of_ones_own(lab_window, qtbot):
    window, messages = lab_window, []
    window.scenes.done.connect(messages.append)
    page = window.scenes.show()
    assert page.played_on.shown_text == "The limbs of the paper"
    page.played_on.choose("lab-1")
    selected(page, "2F")
    assert "Opens on Lab 1." in page.text.text()
    assert "played at its places 1 in place of 8, 2 in place of 13" in page.text.text()
    page.buttons.button(OPEN).click()
    qtbot.waitUntil(lambda: not window.engine.busy, timeout=30_000)
    window.catch_up()
    opened = ss.scenes.open_scene("2F", limb="lab-1")
    assert window.document.design == opened.design
    assert window.document.view == replace(opened.view, slow_motion=0.0)
    assert not window.document.modified
    assert window.notice.text == ""
    assert messages[-1] == "Opened 2F · Two inputs interfere, on Lab 1"
    again = window.scenes.show()
    assert (again.played_on.value, again.scene.name) == ("lab-1", "2F")
    again.reject()


def test_a_scene_that_does_not_apply_says_why_and_is_not_opened(lab_window):
    before = lab_window.document.design
    page = lab_window.scenes.show()
    page.played_on.choose("lab-1")
    selected(page, "1G")
    assert "Does not apply on Lab 1: It compares 4 people" in page.text.text()
    assert not page.buttons.button(OPEN).isEnabled()
    page.list.itemDoubleClicked.emit(page.list.currentItem())
    assert lab_window.document.design is before
    rows = {name: page.list.item(row) for row, name in enumerate(ss.scenes.names())}
    assert rows["1G"].foreground().color() != rows["1F"].foreground().color()
    assert "It compares 4 people" in rows["1G"].toolTip()
    page.played_on.choose("")
    assert page.buttons.button(OPEN).isEnabled()
    assert "Opens on Synthetic 1" in page.text.text()
    page.reject()
