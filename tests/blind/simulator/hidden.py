"""What one run of the hidden rig is made of: every number the simulator needs, in SI units."""

from __future__ import annotations

from typing import NamedTuple


class Hidden(NamedTuple):
    """Rig, friction and effects of one run, those out of the catalogue too; off at their defaults.

    `*_form` picks the formula of an effect (0: off). Angles in rad, forces in N.
    """

    mass: float = 0.87
    inertia: float = 7e-4
    stiffness: float = 38.5  # of one spring
    length: float = 0.20  # installed
    natural: float = 0.17
    attachment: float = 0.05  # radius of the attachments
    radius: float = 0.04  # of the contact disc
    speed: float = 0.06  # of the surface
    mu_s: float = 0.24
    mu_k: float = 0.17
    smooth: float = 5e-6  # m/s, over which friction turns round
    lateral: float = 0.0  # share of the friction across x: 0 along x, 1 isotropic
    curvature: float = 0.0  # 1/m, of a turning surface
    ageing_form: float = 0.0
    ageing: float = 0.0
    ageing_time: float = 0.02
    ageing_way: float = 2e-5  # m of slip that makes a contact young again
    weakening_form: float = 0.0
    weakening: float = 0.0
    weakening_speed: float = 0.1
    drag: float = 0.0  # N s/m
    root_drag: float = 0.0  # N at 1 m/s
    thermal_form: float = 0.0
    thermal: float = 0.0  # 1/J
    thermal_time: float = 5.0
    run_in_form: float = 0.0
    run_in: float = 0.0
    run_in_way: float = 1.0
    cubic_form: float = 0.0  # 1: of the elongation, 2: of the change since installation
    cubic: float = 0.0  # N/m3
    damping: float = 0.0
    damping_yaw: float = 0.0
    ripple_form: float = 0.0
    ripple: float = 0.0
    ripple_hz: float = 1.0
    ripple_phase: float = 0.0
    pattern_form: float = 0.0
    pattern: float = 0.0
    pattern_length: float = 0.1
    pattern_phase: float = 0.0
    spring_turn: float = 0.0
    spring_shift: float = 0.0
    stick_share: float = 1.0  # part of the spring force that acts at rest
    resonator_mass: float = 0.0
    resonator_stiffness: float = 0.0
    resonator_damping: float = 0.0
    play: float = 0.0  # m, half width
    tilt_x: float = 0.0  # share of gravity along x
    tilt_y: float = 0.0
    asymmetry: float = 0.0  # friction the other way round is larger by this part
    leak: float = 0.0  # part of the stiffness that creeps away
    leak_time: float = 10.0
    seam: float = 0.0  # N, blow of the belt's seam
    seam_loop: float = 1.3
    seam_width: float = 0.008
    magnet: float = 0.0  # N
    magnet_place: float = 0.0
    magnet_width: float = 0.004
    shake: float = 0.0  # m, motion of the frame
    shake_hz: float = 5.0
    melting: float = 0.0  # part of the mass lost per second
    flash: float = 0.0  # part of the kinetic level that flash heating takes away at last
    flash_speed: float = 0.05  # m/s of sliding from which contacts are hot before they part
    lifting: float = 0.0  # N/m, normal force that the springs take away per displacement


class State(NamedTuple):
    """Where the block is when the motion starts: m, rad, m/s, rad/s."""

    x: float = 0.0
    y: float = 0.0
    phi: float = 0.0
    vx: float = 0.0
    vy: float = 0.0
    omega: float = 0.0
