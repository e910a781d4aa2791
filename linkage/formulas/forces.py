"""The equations of forces: the loads, the driving forces by virtual work, the thrusts of cylinders, and further lines of elements.

The laws of force run on the symbols of the listing, as they run on arrays and on the nodes of a program; one that has no formula is a given
number. A load that is vertical is a weight P, times the transfer ratio of its point; any other a vector F. Signs and frictionless virtual
work are those of `linkage.statics.work`. Source of notation: Dyuzhev, Kotov, Chuprynin (Minsk, 2008), (27) to (29).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple, cast

import numpy as np
import sympy
from sympy.matrices.expressions.matadd import MatAdd
from sympy.matrices.expressions.matexpr import MatrixElement, MatrixSymbol
from sympy.matrices.expressions.matmul import MatMul

from ..errors import DefinitionError, ensure
from ..loads import AT_REST, Acting, Case, ForceElement, Rate, Rates, Support, TwoPinned, TwoPoint
from ..mechanism import Mechanism
from ..motion import Motion, drive_kind
from ..motion.requests import stroke_of
from ..quantities import Angle, Distance, Quantity, Reference, joined_names, name_of
from ..statics import applied_elements, applied_loads, axle_load, member_thrust, standing_supports
from ..statics.applied import AppliedElement, case_of
from ..statics.holding import Holders, PressureLine, holders_of, same
from ..vectors import FloatArray, Numbers, Scalar
from .listing import LENGTH, NUMBER, GivenNumber, Listing, ListingLine, Term, Unit, term, unit_named
from .names import Cross, Deg, Direction, Dot, Norm, SymbolNames, Tcos, TurnV

# The derivative of each line by a stroke: the chain of differentiated primitives.
#
# With AB = TurnVL(AO, a, L) and AO turning at the rate w (cross(AO, AO') / |AO|^2), AB' = (w + a') TurnV(AB, 90 deg) + L'/L AB.
# The cosine rule L3^2 = L1^2 + L2^2 - 2 L1 L2 cos(a) gives a'. Source: any text on velocity analogues, such as Artobolevsky.

STILL = sympy.ZeroMatrix(2, 1)


class LineDerivatives:
    """Derivatives by one stroke of the lines read so far."""

    def __init__(self, stroke: sympy.Symbol, unit: Unit, names: SymbolNames) -> None:
        self.stroke, self.unit, self.names = stroke, unit, names
        self.known: dict[sympy.Basic, sympy.Basic] = {stroke: sympy.S.One}
        self._line: ListingLine | None = None
        self._found: list[ListingLine] = []

    def lines(self, written: Sequence[ListingLine]) -> list[ListingLine]:
        """Return the derivative of each line that follows the stroke."""
        for line in written:
            self._line = line
            rate = self.derivative(line.rhs) if line.rhs.is_Matrix else self.number(line.rhs, line.lhs)
            if rate in (sympy.S.Zero, STILL) or getattr(rate, "is_zero_matrix", False):
                continue
            self.known[line.lhs] = self.names.derivative(line.lhs, self.stroke)
            self._found.append(ListingLine(self.known[line.lhs], rate, line.unit.times(self.unit.to_the(-1))))
        return self._found

    # -- scalars ---------------------------------------------------------------------------------------

    def number(self, expr: sympy.Expr, angle: sympy.Symbol | None = None) -> sympy.Expr:
        """Return the derivative of a scalar; `angle` is its own symbol, where it has one."""
        if isinstance(expr, Tcos):
            return self._cosine_rule(expr, expr if angle is None else angle)
        words = sorted(expr.atoms(Norm, Direction, Cross, Dot, MatrixElement, Tcos), key=str)
        stands = {word: sympy.Dummy(real=True) for word in words}
        plain = expr.xreplace(stands)
        rates = [(symbol, self._word(word)) for word, symbol in stands.items()]
        rates += [(symbol, self.known[symbol]) for symbol in sorted(plain.free_symbols, key=str) if symbol in self.known]
        total = sympy.Add(*(plain.diff(symbol) * rate for symbol, rate in rates if rate != 0))
        return total.xreplace({symbol: word for word, symbol in stands.items()})

    def _cosine_rule(self, expr: Tcos, angle: sympy.Expr) -> sympy.Expr:
        a, b, c = expr.args
        da, db, dc = map(self.number, expr.args)
        turned = c * dc - a * da - b * db + sympy.cos(angle) * (a * db + b * da)
        return turned / (a * b * sympy.sin(angle))

    def _word(self, word: sympy.Expr) -> sympy.Expr:
        """Return the derivative of a number read off vectors."""
        match word:
            case Tcos():
                return self._cosine_rule(word, word)
            case MatrixElement():
                rate = self.derivative(word.parent)
                return sympy.S.Zero if rate == STILL else rate[word.i, 0]
            case Norm():
                return self._stretching(word.args[0])
            case Direction():
                return self._turning(word.args[0])
        a, b = word.args  # the factors of a scalar or vector product
        da, db = self.derivative(a), self.derivative(b)
        return sympy.Add(*(type(word)(*pair) for pair, rate in (((da, b), da), ((a, db), db)) if rate != STILL))

    def _turning(self, vector: sympy.MatrixExpr) -> sympy.Expr:
        """Return the rate at which a vector turns."""
        rate = self.derivative(vector)
        return sympy.S.Zero if rate == STILL else Cross(vector, rate) / Norm(vector) ** 2

    def _stretching(self, vector: sympy.MatrixExpr) -> sympy.Expr:
        """Return the rate of a vector's length, that of a named one with a line of its own: d|EC|/dS."""
        if isinstance(vector, TurnV):  # written where it is used
            base, _, *length = vector.args
            return self.number(length[0]) if length else self._stretching(base)
        rate = self.derivative(vector)
        if rate == STILL:
            return sympy.S.Zero
        if not isinstance(vector, MatrixSymbol):
            return Dot(vector, rate) / Norm(vector)
        if Norm(vector) not in self.known:
            symbol = self.known[Norm(vector)] = self.names.stretching(vector, self.stroke)
            self._found.append(ListingLine(symbol, Dot(vector, rate) / Norm(vector), LENGTH.times(self.unit.to_the(-1))))
        return self.known[Norm(vector)]

    # -- vectors ---------------------------------------------------------------------------------------

    def derivative(self, vector: sympy.MatrixExpr) -> sympy.MatrixExpr:
        """Return the derivative of a vector; STILL where it does not follow the stroke."""
        match vector:
            case MatrixSymbol():
                return self.known.get(vector, STILL)
            case MatAdd():
                return summed([rate for rate in map(self.derivative, vector.args) if rate != STILL])
            case MatMul():
                factor, (rest,) = vector.as_coeff_matrices()
                rate, scaled = self.derivative(rest), self.number(factor)
                turned = [] if rate == STILL else [MatMul(factor, rate)]
                return summed(turned + ([] if scaled == 0 else [MatMul(scaled, rest)]))
            case TurnV():
                base, angle, *length = vector.args
                turns = self.number(angle) + self._turning(base)
                longer = self.number(length[0]) / length[0] if length else self._stretching(base) / Norm(base)
                here = self._line.lhs if self._line is not None and vector == self._line.rhs else vector
                return summed([MatMul(factor, part) for factor, part in ((turns, TurnV(here, Deg(90))), (longer, here)) if factor != 0])
        return sympy.ImmutableMatrix([self.number(each) for each in vector])


