"""Pages in a browser: nothing overlaps or sticks out, nothing is fetched, the index sorts by the keyboard.

Deselected unless asked for with `-m browser`: it needs Chromium, and screens are not the same everywhere.
"""

import json
import re
import shutil
import subprocess
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT
from support.web_pages import page_of, reported

from ptmcalc.report import html

pytestmark = pytest.mark.browser

SPECS = [
    "specs/plant_conveyor.yaml",
    "specs/chain_drive.yaml",
    "specs/hoist.yaml",
    "specs/shaft.yaml",
    "specs/drivetrain.yaml",
    "specs/crane_slewing.yaml",
    "specs/crane_travelling.yaml",
    "specs/crane_rack_stacker.yaml",
]

MEASURE = """
function boxes(elements) {
  return elements.map(function (one) {
    var range = document.createRange(); range.selectNodeContents(one);
    var box = one.namespaceURI.endsWith("svg") ? one.getBoundingClientRect() : range.getBoundingClientRect();
    var text = one.textContent.trim().slice(0, 40);
    return {left: box.left, right: box.right, top: box.top, bottom: box.bottom, text: text};
  }).filter(function (box) { return box.right > box.left && box.bottom > box.top && box.text; });
}
function met(found) {
  var pairs = [];
  for (var i = 0; i < found.length; i++) for (var j = i + 1; j < found.length; j++) {
    var a = found[i], b = found[j];
    var wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
    var high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    if (wide > 1.5 && high > 3) pairs.push([a.text, b.text, Math.round(wide), Math.round(high)]);
  }
  return pairs;
}
function all(where, what) { return Array.prototype.slice.call(where.querySelectorAll(what)); }
window.addEventListener("load", function () {
  all(document, "details").forEach(function (one) { one.open = true; });
  var fetched = performance.getEntriesByType("resource").map(function (one) { return one.name; });
  var said = {overlaps: [], small: [], outside: [], resources: fetched};
  function tell(found) { met(boxes(found)).forEach(function (pair) { said.overlaps.push(pair); }); }
  function beyond(box, edge) {
    return box.left < edge.left - 1 || box.right > edge.right + 1 || box.top < edge.top - 1 ||
      box.bottom > edge.bottom + 1;
  }
  all(document, "figure svg").forEach(function (svg) {
    var texts = all(svg, "text"), edge = svg.getBoundingClientRect();
    tell(texts);
    boxes(texts).forEach(function (box) { if (beyond(box, edge)) said.outside.push(box.text); });
    texts.forEach(function (text) {
      var size = parseFloat(getComputedStyle(text).fontSize) * edge.width / svg.viewBox.baseVal.width;
      if (size < 8.5) said.small.push([text.textContent, size]);
    });
  });
  all(document, "tr").forEach(function (row) { tell(Array.prototype.slice.call(row.cells)); });
  tell(all(document, "h1, h2, h3, h4, nav li, .tiles li, dt, dd, main > p"));
  all(document, "figure, .wrap, .source, .verdict, .tiles li, h1, h2, h3, p").forEach(function (one) {
    if (one.getBoundingClientRect().right > innerWidth + 1) said.outside.push(one.textContent.trim().slice(0, 40));
  });
  function scrolls(one) { return one.scrollWidth > one.clientWidth + 1; }
  said.scrolled = all(document, ".wrap").filter(scrolls).length;
  said.wide = document.documentElement.scrollWidth - innerWidth;
  said.width = innerWidth;
  var out = document.createElement("pre"); out.id = "measured"; out.textContent = JSON.stringify(said);
  document.body.appendChild(out);
});
"""
SORT = """
window.addEventListener("load", function () {
  var button = document.querySelectorAll("#files thead button")[1], seen = [];
  function files() {
    var links = document.querySelectorAll("#files tbody a");
    return Array.prototype.map.call(links, function (link) { return link.textContent; });
  }
  button.focus();
  seen.push(document.activeElement === button);
  seen.push(files()); button.click(); seen.push(files()); seen.push(button.parentNode.getAttribute("aria-sort"));
  button.click(); seen.push(files()); seen.push(button.parentNode.getAttribute("aria-sort"));
  var out = document.createElement("pre"); out.id = "measured"; out.textContent = JSON.stringify(seen);
  document.body.appendChild(out);
});
"""


