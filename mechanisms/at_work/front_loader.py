"""The front loader of the classic linkages at work: where it runs, loaded and empty. Figures: illustrative."""

from __future__ import annotations

from linkage import LoadCase, Over

from ..classics.front_loader import FrontLoader


class LoadedFrontLoader(FrontLoader):
    """The self-levelling front loader with two cylinders KL and two cylinders MT: 800 kg in the bucket, which the parallelograms carry.

    `lifting` takes the load up with the bucket level, `dumping` tips it out, `returning` comes down empty.
    """

    empty = LoadCase("empty", scale={"load": 0.0})
    lifting = Over.path(lift=[0.0, 0.6], tilt=0.0, cases=["plain"])
    dumping = Over.path(lift=0.6, tilt=[0.0, 0.30], cases=["plain"])
    returning = Over.path(lift=[0.6, 0.0], tilt=0.0, cases=["empty"])