def summed(vectors: Sequence[sympy.MatrixExpr]) -> sympy.MatrixExpr:
    """Return the sum of vectors, kept as written; STILL for none."""
    return (MatAdd(*vectors) if len(vectors) > 1 else vectors[0]) if vectors else STILL


def lines_needed(lines: Sequence[ListingLine], targets: Iterable[sympy.Basic]) -> list[ListingLine]:
    """Return the lines that some expressions are built from, in order."""
    wanted, found = set[sympy.Basic]().union(*(each.free_symbols for each in targets)), []
    for line in reversed(lines):
        if line.lhs in wanted:
            wanted |= line.rhs.free_symbols
            found.append(line)
    return found[::-1]


def symbols_behind(lines: Sequence[ListingLine], expr: sympy.Basic) -> set[sympy.Basic]:
    """Return the symbols that an expression is built from, those of the lines behind it too."""
    return set(expr.free_symbols).union(*(line.rhs.free_symbols for line in lines_needed(lines, [expr])))


MOST = 3
"""More cylinders that hold their strokes together have no equations that one would read."""
WORDS = (
    "Forces in N, pressures in Pa gauge, without friction. P: a force downwards, F: another one; Q: the force of a drive by virtual work,",
    "positive the way its stroke grows; T: what a member carries, positive where it pushes its ends apart. Pressures and reserves hold",
    "while the load resists.",
)


