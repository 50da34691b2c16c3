"""What happens to a machine: a scene is an event the machine must survive, in a load state."""

from pydantic import Field

from ptmcalc.spec.fragment import Fragment


class Scene(Fragment):
    """Base of every scene. Each kind has its own scene types, told apart by `type`."""

    type: str
    name: str = Field(default="", pattern=r"^[A-Za-z0-9_.-]*$", max_length=60)
    """name in the report; made from the scene's type and load when it is left out"""

    @property
    def label(self) -> str:
        """The scene's name, or one made from its type."""
        return self.name or self.default_name()

    def default_name(self) -> str:
        """The name of a scene that was not given one."""
        return self.type
