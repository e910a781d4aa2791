"""`hydrolinkage export`, `save`, `new`: a machine for another program, as a mechanism file, and a template to begin with."""

from __future__ import annotations

import re
from argparse import Namespace, _ActionsContainer
from pathlib import Path
from string import Template

import numpy as np

from .. import plugins
from ..disk import check_place, replacing_text
from ..errors import FileError, ensure
from ..motion import Motion
from .command import Command, count_option, default_name, machine_options, option, repeatable, whole_number
from .settings import ALONG, machine_of, strokes_or_motion, tell_gaps

OWN_FORMATS = ("xlsx", "csv", "dxf", "svg", "points", "linkage2", "pmks")


def declare_format(parser: _ActionsContainer) -> None:
    """Declare the option that names a format, those that packages bring among them."""
    formats = ", ".join([*OWN_FORMATS, *plugins.entry_points(plugins.EXPORTERS)])
    parser.add_argument("--format", metavar="NAME", help=f"{formats}: one of them, whatever the file's name ends in")


@Command(
    "export",
    "a workbook with live formulas (.xlsx), a table (.csv), a true-size drawing (.dxf, .svg), or a file of Linkage or PMKS",
    *machine_options(),
    option("-o", "--output", metavar="FILE", help=".xlsx, .csv, .dxf, .svg, .linkage2, .txt (default: NAME.xlsx)"),
    declare_format,
    count_option(101, "poses over the stroke"),
    repeatable(
        "--at",
        "S=0.6",
        "hold a stroke at a value; in a workbook the one with two values runs between them: S=0.1,650mm; in a drawing each value "
        "is a pose on layers of its own; repeatable",
        "strokes",
    ),
    option("--poses", metavar="N", type=whole_number, help="a drawing of so many poses over the first stroke"),
    repeatable("--path", "G", "draw this point's path; repeatable"),
    ALONG,
)
def export_command(options: Namespace) -> int:
    """Write a file for another program."""
    machine = machine_of(options)
    from ..exports import ExportJob, export, exporter_of

    exporter = exporter_of(Path(options.output or "x.xlsx"), options.format)
    is_fit = options.over is None or not exporter.of_machines
    ensure(is_fit, f"--over {options.over}: {exporter.of_machines}; hold strokes by --at, S=0.1,0.6.")
    path = Path(default_name(options, machine) + exporter.suffix if options.output is None else options.output)
    check_place(path)
    found = strokes_or_motion(machine, options)
    if isinstance(found, Motion):
        ensure(options.poses is None, f"--over {options.over}: a motion has its poses; leave out --poses, or give --count.")
        print(export(found, path, format=options.format, trace=options.path))
        return 0
    at = dict(found)
    if options.poses is not None:
        first = next((name for name in machine.strokes if name not in at), None)
        if first is not None:
            at[first] = np.linspace(machine.strokes[first].start, machine.strokes[first].end, options.poses)
    tell_gaps(exporter.poses(ExportJob(machine, path.name, at, options.count, options.path, ())))
    print(export(machine, path, format=options.format, at=at, count=options.count, trace=options.path))
    return 0


@Command(
    "save",
    "a machine, as it is set, as a file in TOML or JSON",
    *machine_options(),
    option("file", metavar="FILE", help="the file, named .toml or .json"),
)
def save_command(options: Namespace) -> int:
    """Write a machine into a file, and say which parts such a file does not hold."""
    from ..files import left_out, save

    machine = machine_of(options)
    save(machine, options.file)
    lost = ", ".join(left_out(machine))
    print(f"{options.file}: the linkage with {len(machine.plan.members)} members.")
    if lost:
        print(f"Not in it, since a file holds no functions of a class: {lost}.")
    return 0


TEMPLATES = (".py", ".toml")
"""Each stands beside this file."""


@Command(
    "new",
    "a commented machine to begin with, as .py or .toml, which runs at once",
    option("name", metavar="NAME", help="the machine's name, such as loader, or its file, loader.toml"),
    option("-o", "--output", metavar="FILE", help=".py or .toml (default: NAME.py)"),
)
def new_command(options: Namespace) -> int:
    """Write a template."""
    given = Path(options.name)
    is_file = given.suffix.lower() in TEMPLATES
    words = re.findall(r"[^\W_]+", given.stem if is_file else options.name)
    name = "".join(word[:1].upper() + word[1:] for word in words)
    ensure(name.isidentifier(), f"{options.name!r} gives no name of a class; take letters and digits, no digit first, such as loader.")
    own = given if is_file else Path(f"{'_'.join(words).lower()}.py")
    path = own if options.output is None else Path(options.output)
    ensure(not given.suffix or is_file, f"{given}: a machine's file ends in one of {', '.join(TEMPLATES)}, which chooses the form.")
    ensure(path.suffix.lower() in TEMPLATES, f"-o {path}: the file's name ends in one of {', '.join(TEMPLATES)}, which chooses the form.")
    check_place(path)
    if path.exists():
        raise FileError(f"{path} is there already and stays as it is; choose another name, -o FILE.")
    template = Template((Path(__file__).parent / f"new_machine{path.suffix.lower()}.txt").read_text(encoding="utf-8"))
    text = template.substitute(words=" ".join(words), name=name, file=path, stem=path.stem)
    with replacing_text(path) as stream:
        stream.write(text)
    print(f"{path}: {name}, a lift arm on a cylinder to begin with. Look at it by: hydrolinkage show {path}")
    return 0
