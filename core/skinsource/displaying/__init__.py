"""What a design looks like in a notebook."""

from skinsource.displaying.design_html import html_of

__all__ = ["html_of"]
