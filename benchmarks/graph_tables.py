"""Tables of the graph of quantities for documents, made from the rules.

To update those of a document:

    python benchmarks/graph_tables.py docs/internals/rendering.md
"""

import inspect
import re
import sys
from collections.abc import Iterable
from pathlib import Path

from skinsource.engine.graph import Graph
from skinsource.engine.quantities import new_graph

# A table in a document, between two lines of comments.
_MARKED = re.compile(r"(<!-- rules: ([\w ]+) -->\n).*?(<!-- end -->)", re.DOTALL)


def rules_of(graph: Graph, quantities: Iterable[str]) -> tuple[str, ...]:
    """Return the names of all rules that ``quantities`` need, each after those it needs."""
    names: dict[str, None] = {}

    def visit(name: str) -> None:
        if name in graph.rules and name not in names:
            for need in graph.needs_of(name):
                visit(need)
            names[name] = None

    for name in quantities:
        visit(name)
    return tuple(names)


def table(graph: Graph, names: Iterable[str]) -> str:
    """Return a table of rules with what they need, and the first lines of their docstrings."""
    rows = (
        f"| `{name}` | {', '.join(f'`{need}`' for need in graph.needs_of(name))} "
        f"| {_first_line(graph, name)} |"
        for name in names
    )
    return "\n".join(["| quantity | needs | what it is |", "|---|---|---|", *rows])


def updated(document: str) -> str:
    """Return the document with its tables made again.

    A table stands between ``<!-- rules: WORDS -->`` and ``<!-- end -->``.  The words are rules, and
    modules: of a module all rules are shown that no table names and that lead to a painted map,
    traces or spectra.
    """
    graph = new_graph()
    ends = "surface_levels_db", "selected_extremes", "selected_spectra", "trace_error"
    ordered = rules_of(graph, (*ends, "input_waveforms", "response_time_s", "streamed"))

    named = {word for match in _MARKED.finditer(document) for word in match[2].split()}

    def made(match: re.Match[str]) -> str:
        words = match[2].split()
        names = [
            name
            for name in ordered
            if name in words or (name not in named and _module(graph, name) in words)
        ]
        return f"{match[1]}{table(graph, names)}\n{match[3]}"

    return _MARKED.sub(made, document)


def _module(graph: Graph, name: str) -> str:
    return graph.rules[name].__module__.rpartition(".")[2]


def _first_line(graph: Graph, name: str) -> str:
    return (inspect.getdoc(graph.rules[name]) or "").partition("\n")[0]


if __name__ == "__main__":
    for path in map(Path, sys.argv[1:]):
        path.write_text(updated(path.read_text(encoding="utf-8")), encoding="utf-8")
