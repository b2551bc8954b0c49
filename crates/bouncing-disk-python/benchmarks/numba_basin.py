"""W3 by hand in Numba: what becomes of each start on a grid of impacts. For the comparison only."""

from __future__ import annotations

import math

from numba import njit
from numba_flight import HALF_PI, TAU, first_impact, lift_off_phase

UNDECIDED, ATTACHED, CAUGHT = 0, 1, 2
#: Below this impact speed a disk has come to rest.
AT_REST = 1e-12


@njit(cache=True)
def surely_rests(peak, lift_off, angle, speed, restitution):
    """Whether a disk that is launched like this comes to rest before the platform falls away from it.

    Over the next `reach` the platform pulls with `least` to `most`; a flight then takes at most 2
    speed/least, and ends at most 2 most/least - 1 times as fast as it began.
    """
    pull = 1.0 - peak * math.sin(angle)
    if pull <= 0.0:
        return False
    reach = 6.0 * speed / (pull * (1.0 - restitution))
    until = lift_off - angle if angle < lift_off else lift_off + TAU - angle
    if reach >= until:
        return False
    other = 1.0 - peak * math.sin(angle + reach)
    least, most = min(pull, other), max(pull, other)
    if angle < 3.0 * HALF_PI < angle + reach:
        most = 1.0 + peak
    if least <= 0.0:
        return False
    ratio = restitution * (2.0 * most / least - 1.0)
    return ratio < 1.0 and 2.0 * speed / least <= reach * (1.0 - ratio)


@njit(cache=True)
def basin(peak, restitution, phases, speeds, orbit_phases, orbit_velocities, radius, most, prove, labels):
    """The label of each cell; `prove`: by `surely_rests`, else a disk is followed down to `AT_REST`."""
    lift_off = lift_off_phase(peak)
    for row in range(len(speeds)):
        for column in range(len(phases)):
            angle, velocity = phases[column], -math.pi * speeds[row]
            label = UNDECIDED
            for _ in range(most + 1):
                if velocity > -AT_REST and peak * math.sin(angle) < 1.0:
                    label = ATTACHED
                    break
                if prove and surely_rests(peak, lift_off, angle, -restitution * velocity, restitution):
                    label = ATTACHED
                    break
                for k in range(len(orbit_phases)):
                    turned = angle - orbit_phases[k]
                    turned -= TAU * round(turned / TAU)
                    faster = (velocity - orbit_velocities[k]) / peak
                    if turned * turned + faster * faster <= radius * radius:
                        label = CAUGHT
                        break
                if label != UNDECIDED:
                    break
                _, angle, velocity = first_impact(peak, lift_off, angle, -restitution * velocity)
            labels[row, column] = label
