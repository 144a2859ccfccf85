"""Specifications of fields, which drive checks, files and editors; trees as files and text."""
