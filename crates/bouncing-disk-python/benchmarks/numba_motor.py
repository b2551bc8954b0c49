"""W2 by hand in Numba: run-ups of a motor. For the comparison only.

It is a motor whose platform turns so fast (Q = a_g^2 Phi omega^2/(a_e g) far above mu (1 + P)) that the rotor
never sticks: it slides, flies, and slides again. Angular speeds are in units of g a_e/(a_g^2 omega).
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numba_flight import TAU, first_impact, lift_off_phase, wrapped

#: Below this launch speed, in units of what the platform pulls with, the rest of a chatter is summed in
#: closed form.
SUMMED = 1e-4


@njit(cache=True, inline="always")
def random_share(state):
    """The next state of SplitMix64, and an even number in [0, 1)."""
    state = state + np.uint64(0x9E3779B97F4A7C15)
    z = state
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    z = z ^ (z >> np.uint64(31))
    return state, float(z >> np.uint64(11)) * 1.1102230246251565e-16


@njit(cache=True, inline="always")
def turn_evenly(angles, interval, time, duration, speed):
    """Books a turn at this speed; behind the last interval nothing is booked."""
    end = time + duration
    index = int(time / interval)
    while time < end and index < len(angles):
        stop = min(end, (index + 1) * interval)
        angles[index] += speed * (stop - time)
        time = stop
        index += 1


@njit(cache=True, inline="always")
def slid(speed, direction, friction, peak, sine, cosine, phase, t):
    """Speed and angle after sliding for t: q' = -direction mu (1 - P sin tau)."""
    s, c = math.sin(phase + t), math.cos(phase + t)
    pushed = t + peak * (c - cosine)
    turned = 0.5 * t * t + peak * (s - sine - t * cosine)
    return speed - direction * friction * pushed, speed * t - direction * friction * turned


@njit(cache=True)
def slide(angles, interval, time, phase, duration, speed, twist, friction, peak):
    """Books a contact without sticking, with its reversals of the slip; returns the speed at its end."""
    while duration > 0.0:
        slip = speed - twist * math.cos(phase)
        # Just after a reversal the slip goes the way in which the platform's speed moves away.
        direction = math.copysign(1.0, slip if abs(slip) > 1e-9 * twist else math.sin(phase))
        piece, reverses = duration, False
        if abs(speed) < twist:
            # The platform has the rotor's speed at these two phases; the next of them, corrected for the
            # sliding.
            at = math.acos(speed / twist)
            first, second = wrapped(at - phase), wrapped(-at - phase)
            t = min(first if first > 1e-9 else TAU, second if second > 1e-9 else TAU)
            if t < duration + 1e-2:
                sine, cosine = math.sin(phase), math.cos(phase)
                for _ in range(3):
                    q, _ = slid(speed, direction, friction, peak, sine, cosine, phase, t)
                    slope = -direction * friction * (1.0 - peak * math.sin(phase + t)) + twist * math.sin(
                        phase + t
                    )
                    t -= (q - twist * math.cos(phase + t)) / slope
                if t < duration:
                    piece, reverses = t, True
        sine, cosine = math.sin(phase), math.cos(phase)
        index = int(time / interval)
        boundary = (index + 1) * interval - time
        if piece > boundary:
            piece, reverses = boundary * (1.0 + 1e-12), False
        after, turned = slid(speed, direction, friction, peak, sine, cosine, phase, piece)
        if index < len(angles):
            angles[index] += turned
        time += piece
        phase = wrapped(phase + piece)
        duration -= piece
        speed = twist * math.cos(phase) if reverses else after
    return speed


@njit(cache=True)
def run_up(peak, twist, friction, restitution, phase, length, perturbation, seed, angles):
    """One rotor from rest on the platform; `angles` gets the turn in each interval of `length`/len(angles)."""
    lift_off = lift_off_phase(peak)
    interval = length / len(angles)
    state = np.uint64(seed)
    time, speed = 0.0, 0.0
    launch = 0.0
    resting = peak * math.sin(phase) < 1.0
    impacts = 0
    while time < length:
        if resting:
            wait = wrapped(lift_off - phase)
            speed = slide(angles, interval, time, phase, wait, speed, twist, friction, peak)
            time += wait
            phase = lift_off
            state, share = random_share(state)
            launch = perturbation * share
            resting = False
        flight, phase, velocity = first_impact(peak, lift_off, phase, launch)
        turn_evenly(angles, interval, time, flight, speed)
        time += flight
        impacts += 1
        slip = speed - twist * math.cos(phase)
        pull = 1.0 - peak * math.sin(phase)
        launch = -restitution * velocity
        impulse = friction * (1.0 + restitution) * -velocity
        if pull > 0.0 and launch < SUMMED * pull:
            # All further impacts of the chatter: a geometric series while the platform pulls evenly.
            rest = 2.0 * launch / (pull * (1.0 - restitution))
            if rest < wrapped(lift_off - phase):
                impulse /= 1.0 - restitution
                resting = True
                turn_evenly(
                    angles, interval, time, rest, speed - math.copysign(min(impulse, abs(slip)), slip)
                )
                time += rest
        speed -= math.copysign(min(impulse, abs(slip)), slip)
        if resting:
            phase = wrapped(phase + 2.0 * launch / (pull * (1.0 - restitution)))
    return impacts


@njit(cache=True)
def run_ups(peak, twist, friction, restitution, phases, length, perturbation, seeds, angles):
    """One rotor after the other; `angles` has a row for each."""
    impacts = 0
    for member in range(len(phases)):
        impacts += run_up(
            peak,
            twist,
            friction,
            restitution,
            phases[member],
            length,
            perturbation,
            seeds[member],
            angles[member],
        )
    return impacts
