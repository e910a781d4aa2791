"""What no stroke drives stands still: a pivot is the frame's however it is spelled, and a part's stroke may be a number."""

from numpy.testing import assert_allclose

from hydraulics import Cylinder, thrust
from linkage import RIGHT, Crank, Dimension, Dyad, Ground, Guide, Mechanism, OnGuide, OnLink, Part, Stroke, Weight, deg, mm, pin_forces
from tests.for_all import for_all


class Boom(Mechanism):
    """A boom whose pivot is a fixed point."""

    S = Stroke(0.0, 0.3)
    J, O, A = Ground(0.0, 0.0), Ground(0.0, 1.0), Ground(0.3, 0.2)
    B = Dyad(A, O, AB=0.75 + S, OB=0.6, side=RIGHT)
    G = OnLink(O, B, OG=1.5)
    load = Weight(G, mass=400.0)
    ram = Cylinder(A, B, bore=80 * mm, rod=45 * mm)


class OnPost(Boom):
    """It stands at a height on a post through a named point."""

    post = Guide("J", angle=90 * deg)
    O = OnGuide(post, at=1.0)


class OnTrack(Boom):
    """The same on a track that is given by coordinates."""

    track = Guide((0.0, 0.0), angle=90 * deg)
    O = OnGuide(track, at=1.0)


class Tilted(Boom):
    """It is the end of two arms at an angle that is a dimension."""

    tilt = Dimension(90 * deg, unit="deg")
    M = Crank("J", JM=0.5, angle=tilt)
    O = Crank(M, MO=0.5, angle=180 * deg - tilt)


@for_all("machine", [OnPost, OnTrack, Tilted])
def test_a_pivot_that_nothing_drives_is_one_of_the_frame(machine):
    wanted, found = Boom().sweep(5), machine().sweep(5)
    assert (machine().freedom.gruebler, machine().mobility, len(machine().links)) == (1, 1, 2) and not machine().freedom.loose
    assert_allclose(found[thrust("ram")], wanted[thrust("ram")], rtol=1e-12)
    assert_allclose(machine().evaluate([thrust("ram")], S=[0.0, 0.2]), Boom().evaluate([thrust("ram")], S=[0.0, 0.2]), rtol=1e-12)
    assert_allclose(pin_forces(found).force("O"), pin_forces(wanted).force("O"), rtol=1e-10)


class Flap(Mechanism):
    """A flap on a lug or on a carriage; a stroke turns it."""

    q = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    tilt = Dimension(40 * deg, unit="deg")
    X = Crank(O, OX=0.5, angle=tilt)
    Y = Crank(X, XY=0.3, angle=q)
    load = Weight(Y, mass=100.0)


class OnRail(Flap):
    """The same on a rail at a place that is a number."""

    rail = Guide("O", angle=40 * deg)
    tilt = None
    X = OnGuide(rail, at=0.5)


class Carries(Boom):
    """The boom with a flap that is not moved."""

    flap = Part(Flap, q=0.2, on=("G", "O"))


class CarriesRail(Boom):
    """The same on a rail."""

    flap = Part(OnRail, q=0.2, on=("G", "O"))


class Flat(Boom):
    """The same, typed flat."""

    X = OnLink("G", "O", GX=0.5, OGX=40 * deg)
    Y = OnLink(X, "G", XY=0.3, GXY=180 * deg - 40 * deg + 0.2)
    second = Weight(Y, mass=100.0)


@for_all("machine", [Carries, CarriesRail])
def test_a_part_whose_stroke_is_a_number_is_one_body_with_what_carries_it(machine):
    carries, flat = machine(), Flat()
    assert (carries.freedom.gruebler, len(carries.links)) == (flat.freedom.gruebler, len(flat.links)) == (1, 2)
    assert_allclose(carries.sweep(5)[thrust("ram")], flat.sweep(5)[thrust("ram")], rtol=1e-12)
    assert_allclose(pin_forces(carries.sweep(5)).force("O"), pin_forces(flat.sweep(5)).force("O"), rtol=1e-10)
