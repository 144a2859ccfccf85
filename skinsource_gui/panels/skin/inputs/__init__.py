"""Inputs on the skin map: they act on the other side, and are drawn dashed."""
