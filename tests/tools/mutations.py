"""Small changes of a source: one operator, comparison, constant or line at a time, as text, the rest of the file untouched.

What only words or types are made of is left alone: docstrings and messages, annotations, `__repr__` and `__str__`, imports, decorators
and `strict=` of zip.
"""

from __future__ import annotations

import ast
import difflib
from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass

COMPARED: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
COMBINED: dict[type[ast.operator], tuple[type[ast.operator], ...]] = {
    ast.Add: (ast.Sub,),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div,),
    ast.Div: (ast.Mult,),
    ast.FloorDiv: (ast.Mult,),
    ast.Mod: (ast.Mult,),
    ast.Pow: (ast.Mult,),
    ast.BitAnd: (ast.BitOr,),
    ast.BitOr: (ast.BitAnd,),
    ast.LShift: (ast.RShift,),
    ast.RShift: (ast.LShift,),
}
PAIRS = {"min": "max", "any": "all", "minimum": "maximum", "sin": "cos"}
OTHER_NAME = PAIRS | {other: name for name, other in PAIRS.items()}
SILENT = {"__repr__", "__str__"}
"""Functions that only make words."""


@dataclass(frozen=True)
class Mutant:
    """A changed source: its file, the line and function of the change, what kind it is, and the new text."""

    path: str
    line: int
    kind: str
    old: str
    new: str

    def diff(self) -> str:
        """Return the change as a diff without context."""
        lines = difflib.unified_diff(self.old.splitlines(), self.new.splitlines(), n=0, lineterm="")
        return "\n".join(line for line in list(lines)[2:] if not line.startswith("@@"))


def mutants(path: str, text: str) -> list[Mutant]:
    """Return all mutants of a source, in the order of its lines."""
    found = []
    for node, kind, spelled in changes(ast.parse(text)):
        new = replaced(text, node, spelled)
        if new != text:
            found.append(Mutant(path, node.lineno, kind, text, new))
    return found


def changes(tree: ast.AST) -> Iterator[tuple[ast.expr | ast.stmt, str, str]]:
    """Yield the node that is replaced, the kind of the change and the new spelling, for each change below a node."""
    for child in ast.iter_child_nodes(tree):
        if is_left_alone(child, tree):
            continue
        if isinstance(child, ast.stmt):
            yield from changed_statement(child)
        if isinstance(child, ast.expr):
            yield from ((child, kind, f"({ast.unparse(new)})" if needs_brackets(new) else ast.unparse(new)) for kind, new in changed(child))
        yield from changes(child)


def is_left_alone(node: ast.AST, parent: ast.AST) -> bool:
    """Return whether a node is words, types or names of modules."""
    if isinstance(node, ast.Import | ast.ImportFrom | ast.JoinedStr | ast.arg) or isinstance(parent, ast.Raise):
        return True
    if isinstance(node, ast.FunctionDef) and node.name in SILENT:
        return True
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return True
    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
        return True
    if isinstance(node, ast.AnnAssign) and "TypeAlias" in ast.unparse(node.annotation):
        return True
    if isinstance(node, ast.keyword) and node.arg == "strict":
        return True
    if isinstance(parent, ast.AnnAssign):
        return node is parent.annotation
    if isinstance(parent, ast.FunctionDef | ast.ClassDef) and node in parent.decorator_list:
        return True
    if isinstance(parent, ast.FunctionDef):
        return node is parent.returns
    return isinstance(parent, ast.Call) and ast.unparse(parent.func) in {"isinstance", "cast", "TypeVar"}


def changed_statement(node: ast.stmt) -> Iterator[tuple[ast.expr | ast.stmt, str, str]]:
    """Yield the changes of a whole line: it is dropped, its operator is another, or its condition is turned round."""
    if isinstance(node, ast.AugAssign):
        for operator in COMBINED.get(type(node.op), ()):
            new = copy(node)
            new.op = operator()
            yield node, "operator", ast.unparse(new)
    if isinstance(node, ast.If | ast.While) and isinstance(node.test, ast.Name | ast.Attribute | ast.Call):
        yield node.test, "comparison", f"not {ast.unparse(node.test)}"
    called = isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)
    stored = isinstance(node, ast.Assign) and all(isinstance(target, ast.Attribute | ast.Subscript) for target in node.targets)
    if called or stored or isinstance(node, ast.AugAssign | ast.Raise | ast.Continue | ast.Break):
        yield node, "line", "pass"


def changed(node: ast.expr) -> Iterator[tuple[str, ast.expr]]:
    """Yield the kind and the new form of each change of an expression itself."""
    match node:
        case ast.Compare():
            for place, operator in enumerate(node.ops):
                for other in COMPARED[type(operator)]:
                    new = copy(node)
                    new.ops = [*node.ops[:place], other(), *node.ops[place + 1 :]]
                    yield "comparison", new
        case ast.BinOp():
            for each in COMBINED.get(type(node.op), ()):
                yield "operator", ast.BinOp(node.left, each(), node.right)
        case ast.BoolOp():
            yield "operator", ast.BoolOp(ast.Or() if isinstance(node.op, ast.And) else ast.And(), node.values)
        case ast.UnaryOp(op=ast.USub() | ast.Not() | ast.Invert()):
            yield "operator", node.operand
        case ast.IfExp() if not (is_words(node.body) or is_words(node.orelse)):
            yield "comparison", ast.IfExp(node.test, node.orelse, node.body)
        case ast.Constant(value=bool()):
            yield "constant", ast.Constant(not node.value)
        case ast.Constant(value=int()):
            yield from (("constant", ast.Constant(node.value + step)) for step in (1, -1))
        case ast.Constant(value=float()):
            yield from (("constant", ast.Constant(value)) for value in other_numbers(node.value))
        case ast.Name() | ast.Attribute():
            name = node.id if isinstance(node, ast.Name) else node.attr
            if name in OTHER_NAME and isinstance(node.ctx, ast.Load):
                new = copy(node)
                setattr(new, "id" if isinstance(new, ast.Name) else "attr", OTHER_NAME[name])
                yield "operator", new


def is_words(node: ast.expr) -> bool:
    """Return whether an expression is a text."""
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


def other_numbers(value: float) -> tuple[float, ...]:
    """Return what stands for a number: another one of its size; a tolerance or a limit is a thousand times as large, and as small."""
    if value == 0.0:
        return (1.0,)
    if 1e-3 < abs(value) < 1e3:
        return value + 1.0, 0.5 * value
    return 1e3 * value, 1e-3 * value


def needs_brackets(node: ast.expr) -> bool:
    """Return whether an expression may not stand everywhere without brackets."""
    negative = isinstance(node, ast.Constant) and isinstance(node.value, int | float) and node.value < 0
    return negative or isinstance(node, ast.BinOp | ast.BoolOp | ast.Compare | ast.IfExp | ast.UnaryOp | ast.Lambda)


def replaced(text: str, node: ast.expr | ast.stmt, spelled: str) -> str:
    """Return a source with another spelling in a node's place."""
    lines = [line.encode() for line in text.splitlines(keepends=True)]
    first, last = node.lineno - 1, (node.end_lineno or node.lineno) - 1
    left, right = lines[first][: node.col_offset], lines[last][node.end_col_offset :]
    return b"".join([*lines[:first], left, spelled.encode(), right, *lines[last + 1 :]]).decode()
