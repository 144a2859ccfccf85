"""What a sidecar says of the limb, and of the conditions of the measurement."""

from typing import Any

from skinsource.design import Design
from skinsource.errors import SkinSourceError
from skinsource.quantities import new_graph, sources
from skinsource.view import View


def about_validity(design: Design) -> dict[str, Any]:
    """Note on the limb, and conditions with their state and a sentence.

    Nothing and none where the limb cannot be had here: a stimulus can be exported without it.
    """
    try:
        found = new_graph().evaluate({"limb_data", "validity"}, sources(design, View()))
    except SkinSourceError:
        return {"limb_note": None, "validity": []}
    conditions = [
        {"condition": one.name, "state": one.state, "sentence": one.sentence}
        for one in found["validity"]
    ]
    return {"limb_note": found["limb_data"].note or None, "validity": conditions}
