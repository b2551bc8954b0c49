"""The unit in masters that others wrote: FMPy and PathSim. BOUNCING_DISK is the program that packs it."""

import math
import os
import subprocess
import warnings

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

PROGRAM = os.environ["BOUNCING_DISK"]

# Table III with 0.3 N and a larger contact radius, which settles sooner, on a stator of 50 g in volts.
VOLTS = """
drive_frequency = 70e3
peak_angular_speed = 30.0
mass = 0.033
rotor_radius = 0.01
contact_radius = 5e-3
preload_force = 0.3
friction = 0.1
restitution = 0.5
[stator]
mass = 0.05
quality = 300
resonance = 70e3
anti_resonance = 70.4e3
capacitance = 1.2e-9
volts = 10.0
"""


def packed(folder, sheet, *options):
    source, unit = folder / "motor.toml", folder / "motor.fmu"
    source.write_text(sheet)
    subprocess.run([PROGRAM, "motor", "fmu", source, "--out", unit, "--force", *options], check=True)
    return unit


@pytest.fixture(scope="module")
def unit(tmp_path_factory):
    return packed(tmp_path_factory.mktemp("unit"), VOLTS)


def test_the_unit_is_valid(unit):
    assert validate_fmu(str(unit)) == []
    description = read_model_description(str(unit), validate=True)
    assert description.coSimulation.canGetAndSetFMUstate
    causality = {variable.name: variable.causality for variable in description.modelVariables}
    assert causality["stator.volts"] == causality["load_torque"] == "input"
    assert causality["stator.mass"] == causality["friction"] == causality["seed"] == "parameter"
    assert causality["angle"] == causality["current"] == "output"


def run(unit, step, changes, stop, **parameters):
    """Angle at steps, under inputs that change: rows of time, load torque and drive_on."""
    names = [("time", float), ("load_torque", float), ("drive_on", float)]
    signal = np.array(changes, dtype=names) if changes else None
    return simulate_fmu(
        str(unit),
        stop_time=stop,
        output_interval=step,
        step_size=step,
        input=signal,
        start_values=parameters,
        output=["angle", "speed", "shaft_torque", "vibration_amplitude", "current", "power"],
    )


def test_steps_do_not_matter(unit):
    coarse, fine = (run(unit, step, [], 1.0, load_torque=1e-5) for step in (0.125, 2.0**-10))
    for name in ("angle", "speed", "vibration_amplitude", "current"):
        assert coarse[name][-1] == fine[name][-1], name
    assert coarse["speed"][-1] > 1 and 0 < coarse["power"][-1] < 1


def test_a_load_step_and_a_stop_are_those_of_the_library(unit, tmp_path):
    # FMPy interpolates inputs between rows; two rows at one time are a step.
    torque, changes = 2e-5, []
    for at, load, on in ((0.0, 0.0, 1.0), (0.5, torque, 1.0), (1.0, torque, 0.0)):
        if changes:
            changes.append((at, *changes[-1][1:]))
        changes.append((at, load, on))
    known = run(unit, 0.05, changes, 1.5)
    table = f"[load]\nspeeds = [0.0]\ntorques = [{torque}]\ntimes = [0.0, 0.5]\nfactors = [0.0, 1.0]\non = 0.0\noff = 1.0\n"
    (tmp_path / "loaded.toml").write_text(VOLTS + table)
    out = tmp_path / "run.csv"
    command = [PROGRAM, "motor", "transient", tmp_path / "loaded.toml", "--members", "24", "--duration", "1.5"]
    subprocess.run([*command, "--intervals", "30", "--out", out], check=True)
    rows = np.genfromtxt(out, delimiter=",", names=True, skip_header=1)
    members = [rows[rows["member"] == member + 1]["speed_rad_s"] for member in range(24)]
    mean, spread = np.mean(members, axis=0), np.std(members, axis=0, ddof=1)
    speeds = np.diff(known["angle"]) / np.diff(known["time"])
    # One run more, and the error of the mean; the drive off brakes it to a stand.
    assert np.all(np.abs(speeds - mean) < 4 * spread * math.sqrt(1 + 1 / 24) + 0.02 * mean.max())
    assert abs(known["speed"][-1]) < 0.1 < known["speed"][8] and known["vibration_amplitude"][-1] < 1e-9
    assert np.isclose(known["shaft_torque"][-1], 0.0, atol=3e-5)


