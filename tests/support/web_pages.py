"""HTML read strictly: every element closed in its turn, and what stands in it."""

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from html.parser import HTMLParser

from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_file, load_text
from ptmcalc.report import html
from ptmcalc.report import json as as_json
from support.command import ROOT

VOID = {"meta", "br", "wbr", "link", "img", "input", "hr", "col"}


@dataclass
class Element:
    """An element with its attributes, its children, and the text right inside it."""

    name: str
    attributes: dict[str, str]
    parent: "Element | None" = None
    children: list["Element"] = field(default_factory=list)
    text: str = ""

    def all(self, *names: str) -> Iterator["Element"]:
        """Every element of these names inside it, any where none is named."""
        for child in self.children:
            if not names or child.name in names:
                yield child
            yield from child.all(*names)

    @property
    def words(self) -> str:
        """All the text inside."""
        return " ".join(filter(None, [self.text.strip(), *(child.words for child in self.children)]))


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.top = self.at = Element("", {})
        self.declared: list[str] = []

    def handle_decl(self, decl: str) -> None:
        self.declared.append(decl)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        names = [name for name, _ in attrs]
        assert len(names) == len(set(names)), f"<{tag}> has an attribute twice: {names}"
        element = Element(tag, {name: value or "" for name, value in attrs}, self.at)
        self.at.children.append(element)
        if tag not in VOID:
            self.at = element

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.handle_endtag(tag)

    def handle_endtag(self, tag: str) -> None:
        assert tag == self.at.name, f"</{tag}> closes <{self.at.name}>"
        assert self.at.parent is not None
        self.at = self.at.parent

    def handle_data(self, data: str) -> None:
        self.at.text += data


def read(text: str) -> Element:
    """The elements of a page.

    Raises:
        AssertionError: it is not well formed.
    """
    reader = _Reader()
    reader.feed(text)
    reader.close()
    assert reader.declared == ["DOCTYPE html"]
    assert reader.at is reader.top, f"<{reader.at.name}> is not closed"
    return reader.top


def without_texts(text: str) -> str:
    """A page without what is only read: what is left may refer to something."""
    return re.sub(r">[^<]*<", "><", text)


@cache
def reported(path: str) -> FileReport:
    """The report of a file of the project with its figures, made once."""
    return check(load_file(ROOT / path, path), Options(figures=True, ledger=True, repairs=False))


@cache
def page_of(path: str) -> str:
    """Its page."""
    return html.page(reported(path), (ROOT / path).read_text("utf-8"), html.INDEX)


def as_document(report: FileReport) -> dict[str, object]:
    """What JSON says of a file."""
    document: dict[str, object] = json.loads(as_json.render([report], width=0, color=False))["files"][0]
    return document


def page_of_text(text: str, **options: bool) -> tuple[FileReport, str]:
    """Report and page of a design file that is only a text."""
    report = check(load_text(text.encode(), "case.yaml"), Options(figures=True, ledger=True, **options))
    return report, html.page(report, text)
