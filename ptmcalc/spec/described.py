"""Models whose keys are described by the texts below their fields.

pydantic would read these texts out of the source of every model whenever its module is imported, for a fifth of the
time of a whole check. Only a JSON Schema shows them, so they are read when one is made.
"""

import ast
import inspect
import itertools
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from types import ModuleType

from pydantic import BaseModel, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from ptmcalc.spec.shape import aliases_of, usual


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
        if aliases := aliases_of(cls):
            _show_aliases(handler.resolve_ref_schema(found), aliases)
        return found


def _show_aliases(schema: JsonSchemaValue, aliases: Mapping[str, str]) -> None:
    """Allow each other name in place of its key, but not both."""
    properties, required = schema["properties"], schema.get("required", [])
    for name, key in aliases.items():
        text = f"other name of `{key}`; " + properties[key].get("description", "")
        title = name.replace("_", " ").title()
        properties[name] = properties[key] | {"title": title, "description": text.removesuffix("; ")}
    for key in dict.fromkeys(aliases.values()):
        names = [key, *(name for name, meant in aliases.items() if meant == key)]
        each = [{"required": [name]} for name in names]
        if key in required:
            required.remove(key)
            schema.setdefault("allOf", []).append({"oneOf": each})
        else:
            pairs = [{"required": list(pair)} for pair in itertools.combinations(names, 2)]
            schema.setdefault("allOf", []).append({"not": {"anyOf": pairs}})


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
