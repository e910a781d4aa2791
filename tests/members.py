"""What members of a machine say, without the verdicts on all the rest of it, which take their time."""

from linkage.motion.motion_verdicts import HasVerdicts, speakers


def told_by(machine, *names, over=None):
    """Return the verdicts of some members of a design, by their names; of all that speak without names."""
    judge = machine.judge(over).lost_allowed()
    return [verdict for name in names or speakers(machine.plan, HasVerdicts) for verdict in machine.plan.members[name].verdicts(judge)]
