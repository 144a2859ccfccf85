"""Results: values with axes, units and labels, which draw themselves."""

import base64
import re
import sys
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import skinsource as ss
from skinsource.base.errors import InvalidInputError, MissingExtraError

DESIGN = ss.Design(limb="synthetic-1", inputs=(ss.track(7),))
LOUDER = DESIGN.with_input(0, amplitude=2.0)
VIEW = ss.View(axes="xz", method="mag", outputs=(19, 30))


@pytest.mark.parametrize("quantity", [each.name for each in ss.quantities()])
def test_each_listed_quantity_has_its_axes(quantity):
    value = ss.evaluate(DESIGN, quantity, view=VIEW)[quantity]
    if value is None:  # synthetic limbs have no noise
        with pytest.raises(InvalidInputError, match="is unknown for this design"):
            ss.result(DESIGN, quantity, view=VIEW)
        return
    result = ss.result(DESIGN, quantity, view=VIEW)
    np.testing.assert_array_equal(result.values, value[1] if "n_bins" in result.axes else value)
    assert result.values.shape == tuple(len(along) for along in result.axes.values())
    assert len(result.to_dataframe()) == result.values.size
    assert quantity in repr(result)


def test_a_table_has_a_row_for_each_value():
    result = ss.result(DESIGN, "selected_traces", view=VIEW)
    table = result.to_dataframe()
    assert list(table) == ["output", "time_s", "selected_traces"]
    np.testing.assert_array_equal(table[table.output == 30]["selected_traces"], result.values[1])
    assert list(ss.result(DESIGN, "axis_traces", view=VIEW).axes["n_axes"]) == ["x", "z"]


def test_without_pandas_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(MissingExtraError, match=r"pip install .*\[pandas\]"):
        ss.result(DESIGN).to_dataframe()


def test_maps_and_traces_are_those_of_the_design():
    result = ss.result(DESIGN, view=VIEW)
    ax, bar = result.plot_map().axes
    shown = ss.plot.map(DESIGN, view=VIEW).axes[0].images[0].get_array()
    np.testing.assert_array_equal(ax.images[0].get_array(), shown)
    assert bar.get_ylabel() == result.unit == "dB re 1 m/s²"
    labels = [text.get_text() for text in result.plot_traces().axes[0].get_yticklabels()]
    assert labels == ["Output 19", "Output 30"]
    accelerations = ss.result(DESIGN, "output_rms").plot_map().axes
    assert accelerations[0].images[0].get_clim()[0] == 0.0
    assert accelerations[1].get_ylabel() == "(m/s²)"
    with pytest.raises(InvalidInputError, match="expected a number for each output"):
        ss.result(DESIGN, "surface_levels_db").plot_map()


def test_a_difference_diverges_whatever_its_sign():
    difference = ss.result(LOUDER) - ss.result(DESIGN)
    np.testing.assert_allclose(difference, 20.0 * np.log10(2.0))
    ax, bar = difference.plot_map().axes
    low, high = ax.images[0].get_clim()
    assert low == -high
    assert bar.get_ylabel() == "difference (dB)"
    with pytest.raises(InvalidInputError, match="no output_levels_db of this shape"):
        ss.result(DESIGN) - ss.result(DESIGN, "output_rms")


@pytest.mark.parametrize(
    ("quantity", "told"),
    [
        ("output_levels_db", "Synthetic 1 (175 mm); x, z, magnitude; loudest 100 ms"),
        ("record_rms", "Synthetic 1 (175 mm); x, z, magnitude"),
        ("axis_levels_db", "Synthetic 1 (175 mm); loudest 100 ms"),
        ("sensation_db", "Synthetic 1 (175 mm)"),
        ("axis_traces", "Synthetic 1 (175 mm)"),
    ],
)
def test_a_label_tells_axes_and_time_where_numbers_depend_on_them(quantity, told):
    result = ss.result(DESIGN, quantity, view=replace(VIEW, span="loudest"))
    assert result.label.partition(". ")[2] == told


def test_the_label_of_a_difference_tells_both_people():
    one, other = (ss.result(replace(DESIGN, limb=f"synthetic-{n}")) for n in (1, 2))
    assert (one - other).label == f"Difference of: {one.label}; minus: {other.label}"
    assert (one - one).label == f"Difference of: {one.label}"


def test_what_is_no_listed_quantity_is_refused():
    with pytest.raises(InvalidInputError, match="perhaps 'output_levels_db' is meant"):
        ss.result(DESIGN, "output_level_db")
    with pytest.raises(InvalidInputError, match=r"is not an array; see skinsource\.quantities"):
        ss.result(DESIGN, "limb_map")


def test_a_notebook_shows_levels_as_a_map_and_the_strongest_outputs():
    result = ss.result(LOUDER, view=VIEW)
    html = result._repr_html_()
    (image,) = re.findall(r'src="data:image/png;base64,([^"]+)"', html)
    with Image.open(BytesIO(base64.b64decode(image))) as picture:
        rows, columns = ss.surface_operator("synthetic-1").mask.shape
        assert picture.size == (columns, rows)
    loudest = int(np.argmax(result.values)) + 1
    assert f"<tr><td>{loudest}</td>" in html
    assert len(html.encode()) < 200_000
    assert "<li>Responses are computed from a model, not measured.</li>" in html
    assert "<script" not in html
    # Others say what they are.
    traces = ss.result(LOUDER, "selected_traces", view=VIEW)._repr_html_()
    assert "2 n_selected x " in traces
    assert "<img" not in traces
