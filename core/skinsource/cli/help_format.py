"""How help pages look, and what was given on the command line."""

import argparse
from dataclasses import fields
from textwrap import fill
from typing import Any

#: Where the explanation of a term begins in a list of terms.
EXPLANATION = 13


class HelpFormatter(argparse.HelpFormatter):
    """Wraps each line of a text by itself; indented lines are terms and what they mean."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(
            fill(line, width, subsequent_indent=" " * EXPLANATION if line[:1] == " " else "")
            for line in text.splitlines()
        )


class CommandsFormatter(HelpFormatter):
    """Lists commands in groups: the title of each stands above its first command."""

    titles: dict[str, str]

    def _format_action(self, action: argparse.Action) -> str:
        text = super()._format_action(action)
        title = self.titles.get(action.dest)
        return text if title is None else f"\n  {title}:\n{text}"


def given(arguments: argparse.Namespace, kind: Any) -> dict[str, Any]:
    """Return the flags that are given and called as a field of a class."""
    values = {field.name: getattr(arguments, field.name, None) for field in fields(kind)}
    return {name: value for name, value in values.items() if value is not None}