class Pulled(NamedTuple):
    """A load as it is written: its point, its symbol, and its direction: -1 downwards, 1 upwards, 0 a vector's own."""

    point: str
    symbol: sympy.Symbol | sympy.MatrixSymbol
    sign: int


class ForceLines:
    """The equations of a design's forces, on a listing; one pose of symbols for the laws (see `linkage.loads.element.Formulas`)."""

    shape: tuple[int, ...] = ()

    def __init__(self, design: Mechanism, listing: Listing, case: Case = None) -> None:
        self.design, self.listing, self.plan, self.case = design, listing, design.plan, case
        self.inputs: Mapping[str, Scalar] = {name: listing.input(name) for name in listing.units}
        self.lines: list[ListingLine] = []
        self.givens: list[GivenNumber] = []
        self._thrusts: dict[str, Term] = {}
        self._weights: dict[str, Term] = {}
        self._members: dict[str, TwoPinned] = {}
        self._chains: Mapping[str, Chain] = {}
        self.about = ""
        """The support that the moments of the others are written about; "" where the machine does not stand on any."""
        self.shared: tuple[str, ...] = ()
        """The supports whose loads are given numbers."""

    def write_forces(self) -> None:
        """Write all lines; DefinitionError without a chain of derivatives, and for cylinders that hold strokes together."""
        shut = ", ".join(case_of(self.plan, self.case).shut_names)
        ensure(not shut, f"{self.plan.title}: the load case shuts {shut}, and equations are of open lines; take thrust(motion, case=...).")
        elements = {each.name: each for each in applied_elements(self.plan, Acting(case=self.case))}
        for each in elements.values():
            if each.element.feeds(self.plan.members):
                each.element.formulas(self)
        acting = {name: list(self._acting(each)) for name, each in elements.items()}
        pulled = [each for found in acting.values() for each in found]
        holders = holders_of(self.plan)
        chains = self._chains = {stroke: Chain(self, stroke, pulled, holders) for stroke in self.plan.strokes}
        for stroke, chain in chains.items():
            self.lines += chain.lines
            self._write(f"Q_{stroke}", chain.need(pulled), drive_kind(self.plan, stroke)[1])
        self._hold(holders.lines)
        self._stand(acting)
        self.design.formulas(self)

    @property
    def friction(self) -> list[str]:
        """The elements whose dry friction is left out."""
        return [name for name, each in self.plan.of_kind(ForceElement).items() if each.frictions(self._somewhere())]

    # -- what acts -------------------------------------------------------------------------------------

    def _acting(self, applied: AppliedElement) -> Iterator[Pulled]:
        """Write the loads of an element at rest in the load case, and yield them; members with a thrust of their own are kept."""
        name, element, factor = applied.name, applied.in_case, applied.factor
        if element.feeds(self.plan.members):
            return
        try:
            pushes, loads = element.pushes(self, Rates()), []
            loads = [] if pushes else element.loads(self)
            forces = [np.asarray(each.force, object) for each in loads]
            terms = [(counted_load(factor, term(x)), counted_load(factor, term(y))) for x, y in forces]
            thrusts = [counted_load(factor, scalar(each.thrust)) for each in pushes]
        except Exception:  # whatever a law of a user's own stumbles on: it has numbers all the same
            yield from self._numbers(name)
            return
        for push, thrust in zip(pushes, thrusts, strict=True):
            if not self.equals(thrust, 0.0):
                self.carry(push.member, thrust)
        live: dict[tuple[str, bool], tuple[Term, Term]] = {}  # at one point what is straight up or down, and all else, is one force each
        for load, (x, y) in zip(loads, terms, strict=True):
            if not (self.equals(x, 0.0) and self.equals(y, 0.0)):
                key = name_of(load.point), self.equals(x, 0.0)
                live[key] = (live[key][0] + x, live[key][1] + y) if key in live else (x, y)
        for (point, _), (x, y) in live.items():  # a weight, an upward force, or a vector
            title = name if len(live) == 1 else f"{name}_{point}"
            if self.equals(x, 0.0):
                down = bool(y.expr.could_extract_minus_sign())
                found = self._write(f"P_{title}" if down else f"F_{title}", -y if down else y, "N")
                self._weights[title] = found if down else -found
                yield Pulled(point, found.expr, -1 if down else 1)
            else:
                symbol, parts = self.listing.names.force_vector(f"F_{title}"), [whole_numbers(each.expr) for each in (x, y)]
                self.lines.append(ListingLine(symbol, sympy.ImmutableMatrix(parts), unit_named("N")))
                yield Pulled(point, symbol, 0)

    def _numbers(self, name: str) -> Iterator[Pulled]:
        """Keep the loads of an element without a formula as given numbers from the engine; yield them."""
        situation = Acting([name], case=self.case)
        acting = applied_loads(self._somewhere(), situation, AT_REST)
        for place, thrust in enumerate(acting.thrusts):
            self._thrusts[thrust.name] = cast(Term, self.given(f"T_{thrust.name}", given_thrust(situation, place), "N"))
            self._members[thrust.name] = thrust.member
        for place, load in enumerate(acting.loads):
            point = load.point
            symbol = self.listing.names.force_vector(f"F_{name}" if len(acting.loads) == 1 else f"F_{name}_{point}")
            self.givens.append(GivenNumber(symbol, given_load(situation, place), unit_named("N")))
            yield Pulled(point, symbol, 0)

    def _somewhere(self) -> Motion:
        strokes: dict[str, float] = {name: stroke.start for name, stroke in self.plan.strokes.items()}
        return self.design.at(unreachable="nan", **strokes)

    # -- what holds ------------------------------------------------------------------------------------

    def _hold(self, lines: Sequence[PressureLine]) -> None:
        """Write the thrusts of all lines' cylinders: one line after the other where their strokes allow it, else together."""
        left, strokes = list(lines), [line.stroke for line in lines]
        levers: dict[PressureLine, dict[str, sympy.Expr]] = {}
        for line in lines:  # the work of a unit of pressure in each line on a unit of each stroke
            names = " and ".join(each.name for each in line.cylinders)
            share = f"{self.plan.title}: {names} share their load by"
            ensure(not line.changes_shares, f"{share} the sides that work; take thrust(motion) of each.")
            by_areas = f"{share} their areas beside what a tank pushes; take thrust(motion) of each."
            ensure(self._is_shared_by_areas(line), by_areas)
            areas = [(each.ends, self._area(line, each)) for each in line.cylinders]
            levers[line] = {name: sympy.Add(*(area * self._chains[name].growths[ends] for ends, area in areas)) for name in strokes}
        needs = {stroke: self.listing.names.scalar(f"Q_{stroke}") for stroke in strokes}
        while left:
            holding = {stroke: [line for line in left if levers[line][stroke] != 0] for stroke in needs}
            block, rows = next(((held, [stroke]) for stroke, held in holding.items() if len(held) == 1), (list(left), list(needs)))
            matrix = sympy.Matrix([[levers[line][stroke] for line in block] for stroke in rows])
            names = ", ".join(each.name for line in block for each in line.cylinders)
            many = f"{self.plan.title}: {names} hold their strokes together, too many for equations; take thrust(motion)."
            ensure(len(block) <= MOST, many)
            for place, each in enumerate(block):  # by Cramer's rule, on a unit of area
                changed = matrix.copy()
                changed[:, place] = sympy.Matrix([needs[stroke] for stroke in rows])
                unit_thrust = changed.det() / matrix.det()
                for cylinder in each.cylinders:
                    self.carry(cylinder, Term(unit_thrust * self._area(each, cylinder)))
            left, known = [each for each in left if each not in block], dict[PressureLine, sympy.Expr]()
            for each in block:  # on a unit of area
                one = each.cylinders[0]
                known[each] = self._thrusts[one.name or joined_names(*one.ends)].expr / self._area(each, one)
            needs = {
                name: need - sympy.Add(*(thrust * levers[each][name] for each, thrust in known.items()))
                for name, need in needs.items() if name not in rows
            }  # fmt: skip

    def _is_shared_by_areas(self, line: PressureLine) -> bool:
        """Return whether the thrusts of a line's cylinders are as their areas, which a tank's pressure on their other sides changes."""
        if len(line.cylinders) == 1:
            return True
        motion, acting = self._somewhere(), Acting(case=self.case)
        pressures = np.abs([member_thrust(motion, each, acting) / each.area_in(motion, np.ones(())) for each in line.cylinders])
        return not np.ptp(pressures) > 1e-9 * pressures.max()

    def _area(self, line: PressureLine, cylinder: TwoPoint) -> sympy.Expr:
        """Return the thrust of a cylinder at a unit of its line's pressure; of one that is alone on its line at a unit of its own."""
        return sympy.S.One if len(line.cylinders) == 1 else scalar(cylinder.area_written(self)).expr

    # -- what a vehicle stands on ----------------------------------------------------------------------

    def _stand(self, acting: Mapping[str, Sequence[Pulled]]) -> None:
        """Write two axle loads of a vehicle: by the moments about its first support, and by the sum across the ground; others are given."""
        motion = self._somewhere()
        supports = standing_supports(motion, Acting(case=self.case))
        if not supports:
            return
        (first, start), *others = supports.items()
        second = max(others, key=lambda each: float(np.hypot(*(motion[name_of(each[1].point)] - motion[name_of(start.point)]))))[0]
        across, moment = Term(sympy.S.Zero), Term(sympy.S.Zero)
        pushes = {name: each.pushes_along(self) for name, each in supports.items()}
        self.about, self.shared = first, tuple(name for name in supports if name not in (first, second))
        for name in self.shared:
            size = self.given(f"R_{name}", axle_load(name, case=self.case).of, "kN")
            across = across + size * inner(pushes[name], pushes[first])
            moment = moment + size * self._lever(start, supports[name].point, pushes[name])
        for each in (each for name, found in acting.items() if name not in supports for each in found):
            force = np.array([0.0, each.sign * Term(each.symbol)] if each.sign else [Term(each.symbol[k, 0]) for k in (0, 1)], object)
            across, moment = across + inner(force, pushes[first]), moment + self._lever(start, each.point, force, each)
        held = self._write(f"R_{second}", -moment / self._lever(start, supports[second].point, pushes[second]), "kN")
        self._write(f"R_{first}", -across - held * inner(pushes[second], pushes[first]), "kN")

    def _lever(self, start: Support, point: Reference, force: Any, load: Pulled | None = None) -> Any:
        """Return the moment of a force at a point about a support; of a load that is a vector as the product of both."""
        if name_of(point) == name_of(start.point):
            return Term(sympy.S.Zero)
        if load is not None and not load.sign:
            return Term(Cross(self.listing.between(name_of(start.point), name_of(point)), load.symbol))
        arm = self.between(start.point, point)
        return arm[0] * force[1] - arm[1] * force[0]

    # -- what elements write on ------------------------------------------------------------------------

    @property
    def pi(self) -> Scalar:
        return Term(sympy.pi)

    def line(self, name: str, value: Scalar, unit: str = "") -> Scalar:
        return self._write(name, scalar(value), unit)

    def _write(self, name: str, value: Term, unit: str) -> Term:
        symbol = self.listing.names.scalar(name)
        if symbol not in {each.lhs for each in self.lines}:
            self.lines.append(ListingLine(symbol, whole_numbers(value.expr), unit_named(unit)))
        return Term(symbol)

    def given(self, name: str, value: Callable[[Motion], Numbers], unit: str = "") -> Scalar:
        symbol = self.listing.names.scalar(name)
        self.givens.append(GivenNumber(symbol, value, unit_named(unit)))
        return Term(symbol)

    def equals(self, value: Scalar, number: float) -> bool:
        expr = scalar(value).expr.xreplace(self._values)
        return not expr.free_symbols and float(expr) == number

    @cached_property
    def _values(self) -> dict[sympy.Symbol, sympy.Float]:
        return {self.inputs[name].expr: sympy.Float(float(value)) for name, value in self.design.dimensions.items()}

    def weight(self, name: str) -> Scalar:
        if name not in self._weights:
            raise DefinitionError(f"{self.plan.title}: {name} is no force straight up or down, which an equation of its machine expects.")
        return self._weights[name]

    def thrust(self, member: Reference) -> Scalar:
        return self._thrusts.get(name_of(member))

    def carry(self, member: TwoPinned, thrust: Scalar) -> None:
        title = member.name or joined_names(*member.ends)
        self._thrusts[title] = self.line(f"T_{title}", thrust, "kN")
        self._members[title] = member

    @property
    def acting(self) -> Iterator[tuple[TwoPinned, Term]]:
        """The members whose thrust follows from a law."""
        return ((self._members[name], thrust) for name, thrust in self._thrusts.items())

    # -- what a motion tells ---------------------------------------------------------------------------

    def __getitem__(self, name: str) -> Any:
        place = self.listing.at(name)
        return np.array([place.x, place.y], object)

    def value(self, quantity: Quantity) -> Scalar:
        return self.listing.value(quantity)

    def angle(self, P: Reference, Q: Reference) -> Scalar:
        return self.value(Angle(P, Q))

    def distance(self, P: Reference, Q: Reference) -> Scalar:
        return self.value(Distance(P, Q))

    def sketched(self, quantity: Quantity) -> Scalar:
        strokes: Mapping[str, Any] = self.plan.sketch_strokes
        return term(float(self.design.at(**strokes).value(quantity)))

    def ratio(self, target: Reference, *, wrt: str | None = None, order: int = 1) -> Any:
        """Return the derivative of a loaded point, shape (2,), or of a member's length; DefinitionError where no line gives it."""
        ensure(order == 1, f"{self.plan.title}: no equation gives a ratio of order {order}.")
        chain = self._chains.get(stroke_of(self.plan, wrt))
        if chain is not None and isinstance(target, Distance):
            ends = name_of(target.P), name_of(target.Q)
            if ends in chain.growths:
                return Term(chain.growths[ends])
        elif chain is not None and name_of(target) in chain.points:
            return np.array([Term(each) for each in chain.rates_of(name_of(target))], object)
        raise DefinitionError(f"{self.plan.title}: {target} carries nothing here, so that no equation gives its ratio.")

    def velocity(self, target: Reference, rates: Mapping[str, Rate]) -> Any:
        """Raise DefinitionError: equations of forces are written at rest."""
        raise DefinitionError(f"{self.plan.title}: {target}: no equation gives a velocity.")

    def acceleration(self, target: Reference, rates: Mapping[str, Rate], accelerations: Mapping[str, Rate]) -> Any:
        """Raise DefinitionError as `velocity` does."""
        return self.velocity(target, rates)

    def between(self, P: Reference, Q: Reference) -> Any:
        vector = self.listing.between(name_of(P), name_of(Q))
        return np.array([Term(vector[0, 0]), Term(vector[1, 0])], object)


