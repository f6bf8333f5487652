# SPDX-License-Identifier: MIT
"""peri: deformation and fracture of solids by nonlocal bonds (peridynamics).

    import peri

    with peri.Body(space="plane_stress", horizon=1.5e-3) as pane:
        pane.add_material("bond_based", young=72e9, density=2440, fracture_energy=3.8)
        pane.add_box([0, 0], [0.1, 0.04], spacing=0.5e-3)
        pane.build()
        ...

Names are those of peri.h without "peri_"; enums may be given by name, as "plane_stress". Errors are PeriError and its kin.
"""
from __future__ import annotations

import builtins as _builtins

from ._body import Body, Cracks, Matrix
from ._core import PeriError
from ._fields import LiveField
from ._generated import *  # noqa: F401,F403
from ._generated import VERSION as __version__
from ._generated import __all__ as _names
from ._world import World

__all__ = ["Body", "Cracks", "Matrix", "World", "LiveField", "PeriError"] + [n for n in _names if not hasattr(_builtins, n)]
