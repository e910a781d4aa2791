"""`hydrolinkage import`: a drawing, a table of points or another program's file becomes a machine."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from ..disk import check_place, is_one_file, replacing_text
from ..errors import DefinitionError, ensure
from ..units import parse
from .command import Command, option, repeatable, say_remark
from .settings import has_unit, pair, span_said


@Command(
    "import",
    "a drawing, a table of points, or a file of the board, Linkage, PMKS, PMKS+ or pylinkage as a machine",
    option("file", metavar="FILE", help=".csv, .linkage2, .txt, .json, .dxf, or a share address of PMKS or PMKS+ in quotes"),
    option("-o", "--output", metavar="FILE", help=".toml or .py, .json (board), .csv, .linkage2, .txt (PMKS) (default NAME.toml)"),
    option("--scale", metavar="1mm", help="what 1 of the file is, where it has no unit or another one is meant"),
    option(
        "--drive",
        nargs=2,
        action="append",
        default=[],
        metavar=("O", "A[=90deg]"),
        help="a crank: a fixed pin, and a pin of the link that turns about it, and how far; back and forwards: A=-20:40deg",
    ),
    option(
        "--cylinder",
        nargs=2,
        action="append",
        default=[],
        metavar=("A", "B[=300mm]"),
        help="a cylinder between two pins, and how far it goes out; or its lengths, B=900:1400mm",
    ),
    option("--round", metavar="1mm", help="round lengths and angles, and tell what moves by how much"),
    repeatable("--layer", "pins=Bolts", "the layer of pins, links, ground, slides, crank or cylinder of a drawing; repeatable", "layers"),
)
def import_command(options: Namespace) -> int:
    """Read a file, look whether it assembles, and write the machine."""
    from ..sketch import read_sketch, sketch_text
    from ..sketch.foreign_files import SUFFIXES, is_address

    scale = None if options.scale is None else parse(options.scale, "length")
    layers: dict[str, list[str]] = {}
    for text in options.layers:
        role, name = pair(text, "--layer", "pins=Bolts")
        layers.setdefault(role, []).append(name)
    drives, cylinders = [drive_said(ends, "angle") for ends in options.drive], [drive_said(ends, "length") for ends in options.cylinder]
    found = read_sketch(options.file, scale=scale, drives=drives, cylinders=cylinders, layers=layers)
    if options.round is not None:
        found = found.rounded(parse(options.round, "length"))
    for note in found.notes:
        say_remark(note)
    own = found.name.lower() if is_address(options.file) else Path(options.file).stem
    path = Path(f"{own}.toml" if options.output is None else options.output)
    check_place(path)
    ensure(not is_one_file(path, options.file), f"{path} is the file that is imported and stays as it is; choose another name, -o FILE.")
    is_free = not path.exists() or (options.output is not None and path.suffix.lower() not in SUFFIXES)
    ensure(is_free, f"{path} is there already and stays as it is; choose another name, -o FILE.")
    try:
        machine = found.to_class()
    except DefinitionError as error:  # nothing is written that one could look at
        links = "; ".join(" ".join(points) for points in found.links.values())
        read = f"What was read: fixed {' '.join(found.fixed) or 'nothing'}; links {links or 'none'}"
        raise type(error)(f"{error} {read}; drives {'; '.join(' '.join(each.ends) for each in found.drives.values()) or 'none'}.") from None
    text = sketch_text(found, path.suffix.lower())
    sizes = found.weights or any(drive.bore for drive in found.drives.values())
    if path.suffix.lower() not in (".toml", ".py") and (found.forces or (sizes and path.suffix.lower() != ".json")):
        say_remark(f"{path} has no word for {'forces' if found.forces else 'weights, bores and rods'}; they are left out.")
    with replacing_text(path) as stream:
        stream.write(text)
    print(f"{path}: {machine.__name__}, points: {len(found.points)}, links: {len(found.links)}. Look at it by: hydrolinkage show {path}")
    return 0


def drive_said(ends: list[str], kind: str) -> tuple[str | float, ...]:
    """Return the ends of a drive, and how far it goes where the second says it, such as `B=300mm` or `B=-20:300mm`."""
    name, given, amounts = ends[1].partition("=")
    example = f"{name}={'300mm' if kind == 'length' else '90deg'}"
    ensure(not given or has_unit(amounts), f"{' '.join(ends)}: say the unit too, such as {example}.")
    return (ends[0], name, *(span_said(amounts, kind, f"{ends[0]} {name}") if given else ()))
