"""The disk of Liu, Friend and Yeo (2009) from the equations alone, slowly and without a trick.

Time in units of 1/omega, length in g/omega^2, angular speed in mu a_e g/(a_g^2 omega): the platform has the height P sin(tau), P = pi Gamma,
and the angular speed Q cos(tau + theta). Nothing here shares code or method with the libraries of this repository. `physics(math)` compiles
these functions for doubles, `physics(mpmath)` gives the same ones in as many digits as mpmath works with.
"""

import math
from types import SimpleNamespace

import mpmath
import numba
import numpy as np


def physics(m):
    """First impact, impact map and its derivative with the mathematics of the module `m`, `math` or `mpmath`."""
    compiled = numba.njit if m is math else (lambda function: function)
    sin, cos, sqrt, asin = m.sin, m.cos, m.sqrt, m.asin
    turn, eps = (2 * math.pi, 2.0**-53) if m is math else (2 * mpmath.pi, mpmath.mpf(10) ** -mpmath.mp.dps)

    @compiled
    def gap(P, tau, w, h):
        """Gap over h, h after a launch at phase tau with relative speed w; small h do not cancel."""
        if abs(h) < 1e-2:
            curl = h**2 / 6 - h**4 / 120 + h**6 / 5040 - h**8 / 362880 + h**10 / 39916800
        else:
            curl = 1 - sin(h) / h
        return w - h / 2 + P * (2 * sin(tau) * sin(h / 2) ** 2 / h + cos(tau) * curl)

    @compiled
    def slope(P, tau, w, h):
        """Relative velocity after the time h."""
        return w + P * cos(tau) - h - P * cos(tau + h)

    @compiled
    def bisect(P, tau, w, low, high, of_slope):
        """The change of sign in (low, high) of the gap, from above, or of the slope, from below."""
        while True:
            middle = (low + high) / 2
            if middle <= low or middle >= high or high - low < eps * high:
                return high
            if (slope(P, tau, w, middle) < 0) if of_slope else (gap(P, tau, w, middle) > 0):
                low = middle
            else:
                high = middle

    @compiled
    def flight(P, tau, w):
        """Time of the first impact. Between two inflections of the gap it is convex or concave, so that no root is missed."""
        launch, rise = w + P * cos(tau), P * (1 - sin(tau))
        above = launch * launch - 2 * rise
        # While the disk is higher than the crest nothing can happen.
        skip_from, skip_to = (launch - sqrt(above), launch + sqrt(above)) if above > 0 and launch > 0 else (-1.0, -1.0)
        inflection = asin(1 / P) if P > 1 else 0.0
        low = 0 * w
        while True:
            if skip_from <= low < skip_to:
                low = skip_to
            high = low + 8 * (launch + sqrt(launch * launch + 4 * P) + 1)
            if P > 1:
                for angle in (inflection, turn / 2 - inflection):
                    ahead = (angle - tau - low) % turn
                    ahead = ahead if ahead > 1e-12 else ahead + turn
                    high = min(high, low + ahead)
            if low < skip_from < high:
                high = skip_from
            if P > 1 and sin(tau + (low + high) / 2) * P > 1:
                if slope(P, tau, w, low) < 0 < slope(P, tau, w, high):
                    lowest = bisect(P, tau, w, low, high, True)
                    if gap(P, tau, w, lowest) <= 0:
                        high = lowest
            if gap(P, tau, w, high) <= 0:
                return bisect(P, tau, w, low, high, False)
            low = high

    @compiled
    def step(P, r, tau, v):
        """Phase and speed of the next impact after one at phase tau with relative speed v, and the time of flight."""
        h = flight(P, tau, r * v)
        return (tau + h) % turn, -slope(P, tau, r * v, h), h

    @compiled
    def derivative(P, r, tau, v, h):
        """Of the next (phase, speed) after (tau, v), rows of the Jacobian one after the other."""
        fall = slope(P, tau, r * v, h)
        h_tau, h_v = P * (sin(tau) * h + cos(tau + h) - cos(tau)) / fall, -h * r / fall
        push = P * sin(tau + h)
        return 1 + h_tau, h_v, P * sin(tau) + h_tau - push * (1 + h_tau), h_v - r - push * h_v

    return SimpleNamespace(flight=flight, step=step, derivative=derivative, gap=gap, slope=slope)


DOUBLES = physics(math)
flight, gap, slope, step, derivative = DOUBLES.flight, DOUBLES.gap, DOUBLES.slope, DOUBLES.step, DOUBLES.derivative


