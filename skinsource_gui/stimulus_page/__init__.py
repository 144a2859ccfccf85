"""File > Export stimulus…: the page on which a stimulus is looked at before it is written."""
