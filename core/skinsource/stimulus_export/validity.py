"""What a sidecar says of the conditions of the measurement."""

from skinsource.design import Design
from skinsource.errors import SkinSourceError
from skinsource.quantities import new_graph, sources
from skinsource.view import View


def about_validity(design: Design) -> list[dict[str, str]]:
    """Conditions with their state and a sentence; none where the limb cannot be had here."""
    try:
        found = new_graph().evaluate({"validity"}, sources(design, View()))["validity"]
    except SkinSourceError:
        # A stimulus can be exported without its limb; its sidecar then has nothing to say of it.
        return []
    return [{"condition": one.name, "state": one.state, "sentence": one.sentence} for one in found]
