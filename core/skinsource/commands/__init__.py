"""What is run from a shell: the command ``skinsource``, and the drawing of the graph."""
