"""Contacts that take time: the table of docs/contacts-and-stators.md by the law of the force alone, in small steps (`equations.py`)."""

import math
import pathlib
import re

import numpy as np
import pytest

import bouncing_disk as bd
from equations import soft_motor, spring
from test_judge import PAPER, TURN, of_sheet

PAGE = (pathlib.Path(__file__).parents[2] / "docs" / "contacts-and-stators.md").read_text("utf-8")
NUMBER = r"(-?\d+\.\d+) ± (\d+\.\d+)"
ROWS = re.findall(rf"^\| (\d\S*?)(, flights)? \| {NUMBER} \| {NUMBER} \| {NUMBER} \| {NUMBER} \|", PAGE, re.MULTILINE)
LAGS = (0.0, -math.pi / 2)


@pytest.mark.parametrize("restitution", [0.05, 0.2, 0.5, 0.95])
def test_a_contact_lasts_and_keeps_what_it_shall(restitution):
    k, c = spring(3.0, restitution)
    assert abs(3 * c + 2 * math.log(restitution)) < 1e-6
    if c < 2 * math.sqrt(k):
        angle = math.acos(c / (2 * math.sqrt(k)))
        assert abs(3 * math.sqrt(k) * math.sin(angle) - 2 * angle) < 1e-6


def small_steps(contact_periods, flights, seconds, members):
    """Speeds at both lags and their errors: of the mean over starts, and half of what rotors that were slower and faster still differ by."""
    (P, Q, restitution, _, _), unit = of_sheet(PAPER)
    k, c = spring(TURN * contact_periods, restitution)
    lags, speeds = np.repeat(LAGS, 2), Q * np.array([0.0, 1.0, 0.0, 1.0])
    settling, periods = (PAPER.drive_frequency * time for time in seconds)
    step = TURN / (1000 if contact_periods > 0.6 else 2000 if contact_periods > 0.1 else 4000)
    runs = [soft_motor(P, Q, k, c, lags, speeds, settling, periods, 1, step, seed, flights)[:, 0] for seed in range(members)]
    runs = unit * np.array(runs).reshape(members, 2, 2)
    scatter = runs.mean(2).std(0, ddof=1) / math.sqrt(members)
    return runs.mean((0, 2)), np.hypot(scatter, np.ptp(runs.mean(0), axis=1) / 2)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0] + row[1])
def test_the_table_of_the_page(row):
    contact_periods, flights, (*numbers,) = float(row[0]), row[1] != "", map(float, row[2:])
    printed = np.array(numbers).reshape(4, 2)
    long = flights or contact_periods < 0.55
    found, errors = small_steps(contact_periods, flights, (3.0, 6.0) if long else (4.0, 0.5), 6 if long else 2)
    for lag, library, ours, value, error in zip(LAGS, printed[:2], printed[2:], found, errors):
        assert abs(ours[0] - value) <= 3 * math.hypot(ours[1], error), (lag, ours, value, error)
        assert abs(library[0] - value) <= 3 * math.hypot(library[1], error), (lag, library, value, error)
        if not flights:
            motor = PAPER.replace(phase_lag=lag)
            point = bd.torque_speed_curve(motor, load_torques=[0.0], contact_time=contact_periods / motor.drive_frequency,
                                          relative_error=0.02, members=4, most_impacts=4_000_000)
            assert abs(point.speed[0] - value) <= 3 * math.hypot(point.speed_error[0], error, 0.003), (lag, point.speed, value, error)


def test_the_table_has_its_rows():
    assert len(ROWS) == 10
