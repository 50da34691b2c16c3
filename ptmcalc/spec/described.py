"""Models whose keys are described by the texts below their fields.

pydantic would read these texts out of the source of every model whenever its module is imported, for a fifth of the
time of a whole check. Only a JSON Schema shows them, so they are read when one is made.
"""

import ast
import inspect
import itertools
import sys
from collections.abc import Iterator
from functools import cache
from types import ModuleType

from pydantic import BaseModel, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from ptmcalc.spec.shape import usual


class Described(BaseModel):
    """A model whose JSON Schema says of every key what stands below its field."""

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        found = handler(schema)
        properties = handler.resolve_ref_schema(found).get("properties", {})
        for name, field in cls.model_fields.items():
            text, about = _text_of(cls, name), properties.get(field.alias or name)
            if text and about is not None and field.description is None:
                about["description"] = text
            if about is not None and (listed := usual(cls, field.alias or name)):
                _show_usual(about, listed)
        return found


def _show_usual(about: JsonSchemaValue, value: str) -> None:
    """Show a usual value of the key in place of the example of its quantity."""
    for form in (about, *about.get("anyOf", ())):
        if "number" in form.get("type", ()) and not value.endswith("%"):
            form["examples"] = [float(value), f"{100 * float(value):g} %"]
        elif "x-quantity" in form:
            form["examples"] = [value, *form["examples"][1:]]


def _text_of(model: type[BaseModel], name: str) -> str | None:
    """What stands below a field where it is written last: in the model, or in one it is made from."""
    for one in model.__mro__:
        if name in inspect.get_annotations(one):
            return _texts(sys.modules[one.__module__]).get(one.__qualname__, {}).get(name)
    return None


@cache
def _texts(module: ModuleType) -> dict[str, dict[str, str]]:
    """The texts below the fields of all classes of a module."""
    classes = (one for one in ast.parse(inspect.getsource(module)).body if isinstance(one, ast.ClassDef))
    return {one.name: dict(_below_fields(one)) for one in classes}


def _below_fields(model: ast.ClassDef) -> Iterator[tuple[str, str]]:
    for field, below in itertools.pairwise(model.body):
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name) and isinstance(below, ast.Expr):
            text = below.value.value if isinstance(below.value, ast.Constant) else None
            if isinstance(text, str):
                yield field.target.id, inspect.cleandoc(text)
