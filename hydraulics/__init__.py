"""Cylinders, gas and accumulators: the drives of a linkage and the springs it rests on."""

from pathlib import Path

from linkage.language import add_catalogue
from linkage.star import declare_public

from .accumulator import Accumulator as Accumulator
from .accumulator import AccumulatorBlock as AccumulatorBlock
from .barrel import OnBarrel as OnBarrel
from .barrel import OnRod as OnRod
from .buckling import Buckling as Buckling
from .cycle import PumpCycle as PumpCycle
from .cylinders import Chamber as Chamber
from .cylinders import Cylinder as Cylinder
from .floating import FloatCircuit as FloatCircuit
from .gas import Gas as Gas
from .gas import adiabatic as adiabatic
from .gas import isothermal as isothermal
from .gas import polytropic as polytropic
from .gas import real_nitrogen as real_nitrogen
from .lift import LiftCircuit as LiftCircuit
from .lift import lift_verdicts as lift_verdicts
from .lifting_line import Holding as Holding
from .lifting_line import Lowering as Lowering
from .oil_line import OilLine as OilLine
from .pump import Pump as Pump
from .pump import Relief as Relief
from .pump import Tank as Tank
from .requests import buckling as buckling
from .requests import capacity as capacity
from .requests import fits as fits
from .requests import flow as flow
from .requests import power as power
from .requests import pressure as pressure
from .requests import rate as rate
from .requests import reserve as reserve
from .requests import thrust as thrust
from .standard_sizes import CatalogueRow as CatalogueRow
from .standard_sizes import CylinderSize as CylinderSize
from .standard_sizes import catalogue as catalogue
from .standard_sizes import next_bore as next_bore
from .standard_sizes import next_rod as next_rod
from .standard_sizes import standard_bores as standard_bores
from .standard_sizes import standard_rods as standard_rods
from .standard_sizes import standard_strokes as standard_strokes
from .telescope import Telescope as Telescope
from .valve import HoldingValve as HoldingValve
from .valve import load_pressure as load_pressure
from .valve import pilot_pressure as pilot_pressure
from .working import PumpMotion as PumpMotion

add_catalogue("hydraulics", Path(__file__).with_name("locale"))

declare_public(globals())
