"""What moves a random machine and what hangs from it: cylinders, cranks, telescopes, dyads, slides, groups."""

import math
from dataclasses import replace

import numpy as np

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit
from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dimension,
    Dyad,
    Guide,
    GuideCross,
    Link,
    OnGuide,
    OnLink,
    Pin,
    PinSlotDyad,
    SliderDyad,
    Stroke,
    YokeDyad,
    angle,
)
from linkage.quantities import ref
from tests.laws.plane import Element, Holder, Run, Swap, cross, facing, polar, sine, size, triad_sense, turned
from tests.laws.sketch import APART, OPEN, DeadEndError, Sketch

AIR = 101325.0  # Pa


def area_of(bore, rod, works):
    """Return the area that works [m2], negative where it pulls."""
    return math.pi / 4.0 * (bore**2 if works == "piston" else rod**2 - bore**2)


class Steps(Sketch):
    """A sketch that draws steps."""

    # -- drives --------------------------------------------------------------------------------------------

    def stroke(self, turns):
        name = "STU"[len(self.spans)]
        self.spans[name] = span = 0.12 if turns else 0.05
        size_of = (lambda to: 1.0) if turns else (lambda to: to.scale)
        self.parts[name] = lambda to: Stroke(-span * self.factor * size_of(to), span * self.factor * size_of(to))
        return name

    def angular(self, stroke):
        return self.spans[stroke] == 0.12

    def base(self):
        """Return two points for a drive to stand on: of the frame, or of one moving body."""
        if self.moving and self.chance(0.5):
            return self.pair()
        return self.fix(), self.fix()

    def cylinder(self):
        """A cylinder AX and its arm OX."""
        A, O = self.base()
        place = self.spot(lambda place: abs(sine(place - self.at[A], place - self.at[O])) > OPEN)
        stroke, X, factor = self.stroke(turns=False), self.new(place), self.some([1.0, 1.0, -1.0, 2.0, -0.5])
        length, arm, side = self.apart(A, X), self.apart(O, X), self.side(A, O, place)
        L = f"L{stroke}"
        self.parts[L] = lambda to: Dimension(to.length(length))
        driven = ref(L) - ref(stroke) if factor == -1.0 else ref(L) + (ref(stroke) if factor == 1.0 else factor * ref(stroke))
        labels = lambda to: {A + X: driven, O + X: to.length(arm)}  # noqa: E731
        if self.chance(0.5):
            self.parts[X] = lambda to: Dyad(A, O, side=to.side(side), **labels(to))
        else:
            self.parts[X] = lambda to: Dyad(O, A, side=to.side(RIGHT if side is LEFT else LEFT), **labels(to))
        self.rigid.append((O, X))
        self.watch(lambda at: sine(at[X] - at[A], at[X] - at[O]))
        what, lift = self.random.random(), ""
        if what < 0.6:
            lift = f"lift{stroke}"
            ends, bore, count_of = ((A, X) if self.chance(0.6) else (X, A)), self.uniform(0.05, 0.11), int(self.random.integers(1, 3))
            if what < 0.15:
                self.gas(lift, ends, stroke)
                self.own[stroke] = (A, X)
            else:
                works = self.some(["piston", "rod"])
                self.parts[lift] = lambda to: Cylinder(*ends, bore=bore, rod=0.6 * bore, count=count_of, works=works)
        if stroke not in self.own:
            area = count_of * area_of(bore, 0.6 * bore, works) if lift else 0.0
            self.holders.append(Holder(stroke, A, X, lift, area))
            if lift and self.chance(0.4):
                self.assist(self.holders[-1], O, X)
        if self.is_fixed(O):
            self.swaps.append(Swap(stroke, A, O, X, lift if stroke not in self.own else ""))

    def side(self, P, Q, place):
        return LEFT if cross(self.at[Q] - self.at[P], place - self.at[P]) > 0.0 else RIGHT

    def crank(self, beside=""):
        """A crank; beside it perhaps a cylinder that holds it, or one that gas feeds."""
        moved = not beside and self.moving and self.chance(0.3)
        O, Q = self.pair() if moved else (self.fix(), "")
        start = facing(self.at[Q] - self.at[O]) if moved else 0.0
        arm = self.uniform(0.3, 0.5)
        turns = [turn for turn in self.random.uniform(-3.0, 3.0, 40) if self.clear(polar(self.at[O], arm, start + turn))]
        if not turns:
            raise DeadEndError
        turn = float(turns[0])
        stroke, X = self.stroke(turns=True), self.new(polar(self.at[O], arm, start + turn))
        follows = ref(stroke) + turn
        if moved:
            self.parts[X] = lambda to: Crank(O, angle=angle(O, Q) + (-follows if to.mirror else follows), **{O + X: to.length(arm)})
        else:
            self.parts[X] = lambda to: Crank(O, angle=to.angle(follows), **{O + X: to.length(arm)})
        self.rigid.append((O, X))
        if not beside:
            return
        K = self.fix(self.spot(lambda place: abs(sine(place - self.at[X], self.at[O] - self.at[X])) > OPEN))
        self.watch(lambda at: sine(at[K] - at[X], at[O] - at[X]))
        lift, ends, bore = f"ram{stroke}", ((K, X) if self.chance(0.5) else (X, K)), self.uniform(0.04, 0.09)
        if beside == "gas":
            self.gas(lift, ends, stroke)
            self.tags.add("gas beside a crank")
        else:
            self.parts[lift] = lambda to: Cylinder(*ends, bore=bore, rod=0.55 * bore)
            self.holders.append(Holder(stroke, K, X, lift, area_of(bore, 0.0, "piston")))
            if self.chance(0.4):
                self.assist(self.holders[-1], O, X)

    def assist(self, first, O, X):
        """A second cylinder on the line of one that holds the arm OX: they share a pressure and add to each other's moment."""
        if not self.is_fixed(first.A) or not self.is_fixed(O):
            return
        stroke, bore, works = first.stroke, self.uniform(0.04, 0.08), self.some(["piston", "rod"])
        area, sense = area_of(bore, 0.6 * bore, works), np.sign(first.area * sine(self.at[X] - self.at[O], self.at[X] - self.at[first.A]))
        K = self.fix(self.spot(lambda place: np.sign(area) * sense * sine(self.at[X] - self.at[O], self.at[X] - place) > OPEN))
        self.watch(lambda at: sine(at[X] - at[O], at[X] - at[K]))
        self.parts[f"aid{stroke}"] = lambda to: Cylinder(K, X, bore=bore, rod=0.6 * bore, works=works)
        self.parts[f"line{stroke}"] = lambda to: LiftCircuit([first.member, f"aid{stroke}"], pressure=300e5, relief=330e5)
        self.holders.append(Holder(stroke, K, X, f"aid{stroke}", area))

    def gas(self, lift, ends, stroke):
        """A cylinder on a closed block of one vessel, isothermal, charged in the sketch."""
        A, B = ends
        bore, rod, works = self.uniform(0.03, 0.05), 0.02, self.some(["piston", "rod"])
        volume, charge, held = self.uniform(2e-3, 4e-3), self.uniform(15e5, 40e5), self.uniform(50e5, 90e5)
        losses = self.some([0.0, 3e5])
        self.parts[lift] = lambda to: Cylinder(A, B, bore=bore, rod=rod, works=works)
        self.parts[f"gas{stroke}"] = lambda to: FloatCircuit(
            lift,
            AccumulatorBlock([Accumulator(volume=volume * to.scale, charge=charge)]),
            charge_pressure=held,
            seal_friction=losses,
        )
        area, sense = math.pi / 4.0 * (bore**2 - (rod**2 if works == "rod" else 0.0)), (1.0 if works == "piston" else -1.0)
        length, gas = self.apart(A, B), volume * (charge + AIR) / (held + AIR)

        def thrust(now, rate):
            return sense * area * ((held + AIR) * gas / (gas + sense * area * (now - length)) - AIR)

        def energy(now):
            let_out = sense * area * (now - length)
            return AIR * let_out - (held + AIR) * gas * np.log(1.0 + let_out / gas)

        self.elements[lift] = Element(A, B, thrust, energy, losses * area)

    def guided(self):
        """A point that is driven along a rail of the frame, with a link to hold on to."""
        place, turn, start = self.spot(), self.uniform(-3.0, 3.0), self.uniform(0.1, 0.4)
        origin = polar(place, -start, turn)
        rail, stroke = f"rail{len(self.rails)}", self.stroke(turns=False)
        self.parts[rail] = lambda to: Guide(to.place(origin), angle=to.angle(turn))
        X, back = self.new(place), self.chance(0.3)
        self.parts[X] = lambda to: OnGuide(rail, at=to.length(start) + (-ref(stroke) if back else ref(stroke)))
        along = np.array([[math.cos(turn)], [math.sin(turn)]])
        self.runs.append(Run(X, lambda at: along, driven=True))
        self.rails[rail] = self.runs[-1]
        self.tags.add("slider")

    def telescope(self):
        """An arm that goes out of a body that moves."""
        P, Q = self.pair()
        turn = self.uniform(0.6, 2.4) * self.some([-1.0, 1.0])
        reach = self.uniform(0.4, 0.7)
        place = polar(self.at[P], reach, facing(self.at[Q] - self.at[P]) + turn)
        if not self.clear(place):
            raise DeadEndError
        stroke, X = self.stroke(turns=False), self.new(place)
        self.parts[X] = lambda to: OnLink(P, Q, **{P + X: to.length(reach) + ref(stroke), Q + P + X: to.sense * turn})
        self.arms[X] = (P, Q)

    # -- dyads ---------------------------------------------------------------------------------------------

    def rrr(self, roots=None):
        P, Q = roots or self.pick(2)
        place = self.spot(lambda place: abs(sine(place - self.at[P], place - self.at[Q])) > OPEN)
        side, X = self.side(P, Q, place), self.new(place)
        p, q = self.apart(P, X), self.apart(Q, X)
        self.parts[X] = lambda to: Dyad(P, Q, side=to.side(side), **{P + X: to.length(p), Q + X: to.length(q)})
        self.rigid += [(P, X), (Q, X)]
        self.watch(lambda at: sine(at[X] - at[P], at[X] - at[Q]))
        return X

    def on_link(self):
        """A further point of a body, in one of three ways."""
        P, Q = self.pair()
        reach, turn = self.uniform(0.3, 0.8), self.uniform(0.5, 2.5) * self.some([-1.0, 1.0])
        place = np.array(polar(self.at[P], reach, facing(self.at[Q] - self.at[P]) + turn))
        if not self.clear(place):
            return
        side, X, way = self.side(P, Q, place), self.new(place), int(self.random.integers(3))
        third = self.apart(Q, X)
        angled = {Q + P + X: abs(turn)}
        self.parts[X] = lambda to: (
            OnLink(P, Q, **{P + X: to.length(reach), Q + P + X: to.sense * turn})
            if way == 0
            else OnLink(P, Q, side=to.side(side), **{P + X: to.length(reach)}, **(angled if way == 1 else {Q + X: to.length(third)}))
        )
        self.rigid.append((P, Q, X))

    def guide(self):
        """Return a guide of the frame or of a moving body, its points, and two of its places in the sketch."""
        name = f"rail{len(self.rails)}"
        if self.bodies() and self.chance(0.4):
            P, Q = self.pair()
            self.parts[name] = lambda to: Guide(P, Q)
            self.rails[name] = Run("", lambda at: at[Q] - at[P], P, (P, Q))
            return name, (P, Q), self.at[P], self.at[Q] - self.at[P]
        place, turn = self.spot(), self.uniform(-3.0, 3.0)
        self.parts[name] = lambda to: Guide(to.place(place), angle=to.angle(turn))
        along = np.array([math.cos(turn), math.sin(turn)])
        self.rails[name] = Run("", lambda at: along[:, None])
        return name, (), place, along

    def beside(self, points):
        """Return a moving point that is rigid with none of a guide's points."""
        found = [name for name in self.moving if not any(name == each or self.together(name, each) for each in points)]
        if not found:
            raise DeadEndError
        return self.some(found)

    def slider(self):
        rail, points, origin, along = self.guide()
        P, along = self.beside(points), along / size(along)
        for _ in range(300):
            foot = float(np.dot(self.at[P] - origin, along))
            place = origin + along * (foot + self.uniform(-1.2, 1.2))
            arm = place - self.at[P]
            if self.clear(place) and size(arm) > APART and abs(np.dot(arm, along)) / size(arm) > OPEN:
                break
        else:
            raise DeadEndError
        side, X, reach = (RIGHT if np.dot(arm, along) > 0.0 else LEFT), self.new(place), float(size(arm))
        self.parts[X] = lambda to: SliderDyad(P, rail, side=side, **{P + X: to.length(reach)})
        self.rigid.append((P, X))
        direction = self.rails[rail].direction
        self.watch(lambda at: sine(at[X] - at[P], np.stack([-direction(at)[1], direction(at)[0]])))
        self.runs.append(replace(self.rails[rail], point=X))
        self.tags.add("slider")

    def pin_slot(self):
        P, Q = self.pick(2)
        if self.chance(0.5):
            P, Q = Q, P
        off = self.some([0.0, 1.0]) * self.uniform(-0.08, 0.08)
        to_pin, reach = self.at[Q] - self.at[P], self.uniform(0.3, 0.9)
        ahead = self.some([1.0, 1.0, -1.0])
        lean = math.asin(off / float(size(to_pin)))
        turn = facing(to_pin) - lean if ahead > 0 else facing(to_pin) + math.pi + lean
        place = np.array(polar(self.at[P], reach, turn))
        if not self.clear(place) or size(to_pin) < APART:
            raise DeadEndError
        X = self.new(place)
        self.parts[X] = lambda to: PinSlotDyad(
            P, Q, offset=to.sense * to.length(off), side=RIGHT if ahead > 0 else LEFT, **{P + X: to.length(reach)}
        )
        self.rigid.append((P, X))
        self.runs.append(Run(Q, lambda at: at[X] - at[P], P, (P, X)))
        self.watch(lambda at: np.sqrt(1.0 - (off / size(at[Q] - at[P])) ** 2))
        self.tags.add("slider")

    def yoke(self):
        rail, points, origin, along = self.guide()
        P, along, lean = self.beside(points), along / size(along), math.radians(self.uniform(60.0, 120.0))
        away = self.at[P] - origin
        place = origin + along * (np.dot(along, away) - cross(along, away) / math.tan(lean))
        if not self.clear(place):
            raise DeadEndError
        X = self.new(place)
        self.parts[X] = lambda to: YokeDyad(P, rail, angle=math.pi - lean if to.mirror else lean)
        line = self.rails[rail]
        self.runs += [replace(line, point=X), Run(P, lambda at: turned(line.direction(at), lean), X, line.pair, block=f"{X} (slider)")]
        self.tags.add("slider")

    def cross(self):
        """A pin on two guides, one of which moves."""
        P, Q = self.pair()
        u = self.at[Q] - self.at[P]
        place = self.at[P] + u * self.uniform(0.2, 1.5)
        if not self.clear(place):
            raise DeadEndError
        turn = facing(u) + self.uniform(0.7, 2.4)
        origin = polar(place, self.uniform(-0.5, 0.5), turn)
        moving, still, along = f"rail{len(self.rails)}", f"rail{len(self.rails) + 1}", np.array([[math.cos(turn)], [math.sin(turn)]])
        self.parts[moving], self.parts[still] = (lambda to: Guide(P, Q)), (lambda to: Guide(to.place(origin), angle=to.angle(turn)))
        X = self.new(place)
        self.parts[X] = lambda to: GuideCross(moving, still)
        self.rails[moving], self.rails[still] = Run(X, lambda at: at[Q] - at[P], P, (P, Q)), Run(X, lambda at: along)
        self.runs += [self.rails[moving], self.rails[still]]
        self.watch(lambda at: sine(at[Q] - at[P], along))
        self.tags.add("slider")

    def triad(self):
        """A link of three pins on three rods, a group of class III."""
        for _ in range(60):
            roots = self.pick(3, apart=False)
            if any(self.together(P, Q) for P, Q in zip(roots, roots[1:] + roots[:1], strict=True) if not self.is_fixed(P)):
                continue
            corners = [self.spot() for _ in roots]
            rods = [corner - self.at[root] for corner, root in zip(corners, roots, strict=True)]
            flat = abs(sine(corners[1] - corners[0], corners[2] - corners[0]))
            gaps = [size(corners[k] - corners[k - 1]) for k in range(3)]
            if min(map(size, [*rods])) > APART and min(gaps) > APART and flat > 0.4 and abs(triad_sense(corners, rods)) > 0.6:
                break
        else:
            raise DeadEndError
        pins = [self.new(corner) for corner in corners]
        for pin, rough in zip(pins, self.random.uniform(-0.005, 0.005, (3, 2)), strict=True):
            near = self.at[pin] + rough
            self.parts[pin] = lambda to, near=near: Pin(near=to.place(near))
        for ends in (tuple(pins), *zip(roots, pins, strict=True)):
            name = "bar_" + "_".join(ends)
            lengths = {P + Q: self.apart(P, Q) for k, P in enumerate(ends) for Q in ends[k + 1 :]}
            self.parts[name] = lambda to, ends=ends, lengths=lengths: Link(
                " ".join(ends), **{label: to.length(value) for label, value in lengths.items()}
            )
            self.links[name] = set(ends)
            self.rigid.append(ends)
        self.watch(lambda at: triad_sense([at[pin] for pin in pins], [at[pin] - at[root] for pin, root in zip(pins, roots, strict=True)]))
        self.tags.add("group")
