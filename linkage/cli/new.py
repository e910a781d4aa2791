"""`hydrolinkage new NAME`: a commented machine to begin with, which runs at once."""

from __future__ import annotations

import re
from argparse import ArgumentParser, Namespace
from pathlib import Path
from string import Template
from typing import final

from ..disk import check_place, replacing_text
from ..errors import DefinitionError, FileError, ensure
from .command import Command

PYTHON = '''\
"""$words: `hydrolinkage show $file`, `table`, `forces`, `limits`, `capacity`, `draw $file -o $stem.png`."""

from hydraulics import Cylinder, LiftCircuit
from linkage import *
from linkage.units import minute


class $name(Mechanism):
    """A cylinder AB turns the lever OB; the load hangs at G, on the lever. Say here what your machine is."""

    # Strokes: what moves it, from start to end [m]. Everything is in SI and radians; a value times a unit is that: 80 * mm, 15 * deg.
    S = Stroke(0.00, 0.25)

    # Dimensions: numbers that several members use, or that you want to vary. unit= is the one they are shown in.
    closed = Dimension(500 * mm, unit="mm")               # pin-to-pin length of the cylinder drawn in

    # Points of the frame: x to the right, y upwards [m].
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)

    # Points that move, one line each, in any order. `OB=` is at once the link, its length and a design variable.
    # Dyad(P, Q, ...): the pin of two links that hang from P and Q, on the RIGHT or the LEFT of the way from P to Q.
    B = Dyad(A, O, AB=closed + S, OB=0.30, side=RIGHT)
    # OnLink(P, Q, ...): a point that is rigid with P and Q; BOG is the angle from OB to OG, counter-clockwise.
    G = OnLink(O, B, OG=0.90, BOG=20 * deg)

    # Outputs: what you want to see over the stroke.
    height = y(G) - 0.90

    # Loads, cylinders and what feeds them.
    load = Weight(G, mass=800)                            # kg
    lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm, closed=closed, stroke=250 * mm)
    pump = LiftCircuit(lift, pressure=180 * bar, flow=30 * litre / minute, mechanical_efficiency=0.9)

    # Load cases by name: `hydrolinkage forces $file --case transport`.
    transport = LoadCase("transport", scale={"load": 2.0})
'''

TOML = """\
# $words: `hydrolinkage show $file`, `table`, `forces`, `limits`, `capacity`, `draw $file -o $stem.png`.
# A bare number is in SI; a text with a unit is that: "500 mm", "15 deg".
name = "$name"
doc = "A cylinder AB turns the lever OB; the load hangs at G, on the lever. Say here what your machine is."

[strokes]
# What moves it, from start to end [m].
S = [0.0, 0.25]

[dimensions]
# Numbers that several members use, or that you want to vary.
closed = "500 mm"                 # pin-to-pin length of the cylinder drawn in

[ground]
# Points of the frame: x to the right, y upwards [m].
A = [0.20, 0.55]
O = [0.30, 1.15]

[points]
# Dyad: the pin of two links that hang from P and Q, on the RIGHT or the LEFT of the way from P to Q.
B = { Dyad = ["A", "O"], AB = "closed + S", OB = 0.30, side = "RIGHT" }
# OnLink: a point that is rigid with P and Q; BOG is the angle from OB to OG, counter-clockwise.
G = { OnLink = ["O", "B"], OG = 0.90, BOG = "20 deg" }

[outputs]
# What you want to see over the stroke.
height = "y(G) - 0.90"

[loads]
load = { Weight = "G", mass = 800 }             # kg

[cases]
# Load cases by name: `hydrolinkage forces $file --case transport`.
transport = { title = "transport", scale = { load = 2.0 } }

[hydraulics]
lift = { Cylinder = ["A", "B"], bore = "80 mm", rod = "45 mm", closed = "closed", stroke = "250 mm" }
pump = { LiftCircuit = "lift", pressure = "180 bar", flow = "30 l/min", mechanical_efficiency = 0.9 }
"""

TEMPLATES = {".py": PYTHON, ".toml": TOML}


@final
class NewCommand(Command):
    """Writes a template."""

    name = "new"
    help = "a commented machine to begin with, as .py or .toml, which runs at once"

    def add(self, parser: ArgumentParser) -> None:
        parser.add_argument("name", metavar="NAME", help="the machine's name, such as loader, or its file, loader.toml")
        parser.add_argument("-o", "--output", metavar="FILE", help=".py or .toml (default: NAME.py)")

    def run(self, options: Namespace) -> int:
        given = Path(options.name)
        is_file = given.suffix.lower() in TEMPLATES
        words = re.findall(r"[^\W_]+", given.stem if is_file else options.name)
        name = "".join(word[:1].upper() + word[1:] for word in words)
        ensure(name.isidentifier(), f"{options.name!r} gives no name of a class; take letters and digits, no digit first, such as loader.")
        own = given if is_file else Path(f"{'_'.join(words).lower()}.py")
        path = own if options.output is None else Path(options.output)
        if given.suffix and not is_file:
            raise DefinitionError(f"{given}: a machine's file ends in one of {', '.join(TEMPLATES)}, which chooses the form.")
        if path.suffix.lower() not in TEMPLATES:
            raise DefinitionError(f"-o {path}: the file's name ends in one of {', '.join(TEMPLATES)}, which chooses the form.")
        check_place(path)
        if path.exists():
            raise FileError(f"{path} is there already and stays as it is; choose another name, -o FILE.")
        text = Template(TEMPLATES[path.suffix.lower()]).substitute(words=" ".join(words), name=name, file=path, stem=path.stem)
        with replacing_text(path) as stream:
            stream.write(text)
        print(f"{path}: {name}, a lift arm on a cylinder to begin with. Look at it by: hydrolinkage show {path}")
        return 0
