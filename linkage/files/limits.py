"""How much a file may hold: enough for any machine, too little to keep a computer busy."""

from __future__ import annotations

FILE_BYTES = 1_000_000
TOML_LINE = 5_000  # characters: a dotted key as long as a file takes the parser's memory by its square
MEMBERS = 400
SKETCHED = 100  # members that stand in a sketch: assembling them takes time by the cube
LINKS = 200
LINK_POINTS = 26
LABELS = 100
EXPRESSION_LENGTH = 1_000
OPERATIONS = 100
NESTING = 40
NAME_LENGTH = 60
FAULTS_SHOWN = 20
