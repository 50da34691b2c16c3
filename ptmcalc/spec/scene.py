"""Load cases of a machine: a scene is an event in a load state."""

from typing import Annotated

from pydantic import Field

from ptmcalc.spec.fields import FactorFromOne
from ptmcalc.spec.fragment import Fragment
from ptmcalc.spec.optional import Setting


class Scene(Fragment):
    """Base of every scene. Each kind has its own scene types, distinguished by `type`."""

    type: str
    name: str = Field(default="", pattern=r"^[A-Za-z0-9_.-]*$", max_length=60)
    """name in the report; default: type and load of the scene"""

    @property
    def label(self) -> str:
        """The scene's name, or one made from its type."""
        return self.name or self.default_name()

    def default_name(self) -> str:
        """The name of a scene that was not given one."""
        return self.type


def type_of(scene: type[Scene]) -> str:
    """The `type` of a scene in a file."""
    return str(scene.model_fields["type"].default)


class TransientScene(Scene):
    """A scene that is simulated over a time window."""

    window_factor: Annotated[FactorFromOne, Setting("the report states the window with the loads")] = 1.0
    """length of the simulated time window, relative to the default"""
