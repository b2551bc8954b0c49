"""A disk that bounces on a platform which vibrates and twists.

Pizza dough on a hand and the rotor of a standing-wave ultrasonic motor obey the same equations (Liu, Friend and
Yeo, Phys. Rev. E 80, 046201 (2009)). Everything is computed by the Rust library ``bouncing-disk``, with the same
bits on every machine and for any number of threads. Arguments are keywords in SI units.
"""

from __future__ import annotations

__all__: list[str] = []
