"""A limb that nobody looks at any more does not stay in memory."""

import gc
from weakref import ref

import pytest

from skinsource.design.design import Design, track
from skinsource.design.view import View
from skinsource.engine.quantities import new_graph, sources


@pytest.mark.parametrize("scaling", ["upstream", "relative", "probe"])
def test_a_limb_that_was_left_is_freed(scaling):
    graph = new_graph()
    quantities = {"limb_data", "surface_levels_db", "selected_traces", "selected_spectra"}

    def show(limb):
        design = Design(limb=limb, inputs=(track(7),))
        given = sources(design, View()) | {"scaling": scaling}
        return ref(graph.evaluate(quantities, given)["limb_data"])

    left = show("synthetic-1")
    assert left() is not None
    show("synthetic-2")
    gc.collect()
    assert left() is None
