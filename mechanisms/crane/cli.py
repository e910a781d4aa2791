"""`hydrolinkage crane`: from a duty to a crane in one flow, skeleton, masses, bound of moments, drives and load map, with its pictures."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from dataclasses import fields
from pathlib import Path

import numpy as np

from linkage import Column, DefinitionError, optimise
from linkage.cli.command import Command, progress_bar
from linkage.cli.table import csv_argument, write_table
from linkage.disk import check_place
from linkage.units import deg, kN, mm, parse

from . import FIGURES, crane_figure
from .duty import Duty
from .load_map import LIMITERS, LoadMap, load_map
from .machine import Crane
from .moments import arm_bound, boom_bound
from .reach import envelope
from .skeleton import CraneSkeleton
from .strength import strength_text
