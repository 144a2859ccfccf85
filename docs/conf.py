"""How Sphinx makes the site out of these pages; ``make docs`` writes it to ``build/docs``."""

import os
import shutil
import sys
import tempfile
from pathlib import Path

from skinsource.version import __version__

# Examples find the synthetic limbs alone, and leave nothing behind.
os.environ["SKINSOURCE_DATA"] = tempfile.mkdtemp()
HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "build" / "examples"
shutil.copytree(HERE.parent / "examples" / "gallery", EXAMPLES, dirs_exist_ok=True)
sys.path.insert(0, str(HERE))

project, author, language = "SkinSource studio", "the SkinSource studio authors", "en"
copyright = author
version = release = __version__
extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "myst_parser",
    "sphinx_gallery.gen_gallery",
    "site_parts",
]
exclude_patterns = ["gallery/*.ipynb", "gallery/*.py"]
templates_path, html_static_path, html_css_files = ["_templates"], ["_static"], ["site.css"]
# References within the project are checked; no other project's names are looked up anywhere.
nitpicky = True
add_module_names = False

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3

autosummary_generate = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True}
numpydoc_show_class_members = False

sphinx_gallery_conf = {
    "examples_dirs": [str(EXAMPLES)],
    "gallery_dirs": ["gallery"],
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": ["site_parts"],
    "abort_on_example_error": True,
    "download_all_examples": False,
    "remove_config_comments": True,
    "write_computation_times": False,
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 3600,
}

html_math_renderer = "mathml"
html_theme = "pydata_sphinx_theme"
html_title = "SkinSource studio"
html_show_sourcelink = False
html_copy_source = False
# The list of pages, the search and the pages of the library lead to every name.
html_use_index = html_domain_indices = False
html_sidebars = {"**": ["all-pages"]}
html_theme_options = {
    "navbar_center": [],
    "navbar_end": ["theme-switcher"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
    "article_header_start": [],
    "search_bar_text": "Search",
}
