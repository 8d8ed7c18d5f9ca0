"""Kinds of figures: what draws them, which tables and options they have, what they show."""
from dataclasses import dataclass
from typing import Callable, Optional, Tuple

from ..history import NotKeptError
from . import curves, fields, joints, mesh, pile, polar, series, yielding


class NothingToDraw(LookupError):
    """Why a result has no figure of a kind."""


@dataclass(frozen=True)
class Kind:
    """A kind of figures.

    about           what it shows
    draw            (result, options) -> yields name, Figure
    takes           names of the options that it heeds, beside those of all figures
    each_increment  each increment that is asked for has figures of its own
    each_angle      each angle that is asked for, too
    tables          (result, options) -> yields name, Table
    tells           (result) -> whether it is drawn where no kinds are asked for
    """
    about: str
    draw: Callable
    takes: Tuple[str, ...] = ()
    each_increment: bool = False
    each_angle: bool = False
    tables: Optional[Callable] = None
    tells: Callable = lambda result: True


def _several(result):
    return len(result.history.increment) > 1


def _has_joints(result):
    return len(result.mesh.joint_label) > 0


def _contours(result, options):
    yield "contours_displacement", fields.draw_contours(result, "displacement", options)
    for name in fields.quantities(result)[1:]:
        yield f"contours_{name}", fields.draw_contours(result, name, options)


def _sections(result, options):
    found = {name: curves.of_solid(section, options) for name, section
             in curves.sections(result, options.angles).items()}
    drawn = {name: one for name, one in found.items() if max(map(len, one.pieces()), default=0) > 1}
    for name, section in drawn.items():
        yield name, curves.draw_section(result, section, options)
    if not drawn:
        raise NothingToDraw("no section runs through what is asked for")


def _joints(result, options):
    for name, interface in joints.interfaces(result).items():
        yield name, joints.draw(result, interface, options)
    if not _has_joints(result):
        raise NothingToDraw("there are no joints")


def _convergence(result, options):
    figure = curves.draw_convergence(result, options)
    if figure is None:
        raise NothingToDraw("no joint slips or opens, or the job is linear")
    yield "convergence", figure


def _points(result, options):
    _need_points(result)
    yield "points", series.draw_points(result, options)


def _points_tables(result, options):
    _need_points(result)
    yield "points", series.points_table(result, options)


def _need_points(result):
    if not _has_points(result):
        raise NothingToDraw("the deck has no POINTS")


def _pressure(result, options):
    if not _has_joints(result):
        raise NothingToDraw("there are no joints")
    for name, interface in joints.interfaces(result).items():
        yield name.replace("joints", "pressure", 1), polar.draw(result, options, interface)


def _yielding(result, options):
    if not yielding.has(result):
        raise NothingToDraw("no material yields")
    yield "yielding", yielding.draw_zones(result, options)
    for name, figure in (("yielding_unrolled", yielding.draw_unrolled(result, options)),
                         ("dissipation", yielding.draw_dissipation(result, options)),
                         ("mechanism", yielding.draw_mechanism(result, options))):
        if figure is not None:
            yield name, figure


def _of_pile(draw):
    """What draws a pile; why it cannot is no error."""
    def drawn(result, options):
        try:
            yield from draw(result, options)
        except NotKeptError:
            raise
        except LookupError as reason:
            raise NothingToDraw(str(reason)) from reason
    return drawn


def _soil(name, draw):
    return _of_pile(lambda result, options: [(name, draw(result, options))])


def _soil_tables(result, options):
    soil = pile.reactions(result, options)
    yield "pisa_shaft", soil.shaft_table()
    yield "pisa_base", soil.base_table()


def _has_pile(result):
    return _several(result) and pile.has_shaft(result)


def _has_points(result):
    return result.has("history/points/label") and len(result.read("history/points/label")) > 0


OF_SOLIDS = ("body", "material", "angles", "increments")
OF_PILES = ("body", "angles", "increments")

KINDS = {
    "mesh": Kind("materials, joints, supports, loads", lambda result, options: [("mesh", mesh.draw(result, options))]),
    "deformed": Kind("two opposite planes, displacements enlarged",
                     lambda result, options: [("deformed", fields.draw_deformed(result, options))],
                     (*OF_SOLIDS, "enlargement"), each_increment=True, each_angle=True),
    "contours": Kind("displacement and stresses on two opposite planes", _contours, (*OF_SOLIDS, "range"),
                     each_increment=True, each_angle=True),
    "sections": Kind("displacements and stresses along lines", _sections, OF_SOLIDS, each_increment=True),
    "joints": Kind("state, stresses, gap and slip over depth and theta", _joints, ("increments",),
                   each_increment=True),
    "convergence": Kind("residuals by iteration", _convergence),
    "spectrum": Kind("displacement and stress of each harmonic",
                     lambda result, options: [("spectrum", curves.draw_spectrum(result, options))], ("increments",),
                     each_increment=True),
    "points": Kind("load against displacement of named points", _points, ("angles",), each_angle=True, tells=_has_points,
                   tables=_points_tables),
    "energy": Kind("work, energy, dissipation and residuals by increment",
                   lambda result, options: [("energy", series.draw_energy(result, options))], tells=_several,
                   tables=lambda result, options: [("increments", result.increments)]),
    "pile": Kind("deflection, rotation, shear, moment, axial force by depth, from CUTS",
                 _soil("pile", pile.draw_profile), OF_PILES, each_angle=True,
                 tells=pile.has_profile,
                 tables=_of_pile(lambda result, options: [("pile", pile.profile_table(result, options))])),
    "py": Kind("p-y curves by depth", _soil("py", lambda *one: pile.draw_curves(*one, "py")), (*OF_PILES, "depths"),
               each_angle=True, tables=_of_pile(_soil_tables), tells=_has_pile),
    "tz": Kind("t-z curves by depth", _soil("tz", lambda *one: pile.draw_curves(*one, "tz")), (*OF_PILES, "depths"),
               each_angle=True, tables=_of_pile(_soil_tables), tells=_has_pile),
    "pisa": Kind("the four soil reactions of the PISA method", _soil("pisa", pile.draw_pisa), (*OF_PILES, "depths"),
                 each_angle=True, tables=_of_pile(_soil_tables), tells=_has_pile),
    "pressure": Kind("pressure in joints round the circle", _pressure, ("increments", "depths", "range"),
                     tables=lambda result, options: [("pressure", polar.table(result, options))],
                     tells=_has_joints),
    "yielding": Kind("plastic strain and dissipation on two opposite planes, yield margin round a circle, what moves beyond the limit load",
                     _yielding, ("body", "material", "angles", "range"), each_angle=True, tells=yielding.has)}
