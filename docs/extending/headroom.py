"""A member with a verdict of its own: a point stays below a roof."""

from linkage import Verdict, most, y
from linkage.motion import HasVerdicts


class Headroom(HasVerdicts):
    """A point stays below a roof, over all that the machine runs: `roof = Headroom("T", height=2.4)`, in metres."""

    kind = "headroom"

    def __init__(self, point, height):
        self.point, self.height = point, height

    def parts(self):
        return (self.point,)

    def conditions(self, judge):
        return {"headroom": most(y(self.point)) <= self.height}

    def questions(self, judge):
        return list(self.conditions(judge).values())

    def verdicts(self, judge):
        (highest,) = judge.answers(self.questions(judge))
        remedy = "" if highest.ok else "; lower the pivot, shorten the arm or hold the stroke back"
        text = f"{self.point} rises to {highest}, the roof stands at {self.height:g} m{remedy}."
        return [Verdict("headroom", highest.ok, text, answer=highest)]
