"""Drive trains for tests: one with everything in it."""

from typing import Any

from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.text.document import parse
from support.machines import loaded

EVERYTHING = """\
kind: drivetrain
name: Everything
description: every key of every part, each at least once
gravity: 9.81 m/s^2
effects: {elasticity: auto, backlash: on}
inertias:
  motor: {inertia: 1.2 kg*m^2, position: 10 deg}
  hub:
    body: {type: coupling, mass: 30 kg, diameter: 400 mm, shape: 0.5}
  wheel:
    body: {type: solid, mass: 80 kg, diameter: 500 mm}
  flywheel:
    body: {type: hollow, mass: 120 kg, outer_diameter: 800 mm, inner_diameter: 600 mm}
  rim:
    body: {type: ring, mass: 40 kg, mean_diameter: 700 mm}
  drum:
    body:
      type: drum
      outer_diameter: 400 mm
      inner_diameter: 360 mm
      length: 1100 mm
      disc_thickness: 20 mm
      shaft_diameter: 90 mm
      density: 7850 kg/m^3
  sheave:
    body:
      type: sheave
      rings:
        - {outer_radius: 250 mm, inner_radius: 220 mm, width: 60 mm}
        - {outer_radius: 80 mm, inner_radius: 0 mm, width: 70 mm}
      density: 7200 kg/m^3
  arm:
    body: {type: rod, mass: 20 kg, length: 900 mm, position: radial, distance: 100 mm}
  bar:
    body: {type: rod, mass: 12 kg, length: 500 mm, position: parallel, distance: 200 mm, radius: 20 mm}
  strut:
    body: {type: rod, mass: 12 kg, length: 500 mm, position: inclined, angle: 30 deg}
  hook: {mass: 200 kg, position: 1 m}
  load: {mass: 2 t, speed: 0 m/s}
  table: {inertia: 5 kg*m^2, speed: 0 rpm}
links:
  gap_link:
    between: [motor, hub]
    stiffness: 30 kN*m/rad
    damping: 20 N*m*s/rad
    gap: 0.4 deg
    law: clamped
    start: driving
    limit: 5 kN*m
  toothed:
    between: [hub, wheel]
    stiffness: 60 kN*m/rad
    clearance:
      centre_distance: 250 mm
      accuracy_class: 3
      pitch_radius: 80 mm
      module: 4 mm
      wear: 0.6 mm
      both_worn: false
      kind: open_gear
  measured:
    between: [wheel, flywheel]
    stiffness: 60 kN*m/rad
    clearance: {value: 0.4 mm, pitch_radius: 100 mm}
    law: kelvin
  hertz:
    between: [flywheel, rim]
    stiffness: 80 kN*m/rad
    gap: 0.2 deg
    law: hunt_crossley
    dissipation: 0.1
    exponent: 1.5
  claw:
    between: [sheave, arm]
    gap: 2 deg
    law: rigid
    restitution: 0.3
  rope:
    between: [hook, load]
    stiffness: 400 kN/m
    damping: 4 kN*s/m
    slack: 10 mm
    preload: 2 kN
  anchor:
    between: [ground, bar]
    stiffness: 5 kN*m/rad
    damping: 10 N*m*s/rad
gears:
  stage: {from: rim, to: drum, ratio: 8, efficiency: 0.94, reverse_efficiency: 0.92}
  winding: {from: drum, to: hook, radius: 200 mm}
  bevel: {from: rim, to: sheave, ratio: -2}
  tie: {from: bar, to: strut, ratio: 1}
brakes:
  holding:
    at: motor
    torque: 300 N*m
    static_ratio: 1.2
    delay: 0.1 s
    rise_time: 0.1 s
    rise: exponential
    applied: always
    below: 20 rpm
  clutch: {at: table, against: arm, torque: 40 N*m, rise: linear, applied: when_stopping}
motors:
  main:
    at: motor
    motor:
      type: induction
      power: 11 kW
      speed: 960 rpm
      synchronous_speed: 1000 rpm
      overload: 2.4
      largest_torque: 400 N*m
    count: 2
    off_after: 0.4 s
    off_delay: 0.05 s
torques:
  weight: {at: load, type: constant, torque: -9.81 kN, delay: 0.1 s, acts: always}
  growing: {at: flywheel, type: ramp, torque: 50 N*m, first: 10 N*m, time: 0.2 s, acts: when_running}
  beat: {at: rim, type: sine, amplitude: 20 N*m, frequency: 3 Hz, mean: 5 N*m, phase: 30 deg}
  hum: {at: bar, type: sine, amplitude: 2 N*m, angular_frequency: 40 rad/s}
  wind: {at: load, type: over_time, points: [{time: 0 s, torque: 0 N}, {time: 0.3 s, torque: 200 N}]}
  fan: {at: wheel, type: over_speed, points: [{speed: 0 rpm, torque: 0 N*m}, {speed: 1000 rpm, torque: -30 N*m}]}
  cam:
    at: strut
    type: over_position
    points: [{position: 0 deg, torque: 1 N*m}, {position: 180 deg, torque: -1 N*m}, {position: 360 deg, torque: 1 N*m}]
    period: 360 deg
resistances:
  bearing: {at: wheel, coulomb: 5 N*m, static_ratio: 1.3, viscous: 0.2 N*m*s/rad}
motions:
  turning: {at: table, points: [{time: 0 s, speed: 0 rpm}, {time: 0.3 s, speed: 60 rpm}]}
impulses:
  blow: {at: strut, time: 0.2 s, size: 3 N*m*s}
checks:
  start_time: 6 s
  stop_time: 4 s
  stop_angle: 900 deg
  resonance_margin: 0.1
  cycle_time: 60 s
  DRV102: {off: too short a look}
  DRV103: {off: too short a look}
scenes:
  - {type: run, name: work, duration: 0.5 s, of: motor, speed: 0 rpm, links: relaxed}
  - {type: start, duration: 0.4 s, until: 500 rpm}
  - {type: stop, duration: 0.4 s, speed: 100 rpm, links: loaded}
"""


def data_of(text: str) -> dict[str, Any]:
    """The data of a design file, read as the loader reads it: `on` is a word."""
    data = parse(text.encode(), "case.yaml").data
    assert isinstance(data, dict)
    return data


def spec_of(data: dict[str, Any]) -> Drivetrain:
    """The filled-in spec of a drive train."""
    spec = loaded(data).spec
    assert isinstance(spec, Drivetrain)
    return spec