def scalar(value: Scalar) -> Term:
    """Return a number, or an array of one, as a term."""
    return term(np.asarray(value, object)[()])


def inner(a: FloatArray, b: FloatArray) -> Scalar:
    """Return the scalar product of two vectors of terms or numbers."""
    return a[0] * b[0] + a[1] * b[1]


def counted_load(factor: float, value: Term) -> Term:
    """Return a load as its load case counts it."""
    return value if factor == 1.0 else factor * value


def given_thrust(situation: Acting, place: int) -> Callable[[Motion], FloatArray]:
    """Return a function of a motion that gives an element's thrust [N]."""
    return lambda motion: applied_loads(motion, situation, AT_REST).thrusts[place].thrust


def given_load(situation: Acting, place: int) -> Callable[[Motion], FloatArray]:
    """Return a function of a motion that gives a load of an element, shape (2, ...) [N]."""
    return lambda motion: applied_loads(motion, situation, AT_REST).loads[place].force


def whole_numbers(expr: sympy.Expr) -> sympy.Expr:
    """Return an expression whose decimals that are whole numbers stand as such: 1.0 m is m."""
    whole = {each: sympy.Integer(round(float(each))) for each in expr.atoms(sympy.Float) if float(each) == round(float(each))}
    return expr.xreplace(whole)


