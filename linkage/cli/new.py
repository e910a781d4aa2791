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

SUFFIXES = (".py", ".toml")
"""Each has a template beside this file."""


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
        is_file = given.suffix.lower() in SUFFIXES
        words = re.findall(r"[^\W_]+", given.stem if is_file else options.name)
        name = "".join(word[:1].upper() + word[1:] for word in words)
        ensure(name.isidentifier(), f"{options.name!r} gives no name of a class; take letters and digits, no digit first, such as loader.")
        own = given if is_file else Path(f"{'_'.join(words).lower()}.py")
        path = own if options.output is None else Path(options.output)
        if given.suffix and not is_file:
            raise DefinitionError(f"{given}: a machine's file ends in one of {', '.join(SUFFIXES)}, which chooses the form.")
        if path.suffix.lower() not in SUFFIXES:
            raise DefinitionError(f"-o {path}: the file's name ends in one of {', '.join(SUFFIXES)}, which chooses the form.")
        check_place(path)
        if path.exists():
            raise FileError(f"{path} is there already and stays as it is; choose another name, -o FILE.")
        template = Template((Path(__file__).parent / f"new_machine{path.suffix.lower()}.txt").read_text(encoding="utf-8"))
        text = template.substitute(words=" ".join(words), name=name, file=path, stem=path.stem)
        with replacing_text(path) as stream:
            stream.write(text)
        print(f"{path}: {name}, a lift arm on a cylinder to begin with. Look at it by: hydrolinkage show {path}")
        return 0
