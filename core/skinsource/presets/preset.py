"""What the library holds: a piece of a design under a name."""

from dataclasses import dataclass

from skinsource import fields
from skinsource.clips import Fragment
from skinsource.errors import InvalidInputError
from skinsource.fields import ListSpec, RecipeSpec, TextSpec

MAX_TAGS = 20

NAME = TextSpec(label="Name", longest=100, one_line=True)
TAG = TextSpec(label="Tag", longest=40, one_line=True)
TAGS = ListSpec(label="Tags", of=TAG, most=MAX_TAGS, different=True)
SOURCE = TextSpec(label="Source", longest=1000)
DESCRIPTION = TextSpec(label="Description", longest=5000)
FRAGMENT = RecipeSpec(label="Clips", kinds=lambda: (Fragment,))


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """Clips that are kept under a name.

    Attributes
    ----------
    name
        What it is for; not empty.
    tags
        Words that it is found by.
    source
        Where its numbers come from.
    description
        What it is, in a sentence or two.
    fragment
        The clips, of one track or several.
    """

    name: str = fields.field(NAME)
    tags: tuple[str, ...] = fields.field(TAGS, ())
    source: str = fields.text("", SOURCE)
    description: str = fields.text("", DESCRIPTION)
    fragment: Fragment = fields.field(FRAGMENT)

    def __post_init__(self) -> None:
        fields.check(self)
        if not self.name.strip():
            raise InvalidInputError("Preset.name is empty; give it one that says what it is for")


def tags_of(words: str) -> tuple[str, ...]:
    """Tags as they are typed: between commas, each once, without blanks around them.

    >>> tags_of("tap, texture,, tap ")
    ('tap', 'texture')
    """
    tags = (" ".join(part.split()) for part in words.split(","))
    return tuple(dict.fromkeys(tag for tag in tags if tag))
