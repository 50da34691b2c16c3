"""An XML document held against an XML Schema: as much of it as a schema of elements and string attributes needs.

Elements by reference with how often they may occur, in a sequence or a choice; attributes; text where it is mixed.
Anything else in the schema is refused, so that nothing goes unchecked.
"""

import re
from collections.abc import Iterator
from xml.etree import ElementTree as Xml

XS = "{http://www.w3.org/2001/XMLSchema}"


class Schema:
    """The global elements of a schema."""

    def __init__(self, text: str) -> None:
        self.elements = {one.attrib["name"]: one for one in Xml.fromstring(text).findall(f"{XS}element")}

    def problems(self, node: Xml.Element) -> Iterator[str]:
        """What breaks the schema, in a document that begins with this element."""
        declared = self.elements.get(node.tag)
        if declared is None:
            yield f"<{node.tag}> is no element of the schema"
            return
        kind = declared.find(f"{XS}complexType")
        if kind is None:
            assert declared.attrib["type"] == "xs:string"
            if len(node) or node.attrib:
                yield f"<{node.tag}> is text alone"
            return
        yield from _attributes(kind, node)
        if kind.get("mixed") != "true" and "".join([node.text or "", *(child.tail or "" for child in node)]).strip():
            yield f"<{node.tag}> has text"
        groups = [group for group in kind if group.tag != f"{XS}attribute"]
        pattern = "".join(_pattern(group) for group in groups)
        inside = "".join(f"{child.tag} " for child in node)
        if not re.fullmatch(pattern, inside):
            yield f"<{node.tag}> holds {inside.split()}"
        for child in node:
            yield from self.problems(child)


def _attributes(kind: Xml.Element, node: Xml.Element) -> Iterator[str]:
    known = {one.attrib["name"]: one for one in kind.findall(f"{XS}attribute")}
    assert {one.attrib["type"] for one in known.values()} <= {"xs:string"}
    yield from (f"<{node.tag}> has no attribute `{name}`" for name in node.attrib.keys() - known.keys())
    required = {name for name, one in known.items() if one.get("use") == "required"}
    yield from (f"<{node.tag}> needs the attribute `{name}`" for name in required - node.attrib.keys())


def _pattern(group: Xml.Element) -> str:
    """A regular expression for the names of the children, each with a space behind it."""
    if group.tag == f"{XS}element":
        found = f"(?:{re.escape(group.attrib['ref'])} )"
    else:
        joined = {f"{XS}sequence": "", f"{XS}choice": "|"}[group.tag]
        found = f"(?:{joined.join(map(_pattern, group))})"
    least, most = group.get("minOccurs", "1"), group.get("maxOccurs", "1")
    return f"{found}{{{least},{'' if most == 'unbounded' else most}}}"
