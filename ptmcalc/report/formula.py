"""Formulas in the notation of the program, `S_tight <= S_slack exp(mu alpha)`: their symbols, and the same in LaTeX.

The translation is made word by word and preserves the structure: `a/b` remains `a/b`. Words other than symbols are set
as text.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, auto

GREEK = frozenset(
    (
        *("alpha", "beta", "gamma", "delta", "eps", "epsilon", "zeta", "eta", "theta", "kappa", "lambda", "mu", "nu"),
        *("xi", "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega"),
        *("Gamma", "Delta", "Theta", "Lambda", "Pi", "Sigma", "Phi", "Psi", "Omega"),
    )
)
FUNCTIONS = frozenset(
    (
        *("exp", "ln", "log", "sin", "cos", "tan", "atan", "arcsin", "arccos", "arctan"),
        *("sqrt", "max", "min", "det", "sgn", "Im", "Re"),
    )
)
_OPERATORS = {"<=": r"\le ", ">=": r"\ge ", "=>": r"\Rightarrow ", "->": r"\to ", "+-": r"\pm ", "-+": r"\mp "}
_COMMANDS = {"eps": r"\varepsilon", "atan": r"\arctan", "sgn": r"\operatorname{sgn}", "Im": r"\operatorname{Im}"}
_COMMANDS |= {"Re": r"\operatorname{Re}"}
_SHORT_WORDS = frozenset(
    ("of", "on", "or", "to", "by", "is", "in", "as", "at", "if", "no", "it", "an", "so", "be", "we", "do", "up")
)
_LETTERS = frozenset(("EA", "EF", "GD", "ED", "ds", "dt", "dv", "dS", "dV", "dH", "dM", "dR", "dm", "dF", "dw", "HC"))
"""Two letters that stand together as one symbol, or as a differential."""

_TOKEN = re.compile(
    r"(?P<code>`[^`]*`|checks\.\w+)"
    r"|(?P<quantity>(?<=[<>]= )[0-9.]+ s(?!\w)|0\.[0-9]+ m(?=,| below| -))"
    r"|(?P<prose>[A-Za-z]{3,}'s(?![\w(]))"
    r"|(?P<angle>\s*deg(?!\w))"
    r"|(?P<of>(?<=integral) of(?!\w))"
    r"|(?P<operator><=|>=|=>|->|\+-(?=\s)|-\+(?=\s))"
    r"|(?P<word>[A-Za-z]+[0-9]*\*?'*(?:_(?:\([^)]*\)|[A-Za-z0-9]+(?:,[A-Za-z0-9]+(?=[\s)^+*/|;=]|$))?'*))?)"
    r"|(?P<number>[0-9]+(?:\.[0-9]+)?(?:e[+-]?[0-9]+)?)"
    r"|(?P<space>\s+)"
    r"|(?P<other>.)",
    re.DOTALL,
)


class Role(Enum):
    """What a piece of a formula is."""

    SYMBOL = auto()
    FUNCTION = auto()
    TEXT = auto()
    MARK = auto()


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece of a formula."""

    text: str
    role: Role


def pieces(formula: str) -> tuple[Piece, ...]:
    """A formula taken apart."""
    found = [(match.lastgroup or "", match[0]) for match in _TOKEN.finditer(formula)]
    return tuple(Piece(text, _role(kind, text, found[index + 1 :])) for index, (kind, text) in enumerate(found))


def _role(kind: str, text: str, rest: list[tuple[str, str]]) -> Role:
    if kind in ("code", "prose"):
        return Role.TEXT
    if kind != "word":
        return Role.MARK
    if text == "e" and "".join(one for _, one in rest[:2]) == "^(":
        return Role.FUNCTION
    if text.partition("_")[0] in (*FUNCTIONS, "sum", "integral", "int"):
        return Role.FUNCTION
    if text == "a" and len(rest) > 1 and rest[0][1] == " " and rest[1][0] == "word" and _is_prose(rest[1][1]):
        return Role.TEXT
    return Role.TEXT if _is_prose(text) else Role.SYMBOL


def _is_prose(word: str) -> bool:
    """Whether a word is English: three letters and more without an index, that are no Greek letter."""
    base, _, index = word.partition("_")
    bare = base.rstrip("'*")
    if index or bare in GREEK or bare in FUNCTIONS or bare in ("sum", "integral", "int"):
        return False
    return bare in _SHORT_WORDS or (len(bare) > 2 and bare.isalpha())


def symbols(formula: str) -> tuple[str, ...]:
    """The symbols of a formula in their order, each once, without dashes of derivatives.

    >>> symbols("S_tight <= S_slack exp(mu alpha)")
    ('S_tight', 'S_slack', 'mu', 'alpha')
    """
    return tuple(one for one in letters(formula) if one not in ("dt", "e"))