@numba.njit
def fate(P, r, tau, v, impacts):
    """Impacts up to the first rest (-1 of a disk that bounces on), the last phase and speed, and the log growth of a perturbation."""
    x, y, growth = 1.0, 0.3, 0.0
    for n in range(impacts):
        if r * v < 1e-11 and P * math.sin(tau) < 1:
            return n, tau, v, growth
        old, speed = tau, v
        tau, v, h = step(P, r, tau, v)
        a, b, c, d = derivative(P, r, old, speed, h)
        x, y = a * x + b * y, c * x + d * y
        length = math.sqrt(x * x + y * y)
        growth += math.log(length)
        x, y = x / length, y / length
    return -1, tau, v, growth


def refine(P, r, orbit, digits=40):
    """Newton's method in `digits` digits from a list of (tau, v): the periodic orbit there and its multipliers; None if it finds none."""
    with mpmath.workdps(digits):
        M, n = physics(mpmath), len(orbit)
        P, r = mpmath.mpf(P), mpmath.mpf(r)
        points = mpmath.matrix([mpmath.mpf(value) for pair in orbit for value in pair])
        for _ in range(100):
            equations, jacobian, round_trip = mpmath.zeros(2 * n, 1), mpmath.zeros(2 * n), mpmath.eye(2)
            for k in range(n):
                tau, v, after = points[2 * k], points[2 * k + 1], 2 * (k + 1) % (2 * n)
                if v <= 0:
                    return None
                h = M.flight(P, tau, r * v)
                turns = (tau + h - points[after]) / (2 * mpmath.pi)
                equations[2 * k] = 2 * mpmath.pi * (turns - mpmath.nint(turns))
                equations[2 * k + 1] = -M.slope(P, tau, r * v, h) - points[after + 1]
                block = mpmath.matrix(2, 2)
                block[0, 0], block[0, 1], block[1, 0], block[1, 1] = M.derivative(P, r, tau, v, h)
                round_trip = block * round_trip
                for i in range(2):
                    for j in range(2):
                        jacobian[2 * k + i, 2 * k + j] += block[i, j]
                    jacobian[2 * k + i, after + i] -= 1
            try:
                change = mpmath.lu_solve(jacobian, equations)
            except ZeroDivisionError:
                return None
            points -= change
            if mpmath.norm(change) < mpmath.mpf(10) ** (10 - digits):
                orbit = [(points[2 * k] % (2 * mpmath.pi), points[2 * k + 1]) for k in range(n)]
                return orbit, sorted(mpmath.eig(round_trip)[0], key=abs)
    return None


@numba.njit
def motor(P, Q, r, theta, load, periods, kick, seed, windows):
    """Mean angular speed in each of equal windows of a rotor that starts at rest on the platform; relaunches get a speed below `kick`."""
    np.random.seed(seed)
    tau, w, q, now, end = 2 * math.pi * np.random.random(), 0.0, 0.0, 0.0, periods * 2 * math.pi
    means = np.zeros(windows)
    width = end / windows
    attached = True
    while now < end:
        if attached:
            # Coulomb friction in steps of 1/1000 rad, the last one before the normal force vanishes.
            dt, force = 1e-3, 1 - P * math.sin(tau)
            if force <= 0:
                attached, w = False, kick * np.random.random()
                continue
            platform, needed = Q * math.cos(tau + theta), load - Q * math.sin(tau + theta)
            before = q
            if abs(q - platform) <= (abs(needed) + force + load) * dt and abs(needed) <= force:
                q = Q * math.cos(tau + dt + theta)
            else:
                q -= (math.copysign(force, q - platform) + load) * dt
            means[min(int(now / width), windows - 1)] += (before + q) / 2 * dt
            tau, now = (tau + dt) % (2 * math.pi), now + dt
            continue
        h = flight(P, tau, w)
        speed = -slope(P, tau, w, h)
        # A flight that crosses windows is shared among them.
        time = now
        while time < now + h:
            window = min(int(time / width + 1e-12), windows - 1)
            until = now + h if window == windows - 1 else min(now + h, (window + 1) * width)
            means[window] += (until - time) * (q - load * ((time + until) / 2 - now))
            time = until
        now, tau, q = now + h, (tau + h) % (2 * math.pi), q - load * h
        slip, most = q - Q * math.cos(tau + theta), (1 + r) * speed
        q -= min(max(slip, -most), most)
        w = r * speed
        attached = w < 1e-9 and P * math.sin(tau) < 1
    return means / width


@numba.njit
def impact_of(damping):
    """Duration and restitution of an impact of speed 1 on a spring of stiffness 1 with this damper, up to the zero of its force."""
    y, v, t, h = 0.0, -1.0, 0.0, 1e-4
    while True:
        # The classical fourth-order step of y'' = -y - damping y'.
        a, b = y, v
        dy, dv = 0.0, 0.0
        for share, weight in ((0.5, 1 / 6), (0.5, 1 / 3), (1.0, 1 / 3), (0.0, 1 / 6)):
            force = -a - damping * b
            dy, dv = dy + weight * h * b, dv + weight * h * force
            a, b = y + share * h * b, v + share * h * force
        before, after = -y - damping * v, -(y + dy) - damping * (v + dv)
        if after <= 0:
            left = before / (before - after)
            return t + left * h, v + left * dv
        y, v, t = y + dy, v + dv, t + h


