"""Random machines whose arms hang on closed oil lines, well away from dead points: what fills what is kept in plain numbers.

An arm is held by a slave between two bodies; masters, between any points that move against each other, push oil into its line. A slave's
other side may drive the next one, both sides may be joined, and an arm may stand on what hangs from the one before.
"""

import math
from dataclasses import dataclass, replace
from functools import cache
from itertools import count

from hydraulics import Cylinder, OilLine, Pump
from linkage import LEFT, RIGHT, Dyad
from linkage.quantities import ref
from tests.laws.plane import Holder, sine
from tests.laws.random_loads import Draft
from tests.laws.sketch import OPEN, DeadEndError

KINDS = ("one master", "two masters", "chain", "double", "beside a lift")
TAGS = (*KINDS, "slider", "several strokes")
SIDES = ("piston", "rod")


@dataclass(frozen=True)
class Ram:
    """A cylinder: its ends, its bore and rod [m], how many stand side by side."""

    A: str
    B: str
    bore: float
    rod: float
    count: int = 1

    def cylinder(self):
        """Return it as a member of a class."""
        return Cylinder(self.A, self.B, bore=self.bore, rod=self.rod, count=self.count)

    def area(self, side):
        """Return a chamber's signed area [m2]."""
        whole = math.pi / 4.0 * self.count
        return whole * self.bore**2 if side == "piston" else whole * (self.rod**2 - self.bore**2)


def other(side):
    return "rod" if side == "piston" else "piston"


class OilDraft(Draft):
    """A sketch of a machine with closed lines: `rams` by name, `lines` as pairs of a ram's name and a side."""

    def __init__(self, seed, attempt=0):
        super().__init__(seed, attempt)
        self.rams, self.lines, self.held = {}, {}, {}

    def ram(self, ends):
        """Return the name of a new cylinder between two points."""
        name, bore = f"ram{len(self.rams)}", self.uniform(0.06, 0.1)
        self.rams[name] = Ram(*ends, bore, self.uniform(0.45, 0.7) * bore, 2 if self.chance(0.2) else 1)
        self.parts[name] = lambda to: self.rams[name].cylinder()
        self.holders.append(Holder("", *ends, name))
        return name

    def line(self, on, slave):
        """A closed line of chambers, filled in the sketch, where a slave has its length."""
        name, length = f"level{len(self.lines)}", self.apart(self.rams[slave].A, self.rams[slave].B)
        self.lines[name] = tuple(on)
        sides = [f"{ram}.{side}_side" for ram, side in on]
        self.parts[name] = lambda to: OilLine(*sides, filled={slave: to.length(length)})

    def arm(self):
        """An arm OX and a slave AX, whose length makes its angle; its chambers are on no line yet."""
        A, O = self.base()
        place = self.spot(lambda place: abs(sine(place - self.at[A], place - self.at[O])) > OPEN)
        X = self.new(place)
        slave, arm, side = self.ram((A, X) if self.chance(0.5) else (X, A)), self.apart(O, X), self.side(A, O, place)
        labels = lambda to: {A + X: ref(f"{slave}.length"), O + X: to.length(arm)}  # noqa: E731
        if self.chance(0.5):
            self.parts[X] = lambda to: Dyad(A, O, side=to.side(side), **labels(to))
        else:
            self.parts[X] = lambda to: Dyad(O, A, side=to.side(RIGHT if side is LEFT else LEFT), **labels(to))
        self.rigid.append((O, X))
        self.watch(lambda at: sine(at[X] - at[A], at[X] - at[O]))
        return slave

    def master(self):
        """A cylinder between points that move against each other."""
        return self.ram(self.ends() if len(self.moving) > 1 else (self.fix(), self.moving[0]))

    def driven(self):
        """A length that is driven without a Cylinder."""
        A, O = self.fix(), self.fix()
        place = self.spot(lambda place: abs(sine(place - self.at[A], place - self.at[O])) > OPEN)
        stroke, X = self.stroke(turns=False), self.new(place)
        length, arm, side = self.apart(A, X), self.apart(O, X), self.side(A, O, place)
        self.parts[X] = lambda to: Dyad(A, O, side=to.side(side), **{A + X: to.length(length) - ref(stroke), O + X: to.length(arm)})
        self.rigid.append((O, X))
        self.holders.append(Holder(stroke, A, X))
        self.watch(lambda at: sine(at[X] - at[A], at[X] - at[O]))

    def lift(self):
        """A cylinder in the place of a drive, which a pump holds by its piston side."""
        A, O = self.fix(), self.fix()
        place = self.spot(lambda place: abs(sine(place - self.at[A], place - self.at[O])) > OPEN)
        stroke, X = self.stroke(turns=False), self.new(place)
        lift, length, arm, side = self.ram((A, X)), self.apart(A, X), self.apart(O, X), self.side(A, O, place)
        self.parts[X] = lambda to: Dyad(A, O, side=to.side(side), **{A + X: to.length(length) + ref(stroke), O + X: to.length(arm)})
        self.rigid.append((O, X))
        self.watch(lambda at: sine(at[X] - at[A], at[X] - at[O]))
        self.parts[f"{lift}pump"] = lambda to: Pump(300e5)
        self.parts[f"{lift}line"] = lambda to: OilLine(f"{lift}.piston_side", f"{lift}pump")
        self.held[f"{lift}line"] = ((lift, "piston"),)
        return lift

    def levelled(self, what):
        """An arm on a closed line: with one master or two, with both sides joined, from a lift's rod side, or driving the next one."""
        side, end = self.some(SIDES), self.some(SIDES)
        feeding = [(self.lift(), "rod")] if what == "beside a lift" else [(self.master(), side)]
        feeding += [(self.master(), self.some(SIDES))] if what == "two masters" else []
        slave = self.arm()
        if what == "double":
            end, master = side, self.rams[feeding[0][0]]
            self.rams[slave] = replace(master, A=self.rams[slave].A, B=self.rams[slave].B)
            self.line([(feeding[0][0], other(side)), (slave, other(side))], slave)
        self.line([*feeding, (slave, end)], slave)
        if what == "chain":
            last = self.arm()
            self.line([(slave, other(end)), (last, self.some(SIDES))], last)
        self.tags.add(what)


def drafted(seed, attempt):
    """Return a draft with a closed line or two, of the kind its seed asks for."""
    draft = OilDraft(seed, attempt)
    draft.some([draft.crank, draft.guided, draft.driven])()
    if not draft.bodies():
        draft.rrr((draft.moving[0], draft.fix()))
    if draft.chance(0.4):
        draft.some([draft.crank, draft.guided, draft.driven])()
    draft.levelled(KINDS[seed % len(KINDS)])
    if draft.chance(0.4):
        draft.some([draft.slider, draft.pin_slot, draft.yoke, draft.cross])()
    for number in range(int(draft.random.integers(2, 5))):
        draft.some([draft.weight, draft.weight, draft.body_mass, draft.force, draft.moment])(number)
    if draft.chance(0.4):
        draft.element(0)
    if len(draft.spans) > 1:
        draft.tags.add("several strokes")
    return draft


@cache
def random_oil(seed):
    """Return a draft whose closed lines keep it well away from dead points wherever it is driven."""
    for attempt in count():
        try:
            draft = drafted(seed, attempt)
        except DeadEndError:
            continue
        for halvings in range(3):
            draft.factor = 0.5**halvings
            if draft.is_open():
                return draft
