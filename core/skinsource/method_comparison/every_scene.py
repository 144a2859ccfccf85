"""All that is measured, of every family."""

from skinsource.method_comparison.compared_limb import MADE_UP, ComparedLimb
from skinsource.method_comparison.engines import ENGINES, ComparedEngine
from skinsource.method_comparison.scenes import SCENES, ComparedScene, scenes_on
from skinsource.method_comparison.signal_engines import SIGNAL_ENGINES, SignalEngine
from skinsource.method_comparison.signal_scenes import SIGNAL_SCENES, SignalScene

Scene = ComparedScene | SignalScene
Engine = ComparedEngine | SignalEngine

EVERY_SCENE: tuple[Scene, ...] = (*SCENES, *SIGNAL_SCENES)
EVERY_ENGINE: tuple[Engine, ...] = (*ENGINES, *SIGNAL_ENGINES)


def every_scene_on(limb: ComparedLimb) -> tuple[Scene, ...]:
    """Scenes that depend on the limb; on the made-up one the others too, which know no limb."""
    return EVERY_SCENE if limb == MADE_UP else scenes_on(limb)


def any_scene(key: str, limb: ComparedLimb = MADE_UP) -> Scene:
    """Return the scene called ``key``, of any family."""
    return next(scene for scene in every_scene_on(limb) if scene.key == key)


def limb_of(scene: Scene) -> ComparedLimb:
    """The limb of a scene; the made-up one of those that know no limb."""
    return scene.limb if isinstance(scene, ComparedScene) else MADE_UP


def is_ours(engine: str) -> bool:
    """Whether the engine of this name is what the program runs."""
    return any(one.is_ours for one in EVERY_ENGINE if one.name == engine)
