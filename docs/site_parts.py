"""What the site needs beside its extensions: formulas without a script, pictures of examples."""

import re
from collections.abc import Iterable
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx_gallery.scrapers import figure_rst

DOTS_PER_INCH = 130


def setup(app: Sphinx) -> dict[str, bool]:
    """Register formulas as MathML, which browsers draw themselves, without a network."""
    app.connect("autodoc-process-docstring", _keep_bars)
    app.add_html_math_renderer("mathml", (_draw_inline, None), (_draw_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _keep_bars(*about: Any) -> None:
    """Let |H| in a docstring mean a magnitude, where Sphinx takes it for a name of a text."""
    lines = about[-1]
    lines[:] = [re.sub(r"(?<![\\`])\|(?=\S)", r"\|", line) for line in lines]


def _draw_inline(writer: Any, node: nodes.math) -> None:
    writer.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def _draw_block(writer: Any, node: nodes.math_block) -> None:
    writer.body.append(f'<div class="math">{tex2mathml(node.astext(), as_block=True)}</div>')
    raise nodes.SkipNode


def _get_sg_image_scraper() -> Any:
    """Return what finds the figures that a block of an example made, by its variables."""
    return _figures_of


def _figures_of(_block: tuple, found: dict[str, Any], gallery: dict[str, Any]) -> str:
    paths = []
    for figure in _new(found["example_globals"].values()):
        path = next(found["image_path_iterator"])
        figure.savefig(path, dpi=DOTS_PER_INCH, bbox_inches="tight")
        figure.stands_in_the_gallery = True
        paths.append(path)
    return figure_rst(paths, gallery["src_dir"])


def _new(values: Iterable[Any]) -> list[Any]:
    figures = [value for value in list(values) if hasattr(value, "savefig")]
    return [figure for figure in figures if not hasattr(figure, "stands_in_the_gallery")]
