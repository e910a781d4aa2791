"""What a reader types into the search, and the page that answers it: the built pages have these words in their index.

The search of the built pages puts an entry of the index first, then pages by their titles and their kind (`scorer.js`).
"""

from __future__ import annotations

WORDS = {
    "bulk": ["numpy array", "broadcasting", "numba", "javascript", "gradient"],
    "conventions": ["slider crank"],
    "equations": ["sympy", "latex"],
    "excavator": ["excavator", "backhoe"],
    "extending": ["plugin"],
    "files": ["file", "toml"],
    "forces": ["pin forces", "center of gravity", "bearing load"],
    "header_balancer": ["header"],
    "hydraulics": ["accumulator", "pressure", "relief valve", "nitrogen", "pump power", "flow rate"],
    "index": ["install"],
    "machines_at_work": ["wheel loader"],
    "parts": ["mobility", "degrees of freedom", "assur group"],
    "performance": ["speed"],
    "redesign": ["redesign", "catalogue", "cylinder size"],
    "quickstart": ["quick start"],
    "reference": ["exception", "api"],
    "reliability": ["singular", "accuracy", "error"],
    "sketch": ["sketch", "dxf", "autocad"],
    "studies": ["tolerance", "optimise", "six-bar", "multiprocessing", "monte carlo", "sensitivity", "pareto", "genetic algorithm"],
    "theory": ["transfer ratio", "virtual work", "dynamics", "kinematics", "moment of inertia", "3d"],
    "three_point_hitch": ["three-point hitch"],
    "units_and_languages": ["translation"],
    "howto/axle_loads": ["axle load", "tipping", "stability", "wheel load", "crane outrigger"],
    "howto/barrel_and_rod": ["barrel", "weight of cylinder"],
    "howto/chart": ["load chart", "payload"],
    "howto/closed_curve": ["coupler curve", "four-bar"],
    "howto/columns": ["own columns", "dataframe"],
    "howto/cylinders": ["two cylinders"],
    "howto/duty": ["duty", "fatigue"],
    "howto/element": ["force element"],
    "howto/exact_synthesis": ["synthesis"],
    "howto/export": ["report", "drawing", "matplotlib", "csv", "excel", "pdf", "save picture"],
    "howto/forces": ["instant centre", "velocity", "free body", "free body diagram"],
    "howto/friction": ["friction", "hysteresis"],
    "howto/gas_spring": ["gas spring", "damper"],
    "howto/holding_valve": ["holding valve", "check valve", "counterbalance valve", "leak", "drift", "lock valve"],
    "howto/load_case": ["load case", "slope"],
    "howto/machine_of_parts": ["bucket", "mirror"],
    "howto/notebook": ["notebook", "jupyter"],
    "howto/page": ["undo", "live page", "gif", "animation", "zoom", "copy design"],
    "howto/places": ["level lift", "grading path"],
    "howto/planes": ["collision", "interference", "clearance"],
    "howto/reach": ["cannot be reached", "missing millimetres", "dead point", "dead center"],
    "howto/regenerative": ["regenerative"],
    "howto/rope": ["rope", "pulley", "winch"],
    "howto/side": ["side of a dyad", "wrong side"],
    "howto/telescope": ["telescope", "dump trailer"],
    "howto/units": ["units", "inches", "change language"],
    "howto/vectors": ["vector"],
}  # fmt: skip
"""By page, without .md, what is typed by designers of machines, students, programmers, and readers whose English is plain."""


def indexed(page: str, text: str) -> str:
    """Return the text of a page with its words as entries of the index, behind its title."""
    title, rest = text.split("\n", 1)
    words = ", ".join(f"! {word}" for word in WORDS.get(page, ()))
    return f"{title}\n\n```{{index}} {words}\n```\n{rest}" if words else text
