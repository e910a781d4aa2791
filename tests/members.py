"""What members of a machine say, without the verdicts on all the rest of it, which take their time; what a page's file holds."""

import re
from zlib import decompress

from linkage.motion.motion_verdicts import HasVerdicts, speakers


def told_by(machine, *names, over=None):
    """Return the verdicts of some members of a design, by their names; of all that speak without names."""
    judge = machine.judge(over).lost_allowed()
    return [verdict for name in names or speakers(machine.plan, HasVerdicts) for verdict in machine.plan.members[name].verdicts(judge)]


def unpacked(page, name):
    """Return a part of a page's text as it was packed: eleven letters are nine bytes."""
    (text,) = re.findall(rf'<script id="{name}" type="text/plain">(.*?)</script>', page, re.DOTALL)
    digits = [28 if letter == "~" else ord(letter) - 32 for letter in text.ljust(-(-len(text) // 11) * 11, "}")]
    numbers = [sum(digit * 94 ** (10 - k) for k, digit in enumerate(digits[start : start + 11])) for start in range(0, len(digits), 11)]
    return decompress(b"".join(number.to_bytes(9, "big") for number in numbers)[: 9 * len(text) // 11]).decode()
