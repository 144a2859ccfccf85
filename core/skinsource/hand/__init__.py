"""The project's own drawing of a right hand and arm, from the proportions of its parts."""
