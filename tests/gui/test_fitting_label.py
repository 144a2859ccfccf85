"""A label that says as much as there is room for."""

from skinsource_gui.qt.labels import FittingLabel


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
