"""The skeleton of a forestry crane: column, boom, arm and telescope, their masses, and the conditions of a good one, (2.4)-(2.18).

Angles go as in the source: phi is the boom's from the upward vertical, psi the inner one between boom and arm, 180 deg where they
are in line. Forces hold with g = 9.81 m/s2, by the load case `lifting`. Every margin is a named output [m], kept where it is not negative.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar, Literal

import numpy as np

from linkage import Column, Crank, Dimension, Featured, Ground, Link, Mechanism, Motion, OnLink, Outline, Stroke, Verdict, angle, ref
from linkage.errors import cited, ensure, require
from linkage.language import noted, said, translated
from linkage.loads import LinkMass, LoadCase, Weight
from linkage.program import FloatArray
from linkage.units import deg, kN, mm, show

GRAVITY = 9.81
"""m/s2, the source's."""
JOINT = 300.0
"""Weight of the parts at the joint of boom and arm, G_m [N] (2.24)."""
OF_DRIVE, AT_BOOM, AT_DRIVE, AT_ARM = 0.025, 0.4, 0.7, 0.45
"""The boom drive's share of the crane's mass; where the centres of gravity lie: of boom and drive in l_c, of the arm in its length."""
DOWNWARDS = (0.0, -GRAVITY)
"""m/s2, the source's gravity as load cases take it."""

GUARDS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        ">=": ("past_guard", noted("the folded tip clears the guard (2.13)")),
        "<=": ("within_guard", noted("the folded tip comes as near as the guard (2.13)")),
    }
)
"""The two readings of (2.13), whose relation sign is lost in print: each with the margin that it keeps."""

CLOSE = 1e-6
"""m: a condition missed by no more is kept."""


