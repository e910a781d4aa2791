"""What acts on a random machine: weights, forces, moments, straight elements between two points, friction."""

from collections import Counter

import numpy as np

from linkage import Actuator, Between, Damper, Force, GuideFriction, LinkMass, Moment, PinFriction, Spring, Weight
from tests.laws.plane import G0, Act, Element, External, facing, size, turned
from tests.laws.random_steps import Steps
from tests.laws.sketch import APART, DeadEndError


class Draft(Steps):
    """A sketch of a machine with its loads."""

    # -- loads ---------------------------------------------------------------------------------------------

    def weight(self, number):
        P, mass = self.some(self.moving), self.uniform(20.0, 200.0)
        self.parts[f"weight{number}"] = lambda to: Weight(P, mass=mass, **to.gravity)
        force = np.array([[0.0], [-mass * G0]])
        self.loads[f"weight{number}"] = External(
            lambda at: [Act(P, force, at[P])],
            lambda at: mass * G0 * at[P][1],
        )

    def body_mass(self, number):
        P, Q = self.pair()
        mass, along, across = self.uniform(10.0, 80.0), self.uniform(0.1, 0.4), self.uniform(-0.2, 0.2)
        middle = self.chance(0.4)
        self.parts[f"own{number}"] = lambda to: LinkMass(
            f"{P} {Q}", mass=mass, at=None if middle else (to.length(along), to.sense * to.length(across)), **to.gravity
        )

        def centre(at):
            if middle:
                return (at[P] + at[Q]) / 2.0
            u = (at[Q] - at[P]) / size(at[Q] - at[P])
            return at[P] + along * u + across * np.stack([-u[1], u[0]])

        force = np.array([[0.0], [-mass * G0]])
        self.loads[f"own{number}"] = External(lambda at: [Act(P, force, centre(at), (P, Q))], lambda at: mass * G0 * centre(at)[1])

    def force(self, number):
        P, x, y = self.some(self.moving), self.uniform(-2e3, 2e3), self.uniform(-2e3, 2e3)
        self.parts[f"pull{number}"] = lambda to: Force(P, to.vector((x, y)))
        force = np.array([[x], [y]])
        self.loads[f"pull{number}"] = External(lambda at: [Act(P, force, at[P])], lambda at: -(x * at[P][0] + y * at[P][1]))

    def moment(self, number):
        (P, Q), M = self.pair(), self.uniform(-400.0, 400.0)
        self.parts[f"moment{number}"] = lambda to: Moment(f"{P} {Q}", M=to.sense * to.scale * M)
        start = facing(self.at[Q] - self.at[P])

        def since(at):
            u = turned(at[Q] - at[P], -start)
            return np.arctan2(u[1], u[0])

        self.loads[f"moment{number}"] = External(
            lambda at: [Act(P, np.zeros((2, 1)), at[P], (P, Q), M)],
            lambda at: -M * since(at),
        )

    def ends(self):
        """Return two points that something acts between: of different bodies, pins of the frame now and then new ones."""
        for _ in range(100):
            A = self.fix() if self.chance(0.25) else self.some(list(self.at))
            B = self.some([name for name in self.moving if name != A])
            if self.apart(A, B) > APART and not self.together(A, B):
                return (A, B) if self.chance(0.5) else (B, A)
        raise DeadEndError

    def element(self, number, ends=None):
        """A spring, damper, actuator or a law of its own between two points."""
        A, B = ends or self.ends()
        length, what, name = self.apart(A, B), self.some(["spring", "preload", "damper", "actuator", "law"]), f"element{number}"
        if what in ("spring", "preload"):
            stiffness, pull = self.uniform(1e3, 2e4), self.uniform(-800.0, 800.0)
            free = length - pull / stiffness if what == "preload" else length * self.uniform(0.7, 1.2)
            given = (lambda to: {"preload": pull}) if what == "preload" else (lambda to: {"free_length": to.length(free)})
            self.parts[name] = lambda to: Spring(A, B, stiffness=stiffness / to.scale, **given(to))
            law = Element(A, B, lambda now, rate: -stiffness * (now - free), lambda now: stiffness * (now - free) ** 2 / 2.0)
        elif what == "damper":
            coefficient = self.uniform(1e3, 1e4)
            self.parts[name] = lambda to: Damper(A, B, coefficient=coefficient / to.scale)
            law = Element(A, B, lambda now, rate: -coefficient * rate, lambda now: 0.0 * now)
        elif what == "actuator":
            push = self.uniform(-2e3, 2e3)
            self.parts[name] = lambda to: Actuator(A, B, force=push)
            law = Element(A, B, lambda now, rate: push + 0.0 * now, lambda now: -push * now)
        else:
            push, slope, drag = self.uniform(300.0, 1200.0), self.uniform(500.0, 4e3), self.uniform(100.0, 1e3)
            strut = lambda now, rate: push + slope * (length - now) - drag * rate  # noqa: E731
            self.parts[name] = lambda to: Between(A, B, law=lambda now, rate: strut(now / to.scale, rate / to.scale))
            law = Element(A, B, strut, lambda now: -(push + slope * length) * now + slope * now**2 / 2.0)
        self.elements[name] = law
        self.watch(lambda at: size(at[B] - at[A]) / 0.3)

    def second(self, number):
        """One more element on two points that have one, or beside a cylinder."""
        pairs = [(each.A, each.B) for each in (*self.elements.values(), *self.holders)]
        if not pairs:
            self.element(number)
            pairs = [(self.elements[f"element{number}"].A, self.elements[f"element{number}"].B)]
        ends = self.some(pairs)
        self.element(number + 1, ends if self.chance(0.5) else ends[::-1])
        self.tags.add("two on two points")

    # -- friction ------------------------------------------------------------------------------------------

    def joined(self):
        """Return how many bodies meet at each point, in the order of the points: the frame, links, cylinders, elements."""
        bars = [*self.bodies(), *({each.A, each.B} for each in self.holders), *({each.A, each.B} for each in self.elements.values())]
        bars += [set(pair) for pair in self.own.values() if pair not in [(each.A, each.B) for each in self.elements.values()]]
        found = Counter(point for bar in bars for point in bar)
        found.update(point for point in self.at if self.is_fixed(point))
        return {name: found[name] for name in self.at}

    def rub(self):
        """Friction in some pins and on some guides."""
        runs = Counter(run.point for run in self.runs if not (run.driven or run.block))
        pins = [name for name, bodies in self.joined().items() if bodies > 1 or (bodies == 1 and runs[name] == 1 and name in self.moving)]
        for name in self.random.permutation(pins)[: int(self.random.integers(2, 5))]:
            radius, coefficient = self.uniform(0.005, 0.02), self.uniform(0.03, 0.12)
            self.parts[f"rub{name}"] = lambda to, name=str(name), radius=radius, coefficient=coefficient: PinFriction(
                name, radius=to.length(radius), coefficient=coefficient
            )
            self.frictions[f"rub{name}"] = (str(name), radius, coefficient)
        for name in dict.fromkeys(run.point for run in self.runs):
            coefficient = self.uniform(0.03, 0.1)
            self.parts[f"slip{name}"] = lambda to, name=name, coefficient=coefficient: GuideFriction(name, coefficient=coefficient)
            self.frictions[f"slip{name}"] = (name, None, coefficient)
        self.tags.add("friction")
