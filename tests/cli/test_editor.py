"""What an editor sees: a validator of JSON Schema takes the templates and marks a wrong key, for each kind and type."""

import json
import re
from functools import cache
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from support.command import ptmcalc

from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.text.document import parse

TYPES: dict[str, tuple[str, AnyKind]] = {
    one.label: (name, one) for name in kind_names() for one in load_kind(name).manifests
}

of_every_type = pytest.mark.parametrize("label", TYPES)


@cache
def validator(kind: str) -> Draft202012Validator:
    """What `# yaml-language-server: $schema=` names, as it is exported."""
    return Draft202012Validator(json.loads(ptmcalc("schema", *filter(None, [kind])).out))


def template(label: str) -> dict[str, Any]:
    data = parse(TYPES[label][1].template.encode(), label).data
    assert isinstance(data, dict)
    return data


@of_every_type
def test_the_template_fits_the_schema(label: str) -> None:
    assert list(validator(TYPES[label][0]).iter_errors(template(label))) == []
    assert validator("").is_valid(template(label))


@of_every_type
def test_a_wrong_key_is_marked_by_a_validator_and_by_the_check(label: str) -> None:
    """At the top and in a block: the schema refuses it, and the check names it."""
    data = template(label)
    block = next(key for key, value in data.items() if isinstance(value, dict) and key not in ("inertias", "links"))
    text = f"{TYPES[label][1].template}descripton: x\n"
    said = [one.message for one in load_text(text.encode(), label).diagnostics if one.code == "SPC104"]
    assert said == ["unknown key `descripton`"]
    for faulty in (data | {"descripton": "x"}, data | {block: {**data[block], "colour": "red"}}):
        assert not validator(TYPES[label][0]).is_valid(faulty)


@of_every_type
def test_a_line_for_the_editor_changes_nothing(label: str) -> None:
    text = TYPES[label][1].template
    line = f"# yaml-language-server: $schema={TYPES[label][0]}.schema.json\n"
    assert parse((line + text).encode(), label).data == parse(text.encode(), label).data


@of_every_type
def test_a_template_explains_its_choices(label: str) -> None:
    """A comment on top says what it is, most blocks say why, and keys that may be left out stand behind a `#`."""
    text = TYPES[label][1].template
    assert text.startswith("# ")
    values = [line for line in text.splitlines() if re.match(r"\s*[\w]+: \S", line) and not line.startswith("#")]
    told = [line for line in values if "#" in line]
    assert len(told) >= 0.25 * len(values), f"{len(told)} of {len(values)} lines say why"
    assert re.search(r"^\s*# [\w]+: ", text, re.MULTILINE), "no optional key is shown"
