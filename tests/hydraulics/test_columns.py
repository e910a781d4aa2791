"""What a table shows of a machine's cylinders: thrust and pressure of each, gaps where there is none."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit, isothermal
from linkage import Crank, Dyad, Ground, Mechanism, OnLink, PinFriction, Stroke, Weight, deg
from linkage.files import load, to_toml
from linkage.motion import Column, Motion, Tabled
from linkage.reports import results
from linkage.units import MPa, bar, kN, litre
from linkage.vectors import RIGHT
from mechanisms.three_point_hitch import ThreePointHitch

GRAVITY = 9.80665


class Boom(Mechanism):
    phi = Stroke(-80 * deg, 60 * deg)
    O, A = Ground(0.0, 1.0), Ground(0.5, 0.2)
    B = Crank(O, OB=0.8, angle=phi)
    T = OnLink(O, B, OT=2.0)
    load = Weight(T, mass=200)
    lift = Cylinder(A, B, bore=0.08, rod=0.045)


class Digger(Boom):
    psi = Stroke(-150 * deg, -30 * deg)
    C = OnLink("O", "B", OC=3.0)
    D = OnLink("O", "B", OD=2.0, BOD=15 * deg)
    E = Crank(C, CE=0.5, angle=Boom.phi + psi + 160 * deg)
    G = OnLink(C, E, CG=2.0, ECG=-160 * deg)
    bucket = Weight(G, mass=100)
    arm = Cylinder(D, E, bore=0.07, rod=0.04, works="both")
    pump = LiftCircuit(arm, pressure=180 * bar, mechanical_efficiency=0.9, hydraulic_efficiency=0.95)


def shown(machine, motion):
    return {column.name: column for column in results(machine, motion)}


def test_a_cylinder_beside_a_crank_shows_its_own_thrust_and_pressure():
    motion = Boom().at(phi=np.linspace(-0.6, 1.0, 9))
    columns = shown(Boom(), motion)
    assert list(columns)[-3:] == ["torque", "thrust", "pressure"]
    assert [columns[name].heading for name in ("torque", "thrust", "pressure")] == ["torque, Nm", "thrust, kN", "pressure, bar"]
    (ax, ay), (ox, oy), (bx, by) = (motion[name] for name in "AOB")
    arm = ((bx - ox) * (by - ay) - (by - oy) * (bx - ax)) / np.hypot(bx - ax, by - ay)  # of the thrust about O
    thrust = 200 * GRAVITY * (motion.x("T") - ox) / arm
    assert_allclose(columns["thrust"].values, thrust, rtol=1e-12)
    assert_allclose(columns["thrust"].shown, thrust / kN, rtol=1e-12)
    assert_allclose(columns["pressure"].shown, np.maximum(thrust, 0.0) / (np.pi / 4 * 0.08**2) / bar, rtol=1e-12)


def test_dead_points_and_poses_out_of_reach_are_gaps():
    dead = float(np.arctan2(-0.8, 0.5))
    columns = shown(Boom(), Boom().at(phi=[dead, 0.3]))
    assert np.isnan(columns["thrust"].values).tolist() == [True, False]
    assert np.isnan(columns["pressure"].values).tolist() == [True, False]
    assert np.isfinite(columns["torque"].values).all()

    class Lift(Mechanism):
        S = Stroke(0.0, 0.25)
        A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
        B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=RIGHT)
        load = Weight(B, mass=100)
        lift = Cylinder(A, B, bore=0.08, rod=0.045)

    columns = shown(Lift(), Lift().at(S=[0.1, 0.9], unreachable="nan"))
    assert_allclose(columns["thrust"].values, columns["drive force"].values)  # the stroke is that of the cylinder
    for name in ("thrust", "pressure", "drive force"):
        assert np.isnan(columns[name].values).tolist() == [False, True]


def test_several_cylinders_have_their_names():
    motion = Digger().sweep(phi=3, psi=4)
    columns = shown(Digger(), motion)
    names = ["torque phi", "torque psi", "thrust lift", "pressure lift", "thrust arm", "pressure arm", "reserve arm"]
    assert sorted(list(columns)[-7:]) == sorted(names)  # only the one on a pump has a reserve
    for name in ("lift", "arm"):
        cylinder = Digger.plan.members[name]
        assert_allclose(columns[f"thrust {name}"].values, cylinder.thrust(motion))
        assert_allclose(columns[f"pressure {name}"].values, cylinder.pressure(motion))
    assert columns["pressure arm"].values.shape == (3, 4)


def test_the_pressure_is_the_circuits_and_missing_where_several_have_the_cylinder():
    class Pumped(Boom):
        rub = PinFriction("O", radius=0.03, coefficient=0.1)
        pump = LiftCircuit("lift", pressure=18 * MPa, mechanical_efficiency=0.85)

    class Twice(Pumped):
        spare = LiftCircuit("lift", pressure=12 * MPa)

    motion = Pumped().at(phi=[-0.5, 0.0, 0.5])
    columns = shown(Pumped(), motion)
    assert_allclose(columns["pressure"].values, Pumped.plan.members["pump"].pressure_for(motion))
    assert (columns["pressure"].values > columns["thrust"].values / (np.pi / 4 * 0.08**2)).all()  # efficiency and friction
    assert list(shown(Twice(), Twice().at(phi=[-0.5, 0.0, 0.5])))[-2:] == ["torque", "thrust"]


def test_a_gas_fed_cylinder_shows_the_line():
    class Floating(Boom):
        lift = Cylinder("A", "B", bore=0.06, rod=0.04)
        line = FloatCircuit(lift, AccumulatorBlock([Accumulator(2 * litre, 30 * bar)], isothermal), charge_pressure=60 * bar, at=0.0)

    motion = Floating().at(phi=[-0.4, 0.0, 0.4])
    columns = shown(Floating(), motion)
    line = Floating.plan.members["line"]
    assert_allclose(columns["pressure"].values, line.pressure(motion))
    assert_allclose(columns["pressure"].values[1], 60 * bar, rtol=1e-12)
    assert_allclose(columns["thrust"].values, line.pressure(motion) * np.pi / 4 * 0.06**2)


def test_without_loads_and_with_a_table_of_its_own_nothing_is_added():
    class Bare(Boom):
        load = None

    motion = Bare().at(phi=[0.0, 0.1])
    assert [each.name for each in results(Bare(), motion)] == [each.name for each in Bare().columns(motion)]
    hitch = ThreePointHitch()
    assert [each.name for each in results(hitch, hitch.sweep(3))] == [each.name for each in hitch.columns(hitch.sweep(3))]
    again = load(to_toml(ThreePointHitch))()
    assert [each.name for each in results(again, again.sweep(3))][-4:] == ["drive force", "thrust", "pressure", "reserve"]


def test_any_member_may_have_columns():
    class Marked(Weight, Tabled):  # type: ignore[misc]
        """A user's own member."""

        def columns(self, motion: Motion) -> list[Column]:
            return [Column("height", motion.y(self.point), "mm", 0)]

    class Own(Boom):
        load = Marked("T", mass=100)

    class Two(Own):
        other = Marked("B", mass=50)

    motion = Own().at(phi=[0.0, 0.3])
    assert_allclose(shown(Own(), motion)["height"].values, motion.y("T"))
    assert {"height load", "height other"} <= set(shown(Two(), Two().at(phi=[0.0, 0.3])))


@pytest.mark.parametrize("count", [1, 3])
def test_batches_of_designs_are_shown_too(count):
    machine = Boom(**{"load.mass": np.linspace(100.0, 300.0, count)})
    columns = shown(machine, machine.at(phi=[0.0, 0.2]))
    assert columns["thrust"].values.shape == (count, 2)
    assert_allclose(columns["thrust"].values[-1] / columns["thrust"].values[0], 3.0 if count > 1 else 1.0)
