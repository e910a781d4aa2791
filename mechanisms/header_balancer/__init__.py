"""Header balancing of a forage harvester with gas accumulators: the machine, its headers, its criteria, its figures.

Source: Rekhlitski, Chuprynin, "Mathematical description of the balancing system of the adapters of a mobile forage
harvester with a hydropneumatic accumulator" (2013). The paper prints no geometry: the dimensions are illustrative.
"""

from .charge import WAYS as WAYS
from .charge import Way as Way
from .charge import charge_for as charge_for
from .charge import largest_charge as largest_charge
from .criteria import criteria as criteria
from .figures import figure as figure
from .following import over_following as over_following
from .following import relief as relief
from .headers import HEADERS as HEADERS
from .machine import HeaderBalancer as HeaderBalancer
from .machine import ImprovedBalancer as ImprovedBalancer
from .measured import deviations as deviations
from .measured import read_measured as read_measured
from .settings import setting_table as setting_table
from .settings import with_header as with_header
