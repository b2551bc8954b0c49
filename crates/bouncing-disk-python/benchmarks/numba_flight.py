"""Eq. 11 by hand in Numba: the first impact of a flight, and the impact map. For the comparison only.

Times are in radians of the platform's phase, lengths in g/omega^2, speeds in g/omega; `peak` is P = pi Gamma.
As fast as its author could make it while it finds the same first impacts as the library:

* A disk is hit before the first crest (phase pi/2) that it does not clear. If it clears the next one, it
  falls freely to the height of the crests, in closed form, and then is hit before the one after.
* Between the phases asin(1/P) and pi - asin(1/P) the gap is convex, elsewhere concave: a piece holds one root
  that is known from the signs at its ends, or two, if a convex one dips.
* A short flight is a root of gap(h)/h in a power series, which needs no sine; the others are found by
  Halley's method, inside of a bracket.
"""

from __future__ import annotations

import math

from numba import njit

TAU = 2.0 * math.pi
HALF_PI = 0.5 * math.pi
#: The longest flight that the power series is good for, to the last digits.
SHORT = 0.25


@njit(cache=True, inline="always")
def wrapped(angle):
    """The angle in [0, 2 pi)."""
    turned = angle - TAU * math.floor(angle / TAU)
    return turned if turned < TAU else 0.0


@njit(cache=True, inline="always")
def short_form(h, speed, sine, cosine):
    """gap(h)/h and its derivative, where `sine` and `cosine` have the factor P."""
    h2 = h * h
    # (1 - cos h)/h and (h - sin h)/h, and the derivatives of both.
    versine = 0.5 * h * (1.0 - h2 / 12.0 * (1.0 - h2 / 30.0 * (1.0 - h2 / 56.0 * (1.0 - h2 / 90.0))))
    deficit = h2 / 6.0 * (1.0 - h2 / 20.0 * (1.0 - h2 / 42.0 * (1.0 - h2 / 72.0 * (1.0 - h2 / 110.0))))
    value = speed - 0.5 * h + sine * versine + cosine * deficit
    slope = -0.5 + 0.5 * sine * (1.0 - 0.25 * h2) + cosine * h / 3.0
    return value, slope


@njit(cache=True, inline="always")
def root_between(low, high, guess, peak, height, speed, angle):
    """The root of height + speed t - t^2/2 - P sin(angle + t) between `low` and `high`, where it falls from +
    to -.

    The only one there. Returns the time and the cosine of the phase.
    """
    t = guess
    cosine = 0.0
    for _ in range(60):
        sine, cosine = math.sin(angle + t), math.cos(angle + t)
        value = height + t * (speed - 0.5 * t) - peak * sine
        slope = speed - t - peak * cosine
        if value > 0.0:
            low = t
        else:
            high = t
        step = math.inf
        if slope < 0.0:
            newton = value / slope
            damped = 1.0 - 0.5 * newton * (peak * sine - 1.0) / slope
            step = newton / damped if damped > 0.5 else newton
        if abs(step) <= 1e-6 * (1.0 + t):
            # Third order: what is left is below the rounding. The cosine goes along.
            return t - step, cosine + step * (sine - 0.5 * step * cosine)
        following = t - step
        t = following if low < following < high else 0.5 * (low + high)
        if high - low <= 2e-16 * (1.0 + high):
            break
    return t, math.cos(angle + t)


@njit(cache=True)
def dip(low, high, peak, height, speed, angle):
    """The end of a bracket of the first root of a convex piece that falls, then rises; -1 without a root."""
    for _ in range(100):
        t = 0.5 * (low + high)
        sine = math.sin(angle + t)
        if height + t * (speed - 0.5 * t) - peak * sine <= 0.0:
            return t
        if speed - t - peak * math.cos(angle + t) < 0.0:
            low = t
        else:
            high = t
        if high - low <= 1e-13 * (1.0 + high):
            break
    return -1.0


