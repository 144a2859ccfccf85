"""What is wrong is red; what is only not known yet is not."""

from skinsource.actuator_demand import ActuatorSettings, Demand
from skinsource_gui.panel import PREPARING
from skinsource_gui.panels.actuator.figures_view import FiguresView
from skinsource_gui.theme import DARK


def test_what_is_only_not_known_yet_is_said_in_quiet_colours(qtbot):
    view = FiguresView()
    qtbot.addWidget(view)
    view.show_theme(DARK)

    def colours(refusal):
        found = Demand(place=None, refusal=refusal, leaves_velocity=False)
        view.show_demand(found, ActuatorSettings(), tap=False)
        return view.refusal.styleSheet()

    assert DARK.dim in colours(PREPARING)
    assert DARK.error in colours("The limb is not here.")
    assert DARK.dim in colours("")
