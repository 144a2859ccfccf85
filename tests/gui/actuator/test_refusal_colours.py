"""What is wrong is red; what is only not known yet is not."""

from skinsource.engine.actuator_demand import ActuatorSettings, Demand
from skinsource_gui.panels.actuator.figures import FiguresView
from skinsource_gui.qt.theme import DARK
from skinsource_gui.state.panel import PREPARING


def test_what_is_only_not_known_yet_is_said_in_quiet_colours(qtbot, use_theme):
    view = FiguresView()
    qtbot.addWidget(view)
    use_theme(DARK)

    def colour(refusal):
        demand = Demand(place=None, refusal=refusal, leaves_velocity=False)
        view.show_demand(demand, ActuatorSettings(), tap=False)
        view.refusal.ensurePolished()
        return view.refusal.palette().windowText().color().name()

    assert colour(PREPARING) == DARK.dim
    assert colour("The limb is not here.") == DARK.error
    assert colour("") == DARK.dim
