"""The loads a slewing crane can report."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_CHAIN = (
    LoadInfo("slew_inertia", "moment of inertia about slewing axis", units.INERTIA, governing=True),
    LoadInfo("start_time", "starting time", units.TIME, governing=True),
    LoadInfo("start_angle", "starting angle", units.ANGLE),
    LoadInfo("steady_time", "steady slewing time", units.TIME),
    LoadInfo("steady_angle", "steady slewing angle", units.ANGLE),
    LoadInfo("brake_time", "stopping time", units.TIME, governing=True),
    LoadInfo("brake_angle", "stopping angle", units.ANGLE, governing=True),
    LoadInfo("cycle_time", "time of one slewing motion", units.TIME, governing=True),
    LoadInfo("share_start", "time share of start", units.RATIO, headline=False),
    LoadInfo("share_steady", "time share of steady slewing", units.RATIO, headline=False),
    LoadInfo("share_brake", "time share of stop", units.RATIO, headline=False),
    LoadInfo("torque_start", "axis torque, start", units.TORQUE, governing=True),
    LoadInfo("torque_steady", "axis torque, steady slewing", units.TORQUE, governing=True),
    LoadInfo("torque_inertia_brake", "axis inertia torque, braking", units.TORQUE),
    LoadInfo("torque_brake", "axis torque, braking", units.TORQUE, governing=True),
    LoadInfo("torque_equivalent", "axis torque, equivalent", units.TORQUE, governing=True),
    LoadInfo("torque_pinion", "equivalent torque at slewing pinion", units.TORQUE),
    LoadInfo("torque_worm", "gearbox equivalent input torque", units.TORQUE, governing=True),
    LoadInfo("power_gearbox", "gearbox power at equivalent torque", units.POWER),
)
OF_THE_DRIVE = (
    LoadInfo("torque_motor_start", "starting torque, all motors, maximum", units.TORQUE),
    LoadInfo("torque_brake_required", "required brake torque, motor shaft", units.TORQUE),
    LoadInfo("starting_reserve", "starting torque reserve", units.RATIO),
    LoadInfo("speed_reserve", "torque reserve up to full speed", units.RATIO),
    LoadInfo("wind_reserve_motor", "motor reserve against wind", units.RATIO),
    LoadInfo("overhauling_reserve", "motor braking torque reserve", units.RATIO),
    LoadInfo("wind_reserve_brake", "brake reserve against wind", units.RATIO),
    LoadInfo("torque_motor_rms", "motor torque, rms, per motor", units.TORQUE),
    LoadInfo("heating_utilisation", "thermal utilisation (rms torque)", units.SHARE),
    LoadInfo("rotation_used", "rotation share of start and stop", units.SHARE, headline=False),
    LoadInfo("gear_locks", "jam ratio, reflected/rotor inertia", units.RATIO, headline=False),
)
OF_THE_SWING = (
    LoadInfo("sway_radial_max", "radial sway angle, maximum", units.ANGLE, governing=True),
    LoadInfo("sway_tangential_max", "tangential sway angle, maximum", units.ANGLE, governing=True),
    LoadInfo("sway_max", "hoist rope angle, maximum", units.ANGLE, headline=False),
    LoadInfo("sway_residual", "residual sway amplitude after stop", units.ANGLE),
)
OF_THE_RING = (
    LoadInfo("ring_force_axial", "slewing ring axial force", units.FORCE, governing=True),
    LoadInfo("ring_force_radial", "slewing ring radial force", units.FORCE),
    LoadInfo("ring_moment", "slewing ring tilting moment", units.TORQUE, governing=True),
    LoadInfo("ring_utilisation", "slewing ring utilisation", units.SHARE),
)
OF_THE_USE = (
    LoadInfo("spectrum_factor", "load spectrum factor K_p", units.RATIO, headline=False),
    LoadInfo("crane_group", "required crane group, A", units.RATIO, headline=False),
)
LOADS = (*OF_THE_CHAIN, *OF_THE_DRIVE, *OF_THE_SWING, *OF_THE_RING, *OF_THE_USE)