@njit(cache=True)
def root_before_crest(peak, lift_off, height, speed, angle, crest, at_start):
    """The first root before the crest that comes `crest` after `angle`; -1 if there is none.

    `height`, `speed` as of `root_between`; `at_start`: whether the time 0 is itself a root, from which the
    disk rises. Returns the time and the cosine of the phase.
    """
    start, inflection = 0.0, 0.0
    if peak > 1.0:
        inflection = crest - (HALF_PI - lift_off)
        retention = math.pi - lift_off
        if HALF_PI < angle < retention:
            # Convex until pi - asin(1/P). A disk that rises relative to the platform goes on doing so.
            end = retention - angle
            if not at_start:
                if height + end * (speed - 0.5 * end) <= 1.0:
                    return root_between(0.0, end, 0.0, peak, height, speed, angle)
                first = speed - peak * math.cos(angle)
                last = speed - end + peak * math.cos(lift_off)
                if first < 0.0 < last:
                    high = dip(0.0, end, peak, height, speed, angle)
                    if high > 0.0:
                        return root_between(0.0, high, 0.0, peak, height, speed, angle)
            start = end
    else:
        inflection = crest
    # A launch where the platform begins to fall away has no concave piece, whatever rounding says.
    if inflection > 1e-12 and height + inflection * (speed - 0.5 * inflection) <= (
        1.0 if peak > 1.0 else peak
    ):
        # Concave: from the end Newton's steps stay on one side; the parabola of the launch is nearer if it is
        # inside.
        guess = inflection
        if at_start:
            pull = 1.0 - peak * math.sin(angle)
            parabola = 2.0 * (speed - peak * math.cos(angle)) / pull if pull > 0.0 else inflection
            if start < parabola < inflection:
                guess = parabola
        return root_between(start, inflection, guess, peak, height, speed, angle)
    low = max(inflection, start)
    if low >= crest:
        return -1.0, 0.0
    if height + crest * (speed - 0.5 * crest) <= peak:
        return root_between(low, crest, low, peak, height, speed, angle)
    # Convex, and above at both ends: a dip, if it falls at first and rises at last, and its tangents meet
    # below zero.
    first = speed - low - peak * math.cos(angle + low)
    last = speed - crest
    if first < 0.0 < last:
        gap_low = height + low * (speed - 0.5 * low) - peak * math.sin(angle + low)
        gap_high = height + crest * (speed - 0.5 * crest) - peak
        meet = (gap_high - gap_low - last * (crest - low)) / (first - last)
        if gap_low + first * meet <= 0.0:
            high = dip(low, crest, peak, height, speed, angle)
            if high > 0.0:
                return root_between(low, high, low, peak, height, speed, angle)
    return -1.0, 0.0


@njit(cache=True)
def first_impact(peak, lift_off, angle, speed):
    """The first impact after a launch at this phase with this relative speed: duration, phase, relative
    velocity.

    `lift_off` is asin(1/P) where P > 1.
    """
    sine, cosine = peak * math.sin(angle), peak * math.cos(angle)
    crest = HALF_PI - angle
    if crest <= 0.0:
        crest += TAU
    pull = 1.0 - sine
    # Concave until asin(1/P): the power series has one root, and it is ours if it lies before.
    if pull > 0.0 and speed < 0.5 * SHORT * pull:
        end = crest - (HALF_PI - lift_off) if peak > 1.0 else crest
        h = 2.0 * speed / pull
        found = False
        for _ in range(8):
            value, slope = short_form(h, speed, sine, cosine)
            step = value / slope
            h -= step
            if not 0.0 < h < SHORT:
                break
            if abs(step) <= 1e-9 * h:
                found = True
                break
        if found and h < end:
            h2 = h * h
            one_less = 0.5 * h2 * (1.0 - h2 / 12.0 * (1.0 - h2 / 30.0 * (1.0 - h2 / 56.0)))
            sin_h = h * (1.0 - h2 / 6.0 * (1.0 - h2 / 20.0 * (1.0 - h2 / 42.0 * (1.0 - h2 / 72.0))))
            velocity = speed - h + cosine * one_less + sine * sin_h
            return h, wrapped(angle + h), min(velocity, 0.0)
    disk_speed = speed + cosine
    # The disk clears every crest before the one that it finds it below.
    before, cos_before = root_before_crest(peak, lift_off, sine, disk_speed, angle, crest, True)
    if before >= 0.0:
        return before, wrapped(angle + before), disk_speed - before - peak * cos_before
    fall = math.sqrt(max(disk_speed * disk_speed - 2.0 * (peak - sine), 0.0))
    free = disk_speed + fall
    at = wrapped(angle + free)
    crest = HALF_PI - at
    if crest <= 0.0:
        crest += TAU
    after, cos_after = root_before_crest(peak, lift_off, peak, -fall, at, crest, False)
    return free + after, wrapped(at + after), -fall - after - peak * cos_after


@njit(cache=True, inline="always")
def lift_off_phase(peak):
    """asin(1/P), where the platform begins to fall away from the disk; 0 where it never does."""
    return math.asin(1.0 / peak) if peak > 1.0 else 0.0
