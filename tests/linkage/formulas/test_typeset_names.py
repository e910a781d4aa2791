"""Members of any legal name are set in type: in LaTeX, in MathML and on a page, and no two of them look the same."""

import random
import re
from xml.etree import ElementTree

from linkage import LEFT, Dyad, Ground, Mechanism, OnLink, Stroke, Weight, angle, equations
from linkage.documents.content import Document, Equality, Mark, Section, TitleBlock
from linkage.documents.html import math
from linkage.documents.pdf import pdf
from linkage.formulas.names import SymbolNames
from tests.for_all import for_all

LETTERS = ("ABMxyz", "αλΩρ", "ЖфЩ", "_", "0127", "é中")
WORDS = ("alpha", "dot", "hat", "frac", "Omega", "lambda_", "L", "is_", "d", "mathit")


def arm(name: str) -> type[Mechanism]:
    """Return a mechanism with a point and an output of a name."""
    S = Stroke(0.0, 0.1)
    members = {
        "S": S,
        "P": Ground(0.0, 0.0),
        "Q": Ground(0.5, 0.0),
        name: Dyad("P", "Q", **{f"P{name}": 0.4 + S, f"Q{name}": 0.3}, side=LEFT),
        f"out_{name}": angle("P", name),
        "K": OnLink("P", name, PK=0.2),
        f"load{name}": Weight(name, 100.0),
    }
    return type("Arm", (Mechanism,), members)


def drawn_name(random_: random.Random) -> str:
    """Return a legal name: a word or letters of several alphabets, with digits and underscores anywhere."""
    while True:
        parts = [
            random_.choice(WORDS) if random_.random() < 0.3 else random_.choice(random_.choice(LETTERS))
            for _ in range(random_.randint(1, 5))
        ]
        name = "".join(parts)
        if name.isidentifier() and not name.startswith("__") and name not in ("is_", "lambda") and len(name) > 1:
            return name


@for_all("seed", range(2), slow=range(2, 12))
def test_a_point_of_any_name_is_typeset(seed):
    name = ["M_", "_M", "M__"][seed] if seed < 3 else drawn_name(random.Random(seed))
    listed = equations(arm(name), forces=True, ratio=name)
    texts = [step for line in listed.sheet({"S": 0.05}) for step in line.steps] + listed.definitions
    assert pdf(Document("M", "", TitleBlock(), (), Mark(True, ""), (Section("", (Equality(1, tuple(texts)),)),), "en"))
    for text in texts:
        ElementTree.fromstring(math(text))
        assert "_" not in re.sub(r"\\_|_\{|_[A-Za-z0-9]", "", text)


def test_names_that_differ_by_underscores_look_different():
    plan = arm("M_").plan
    names = SymbolNames(plan)
    shown = {name: names._scalar_latex(name) for name in ("M", "M_", "M__", "_M", "M_1", "M_1_")}
    assert len(set(shown.values())) == len(shown)
    assert shown["M_"] == r"M_{\_}" and shown["M_1"] == "M_{1}"
