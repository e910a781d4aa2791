"""How much a file may hold: enough for any machine, too little to keep a computer busy."""

from __future__ import annotations

FILE_BYTES = 1_000_000
MEMBERS = 400
LINK_POINTS = 26
LABELS = 100
EXPRESSION_LENGTH = 1_000
OPERATIONS = 100
NESTING = 40
NAME_LENGTH = 60
FAULTS_SHOWN = 20
