"""A disk that bounces on a platform which vibrates and twists.

Pizza dough on a hand and the rotor of a standing-wave ultrasonic motor obey the same equations (Liu, Friend
and Yeo, Phys. Rev. E 80, 046201 (2009)). Everything is computed by the Rust library ``bouncing-disk``, with
the same bits on every machine and for any number of threads. Arguments are keywords in SI units. A long call
calls its ``progress`` as ``progress(done, total)`` on the calling thread; an exception raised there ends the
call.

>>> import bouncing_disk as bd
>>> bd.System.pizza_toss().friction
0.6
"""

from __future__ import annotations

from bouncing_disk import (
    _attractors,
    _chaos,
    _errors,
    _estimate,
    _motor,
    _native,
    _orbits,
    _sweep,
    _system,
    _toss,
)
from bouncing_disk._attractors import *
from bouncing_disk._base import Result, set_threads, threads
from bouncing_disk._chaos import *
from bouncing_disk._errors import *
from bouncing_disk._estimate import *
from bouncing_disk._motor import *
from bouncing_disk._orbits import *
from bouncing_disk._sweep import *
from bouncing_disk._system import *
from bouncing_disk._toss import *

__version__: str = _native.VERSION

__all__ = ["Result", "set_threads", "threads"]
__all__ += _attractors.__all__
__all__ += _chaos.__all__
__all__ += _errors.__all__
__all__ += _estimate.__all__
__all__ += _motor.__all__
__all__ += _orbits.__all__
__all__ += _sweep.__all__
__all__ += _system.__all__
__all__ += _toss.__all__
