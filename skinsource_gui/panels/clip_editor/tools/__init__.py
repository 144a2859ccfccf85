"""What the pointer does in the editor, one file for each tool."""