def test_parameters_instances_and_stored_states(unit):
    description = read_model_description(str(unit))
    place = extract(str(unit))
    references = {variable.name: variable.valueReference for variable in description.modelVariables}

    def instance(name, token=description.instantiationToken, messages=None):
        def say(environment, status, category, message):
            messages.append(message.decode())

        slave = FMU3Slave(
            guid=token,
            unzipDirectory=place,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        options = {} if messages is None else {"logMessage": say}
        slave.instantiate(**options)
        return slave

    def started(slave, **values):
        slave.enterInitializationMode()
        for name, value in values.items():
            slave.setFloat64([references[name]], [value])
        slave.exitInitializationMode()
        return slave

    one, other = started(instance("one")), started(instance("other"), friction=0.2)
    angle = lambda slave: slave.getFloat64([references["angle"]])[0]
    for slave in (one, other):
        slave.doStep(0.0, 0.1)
    assert angle(one) != angle(other) > 0
    state = one.getFMUState()
    one.doStep(0.1, 0.1)
    end = angle(one)
    one.setFMUState(state)
    one.doStep(0.1, 0.1)
    assert angle(one) == end
    one.freeFMUState(state)
    other.doStep(0.1, 0.1)
    for slave in (one, other):
        slave.terminate()
        slave.freeInstance()

    messages = []
    wrong = instance("wrong", messages=messages)
    with pytest.raises(Exception):
        started(wrong, friction=-1.0)
    assert any("friction = -1" in message for message in messages)
    wrong.freeInstance()
    with pytest.raises(Exception):
        instance("foreign", token="{other}", messages=messages)
    assert any("token" in message for message in messages)


def test_a_fan_behind_a_gear_in_pathsim(unit, tmp_path):
    warnings.simplefilter("ignore")
    from pathsim import Connection, Simulation
    from pathsim.blocks import CoSimulationFMU, Function, Scope

    # The fan turns four times as fast and takes 2 uN m at 40 rad/s.
    gear, rated, torque = 4.0, 40.0, 2e-6
    step = 2.0**-10
    motor = CoSimulationFMU(str(unit), dt=step)
    load = Function(lambda speed: gear * torque * (gear * speed / rated) * abs(gear * speed / rated))
    scope = Scope(labels=["angle"])
    names = motor.inputs._mapping
    start = {variable.name: float(variable.start) for variable in motor.fmu_wrapper.model_description.modelVariables if variable.causality == "input"}
    from pathsim.blocks import Constant

    others = [Constant(start[name]) for name in names if name != "load_torque"]
    wires = [Connection(source, motor[name]) for source, name in zip(others, (name for name in names if name != "load_torque"))]
    wires += [Connection(motor["speed"], load), Connection(load, motor["load_torque"]), Connection(motor["angle"], scope)]
    Simulation([motor, load, scope, *others], wires, dt=step, log=False).run(6.0)
    times, (angles,) = scope.read()
    late = np.searchsorted(times, 2.0)
    speed = (angles[-1] - angles[late]) / (times[-1] - times[late])

    # The same fan as seen from the motor, as a table.
    shares = np.linspace(-1, 1, 15)
    speeds, torques = shares * rated / gear * 3, gear * torque * 9 * shares * np.abs(shares)
    table = f"[load]\nspeeds = {speeds.tolist()}\ntorques = {torques.tolist()}\n"
    sheet, out = tmp_path / "fan.toml", tmp_path / "fan.csv"
    sheet.write_text(VOLTS + table)
    command = [PROGRAM, "motor", "curve", sheet, "--loads", "0:1e-9:2", "--relative-error", "0.02", "--no-spread"]
    subprocess.run([*command, "--out", out], check=True)
    known = np.genfromtxt(out, delimiter=",", names=True, skip_header=1)["speed_rad_s"][0]
    assert abs(speed - known) < 0.05 * known, (speed, known)
