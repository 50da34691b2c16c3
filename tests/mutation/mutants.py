"""Small faults, one at a time: each operator and each number of `laws` and `numerics` can be drawn.

    + and -, * and / change places, x**n becomes x * n, a comparison turns round, a minus falls away,
    a number that multiplies, divides or is a power grows by 1 %, another one too or, whole, by one;
    one below 1e-5 is a tolerance, which a percent cannot show: it grows ten thousandfold

Not drawn: what is said or raised, annotations, places in a list (`x[-1]`), axes, the swap of < and <=, which differ at
one float only.
"""

import ast
import bisect
import functools
import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from .reach import name_of

SIGNS: dict[type[ast.operator], tuple[bytes, bytes]] = {
    ast.Add: (b"+", b"-"),
    ast.Sub: (b"-", b"+"),
    ast.Mult: (b"*", b"/"),
    ast.Div: (b"/", b"*"),
    ast.Pow: (b"**", b"*"),
    ast.FloorDiv: (b"//", b"*"),
}
TURNED: dict[type[ast.cmpop], tuple[bytes, bytes]] = {
    ast.Lt: (b"<", b">="),
    ast.LtE: (b"<=", b">"),
    ast.Gt: (b">", b"<="),
    ast.GtE: (b">=", b"<"),
    ast.Eq: (b"==", b"!="),
    ast.NotEq: (b"!=", b"=="),
}
PLACES = {"axis", "ndmin", "ndim", "maxsize", "stacklevel", "decimals"}
TOLERANCE = 1e-5


@dataclass(frozen=True)
class Mutant:
    """One fault: the bytes from `start` to `end` of a file become `new`."""

    path: Path
    function: str
    start: int
    end: int
    new: bytes

    @property
    def source(self) -> bytes:
        old = _text(self.path)[0]
        return old[: self.start] + self.new + old[self.end :]

    @property
    def line(self) -> int:
        return bisect.bisect_right(_text(self.path)[1], self.start)

    @property
    def lines(self) -> tuple[str, str]:
        """The line as it is and as it becomes."""
        text, starts = _text(self.path)
        begin = starts[self.line - 1]
        line = text[begin:].splitlines()[0] if self.line == len(starts) else text[begin : starts[self.line] - 1]
        changed = line[: self.start - begin] + self.new + line[self.end - begin :]
        return line.decode().strip(), changed.decode().strip()


@functools.cache
def _text(path: Path) -> tuple[bytes, list[int]]:
    """The bytes of a file and where each of its lines begins."""
    text = path.read_bytes()
    return text, list(itertools.accumulate((len(line) for line in text.splitlines(keepends=True)[:-1]), initial=0))


def grown(number: float, factor: bool) -> bytes:
    """Another number in its place; `factor` one that multiplies, divides or is a power."""
    if isinstance(number, int):
        return repr(round(number * 1.01, 12) if factor and number else number + 1).encode()
    if number and abs(number) < TOLERANCE:
        return repr(number * 1e4).encode()
    return repr(number * 1.01 if number else 0.01).encode()


def mutants(path: Path) -> list[Mutant]:
    """All of a file, in the order of its text."""
    text = path.read_bytes()
    starts = list(itertools.accumulate((len(line) for line in text.splitlines(keepends=True)), initial=0))
    found: list[Mutant] = []

    def place(node: ast.expr) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return starts[node.lineno - 1] + node.col_offset, starts[node.end_lineno - 1] + node.end_col_offset

    def between(first: ast.expr, second: ast.expr, sign: tuple[bytes, bytes], inside: str) -> None:
        begin, end = place(first)[1], place(second)[0]
        if b"#" not in text[begin:end]:
            at = text.index(sign[0], begin, end)
            found.append(Mutant(path, name_of(path, inside), at, at + len(sign[0]), sign[1]))

    def look(node: ast.AST, inside: str, factor: bool = False) -> None:
        match node:
            case ast.Raise() | ast.JoinedStr() | ast.Assert():
                return
            case ast.FunctionDef() | ast.ClassDef():
                name = f"{inside}.{node.name}" if inside else node.name
                held = [*node.args.defaults, *node.args.kw_defaults] if isinstance(node, ast.FunctionDef) else []
                for child in (*held, *node.body):
                    if child is not None:
                        look(child, name)
                return
            case ast.AnnAssign():
                if node.value is not None:
                    look(node.value, inside)
                return
            case ast.Subscript():
                look(node.value, inside)
                return
            case ast.keyword() if node.arg in PLACES:
                return
            case ast.BinOp():
                words = any(isinstance(s, ast.JoinedStr | ast.List | ast.Tuple) for s in (node.left, node.right))
                if type(node.op) in SIGNS and not words:
                    between(node.left, node.right, SIGNS[type(node.op)], inside)
                scales = isinstance(node.op, ast.Mult | ast.Div | ast.Pow)
                look(node.left, inside, scales)
                look(node.right, inside, scales)
                return
            case ast.AugAssign() if type(node.op) in SIGNS:
                between(node.target, node.value, SIGNS[type(node.op)], inside)
            case ast.Compare():
                for first, sign, second in zip(
                    (node.left, *node.comparators), node.ops, node.comparators, strict=False
                ):
                    if type(sign) in TURNED:
                        between(first, second, TURNED[type(sign)], inside)
            case ast.UnaryOp(op=ast.USub()):
                at = place(node)[0]
                found.append(Mutant(path, name_of(path, inside), at, at + 1, b""))
            case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
                found.append(Mutant(path, name_of(path, inside), *place(node), grown(number, factor)))
        for child in ast.iter_child_nodes(node):
            look(child, inside)

    look(ast.parse(text), "")
    return sorted(found, key=lambda mutant: mutant.start)


def population(package: Path) -> Iterator[Mutant]:
    for room in ("laws", "numerics"):
        for path in sorted((package / room).rglob("*.py")):
            yield from mutants(path)