class CraneSkeleton(Mechanism):
    """Boom OJ, arm JK and telescope KT, turned and pushed by their strokes, on a column whose top is O.

    The origin is the foot of the column's axis on the ground, x away from it, y up. The drives move phi, psi and t: boom angle from the
    upward vertical, inner angle of boom and arm, telescope out. The members' heights b and masses W follow from the regressions
    (2.5)-(2.9), of cranes of 23.5 to 185 kN m; W_m is the mass's measure (2.4) that a skeleton is chosen by.
    """

    phi = Stroke(15 * deg, 100 * deg)                     # boom, from the upward vertical
    psi = Stroke(0 * deg, 180 * deg)                      # arm, from the boom
    t = Stroke(0.0, 2.493)                                # telescope, m

    L = Dimension(10.0, unit="m")                         # greatest reach
    M = Dimension(100 * kN, unit="kNm")                   # rated moment
    H_p, H_w = Dimension(1.1, unit="m"), Dimension(1.2, unit="m")             # platform, tool
    H_k, H_max = Dimension(2.95, unit="m"), Dimension(4.0, unit="m")          # cab, the legal height
    h_s = Dimension(2.88760963074689, unit="m")           # stakes, from the ground as all heights
    c = Dimension(0.5, unit="m")                          # column to guard
    psi_0 = Dimension(0 * deg, unit="deg")
    psi_k = Dimension(180 * deg, unit="deg")
    Q = Dimension(10 * kN, unit="kN")                     # load and tool

    l_c, l_p = Dimension(4.542413835813, unit="m"), Dimension(3.116420231283, unit="m")
    l_t = Dimension(2.493136185027, unit="m")             # boom, arm, telescope
    h_0 = Dimension(1.85, unit="m")                       # column, from the platform
    phi_0 = Dimension(20.526019274995 * deg, unit="deg")  # boom at its highest

    O = Ground(0.0, H_p + h_0)
    F = Ground(L, H_w)                                    # where the tool is set down at the whole reach
    phi_k = 90 * deg - angle(O, F)                        # boom at its lowest (2.10)
    J = Crank(O, OJ=l_c, angle=90 * deg - phi)
    K = Crank(J, JK=l_p, angle=angle(J, O) + psi)         # the arm's end
    T = OnLink(J, K, JT=l_p + t)                          # the telescope's end, with load and tool
    about = Featured("T_y", ["K", "T"])
    main_boom, arm = Link(O, J), Link(J, K)

    ground = Outline.line((-3.0, 0.0), (10.5, 0.0))       # what stands around is drawn only; its figures are illustrative
    platform = Outline([(-2.6, H_p - 0.25), (0.45, H_p - 0.25), (0.45, H_p), (-2.6, H_p)])
    wheel = Outline.circle(at=(-0.6, 0.5), radius=0.5)
    column = Outline([(-0.16, H_p), (0.16, H_p), (0.1, H_p + h_0), (-0.1, H_p + h_0)])
    stems = Outline([(-0.9, -0.95), (0.9, -0.95), (0.9, -0.6), (0.05, -0.6), (0, 0), (-0.05, -0.6), (-0.9, -0.6)], on=T)

    b_0 = 0.0352123 + 0.12889 * h_0                       # m (2.5)
    b_c = -0.236125 + 0.00257739 * L + 0.126493 * l_c + 0.295468e-6 * M       # (2.6)
    b_p = 0.0104471 + 0.0217203 * L + 0.74192e-6 * M      # (2.7)
    b_t = 0.0437195 - 0.00409106 * l_t + 0.580051 * b_p   # (2.8)
    W = -277.332 + 156.808 * L - 17.0799 * l_t**2 + 7.90261e-3 * M            # kg (2.9)
    W_m = b_0 * h_0 + b_c * l_c + b_p * l_p + b_t * l_t   # m2 (2.4)
    W_0, W_c = 0.75 * W * b_0 * h_0 / W_m, 0.75 * W * b_c * l_c / W_m         # (2.16)
    W_p, W_t = 0.75 * W * b_p * l_p / W_m, 0.75 * W * b_t * l_t / W_m

    OC = OnLink(O, J, OOC=AT_BOOM * l_c)                  # centres of gravity of the boom and of its drive
    OG = OnLink(O, J, OOG=AT_DRIVE * l_c)
    boom = Weight(OC, mass=W_c)
    drive = Weight(OG, mass=OF_DRIVE * W)
    joint = Weight(J, mass=JOINT / GRAVITY)
    root = LinkMass((J, K), mass=(1.0 - AT_ARM) * (W_p + W_t), at=(0.0, 0.0)) # arm and telescope: their centre at 0.45 JT
    end = Weight(T, mass=AT_ARM * (W_p + W_t))
    load = Weight(T, mass=Q / GRAVITY)
    lifting = LoadCase("lifting", gravity=DOWNWARDS)
    side_slope = LoadCase("on a side slope", gravity=DOWNWARDS, slope=-10 * deg)             # reaching downhill

    reach_error = l_c + l_p + l_t - np.sqrt(L**2 + (H_p + h_0 - H_w) ** 2)    # (2.10)
    over_stakes = H_p + h_0 + l_c * np.cos(phi_0) - l_p - H_w - h_s           # (2.11)
    past_guard = l_c * np.sin(phi_0) - l_p * np.sin(phi_0 - psi_0) - c        # (2.13)
    below_legal = H_max - H_p - h_0                       # (2.14)
    above_cab = H_p + h_0 - H_k                           # (2.15)
    above_load = H_p + h_0 - h_s
    within_guard = -past_guard                            # the other reading of (2.13)
    telescope_over = l_t - 0.3 * l_p                      # (2.16)
    telescope_under = 0.8 * l_p - l_t
    boom_over_arm = l_c - l_p
    arm_over_column = l_p - h_0
    boom_turns = phi_k - phi_0                            # rad

    reading: ClassVar[Literal[">=", "<="]] = ">="
    margins: ClassVar[Mapping[str, str]] = MappingProxyType(
        {
            "over_stakes": noted("the arm clears the stakes (2.11)"),
            "below_legal": noted("the column keeps the legal height (2.14)"),
            "above_cab": noted("the boom lies above the cab in transport (2.15)"),
            "above_load": noted("the boom lies above the stakes in transport (2.15)"),
            "telescope_over": noted("the telescope is at least 0.3 of the arm (2.16)"),
            "telescope_under": noted("the telescope is at most 0.8 of the arm (2.16)"),
            "boom_over_arm": noted("the boom is no shorter than the arm (2.16)"),
            "arm_over_column": noted("the arm is no shorter than the column (2.16)"),
        }
    )
    errors: ClassVar[Mapping[str, str]] = MappingProxyType(
        {"reach_error": noted("boom, arm and telescope reach L at the tool's height (2.10)")}
    )

    def __init__(self, **dimensions: Any) -> None:
        """Set the design [SI]; DefinitionError also for a boom so short that the regression (2.6) gives it no height."""
        super().__init__(**dimensions)
        heights = self.outputs("b_c", "b_t", "W")
        boom = f"b_c = {np.min(heights['b_c']) / mm:.4g} mm: a boom of l_c = {np.min(self['l_c']):.4g} m"
        ensure(np.all(heights["b_c"] > 0.0), f"{boom} is outside the regression (2.6); give a longer one, from about 1.7 m on.")
        for name in ("b_t", "W"):
            long = f"{name} is not above zero: l_t = {np.max(self['l_t']):.4g} m"
            ensure(np.all(heights[name] > 0.0), f"{long} is outside the regressions (2.8), (2.9); give a shorter telescope.")

    def columns(self, motion: Motion) -> list[Column]:
        """Return the table of results without the values of the design alone."""
        found = []
        for each in super().columns(motion):
            name = each.name if each.name in self.plan.members else each.name.removesuffix("_x").removesuffix("_y")
            found += [each] if each.name in self.strokes or not self.plan.reaches(name).isdisjoint(self.strokes) else []
        return found

    def rules(self, motion: Motion) -> list[Verdict]:
        """Return the source's conditions on the skeleton as verdicts on this design, with their spare; of a batch none."""
        return [] if any(np.ndim(value) for value in self.dimensions.values()) else self.judged()

    @classmethod
    def conditions(cls, reading: str) -> dict[str, str]:
        """Return the named margins that a skeleton has to keep, with their words.

        Parameters
        ----------
        reading : {">=", "<="}
            How (2.13) is read: ">=", the folded tip clears the guard, or "<=", it comes as near as that.

        Returns
        -------
        dict of str to str
            The words by name.
        """
        require(reading in GUARDS, "reading", reading, '(2.13) is read as ">=", the tip clears the guard, or "<=", it comes so near')
        name, words = GUARDS[reading]
        return {**cls.margins, name: words}

    def judged(self) -> list[Verdict]:
        """Return the source's conditions on the skeleton of one design, (2.10)-(2.16).

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        rules = self.conditions(self.reading)
        found = {name: float(value) for name, value in self.outputs(*self.errors, *rules).items()}
        verdicts = []
        for name, rule in {**self.errors, **rules}.items():
            value, words, ok = found[name], translated(rule), found[name] >= -CLOSE
            if name in self.errors:  # a length that should be none [m]
                ok = abs(value) <= CLOSE
                text = said("{rule}: met.", rule=words) if ok else said("{rule}: off by {gap}.", rule=words, gap=show(value, "mm", "+.1f"))
            elif ok:  # a margin [m] that is not negative
                text = said("{rule}: {spare} to spare.", rule=words, spare=show(max(value, 0.0), "mm", ".1f"))
            else:
                text = said("{rule}: {missing} are missing.", rule=words, missing=show(-value, "mm", ".1f"))
            verdicts.append(Verdict(name, bool(ok), text))
        return verdicts

    def outputs(self, *names: str) -> dict[str, FloatArray]:
        """Return named outputs that hang on the design alone [SI], such as W_m, one value a design.

        Parameters
        ----------
        *names : str
            The names.

        Returns
        -------
        dict of str to array
            The values.
        """
        motion = self.at(unreachable="nan", **{name: stroke.start for name, stroke in self.strokes.items()})
        return {name: motion[name] for name in names}

    def output(self, name: str) -> float:
        """Return a named output of one design that hangs on the design alone [SI].

        Parameters
        ----------
        name : str
            The name.

        Returns
        -------
        float
            The value.
        """
        return float(self.outputs(name)[name])

    def limits_of(self) -> dict[str, tuple[float, float]]:
        """Return how far each drive goes in this design: phi, psi [rad], t [m].

        Returns
        -------
        dict of str to tuple of float
            The ends by stroke.
        """
        psi = float(self["psi_0"]), float(self["psi_k"])
        return {"phi": (float(self["phi_0"]), self.output("phi_k")), "psi": psi, "t": (0.0, float(self["l_t"]))}

    def position(self, number: int) -> Motion:
        """Return one of the positions that the skeleton is laid out by.

        Parameters
        ----------
        number : int
            1 reaching, 2 over the stakes, 3 over the guard, 4 in transport.

        Returns
        -------
        Motion
            The pose.
        """
        ensure(number in POSITIONS, f"Position {cited(number)} is unknown; the skeleton has {', '.join(map(str, POSITIONS))}.")
        (phi_0, phi_k), (psi_0, psi_k), (t_0, t_k) = self.limits_of().values()
        poses = {1: (phi_k, psi_k, t_k), 2: (phi_0, max(phi_0, psi_0), t_0), 3: (phi_0, psi_0, t_0), 4: (90 * deg, psi_0, t_0)}
        phi, psi, t = poses[number]
        return self.at(phi=phi, psi=psi, t=t)


POSITIONS: Mapping[int, str] = {
    1: "the whole reach, the tool at its height (2.10)",
    2: "over the stakes, the arm upright (2.11)",
    3: "over the guard, the arm folded (2.13)",
    4: "in transport, the boom level (2.14), (2.15)",
}


class BackBrokenSkeleton(CraneSkeleton):
    """A crane whose arm bends backwards, psi_k above 180 deg: in transport its tool stands on the platform before the cab, (2.17), (2.18).

    Of (2.10) the length alone is kept; phi_k, psi_k and Delta, the height of the joint J over the platform in transport, are design
    variables, bound to the transport pose by `joint_error` and `tool_error`.
    """

    phi = Stroke(15 * deg, 120 * deg)
    psi = Stroke(0 * deg, 230 * deg)
    t = Stroke(0.0, 2.547)
    A_k = Dimension(6.9, unit="m")                        # column to cab: A of (2.18)
    l_c, l_p = Dimension(4.45955493536, unit="m"), Dimension(3.184829964299, unit="m")
    l_t = Dimension(2.547863971439, unit="m")
    h_0 = Dimension(2.070263193179, unit="m")
    phi_0 = Dimension(0.403067078631, unit="deg")
    phi_k = Dimension(2.053562399393, unit="deg")
    psi_k = Dimension(4.010683069459, unit="deg")
    Delta = Dimension(0.0, unit="m")                      # joint over the platform, in transport

    joint_error = h_0 + l_c * np.cos(phi_k) - Delta                    # (2.18)
    tool_error = Delta - l_p * np.cos(psi_k - phi_k) - ref("H_w")
    before_cab = A_k - l_c * np.sin(phi_k) + l_p * np.sin(phi_k - psi_k)

    margins: ClassVar[Mapping[str, str]] = MappingProxyType(
        {**CraneSkeleton.margins, "before_cab": noted("in transport the tip stands before the cab (2.18)")}
    )
    errors: ClassVar[Mapping[str, str]] = MappingProxyType(
        {
            **CraneSkeleton.errors,
            "joint_error": noted("phi_k brings the joint to Delta over the platform (2.18)"),
            "tool_error": noted("psi_k stands the tool on the platform (2.18)"),
        }
    )
