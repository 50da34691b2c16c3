"""Formulas in LaTeX say what they say in plain text, and every bracket of it closes."""

import re
from collections.abc import Iterator

import pytest

from ptmcalc.cli.explain import displayed
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report.formula import GREEK, base, latex, symbols

WRITTEN = {
    "S_tight <= S_slack exp(mu alpha)": r"S_{\mathrm{tight}} \le S_{\mathrm{slack}} \exp(\mu \alpha )",
    "F = (P + (P^2 + c m v^2)^(1/2))/n": r"F = (P + (P^{2} + c m v^{2})^{1/2})/n",
    "psi = sqrt(a (b + c)) >= 2": r"\psi = \sqrt{a (b + c)} \ge 2",
    "integral of M (w_0 - w) dt": r"\int M (w_{0} - w) \mathrm{d}t",
    "sum C_i d_i -> 0": r"\sum C_{i} d_{i} \to 0",
    "|V/V_nk - 1| >= max(15 %, 2 zeta_k)": r"|V/V_{\mathrm{nk}} - 1| \ge \max(15 \,\% , 2 \zeta_{k} )",
    "m_red x'' = -W": r"m_{\mathrm{red}} x'' = -W",
    "t_s <= 10 s": r"t_{s} \le 10\,\mathrm{s}",
    "v^2/(2 s)": r"v^{2}/(2 s)",
    "gamma >= 120 deg": r"\gamma \ge 120^{\circ}",
    "L_(k+1) = L_k/eta": r"L_{k+1} = L_{k}/\eta",
    "min_k |W/w_k - 1|": r"\min_{k} |W/w_{k} - 1|",
    "q'_max, of a sudden force": r"q'_{\mathrm{max}}, \text{ of a sudden force }",
    "EA* = 1e10": r"\mathit{EA}^{*} = 1 \cdot 10^{10}",
    "A = U +- Q": r"A = U \pm Q",
}


@pytest.mark.parametrize(("plain", "tex"), WRITTEN.items(), ids=list(WRITTEN))
def test_translation(plain: str, tex: str) -> None:
    assert latex(plain) == tex


def test_lines_are_lines() -> None:
    assert latex("a = b\nc = d").splitlines() == ["\\begin{aligned}", "& a = b \\\\", "& c = d", "\\end{aligned}"]


def test_symbols_are_no_words_and_no_functions() -> None:
    found = symbols("S = sum max(S_in, S_out) sin(alpha) of all falls that carry a load, e = EA dx'/dt")
    assert found == ("S", "S_in", "S_out", "alpha", "EA", "dx")


@pytest.mark.parametrize(("symbol", "parts"), [("S_in", ("S", "in")), ("J1", ("J", "1")), ("phi", ("phi", ""))])
def test_an_index_is_told_from_its_letter(symbol: str, parts: tuple[str, str]) -> None:
    assert base(symbol) == parts


def formulas() -> Iterator[tuple[str, str]]:
    for kind in map(load_kind, kind_names()):
        for check in kind.checks:
            yield check.code, check.formula
        for effect in kind.effects:
            yield f"{effect.name} criterion", displayed(effect.criterion.__doc__ or "")
            yield f"{effect.name} bound", displayed(effect.bound.__doc__ or "")
        for solver in kind.solvers:
            yield solver.name, displayed(solver.run.__doc__ or "")


FORMULAS = {name: text for name, text in formulas() if text}
COMMANDS = {"le", "ge", "to", "pm", "mp", "Rightarrow", "quad", "text", "mathrm", "mathit", "sqrt", "circ", "cdot"}
COMMANDS |= {"int", "sum", "operatorname", "varepsilon", "begin", "end", "arctan", "arcsin", "arccos", "exp", "ln"}
COMMANDS |= {"log", "sin", "cos", "tan", "max", "min", "det"} | GREEK


@pytest.mark.parametrize("name", FORMULAS)
def test_every_formula_is_translated(name: str) -> None:
    """Braces pair, commands are known, and every number of the plain text is still there in its order."""
    plain, tex = FORMULAS[name], latex(FORMULAS[name])
    depth = 0
    for mark in re.findall(r"(?<!\\)[{}]", tex):
        depth += 1 if mark == "{" else -1
        assert depth >= 0
    assert depth == 0
    assert set(re.findall(r"\\([A-Za-z]+)", tex)) <= COMMANDS
    numbers = re.compile(r"(?<![A-Za-z0-9_.,'(])[0-9]+(?:\.[0-9]+)?(?![0-9.e])")
    assert len(numbers.findall(plain)) <= len(re.findall(r"[0-9]+(?:\.[0-9]+)?", tex))
    assert "`" not in tex
