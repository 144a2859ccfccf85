"""Show a result in a notebook: HTML with what it is, and of levels their map and the strongest."""

import base64
from html import escape
from io import BytesIO

import numpy as np

from skinsource.engine.evaluation import evaluate
from skinsource.export.result import Result
from skinsource.export.tables import picture_of, write_png
from skinsource.limbs.locations import output_name
from skinsource.perception.validity import Judged, in_short
from skinsource.signals.map_range import MAP_RANGE_DB

_HEIGHT_PX, _MOST_ROWS = 420, 5


def html_of(result: Result) -> str:
    """Return HTML that needs no other files and no script; a map takes about 30 kB."""
    size = " x ".join(f"{len(along)} {name}" for name, along in result.axes.items())
    about = f"{size or f'{result.values:g}'} in {result.unit or 'no unit'}"
    head = f"<p><b>{escape(result.label)}</b><br>{escape(about)}</p>"
    of_levels = tuple(result.axes) == ("n_outputs",) and result.unit.startswith("dB")
    if result.is_difference or not of_levels:
        return head
    return head + _map(result) + _strongest(result) + _cautions(result)


def _map(result: Result) -> str:
    surface = evaluate(result.design, "surface")["surface"]
    levels_db = surface.interpolate(result.values)
    top_db = float(np.nanmax(levels_db))
    file = BytesIO()
    write_png(file, picture_of(levels_db, top_db, 1), {})
    picture = base64.b64encode(file.getvalue()).decode()
    colours = f"Map, {top_db - MAP_RANGE_DB:.0f} (dark) to {top_db:.0f} (light) {result.unit}"
    return (
        f'<figure style="margin:0"><img height="{_HEIGHT_PX}" alt="{escape(colours)}" '
        f'src="data:image/png;base64,{picture}"><figcaption>{escape(colours)}</figcaption></figure>'
    )


def _strongest(result: Result) -> str:
    rows = [
        f"<tr><td>{index + 1}</td><td>{escape(output_name(index + 1, result.design.limb).name)}"
        f"</td><td>{result.values[index]:.1f}</td></tr>"
        for index in np.argsort(-result.values, kind="stable")[:_MOST_ROWS].tolist()
    ]
    head = f"<tr><th>Output</th><th>Place</th><th>{escape(result.unit)}</th></tr>"
    return f"<table>{head}{''.join(rows)}</table>"


def _cautions(result: Result) -> str:
    """Return what a map is said with elsewhere, such as outputs that are mostly noise."""
    found = evaluate(result.design, "validity", "limb_data", view=result.view)
    judged = Judged(label="", note=found["limb_data"].note, findings=found["validity"])
    return f"<ul>{''.join(f'<li>{escape(text)}</li>' for text in in_short([judged]))}</ul>"
