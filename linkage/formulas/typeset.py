r"""LaTeX of the equations, parsed into boxes, to be set in type without LaTeX, as MathML or by hand.

Only what the printers here and SymPy's own emit is known: scripts, \frac, \sqrt, \vec, \overrightarrow, \left ... \right,
\operatorname, \mathit, \mathrm, \text, pmatrix and cases. A command that is not known stands as its name.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape
from itertools import groupby, zip_longest
from typing import NamedTuple, TypeAlias

from ..language import with_decimals

SMALL_LETTERS = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau upsilon varphi chi psi omega"
GREEK = dict(zip(SMALL_LETTERS.split(), "αβγδεζηθικλμνξπρστυφχψω", strict=True)) | {
    "phi": "φ", "varepsilon": "ε", "vartheta": "ϑ", "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π",
    "Sigma": "Σ", "Upsilon": "\u03a5", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω", "imath": "\u0131", "infty": "∞", "circ": "°", "angle": "∠",
}  # fmt: skip
OPERATORS = {
    "cdot": "·", "times": "×", "leq": "≤", "le": "≤", "geq": "≥", "ge": "≥", "neq": "≠", "ne": "≠", "wedge": "∧", "vee": "\u2228",
    "neg": "¬", "pm": "±", "|": "‖",
}  # fmt: skip
NAMES = {"operatorname": "name", "mathit": "word", "mathrm": "name", "text": "name", "mathbf": "name", "mathtt": "name"}
FENCES = {"lvert": "|", "rvert": "|", "{": "{", "}": "}", "lfloor": "⌊", "rfloor": "⌋", "lceil": "⌈", "rceil": "⌉", ".": ""}
SIGNS = "+−·=×<>≤≥"
"""Signs of sums, products and comparisons."""
SPACES = {",": 0.17, ":": 0.22, ";": 0.28, "quad": 1.0, " ": 0.3, "!": 0.0}


class Sign(NamedTuple):
    """One sign or word: a `variable`, a `word` of several letters in italics, a `name` upright, a `number`, an `operator`, a `space`."""

    kind: str
    text: str


class BoxRow(NamedTuple):
    """Boxes beside each other."""

    parts: tuple[Box, ...]


class Fraction(NamedTuple):
    """One box over another."""

    over: Box
    under: Box


class Script(NamedTuple):
    """A box with an index or an exponent, or both."""

    base: Box
    low: Box | None
    high: Box | None


class Arrowed(NamedTuple):
    """A box under an arrow; a long one as wide as the box."""

    base: Box
    long: bool


class Rooted(NamedTuple):
    """The square root of a box."""

    base: Box


class Fenced(NamedTuple):
    """A box between signs as high as it is."""

    left: str
    body: Box
    right: str


class Lines(NamedTuple):
    """Rows of boxes below each other."""

    rows: tuple[tuple[Box, ...], ...]


Box: TypeAlias = Sign | BoxRow | Fraction | Script | Arrowed | Rooted | Fenced | Lines

TOKEN = re.compile(r"\\[A-Za-z]+|\\.|[{}^_&]|\d+(?:\.\d+)?|[^\W\d_]|\S", re.DOTALL)


def boxes(latex: str) -> Box:
    """Return the boxes of a formula in LaTeX."""
    return _Reader(latex).boxes_until()


def breakable(box: Box) -> list[Box]:
    """Return a row cut in front of its outermost sums, products and comparisons: where a line may break."""
    if not isinstance(box, BoxRow):
        return [box]
    cut: list[list[Box]] = [[]]
    for part in box.parts:
        match part, cut[-1]:
            case Sign("operator", text), [_, *others] as before if text in SIGNS:
                if others or not isinstance(before[0], Sign) or before[0].kind != "operator":
                    cut.append([])
        cut[-1].append(part)
    return [BoxRow(tuple(parts)) for parts in cut if parts]


def listed_apart(parts: Sequence[Box]) -> Sequence[Box]:
    """Return boxes beside each other, with semicolons between them where a language's decimal commas stand among them, or may.

    They may among numbers; an index, such as `lift,1`, has a name.
    """
    firsts = [each.parts[0] if isinstance(each, BoxRow) and each.parts else each for each in parts]
    signs = [each for each in firsts if isinstance(each, Sign)]
    numbers = [each.text for each in signs if each.kind == "number"]
    may = with_decimals("0.5") != "0.5" and not any(each.kind in ("word", "variable") for each in signs)
    if numbers and (may or any(with_decimals(each) != each for each in numbers)):
        return [Sign("operator", ";") if each == Sign("operator", ",") else each for each in parts]
    return parts


def rough_width(box: Box) -> float:
    """Return about how wide a box is, in sizes of its letters: where a formula has to break, on paper and on a page."""
    match box:
        case Sign("space", text):
            return float(text)
        case Sign(kind, text):
            return (1.2 if kind == "operator" and text in SIGNS else 0.5) * len(text)
        case BoxRow(parts):
            return sum(map(rough_width, parts))
        case Fraction(over, under):
            return 0.2 + max(rough_width(over), rough_width(under))
        case Script(base, low, high):
            return rough_width(base) + 0.7 * max(rough_width(each) for each in (low, high, BoxRow(())) if each is not None)
        case Arrowed(base) | Rooted(base):
            return 0.5 + rough_width(base)
        case Fenced(_, body, _):
            return 1.0 + rough_width(body)
    columns = zip_longest(*box.rows, fillvalue=BoxRow(()))
    return sum(1.0 + max(map(rough_width, column)) for column in columns)


class _Reader:
    """Reads a formula token by token."""

    def __init__(self, latex: str) -> None:
        self.text, self.place = latex, 0

    def peek(self) -> str:
        found = TOKEN.search(self.text, self.place)
        return found.group() if found else ""

    def token(self) -> str:
        """Return the next token and go on behind it."""
        found = TOKEN.search(self.text, self.place)
        self.place = found.end() if found else len(self.text)
        return found.group() if found else ""

    def raw(self) -> str:
        """Return the text of a group in braces as it is written; of one sign without braces."""
        start = self.text.find("{", self.place)
        if self.peek() != "{":
            return self.token()
        depth, place = 0, start
        for place in range(start, len(self.text)):
            depth += {"{": 1, "}": -1}.get(self.text[place], 0)
            if not depth:
                break
        self.place = place + 1
        return self.text[start + 1 : place]

    def boxes_until(self, *ends: str) -> Box:
        """Return the boxes up to one of some tokens, which is not taken."""
        parts: list[Box] = []
        while (token := self.peek()) and token not in ends:
            if token in ("^", "_"):
                parts.append(self.scripts(parts.pop() if parts else BoxRow(())))
            else:
                parts.append(self.one())
        flat = [each for part in parts for each in (part.parts if isinstance(part, BoxRow) else (part,))]
        return flat[0] if len(flat) == 1 else BoxRow(tuple(flat))

    def scripts(self, base: Box) -> Box:
        low = high = None
        while self.peek() in ("^", "_"):
            if self.token() == "_":
                low = self.one()
            else:
                high = self.one()
        if isinstance(low, BoxRow):  # letters beside each other are one word
            parts: list[Box] = []
            for is_word, group in groupby(low.parts, lambda each: isinstance(each, Sign) and each.kind == "variable"):
                signs = [*group]
                word = "".join(each.text for each in signs if is_word and isinstance(each, Sign))
                parts += [Sign("word", word)] if len(word) > 1 else signs
            low = parts[0] if len(parts) == 1 else BoxRow(tuple(parts))
        if high == Sign("variable", "°") and low is None:
            return BoxRow((base, Sign("name", "°")))
        return Script(base, low, high)

    def one(self) -> Box:
        """Return the next box."""
        token = self.token()
        if token == "{":
            found = self.boxes_until("}")
            self.token()
            return found
        if token.startswith("\\"):
            return self.command(token[1:])
        if token[:1].isdigit():
            return Sign("number", token)
        if token.isalpha():
            return Sign("variable", token)
        return Sign("operator", {"-": "−", "*": "·", "'": "′"}.get(token, token)) if token else BoxRow(())

    def command(self, name: str) -> Box:
        """Return the box of a command."""
        match name:
            case "frac" | "dfrac" | "tfrac":
                return Fraction(self.one(), self.one())
            case "sqrt":
                return Rooted(self.one())
            case "vec" | "overrightarrow":
                return Arrowed(self.one(), name != "vec")
            case "left":
                left, body, _ = self.fence(), self.boxes_until("\\right"), self.token()
                return Fenced(left, body, self.fence())
            case "begin":
                return self.lines(self.raw())
        if name in NAMES:
            text = self.raw().replace("\\_", "_").replace("\\ ", " ")
            return Sign("variable" if name == "mathit" and len(text) == 1 else NAMES[name], text)
        if name in GREEK:
            return Sign("variable", GREEK[name])
        if name in SPACES:
            return Sign("space", str(SPACES[name]))
        return Sign("operator", OPERATORS[name]) if name in OPERATORS else Sign("name", FENCES.get(name, name))

    def fence(self) -> str:
        name = self.token().removeprefix("\\")
        return FENCES.get(name, name)

    def lines(self, kind: str) -> Box:
        r"""Return the rows of a matrix or of cases, up to the \end."""
        rows: list[list[Box]] = [[]]
        while (token := self.peek()) and token != "\\end":
            rows[-1].append(self.boxes_until("&", "\\\\", "\\end"))
            if self.peek() == "&":
                self.token()
            elif self.peek() == "\\\\":
                self.token()
                rows.append([])
        self.token()
        self.raw()
        table = Lines(tuple(tuple(row) for row in rows if row))
        left, right = {"pmatrix": ("(", ")"), "cases": ("{", "")}.get(kind, ("", ""))
        return Fenced(left, table, right) if left else table


# -- boxes as MathML Core, which browsers set themselves -----------------------------------------------------

NOT_SPACED = "(),;|[]{}′"


def mathml(box: Box) -> str:
    """Return a box as an element of MathML, without the `math` around it."""
    match box:
        case Sign("space", text):
            return f'<mspace width="{text}em"/>'
        case Sign("name", text) if " " in text or text == "°":
            return f"<mtext>{escape(text)}</mtext>"
        case Sign("operator", text):
            form = ' stretchy="false"' if text in NOT_SPACED else ""
            return f"<mo{form}>{escape(text)}</mo>"
        case Sign("number", text):
            return f"<mn>{escape(with_decimals(text))}</mn>"
        case Sign(kind, text):  # a page sets words of several letters in italics
            form = ' class="w"' if kind == "word" else ' mathvariant="normal"' if kind == "name" and len(text) == 1 else ""
            return f"<mi{form}>{escape(text)}</mi>"
        case BoxRow(parts):
            return f"<mrow>{''.join(map(mathml, listed_apart(parts)))}</mrow>"
        case Fraction(over, under):
            return f"<mfrac>{mathml(over)}{mathml(under)}</mfrac>"
        case Script(base, low, high):
            tag = "msup" if low is None else "msub" if high is None else "msubsup"
            return f"<{tag}>{''.join(mathml(each) for each in (base, low, high) if each is not None)}</{tag}>"
        case Arrowed(base, is_long):
            return f'<mover accent="true">{mathml(base)}<mo stretchy="{str(is_long).lower()}">→</mo></mover>'
        case Rooted(base):
            return f"<msqrt>{mathml(base)}</msqrt>"
        case Fenced(first, body, last):
            left, right = (f'<mo stretchy="true">{escape(each)}</mo>' if each else "" for each in (first, last))
            return f"<mrow>{left}{mathml(body)}{right}</mrow>"
    rows = ("".join(f"<mtd>{mathml(cell)}</mtd>" for cell in row) for row in box.rows)
    return f"<mtable>{''.join(f'<mtr>{row}</mtr>' for row in rows)}</mtable>"
