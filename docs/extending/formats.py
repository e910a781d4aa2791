"""What a package of your own brings by entry points: a kind of file, a language, a back end."""

import numpy as np

from linkage.exports import Exporter, ExportJob
from linkage.program import TEMPLATES, Dialect, Language, ProgramText


class Obj(Exporter):
    """The points of one pose as Wavefront's text: vertices in the plane z = 0."""

    suffix = ".obj"
    help = "points of a pose for viewers of meshes"

    def content(self, job: ExportJob) -> bytes:
        motion = job.motion
        places = {name: np.ravel(motion[name])[:2] for name in motion.plan.points}
        return "".join(f"# {name}\nv {x:.9g} {y:.9g} 0\n" for name, (x, y) in places.items()).encode()


class Lua(Language):
    """Lua: `function poses(d, p)` of tables that count from 1; it returns the outputs one after the other."""

    dialect = Dialect(
        {
            **TEMPLATES,
            **{name: f"math.{name}({{}})" for name in ("sqrt", "sin", "cos", "tan", "exp", "log")},
            "arctan2": "math.atan({}, {})",
            "absolute": "math.abs({})",
            "power": "({}) ^ ({})",
            "sign": "sign({})",
            "minimum": "least({}, {})",
            "maximum": "-least(-({}), -({}))",
            "pick": "({0} <= {1} and {2} or {3})",
        },
        lambda value: repr(value) if np.isfinite(value) else "(0/0)" if np.isnan(value) else f"({'-' if value < 0 else ''}math.huge)",
        "local {} = {}",
    )
    words = "and break do else elseif end false for function goto if in local math nil not or repeat return then true until while"

    def element(self, array: str, place: int) -> str:
        return f"{array}[{place + 1}]"

    def function(self, program: ProgramText) -> list[str]:
        return [
            f"-- {program.comment}",
            "local function least(a, b) if a <= b or a ~= a then return a else return b end end",
            "local function sign(a) if a > 0 then return 1.0 elseif a < 0 then return -1.0 else return a end end",
            f"function {program.name}(d, p)",
            *(f"    {line}" for line in program.design),
            *(f"    local i{k} = p[{k + 1}]" for k in range(program.strokes)),
            *(f"    {line}" for line in program.lines),
            f"    return {', '.join(program.outputs)}",
            "end",
        ]