def given_rate(forces: ForceLines, target: str | Distance, stroke: str, by: sympy.Symbol) -> sympy.Symbol | sympy.MatrixSymbol:
    """Return the derivative of a point, or of a length, that hangs on pins found together: a given number."""
    names = forces.listing.names
    vector = names.vector(target if isinstance(target, str) else joined_names(name_of(target.P), name_of(target.Q)))
    symbol = names.derivative(vector, by) if isinstance(target, str) else names.stretching(vector, by)
    forces.givens.append(GivenNumber(symbol, lambda motion: motion.ratio(target, wrt=stroke), NUMBER))
    return symbol


class Chain:
    """The derivatives by one stroke that forces need: of the points that carry loads, and of the lengths of members."""

    def __init__(self, forces: ForceLines, stroke: str, pulled: Sequence[Pulled], holders: Holders) -> None:
        listing = self.listing = forces.listing
        names = listing.names
        self.symbol = names.quantity(stroke)
        held = [each for line in holders.lines for each in line.cylinders]
        self._acting = [(each, thrust) for each, thrust in forces.acting if not any(same(each, one) for one in holders.every_cylinder)]
        lengths = {member.ends: listing.value(Distance(*member.ends)).expr for member in [*held, *(each for each, _ in self._acting)]}
        points = {each.point: listing.at(each.point).expr for each in pulled}
        together = {names.vector(pin) for pin in listing.unknowns}
        free = [each for each in (*points.values(), *lengths.values()) if not together & symbols_behind(listing.lines, each)]
        rates = LineDerivatives(self.symbol, listing.units[stroke], names)
        self.lines = rates.lines(lines_needed(listing.lines, free))
        fixed = {line.lhs: line.rhs for line in self.lines if line.rhs.is_number}
        self.growths = {
            ends: rates.number(length).xreplace(fixed) if length in free else given_rate(forces, Distance(*ends), stroke, self.symbol)
            for ends, length in lengths.items()
        }
        self.points = {name: rates.known[symbol] for name, symbol in points.items() if symbol in rates.known}
        self.points |= {name: given_rate(forces, name, stroke, self.symbol) for name, symbol in points.items() if symbol not in free}
        is_only = len(forces.plan.strokes) == 1
        self._vertical = dict.fromkeys(each.point for each in pulled if is_only and each.sign and each.point in self.points)
        for name in self._vertical:
            unit = next((each.unit for each in self.lines if each.lhs == self.points[name]), NUMBER)
            self.lines.append(ListingLine(names.ratio(name), self.points[name][1, 0], unit))

    def rates_of(self, point: str) -> tuple[sympy.Expr, sympy.Expr]:
        """Return both parts of a point's derivative; the second by its own name I_G where it has one."""
        x, y = self.points[point][0, 0], self.points[point][1, 0]
        return x, self.listing.names.ratio(point) if point in self._vertical else y

    def need(self, pulled: Sequence[Pulled]) -> Term:
        """Return the force of the stroke's drive by virtual work: minus the work of all loads on a unit of it."""
        total = sympy.S.Zero
        for each in pulled:
            if each.point not in self.points:
                continue
            total -= each.sign * each.symbol * self.rates_of(each.point)[1] if each.sign else Dot(each.symbol, self.points[each.point])
        for member, thrust in self._acting:
            total -= thrust.expr * self.growths[member.ends]
        return Term(total)