def chromium(page: Path, width: int, folder: Path, *more: str) -> str:
    """The document after its scripts have run."""
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    assert program is not None, "no Chromium is installed: apt-get install chromium"
    fixed = ("--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking")
    fixed += ("--disable-component-update", "--disable-sync", "--host-resolver-rules=MAP * ~NOTFOUND")
    own = (f"--user-data-dir={folder / 'profile'}", f"--window-size={width},1600", "--dump-dom", *more)
    done = subprocess.run([program, *fixed, *own, page.as_uri()], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def measured(text: str, script: str, width: int, folder: Path) -> Any:
    """What a script finds that is let into a page; without the page's policy, which would forbid it."""
    page = folder / "measured.html"
    text = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", text)
    framed = folder / "frame.html"
    page.write_text(text.replace("</body>", f"<script>{script}</script></body>"), encoding="utf-8")
    # a window of a browser is never narrower than some 500 pixels: a frame is
    framed.write_text(
        f'<iframe id="f" src="measured.html" style="width:{width}px;height:1600px;border:0"></iframe><script>'
        'addEventListener("message", function (e) { document.body.textContent = e.data; });</script>',
        encoding="utf-8",
    )
    told = 'parent.postMessage("<measured>" + document.getElementById("measured").textContent + "</measured>", "*");'
    page.write_text(
        page.read_text("utf-8").replace("document.body.appendChild(out);", "document.body.appendChild(out);" + told),
        encoding="utf-8",
    )
    dom = chromium(framed, max(width, 600), folder, "--virtual-time-budget=5000")
    found = re.search(r"<measured>(.*)</measured>", unescape(dom), re.DOTALL)
    assert found is not None, dom[-2000:]
    return json.loads(found[1])


@pytest.mark.parametrize("width", [390, 768, 1280])
@pytest.mark.parametrize("path", SPECS)
def test_nothing_overlaps_or_sticks_out(path: str, width: int, tmp_path: Path) -> None:
    found = measured(page_of(path), MEASURE, width, tmp_path)
    assert found["width"] == width
    assert found["wide"] <= 0
    assert found["overlaps"] == []
    assert found["outside"] == []
    assert found["small"] == []
    assert found["resources"] == []


@pytest.mark.parametrize("width", [390, 1280])
def test_the_index_fits_too(width: int, tmp_path: Path) -> None:
    pages = dict(html.site([reported(path) for path in SPECS], lambda report: ""))
    found = measured(pages[html.INDEX], MEASURE, width, tmp_path)
    assert (found["wide"] <= 0, found["overlaps"], found["outside"], found["resources"]) == (True, [], [], [])


def test_on_a_wide_screen_no_column_of_the_index_is_hidden(tmp_path: Path) -> None:
    """Nor where paths and intervals are the longest of all."""
    paths = [*SPECS, "specs/hoist/winding_paper/height_25_rope_17_5.yaml"]
    pages = dict(html.site([reported(path) for path in paths], lambda report: ""))
    assert measured(pages[html.INDEX], MEASURE, 1280, tmp_path)["scrolled"] == 0
    assert measured(pages[html.INDEX], MEASURE, 390, tmp_path)["scrolled"] == 1


def test_the_index_is_sorted_by_a_button_that_has_the_focus(tmp_path: Path) -> None:
    pages = dict(html.site([reported(path) for path in SPECS], lambda report: ""))
    focused, _, up, sorted_up, down, sorted_down = measured(pages[html.INDEX], SORT, 1280, tmp_path)
    assert focused
    assert (sorted_up, sorted_down) == ("ascending", "descending")
    assert sorted(up) == sorted(SPECS)
    assert up == down[::-1]
    assert up == sorted(up, key=lambda one: one.replace("_", " "))


OVERLAPPING = """<!DOCTYPE html><html lang="en"><body><main><h1 style="height:1px;margin:0">One line of words</h1>
<p style="margin:0">Another line</p><p style="width:3000px">too wide</p><figure><svg viewBox="0 0 900 90"
width="300"><text x="5" y="50" font-size="9">small</text></svg></figure><img src="http://nowhere.invalid/x.png" alt="">
</main></body></html>"""


def test_the_measure_sees_what_is_wrong(tmp_path: Path) -> None:
    found = measured(OVERLAPPING, MEASURE, 390, tmp_path)
    assert [pair[:2] for pair in found["overlaps"]] == [["One line of words", "Another line"]]
    assert "too wide" in found["outside"]
    assert [text for text, _ in found["small"]] == ["small"]
    assert found["wide"] > 0
    assert found["resources"] == ["http://nowhere.invalid/x.png"]


def hosts_asked(text: str, folder: Path) -> tuple[str, set[str]]:
    """The document of a page as it is, and whom the browser asked for anything, but its own maker."""
    page, log = folder / "page.html", folder / "net.json"
    page.write_text(text, encoding="utf-8")
    dom = chromium(page, 1280, folder, f"--log-net-log={log}")
    hosts = set(re.findall(r'"url":"(?:https?|wss?)://([^/":]*)', log.read_text("utf-8")))
    return dom, {host for host in hosts if not host.endswith((".google.com", ".googleapis.com"))}


def test_no_request_leaves_a_page(tmp_path: Path) -> None:
    dom, hosts = hosts_asked(page_of(SPECS[0]), tmp_path)
    assert "<footer>ptmcalc" in dom
    assert hosts == set()


def test_no_request_leaves_the_index_whose_own_script_runs(tmp_path: Path) -> None:
    pages = dict(html.site([reported(SPECS[0])], lambda report: (ROOT / report.path).read_text("utf-8")))
    dom, hosts = hosts_asked(pages[html.INDEX], tmp_path)
    assert "<button" in dom
    assert hosts == set()


def test_a_request_would_be_seen(tmp_path: Path) -> None:
    assert hosts_asked(OVERLAPPING, tmp_path)[1] == {"nowhere.invalid"}