def spring(contact_time, restitution):
    """Stiffness and damping of the contact that lasts so long (rad) and keeps this share of the speed, by halving."""
    low, high = 0.0, 50.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if impact_of(middle)[1] > restitution else (low, middle)
    root = impact_of(low)[0] / contact_time
    return root * root, low * root


@numba.njit
def press(P, k, c, tau, y, v, h):
    """Gap and relative velocity after a step of fourth order in contact: y'' = P sin(tau) - 1 - k y - c y'."""
    middle, end = P * math.sin(tau + h / 2) - 1, P * math.sin(tau + h) - 1
    a1 = P * math.sin(tau) - 1 - k * y - c * v
    v2 = v + h / 2 * a1
    a2 = middle - k * (y + h / 2 * v) - c * v2
    v3 = v + h / 2 * a2
    a3 = middle - k * (y + h / 2 * v2) - c * v3
    v4 = v + h * a3
    a4 = end - k * (y + h * v3) - c * v4
    return y + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


@numba.njit
def slack(P, k, c, tau, y, v, h):
    """Whether after the time h of a flight the gap is still negative, and the force would still be."""
    after = y + h * gap(P, tau, v, h)
    return after <= 0 and k * after + c * slope(P, tau, v, h) >= 0


@numba.njit
def soft_motor(P, Q, k, c, lags, q, settling, periods, windows, step, seed, only_flights):
    """Mean speed in each of equal windows of rotors on one vertical motion, by steps of at most `step` in contact.

    They have these lags, and the speeds `q` at first. With `only_flights` a motion that has lost its long flights (none of ten periods
    in 200 touches) starts anew, and all else goes on from the last of them.
    """
    np.random.seed(seed)
    width, now, end = periods / windows * 2 * math.pi, -settling * 2 * math.pi, periods * 2 * math.pi
    sums, q = np.zeros((len(q) + 1, windows)), q.copy()
    kept_sums, kept_q, kept_now, short, flying, anew = sums.copy(), q.copy(), now, 0, 0.0, True
    while now < end:
        if anew:
            tau, y, v, anew = 2 * math.pi * np.random.random(), 0.0, P * (0.2 + 0.8 * np.random.random()), False
        force, before, impulse = -k * y - c * v, q.copy(), 0.0
        if y >= 0 and v > 0:
            h = flight(P, tau, v)
            y, v, flying = 0.0, slope(P, tau, v, h), flying + h
        elif force <= 0:
            # Not free, and not yet in flight: the gap is negative. The end is where the gap closes or the force sets in again.
            low, h = 0.0, step
            while not slack(P, k, c, tau, y, v, h) and h - low > 1e-9:
                low, h = (low, (low + h) / 2) if not slack(P, k, c, tau, y, v, (low + h) / 2) else ((low + h) / 2, h)
            y, v = y + h * gap(P, tau, v, h), slope(P, tau, v, h)
        else:
            if flying > 0:
                short += 1
                if flying > 20 * math.pi:
                    kept_sums[:], kept_q[:], kept_now, short = sums, q, now, 0
                flying = 0.0
                if only_flights and short == 200:
                    sums[:], q[:], now, short, anew = kept_sums, kept_q, kept_now, 0, True
                    continue
            h = step
            after, w = press(P, k, c, tau, y, v, h)
            for _ in range(8):
                if k * after + c * w <= 0 or h <= 1e-9:
                    break
                h = max(h * force / (force + k * after + c * w), 1e-9)
                after, w = press(P, k, c, tau, y, v, h)
            # The force is 1 + x''.
            impulse = max(w - v + P * (math.cos(tau + h) - math.cos(tau)) + h, 0.0)
            y, v = after, w
            for rotor in range(len(q)):
                first = q[rotor] - Q * math.cos(tau + lags[rotor])
                push = -math.copysign(impulse, first)
                last = q[rotor] + push - Q * math.cos(tau + h + lags[rotor])
                if first * last >= 0:
                    q[rotor] += push
                elif abs(Q * math.sin(tau + h / 2 + lags[rotor])) * h <= impulse:
                    q[rotor] = Q * math.cos(tau + h + lags[rotor])
                else:
                    q[rotor] += push * (2 * first / (first - last) - 1)
        if now >= 0:
            window = min(int(now / width), windows - 1)
            sums[:-1, window] += (before + q) / 2 * h
            sums[-1, window] += h
        tau, now = (tau + h) % (2 * math.pi), now + h
    return sums[:-1] / sums[-1]
