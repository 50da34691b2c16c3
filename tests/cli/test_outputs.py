"""Several reports of one run, each in a file of its own."""

import json
from pathlib import Path
from xml.etree import ElementTree as Xml

from support.command import ptmcalc

from ptmcalc.report import Format

SLIPPING = Path(__file__).parent / "specs" / "slipping.yaml"


def test_every_format_at_once(tmp_path: Path) -> None:
    asked = [word for form in Format for word in ("-o", f"{form.value}={tmp_path / form.value}")]
    done = ptmcalc("check", SLIPPING, "--no-repairs", "--format", "plain", *asked)
    assert (done.status, done.err) == (1, "")
    texts = {form: (tmp_path / form.value).read_text("utf-8") for form in Format}
    assert texts[Format.PLAIN] == done.out
    assert json.loads(texts[Format.JSON])["summary"]["fail"] == 1
    assert json.loads(texts[Format.SARIF])["runs"][0]["properties"]["summary"]["fail"] == 1
    assert Xml.fromstring(texts[Format.JUNIT]).attrib["failures"] == "1"
    assert texts[Format.GITHUB].startswith("::error file=")
    assert texts[Format.MARKDOWN].startswith("## ptmcalc\n")
    assert len(set(texts.values())) == len(Format)


def test_each_is_printed_when_asked_for() -> None:
    for form, start in ((Format.SARIF, "{"), (Format.JUNIT, "<?xml"), (Format.GITHUB, "::"), (Format.MARKDOWN, "##")):
        done = ptmcalc("check", SLIPPING, "--no-repairs", "--format", form.value)
        assert (done.status, done.err) == (1, "")
        assert done.out.startswith(start)
