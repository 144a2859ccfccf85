"""Specifications of fields, which drive checks, files and editors, and the codec of files."""
