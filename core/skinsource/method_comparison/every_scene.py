"""All that is measured, of every family."""

from skinsource.method_comparison.engines import ENGINES, ComparedEngine
from skinsource.method_comparison.scenes import SCENES, ComparedScene
from skinsource.method_comparison.signal_engines import SIGNAL_ENGINES, SignalEngine
from skinsource.method_comparison.signal_scenes import SIGNAL_SCENES, SignalScene

Scene = ComparedScene | SignalScene
Engine = ComparedEngine | SignalEngine

EVERY_SCENE: tuple[Scene, ...] = (*SCENES, *SIGNAL_SCENES)
EVERY_ENGINE: tuple[Engine, ...] = (*ENGINES, *SIGNAL_ENGINES)


def any_scene(key: str) -> Scene:
    """Return the scene called ``key``, of any family."""
    return next(scene for scene in EVERY_SCENE if scene.key == key)


def is_ours(engine: str) -> bool:
    """Whether the engine of this name is what the program runs."""
    return any(one.is_ours for one in EVERY_ENGINE if one.name == engine)
