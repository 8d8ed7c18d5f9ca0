"""Jobs of the gallery: deck, what the picture shows, and results beside a calculation by hand.

Each check is a function of the result that yields what is compared, the value found, the value by hand, and by how
much they may differ, of the latter, as the hand calculation leaves something out or the mesh is coarse.
"""
from dataclasses import dataclass
from typing import Callable

import numpy as np

EXACT = 1e-6


@dataclass
class Job:
    """A job: its deck, what it is, the colour and increment of its picture, its checks."""
    deck: str
    told: str
    colour: str
    check: Callable
    combination: int = 0
    increment: int = None
    curve: Callable = None
    zone: bool = False  # the plastic zone in space in place of two planes


def along(first, last, component, angles=(0.0, 90.0, 180.0)):
    """A picture beside: a stress along a wall, at angles."""
    def drawn(axes, result, units):
        line = result.line(first, last, theta=angles)
        for angle, stress, style in zip(angles, line.stress, ("-", "--", ":")):
            axes.plot(stress[:, component], line.position[:, 1], style, color="black", label=f"θ = {angle:g}°")
        name = ("σ_r", "σ_z", "σ_θ")[component]
        axes.set(xlabel=f"{name} [{units.stress}]", ylabel=f"z [{units.length}]")
        axes.legend(fontsize="small")
    return drawn


def p_y(axes, result, units):
    """A picture beside: lateral resistance per length of both sides of the pile against its deflection, by depth."""
    history, mesh = result.history, result.mesh
    del units
    z, order = result.read("cuts/z"), np.argsort(result.read("cuts/z"))
    for depth, style in ((-1.0, "-"), (-5.0, "--"), (-9.0, "-."), (-19.0, ":")):
        p = 0.0
        for name in ("shaft", "plug"):
            joints = result.interfaces_of(name)[0].joints
            ends = mesh.coordinates[mesh.joint_nodes[joints, :2], 1]
            joint = joints[abs(ends.mean(axis=1) - depth).argmin()]
            low, high = np.sort(mesh.coordinates[mesh.joint_nodes[joint, :2], 1])
            p = p - history.joint_resultants[:, joint, 1]/(high - low)
        y = [np.interp((low + high)/2, z[order], row[order]) for row in history["cut_motion"][:, :, 1]]
        axes.plot(1e3*np.array(y), p, style, color="black", marker=".", label=f"z = {(low + high)/2:.3g} m")
    axes.set(xlabel="y [mm]", ylabel="p [MN/m]")
    axes.legend(fontsize="small")


def monopile(result):
    """The ground takes what the head is loaded by."""
    history = result.history
    ground = sum(history.interface(name)[5] for name in ("shaft", "plug", "toe"))
    yield "lateral force between pile and ground [MN]", -ground[1], 5.0, EXACT
    yield "its moment about the mudline [MNm]", -ground[2], -100.0 - 5.0*5.0, EXACT


def caisson(result):
    """Force and moment through the skirt and the lid."""
    ground = sum(one for one in (result.history.interface(name)[-1] for name in
                                 ("outer skirt", "inner skirt", "tip", "lid")))
    yield "axial force between caisson and ground [MN]", -ground[0], -4.0, EXACT
    yield "lateral force [MN]", -ground[1], 1.0, EXACT
    yield "moment about the sea floor: M − H h [MNm]", -ground[2], -5.0 - 1.0*0.5, EXACT


def pile(result):
    """What the clay holds after unloading to half: force and moment of the load. The picture has the plastic strains of the half behind the plane of the push, which was to the right."""
    ground = result.history["joint_resultants"][-1]
    mesh = result.mesh
    height = mesh.coordinates[mesh.joint_nodes[:, :2], 1].mean(axis=1)
    yield "lateral force between pile and clay [kN]", -ground[:, 1].sum(), 350.0, EXACT
    yield "its moment about the base, 5 H [kNm]", -(ground[:, 2] - ground[:, 1]*(height + 5.0)).sum(), -350.0*5.0, EXACT


def plug(result):
    """Friction on the wall when all of it slips: 2 pi r L p tan(phi)."""
    pull = result.history["joint_resultants"][-1, :, 0].sum()
    yield "pull when all slips, 2π r L p tan φ [MN]", abs(pull), 2*np.pi*0.1*0.5*2.0*np.tan(np.radians(30)), 0.03


def shrink_fit(result):
    """Lame: pressure of the fit, and what rotation takes of it."""
    young, nu, rho, b, c = 2.1e5, 0.3, 7.85e-9, 20.0, 60.0
    fit = young*1.2e-5*100/2*(c**2 - b**2)/c**2
    spun = (3 + nu)/8*rho*3000.0**2*(c**2 - b**2)
    for increment, words, wanted in ((1, "pressure of the fit, E αT (c² − b²)/2c² [MPa]", fit),
                                     (2, "with rotation, less (3 + ν) ρ ω² (c² − b²)/8 [MPa]", fit - spun)):
        joints = result.at(increment).joints()
        middle = abs(joints["z"] - 5) < 2.5
        yield words, -joints["sigma"][middle].mean(), wanted, 0.03


def chimney(result):
    """Shear and moment of the wind, factor 1.5, above the cut at z = 0.5."""
    angle = np.linspace(0, 360, 36001)
    shape = np.interp(angle, [0, 30, 75, 120, 240, 285, 330, 360], [1, .2, -1.2, -.5, -.5, -1.2, .2, 1])
    around = np.trapezoid(shape*np.cos(np.radians(angle)), np.radians(angle)) if hasattr(np, "trapezoid") else \
        np.trapz(shape*np.cos(np.radians(angle)), np.radians(angle))
    z = np.linspace(0.5, 20, 20001)
    line = -1.5*2.0*around*(5e-4 + 1e-3*z/20)
    step = z[1] - z[0]
    shear, moment = ((one[1:] + one[:-1]).sum()*step/2 for one in (line, -line*(z - 0.5)))
    cut = result.read("cuts/resultants")[0]
    yield "shear of the wind at z = 0.5 [MN]", cut[1], shear, 1e-5
    yield "its moment [MNm]", cut[2], moment, 1e-5


