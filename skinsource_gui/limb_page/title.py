"""What the page is called, and the job that it starts."""

TITLE = "Own limbs"
IMPORTING = "Importing a limb"
