"""The loads a slewing crane can report."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_CHAIN = (
    LoadInfo("slew_inertia", "moment of inertia about the slewing axis", units.INERTIA, governing=True),
    LoadInfo("start_time", "start time", units.TIME, governing=True),
    LoadInfo("start_angle", "angle of the start", units.ANGLE),
    LoadInfo("steady_time", "time of steady slewing", units.TIME),
    LoadInfo("steady_angle", "angle of steady slewing", units.ANGLE),
    LoadInfo("brake_time", "time of the stop", units.TIME, governing=True),
    LoadInfo("brake_angle", "angle of the stop", units.ANGLE, governing=True),
    LoadInfo("cycle_time", "time of a rotation", units.TIME, governing=True),
    LoadInfo("share_start", "share of the start in a rotation", units.RATIO, headline=False),
    LoadInfo("share_steady", "share of steady slewing", units.RATIO, headline=False),
    LoadInfo("share_brake", "share of the stop", units.RATIO, headline=False),
    LoadInfo("torque_start", "torque at the column, start", units.TORQUE, governing=True),
    LoadInfo("torque_steady", "torque at the column, steady slewing", units.TORQUE, governing=True),
    LoadInfo("torque_inertia_brake", "inertia torque at the column, stop in the allowed angle", units.TORQUE),
    LoadInfo("torque_brake", "torque at the column, stop in the allowed angle", units.TORQUE, governing=True),
    LoadInfo("torque_equivalent", "equivalent torque at the column", units.TORQUE, governing=True),
    LoadInfo("torque_pinion", "equivalent torque of the open pinion", units.TORQUE),
    LoadInfo("torque_worm", "equivalent torque on the fast shaft of the gearbox", units.TORQUE, governing=True),
    LoadInfo("power_gearbox", "power of the gearbox by the equivalent torque", units.POWER),
)
OF_THE_DRIVE = (
    LoadInfo("torque_motor_start", "largest motor torque of the start, all motors", units.TORQUE),
    LoadInfo("torque_brake_required", "brake torque on the motor shaft for the allowed angle", units.TORQUE),
    LoadInfo("starting_reserve", "least starting torque over that of steady slewing", units.RATIO),
    LoadInfo("speed_reserve", "least starting torque of the curve over that of steady slewing", units.RATIO),
    LoadInfo("wind_reserve_motor", "starting torque over friction and the largest wind", units.RATIO),
    LoadInfo("wind_reserve_brake", "closed brake and friction over the largest wind", units.RATIO),
    LoadInfo("torque_motor_rms", "heating torque of a motor (rms)", units.TORQUE),
    LoadInfo("heating_utilisation", "heating torque over what the duty allows", units.SHARE),
    LoadInfo("rotation_used", "start and stop over the whole rotation", units.SHARE, headline=False),
    LoadInfo("gear_locks", "inertia that locks the gear, over that of the rotor", units.RATIO, headline=False),
)
OF_THE_SWING = (
    LoadInfo("sway_radial_max", "largest angle of the load outwards or inwards", units.ANGLE, governing=True),
    LoadInfo("sway_tangential_max", "largest angle of the load along the way", units.ANGLE, governing=True),
    LoadInfo("sway_max", "largest angle of the load's rope", units.ANGLE, headline=False),
    LoadInfo("sway_residual", "amplitude of the swing after the stop", units.ANGLE),
)
OF_THE_RING = (
    LoadInfo("ring_force_axial", "axial force of the slewing ring", units.FORCE, governing=True),
    LoadInfo("ring_force_radial", "radial force of the slewing ring", units.FORCE),
    LoadInfo("ring_moment", "tilting moment of the slewing ring", units.TORQUE, governing=True),
    LoadInfo("ring_utilisation", "tilting moment over that of the ring's curve", units.SHARE),
)
OF_THE_USE = (
    LoadInfo("spectrum_factor", "factor of the load spectrum", units.RATIO, headline=False),
    LoadInfo("crane_group", "group of the crane that its use asks (A)", units.RATIO, headline=False),
)
LOADS = (*OF_THE_CHAIN, *OF_THE_DRIVE, *OF_THE_SWING, *OF_THE_RING, *OF_THE_USE)
