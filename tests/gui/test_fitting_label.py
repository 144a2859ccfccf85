"""A label that says as much as there is room for."""

from skinsource_gui.qt.labels import FittingLabel


def test_words_that_are_shorter_than_their_room_end_beside_what_follows(qtbot):
    label = FittingLabel()
    qtbot.addWidget(label)
    label.show_phrases(("2 inputs · up to date · a long scene", "2 inputs"))
    label.resize(label.minimumSizeHint().width() + 60, 20)
    label.show()
    assert label.text() == "2 inputs"
    image = label.grab().toImage()
    ground = image.pixel(0, 0)
    inked = [
        x
        for x in range(image.width())
        if any(image.pixel(x, y) != ground for y in range(image.height()))
    ]
    assert inked[0] > 30
    assert inked[-1] > image.width() - 10


def test_a_fitting_label_shows_the_longest_phrasing_that_fits(qtbot):
    label = FittingLabel()
    qtbot.addWidget(label)
    label.show_phrases(("a rather long phrasing of it", "a short one", "short"))
    label.resize(label.sizeHint().width(), 20)
    label.show()
    assert label.text() == "a rather long phrasing of it"
    label.resize(label.sizeHint().width() - 3, 20)
    assert label.text() == "a short one"
    label.resize(label.minimumSizeHint().width(), 20)
    assert label.text() == "short"


def test_words_of_which_no_phrasing_fits_end_in_dots(qtbot):
    label = FittingLabel()
    qtbot.addWidget(label)
    label.show_phrases(("a clip with a very long name, and more", "a clip with a very long name"))
    label.resize(label.minimumSizeHint().width() // 2, 20)
    label.show()
    assert label.text().startswith("a clip")
    assert label.text().endswith("…")
    assert label.fontMetrics().horizontalAdvance(label.text()) <= label.width()