def letters(formula: str) -> tuple[str, ...]:
    """All letters of a formula that require a meaning: the symbols, `e` where it is a variable, and `dt`.

    >>> letters("e = 1 - exp(-2 e_0)")
    ('e', 'e_0')
    """
    found = (piece.text.replace("'", "") for piece in pieces(formula) if piece.role is Role.SYMBOL)
    return tuple(dict.fromkeys(one for one in found if one != "pi"))


def base(symbol: str) -> tuple[str, str]:
    """A symbol without its index, and the index."""
    stem, _, index = symbol.partition("_")
    digits = re.fullmatch(r"([A-Za-z]+?)([0-9]+)", stem)
    return (digits[1], digits[2]) if digits and not index else (stem, index)


def latex(formula: str) -> str:
    r"""A formula in LaTeX; lines of the plain text become lines.

    >>> latex("S_tight <= S_slack exp(mu alpha)")
    'S_{\\mathrm{tight}} \\le S_{\\mathrm{slack}} \\exp(\\mu \\alpha)'
    """
    lines = [_line(line.strip()) for line in formula.splitlines() if line.strip()]
    if len(lines) == 1:
        return lines[0]
    return "\\begin{aligned}\n" + " \\\\\n".join(f"& {line}" for line in lines) + "\n\\end{aligned}"


def _line(line: str) -> str:
    written = "".join(_written(pieces(line)))
    return re.sub(r" +", " ", _roots(written)).strip()


def _written(parts: tuple[Piece, ...]) -> Iterator[str]:
    words: list[str] = []
    for index, part in enumerate(parts):
        following = parts[index + 1] if index + 1 < len(parts) else None
        if part.role is Role.TEXT or (words and part.text == " " and following and following.role is Role.TEXT):
            words.append(part.text.strip("`") if part.text != " " else " ")
            continue
        if words:
            yield _text("".join(words))
            words = []
        yield _one(part)
    if words:
        yield _text("".join(words))


def _text(words: str) -> str:
    escaped = words.replace("_", r"\_").replace("%", r"\%")
    return rf" \text{{ {escaped} }} "


def _one(part: Piece) -> str:
    text = part.text
    if part.role is Role.FUNCTION:
        name, _, index = text.partition("_")
        written = {"sum": r"\sum ", "integral": r"\int ", "int": r"\int ", "e": "e"}.get(name, _command(name))
        return written.rstrip() + f"_{{{_index(index)}}} " if index else written
    if part.role is Role.SYMBOL:
        return _symbol(text)
    if text.isspace():
        return r" \quad " if len(text) > 1 else " "
    if text in _OPERATORS:
        return _OPERATORS[text]
    if text.strip() == "deg":
        return r"^{\circ}"
    if text == " of":
        return ""
    quantity = re.fullmatch(r"([0-9.]+) ([ms])", text)
    if quantity:
        return rf"{quantity[1]}\,\mathrm{{{quantity[2]}}}"
    number = re.fullmatch(r"([0-9.]+)e\+?(-?)0*([0-9]+)", text)
    if number:
        return rf"{number[1]} \cdot 10^{{{number[2]}{number[3]}}}"
    return {"%": r"\,\% ", "{": r"\{", "}": r"\}", "*": r" \cdot ", "#": r"\#", "&": r"\&"}.get(text, text)


def _command(word: str) -> str:
    return _COMMANDS.get(word, f"\\{word}")


def _symbol(word: str) -> str:
    stem, index = base(word)
    dashes = "'" * stem.count("'") + "'" * index.count("'")
    star = "^{*}" if stem.endswith("*") else ""
    bare, index = stem.strip("'*"), index.replace("'", "")
    if bare in GREEK:
        written = _command(bare)
    elif len(bare) == 1:
        written = bare
    elif bare[0] == "d" and bare in _LETTERS:
        written = rf"\mathrm{{d}}{bare[1:]}"
    else:
        written = rf"\mathit{{{bare}}}"
    return f"{written}{star}{dashes}" + (f"_{{{_index(index)}}}" if index else "") + (" " if bare in GREEK else "")


def _index(index: str) -> str:
    inner = index.strip("()")
    if re.fullmatch(r"[a-z0-9]|[0-9]+", inner):
        return inner
    if inner in GREEK:
        return _command(inner)
    if re.fullmatch(r"[A-Za-z0-9,]+", inner):
        return rf"\mathrm{{{inner}}}"
    return _line(inner)


def _roots(text: str) -> str:
    r"""Powers in brackets `^(1/2)` and roots `\sqrt(...)` with braces, which LaTeX needs to see their end."""
    for start in (r"\sqrt(", "^("):
        while start in text:
            opened = text.index(start) + len(start) - 1
            closed = _closing(text, opened)
            text = f"{text[:opened]}{{{text[opened + 1 : closed]}}}{text[closed + 1 :]}"
    return re.sub(r"\^(-?[0-9]+(?:\.[0-9]+)?)", r"^{\1}", text)


def _closing(text: str, opened: int) -> int:
    depth = 0
    for place in range(opened, len(text)):
        depth += {"(": 1, ")": -1}.get(text[place], 0)
        if depth == 0:
            return place
    return len(text)
