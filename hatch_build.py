"""What packages carry as manual: the site where ``make docs`` built it, else the pages."""

from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

#: In the tree, in the source package, and where Help looks in the installed one.
BUILT, INSTALLED = "build/docs", "skinsource/_manual"


class Manual(BuildHookInterface):
    """Adds the manual; Sphinx is never needed for a build."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add what is there to the files of a package."""
        found = build_data["force_include"]
        if Path(self.root, BUILT, "index.html").is_file():
            found[BUILT] = BUILT if self.target_name == "sdist" else INSTALLED
        elif self.target_name == "wheel":
            found |= {name: f"{INSTALLED}/{name}" for name in ("README.md", "docs")}