def lined_shaft(result):
    """Plane strain at half the depth: the lining takes what its stiffness gets of K0 sigma_v."""
    depth, a, t, ground, nu, lining, nu_l = 10.0, 3.0, 0.3, 100.0, 0.3, 3e4, 0.2
    p0 = 0.6*2e-3*9.81*depth
    inner = a - t
    of_ground = (1 + nu)*a/ground
    of_lining = (1 + nu_l)*a/lining*((1 - 2*nu_l)*a**2 + inner**2)/(a**2 - inner**2)
    p = p0*of_ground/(of_ground + of_lining)
    hoop = -p*a/t
    yield "mean hoop stress of the lining at z = −10, −p a/t [MPa]", result.stress(
        np.linspace(inner, a, 21), -depth, body=1)[:, 2].mean(), hoop, 0.03


def pipe(result):
    """What the ends hold is the load."""
    yield "lateral force at both ends, 2 p r l sin 20° [N]", result.read("resultants/reacted")[1], \
        2*102*80*np.sin(np.radians(20)), EXACT


def flange(result):
    """Force between the flanges: preload less tension."""
    between = result.history.interface("flange")
    yield "force between the flanges after preload [N]", between[0, 0], 4e5, EXACT
    yield "with tension [N]", between[-1, 0], 4e5 - 1e5, EXACT
    yield "moment between them [Nmm]", -between[-1, 2], 1.2e7, EXACT


def footing(result):
    """A rigid disc on springs without tension: pressure q (x - x0) where x > x0, for N and M."""
    radius, force, moment, bed = 2.0, 1.0, 0.9, 10.0
    x = np.linspace(-radius, radius, 400001)
    width = 2*np.sqrt(np.maximum(radius**2 - x**2, 0))

    def arm(edge):
        pressed = np.maximum(x - edge, 0)*width
        return (pressed*x).sum()/pressed.sum()
    low, high = -radius, radius*0.99
    for _ in range(60):
        edge = (low + high)/2
        low, high = (edge, high) if arm(edge) < moment/force else (low, edge)
    slope = force/((np.maximum(x - edge, 0)*width).sum()*(x[1] - x[0]))
    joints = result.joints()
    half = joints.where(np.isclose(joints["theta"], 180.0))
    outermost = half["r"].argmax()
    yield "largest pressure at r = " + f"{half['r'][outermost]:.3f}" + " [MPa]", -half["sigma"][outermost], \
        slope*(half["r"][outermost] - edge), 0.01
    along = result.history.point("edge")[-1, 1]
    yield "edge lifted by [m]", along, slope*(radius + edge)/bed, 0.01


def tank(result):
    """Membrane hoop stress of water; inextensional shell under settlement s cos 2 theta: u = -4 s z/r cos 2 theta."""
    radius, wall, height = 19.97, 0.06, 12.0
    mean = result.displacement(20.0, height, [0.0, 45.0])
    hoop = (result.stress(radius, 6.0, 0.0)[2] + result.stress(radius, 6.0, 90.0)[2])/2
    yield "hoop stress of water at half the height, p r/t [MPa]", hoop, 0.06*(radius - wall/2)/wall, 0.02
    yield "radial displacement of the top, 4 s h/r [m]", -(mean[0, 0] - mean[1, 0]), 4*0.02*height/radius, 0.05


JOBS = {
    "monopile": Job("inputs/monopile.dat", "A monopile in layered ground, with a gap behind it, at its largest load", "u",
                    monopile, increment=6, curve=p_y),
    "caisson": Job("inputs/gallery/caisson.dat", "A suction caisson in clay under weight and waves; adhesion that breaks", "u",
                   caisson),
    "pile": Job("inputs/pile_clay.dat", "A pile pushed through clay that yields: the plastic zone", "u", pile, zone=True),
    "plug": Job("inputs/gallery/plug.dat", "A plug pulled out of a block against friction", "tau_rz", plug),
    "shrink_fit": Job("inputs/gallery/shrink_fit.dat", "A wheel shrunk on a shaft, under rotation and moment", "sigma_theta",
                      shrink_fit),
    "chimney": Job("inputs/chimney.dat", "A chimney under weight, wind and sun on a pad that lifts off", "sigma_z", chimney,
                   combination=2),
    "lined_shaft": Job("inputs/gallery/lined_shaft.dat", "A lined shaft in ground of K0 = 0.6", "u", lined_shaft,
                       curve=along((2.85, -20.0), (2.85, 0.0), 2, (0.0,))),
    "pipe": Job("inputs/gallery/pipe.dat", "A pipe under a patch load", "sigma_theta", pipe,
                curve=along((100.0, 0.0), (100.0, 800.0), 2)),
    "flange": Job("inputs/gallery/flange.dat", "A bolted flange under tension and moment: it opens on one side", "sigma_z",
                  flange),
    "footing": Job("inputs/gallery/footing.dat", "A footing under an eccentric load, which lifts off", "sigma_z", footing),
    "tank": Job("inputs/gallery/tank.dat", "A tank under water and settlement of harmonic 2", "sigma_theta", tank, combination=3,
                curve=along((19.97, 0.0), (19.97, 12.0), 2)),
}
