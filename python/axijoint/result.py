"""A result file of axijoint."""
import copy
import pathlib
import re
from functools import cached_property

import h5py
import numpy as np

from . import circle, convert, elements, joint_points
from .components import DISPLACEMENTS, STRESSES
from .history import ATTRIBUTES_OF_THE_END, History, JUMPS, NotKeptError, place_of
from .interface import read_interfaces
from .mesh import Mesh
from .section import Section, line_rows
from .table import Table

STATES = np.array(["stick", "slip", "open"])
# What is the same in all increments and may be shared by their views
SHARED = ("mesh", "deck", "messages", "harmonic", "family", "value_of", "interfaces", "history")


class OutsideError(ValueError):
    """Points that lie in no element, or in none of the body and material asked for."""


class Result:
    """A result file NAME.h5, opened for reading.

    Arrays are read when they are first needed, and kept; the file is not held open. Lengths, forces
    and stresses are in the units of the deck, angles in degrees. Components of displacements are u (r),
    v (z), w (theta), those of stresses r, z, theta, rz, r-theta, z-theta (`STRESSES`); tension is
    positive. Numbers of nodes, elements, bodies, materials and joints are those of the deck.

    path          the file
    title         title card
    status        converged, not_converged or mechanism
    combination   number of the load combination; 0 if there is one only
    attributes    all attributes of the file
    increment     number of the increment that displacements, joints, stresses, sections, cuts and
                  resultants are of: the last, or the one asked for by `at`
    """

    def __init__(self, path):
        self.path = pathlib.Path(path)
        with h5py.File(self.path, "r") as file:
            self.attributes = {name: text_of(value) for name, value in file.attrs.items()}
            whole = {"title", "status", "combination"} <= self.attributes.keys() and "modes" in file
        if self.attributes.get("program") != "axijoint" or not whole:  # files of studies, or of swept bodies
            raise ValueError(f"{path} is no result file NAME.h5 of axijoint")
        self.title = self.attributes["title"].strip()
        self.status = self.attributes["status"]
        self.combination = int(self.attributes["combination"])
        self._wanted = None

    def __repr__(self):
        at = "" if self._wanted is None else f".at({self._wanted})"
        return f"Result({str(self.path)!r}){at}: {self.title}"

    # Increments

    @cached_property
    def history(self):
        """Series by increment: a History."""
        return History(self)

    @cached_property
    def increments(self):
        """Table of the increments: load factor, iterations, residual, joint states, work and energy."""
        return self.history.table()

    @property
    def increment(self):
        """Number of the increment that this is a view of."""
        return int(self.history.increment[-1]) if self._wanted is None else self._wanted

    def at(self, increment):
        """This result as it was at the end of an increment: a Result.

        Displacements, reactions, joints, stresses, sections, cuts and resultants are those of that increment, the
        convergence path ends with it. What the file does not keep of it raises a NotKeptError when it is asked for.
        """
        known = self.history.known.tolist()
        if increment not in known:
            raise ValueError(f"there is no increment {increment}; the file keeps {known}")
        self.mesh, self.harmonic, self.family  # read once for all views
        view = copy.copy(self)
        view.__dict__ = {name: value for name, value in self.__dict__.items()
                         if name in SHARED or not isinstance(getattr(Result, name, None), cached_property)}
        view._wanted = int(increment)
        return view

    # What is in the file

    def read(self, name):
        """A dataset as it is stored (C order), of the increment that this is a view of."""
        with h5py.File(self.path, "r") as file:
            place, row = (name, ()) if self._wanted is None else place_of(file, name, self._wanted)
            if place not in file:
                raise KeyError(f"{self.path} has no {place}")
            if isinstance(file[place], h5py.Group):
                raise KeyError(f"/{place} of {self.path} is a group; datasets in it: {', '.join(_datasets(file, place))}")
            value = text_of(file[place][row])
            if name == "joints/jump" and place != name:
                value = circle.on_planes(value, file["modes/harmonic"][()], file["modes/family"][()],
                                         np.degrees(file["joints/planes"][()]))
            return value

    def names_in(self, group):
        """Names of the datasets and groups in a group."""
        with h5py.File(self.path, "r") as file:
            return sorted(file[group])

    def has(self, name):
        """Whether the file has a dataset or group."""
        with h5py.File(self.path, "r") as file:
            return name in file

    def attributes_of(self, name):
        """Attributes of a group, by name."""
        if name in ATTRIBUTES_OF_THE_END and self.increment != self.history.increment[-1]:
            raise NotKeptError(f"attributes of /{name} are of the last increment alone")
        with h5py.File(self.path, "r") as file:
            return {key: text_of(value) for key, value in file[name].attrs.items()}

    @cached_property
    def mesh(self):
        """The mesh."""
        return Mesh(self.read)

    @cached_property
    def interfaces(self):
        """The cards of INTERFACES, with name, law, bodies and joints: a list of Interfaces."""
        return read_interfaces(self)

    def interfaces_of(self, wanted):
        """Interfaces of a name, or that of a number."""
        found = [one for one in self.interfaces if wanted in (one.name, one.number)]
        if not found:
            names = ", ".join(one.name for one in self.interfaces) or "none"
            raise ValueError(f"there is no interface {wanted!r}; there is {names}")
        return found

    @cached_property
    def deck(self):
        """Text of the deck, included files in place."""
        return self.read("deck")

    @cached_property
    def messages(self):
        """Warnings, remarks, and how the iteration ended: a list of texts."""
        return [line for line in self.read("messages").splitlines() if line.strip()]

    @cached_property
    def harmonic(self):
        """Harmonic m of each mode."""
        return self.read("modes/harmonic")

    @cached_property
    def family(self):
        """Family of each mode: 1 symmetric (u, v ~ cos, w ~ sin), 2 antisymmetric (~ sin, -cos)."""
        return self.read("modes/family")

    @cached_property
    def displacement_amplitude(self):
        """Amplitudes u, v, w of the nodes, (modes, nodes, 3)."""
        return self.read("displacement")

    @cached_property
    def jump_amplitude(self):
        """Amplitudes of the relative displacements d_xi, d_eta, d_theta of the joint points, (modes, points, 3)."""
        if JUMPS not in self.history:  # a job of one increment
            rule = self.read("joint_materials/rule")[self.mesh.joint_material]
            return joint_points.jumps(self.mesh, self.read("joints/joint") - 1, rule, self.displacement_amplitude)
        with h5py.File(self.path, "r") as file:
            _, row = place_of(file, "joints/jump", self.increment)
            return file[f"history/{JUMPS}"][-1 if row == () else row]

    @cached_property
    def gauss_amplitude(self):
        """Amplitudes of the stresses at the Gauss points, (modes, points, 6)."""
        return self.read("stress/amplitude")

    @cached_property
    def nodal_amplitude(self):
        """Amplitudes of the stresses smoothed to the nodes, (modes, values, 6)."""
        return self.read("stress/nodal")

    @cached_property
    def value_of(self):
        """Index of the smoothed stress of each node of each element, (elements, 9); -1 beyond."""
        node, material = self.read("stress/nodal_node") - 1, self.read("stress/nodal_material") - 1
        count = len(self.mesh.material_label)
        key = node*count + material
        order = np.argsort(key)
        wanted = self.mesh.element_nodes*count + self.mesh.element_material[:, None]
        place = np.searchsorted(key[order], np.maximum(wanted, 0))
        found = order[np.minimum(place, len(order) - 1)]
        return np.where(self.mesh.element_nodes >= 0, found, -1)

    # Values at points

    def displacement(self, r, z, theta=0.0, *, body=None, material=None, outside="error",
                     cartesian=False):
        """Displacement u, v, w at points: an array (..., 3).

        r, z, theta: numbers or arrays, which are broadcast; theta in degrees.
        body, material: only this body, only this material (numbers of the deck). Where solids meet, a
            point lies in several; of those left, the one of the lowest body number counts, and of
            these the one of the lowest material number.
        outside: "error" raises an OutsideError for points in no element, "nan" gives nan there.
        cartesian: components x, y, z in place of r, z, theta; x is along theta = 0, y along 90 degrees.
        """
        points, theta, shape = self._points(r, z, theta)
        known, element, natural = self._find(points, body, material, outside)
        total = self._totals(self.displacement_amplitude, self.mesh.element_nodes, element, natural,
                             theta[known])
        if cartesian:
            total = circle.cartesian_displacement(total, theta[known])
        return _filled(total, known, shape)

    def stress(self, r, z, theta=0.0, *, body=None, material=None, outside="error", cartesian=False,
               source="nodal"):
        """Stresses r, z, theta, rz, r-theta, z-theta at points: an array (..., 6).

        source: "nodal", the stresses smoothed to the nodes of the point's material, interpolated by the
            shape functions of its element, as the listing does on sections; or "gauss", the stress
            of the nearest Gauss point of its element, as computed.
        cartesian: xx, yy, zz, xy, yz, xz in place of the cylindrical components.
        The other arguments are those of `displacement`.
        """
        if source not in ("nodal", "gauss"):
            raise ValueError(f"source is {source!r}; it may be 'nodal' or 'gauss'")
        points, theta, shape = self._points(r, z, theta)
        known, element, natural = self._find(points, body, material, outside)
        if source == "nodal":
            total = self._totals(self.nodal_amplitude, self.value_of, element, natural, theta[known])
        else:
            nearest = self._nearest_gauss(points[known], element)
            total = circle.totals(self.gauss_amplitude[:, nearest], self.harmonic, self.family,
                                  theta[known])
        if cartesian:
            total = circle.cartesian_stress(total, theta[known])
        return _filled(total, known, shape)

    def _points(self, r, z, theta):
        r, z, theta = np.broadcast_arrays(*(np.asarray(x, float) for x in (r, z, theta)))
        return np.stack([r.ravel(), z.ravel()], -1), theta.ravel(), r.shape

    def _find(self, points, body, material, outside):
        """Numbers of the points that lie in the mesh, their elements and natural coordinates."""
        if outside not in ("error", "nan"):
            raise ValueError(f"outside is {outside!r}; it may be 'error' or 'nan'")
        places, place = np.unique(points, axis=0, return_inverse=True)  # each once, whatever angles there are of it
        point, element, natural = self.mesh.locate(places)
        keep = self.chosen(body, material)[element]
        point, element, natural = point[keep], element[keep], natural[keep]
        order = np.lexsort((self.mesh.material_label[self.mesh.element_material[element]],
                            self.mesh.element_body[element], point))
        point, first = np.unique(point[order], return_index=True)
        row = np.full(len(places), -1)
        row[point] = order[first]
        row = row[place.ravel()]
        known = np.flatnonzero(row >= 0)
        if outside == "error" and len(known) < len(points):
            missing = np.flatnonzero(row < 0)
            where = "the mesh" if body is None and material is None else \
                f"body {'any' if body is None else body}, material {'any' if material is None else material}"
            first_r, first_z = points[missing[0]]
            raise OutsideError(f"{len(missing)} of {len(points)} points outside {where}, the first at "
                               f"r = {first_r:g}, z = {first_z:g}; outside='nan' gives nan there")
        return known, element[row[known]], natural[row[known]]

    def chosen(self, body=None, material=None):
        """Which elements are of a body and a material (None: of any)."""
        mesh = self.mesh
        keep = np.ones(len(mesh.element_body), bool)
        for name, wanted, labels in (("body", body, mesh.element_body),
                                     ("material", material, mesh.material_label[mesh.element_material])):
            if wanted is None:
                continue
            if wanted not in labels:
                raise ValueError(f"there is no {name} {wanted}; there is {sorted(map(int, set(labels)))}")
            keep &= labels == wanted
        return keep

    def _totals(self, amplitude, index, element, natural, theta):
        """Interpolate in elements and add up the modes: (points, components)."""
        total = np.empty((len(element), amplitude.shape[-1]))
        for size in np.unique(self.mesh.element_size[element]):
            chosen = np.flatnonzero(self.mesh.element_size[element] == size)
            value, _ = elements.shape_functions(int(size), natural[chosen])
            nodes = index[element[chosen], :size]
            here = np.einsum("pn,mpnc->mpc", value, amplitude[:, nodes])
            total[chosen] = circle.totals(here, self.harmonic, self.family, theta[chosen])
        return total

    def _nearest_gauss(self, points, element):
        """Index of the Gauss point of an element that is nearest to a point."""
        owner, position = self.read("stress/element") - 1, self.read("stress/position")
        start, end = (np.searchsorted(owner, element, side) for side in ("left", "right"))
        best, least = start.copy(), np.full(len(points), np.inf)
        for k in range(int((end - start).max(initial=0))):
            here = np.minimum(start + k, end - 1)
            distance = ((position[here] - points)**2).sum(axis=1)
            nearer = distance < least
            best[nearer], least[nearer] = here[nearer], distance[nearer]
        return best

    # Sections

    @cached_property
    def section_numbers(self):
        """Numbers of the sections of the deck."""
        with h5py.File(self.path, "r") as file:
            return sorted(int(name) for name in file["sections"]) if "sections" in file else []

    def section(self, number):
        """A section of the deck, as stored: a Section."""
        if number not in self.section_numbers:
            raise KeyError(f"{self.path} has no section {number}; it has {self.section_numbers}")
        group = f"sections/{number}/"
        element = self.read(group + "element") - 1
        first, last = self.read(group + "ends")
        return self._section(first, last, self.read(group + "point"), self.read(group + "position"),
                             element, np.degrees(self.read(group + "angles")),
                             self.read(group + "displacement"), self.read(group + "stress"), number)

    def line(self, first, last, theta=0.0, points=101):
        """Values along a straight line of the meridional plane: a Section.

        first, last: r and z of its ends; theta: an angle or several [degree]; points: how many at equal
        distances, or their distances from the first end over the length. Points outside the mesh are
        left out, a line without others raises an OutsideError; where solids meet, a point has a row for each, first for
        the one the line comes from.
        """
        first, last = np.asarray(first, float), np.asarray(last, float)
        if not np.linalg.norm(last - first) > 0:
            raise ValueError(f"the line has no length: its ends are {_place(first)} and {_place(last)}")
        share = np.linspace(0, 1, points) if np.isscalar(points) else np.asarray(points, float)
        place = (1 - share)[:, None]*first + share[:, None]*last
        number, element, natural = line_rows(self.mesh, place)
        if not len(number):
            raise OutsideError(f"all {len(place)} points of the line from {_place(first)} to {_place(last)} are outside the mesh")
        angles = np.atleast_1d(np.asarray(theta, float))
        values = [[self._totals(amplitude, index, element, natural, np.full(len(element), angle))
                   for angle in angles]
                  for amplitude, index in ((self.displacement_amplitude, self.mesh.element_nodes),
                                           (self.nodal_amplitude, self.value_of))]
        return self._section(first, last, number + 1, place[number], element, angles,
                             np.array(values[0]), np.array(values[1]), None)

    def _section(self, first, last, point, position, element, theta, displacement, stress, number):
        direction = (last - first)/np.linalg.norm(last - first)
        return Section(number, first, last, theta, point, position, (position - first) @ direction,
                       self.mesh.element_label[element], self.mesh.element_body[element],
                       self.mesh.material_label[self.mesh.element_material[element]],
                       displacement, stress)

    # Tables

    def nodes(self, theta=0.0):
        """Table of the total displacements of all nodes at an angle [degree]."""
        total = self.nodal_displacement(theta)
        return Table({"node": self.mesh.node_label, "r": self.mesh.coordinates[:, 0],
                      "z": self.mesh.coordinates[:, 1]} | _columns(DISPLACEMENTS, total))

    def nodal_displacement(self, theta=0.0):
        """Total displacements of all nodes at an angle [degree], (nodes, 3)."""
        return self._sum(self.displacement_amplitude, theta)

    def nodal_stress_values(self, theta=0.0):
        """Total smoothed stresses at an angle [degree], (values, 6); `value_of` tells whose they are."""
        return self._sum(self.nodal_amplitude, theta)

    def nodal_stresses(self, theta=0.0):
        """Table of the smoothed stresses at the nodes, a row for each material of a node."""
        node, material = self.read("stress/nodal_node") - 1, self.read("stress/nodal_material") - 1
        r, z = self.mesh.coordinates[node].T
        return Table({"node": self.mesh.node_label[node], "material": self.mesh.material_label[material],
                      "r": r, "z": z} | _columns(STRESSES, self.nodal_stress_values(theta)))

    def gauss_stresses(self, theta=0.0):
        """Table of the stresses at the Gauss points, as computed."""
        element = self.read("stress/element") - 1
        r, z = self.read("stress/position").T
        return Table({"element": self.mesh.element_label[element], "point": _places(element),
                      "r": r, "z": z} | _columns(STRESSES, self._sum(self.gauss_amplitude, theta)))

    def joints(self, theta=None):
        """Table of the joint points on all planes on which the law is checked.

        theta: where no joint yields, and so no law is checked: angles [degree]; without it those of OUTPUT.

        joint, law, point, r, z, theta [degree]; sigma (tension positive), tau_xi, tau_theta; tau, the
        size of both; gap, how far the faces stand apart, the gap before loading included, 0 where they touch; d_eta,
        the normal relative displacement (positive opens); slip_xi and slip_theta, the relative
        displacements d_xi and d_theta, elastic parts included; slip, the size of both; state: stick, slip, open.
        """
        points = joint_points.JointPoints(self)
        owner, n = points.owner, len(points.owner)
        field = points.on_planes() if theta is None else points.at(np.atleast_1d(theta))
        count = len(field.theta) if n else 0
        position = self.read("joints/position").reshape(n, 2)
        each = np.tile(np.arange(n), count)
        tau_xi, _, tau_theta = field.stress.reshape(-1, 3).T
        slip_xi, d_eta, slip_theta = field.jump.reshape(-1, 3).T
        return Table({
            "joint": self.mesh.joint_label[owner][each],
            "law": self.mesh.law_label[self.mesh.joint_material[owner]][each],
            "point": _places(owner)[each], "r": position[each, 0], "z": position[each, 1],
            "theta": np.repeat(field.theta[:count], n), "sigma": field.sigma.ravel(), "tau_xi": tau_xi,
            "tau_theta": tau_theta, "tau": field.tau.ravel(), "gap": field.gap.ravel(), "d_eta": d_eta,
            "slip_xi": slip_xi, "slip_theta": slip_theta, "slip": field.slip.ravel(),
            "state": STATES[field.state.ravel()]})

    def convergence(self):
        """Table of the convergence path up to this increment; no rows for a linear job."""
        names = ("increment", "iteration", "load_factor", "ratio", "n_slip", "n_open")
        path = Table((name, self.read(f"convergence/{name}")) for name in names)
        return path if self._wanted is None else path.where(path["increment"] <= self._wanted)

    def spectrum(self):
        """Table of the modes: harmonic, family, largest amplitude of displacement and of stress.

        displacement is the largest sqrt(u^2 + v^2 + w^2) of the nodes; stress the largest root of the sum
        of the squares of all nine components, of the smoothed stresses.
        """
        weight = np.array([1, 1, 1, 2, 2, 2])
        size = np.sqrt((self.displacement_amplitude**2).sum(-1)).max(-1)
        stress = np.sqrt((self.nodal_amplitude**2*weight).sum(-1)).max(-1)
        family = np.where(self.family == circle.SYMMETRIC, "symmetric", "antisymmetric")
        return Table({"harmonic": self.harmonic, "family": family, "displacement": size, "stress": stress})

    # For other packages

    def to_pandas(self, theta=0.0):
        """All tables as pandas.DataFrames: a dictionary from their names.

        nodes, nodal_stresses, gauss_stresses at an angle [degree]; joints, increments, convergence, spectrum.
        """
        return convert.to_pandas(self, theta)

    def to_xarray(self):
        """What the file keeps of all increments as an xarray.Dataset.

        Amplitudes of displacements (increment, mode, node, component) and of smoothed stresses; relative
        displacements, stresses and states of joints (increment, plane [degree], joint_point); every series of
        the increments; resultants and motion of cuts. Fields and series that are not kept of an increment are nan there.
        """
        return convert.to_xarray(self)

    def to_pyvista(self, sectors=None):
        """The bodies swept round the axis as a pyvista.UnstructuredGrid, at this increment.

        sectors: of the circle; 16 for each wave of the highest harmonic, at least 36. Point data: displacement
        (x, y, z) and u, v, w; stress (xx, yy, zz, xy, yz, xz) and its cylindrical components, if they are
        kept of this increment. Cell data: body, material, element. The mesh is at rest: `warp_by_vector`.
        At the axis cells have points twice.
        """
        return convert.to_pyvista(self, sectors)

    def _sum(self, amplitude, theta):
        if np.ndim(theta):
            raise ValueError("theta is one angle here")
        return circle.totals(amplitude, self.harmonic, self.family,
                             np.full(amplitude.shape[1], float(theta)))


def open_result(path):
    """Open a result file NAME.h5: a Result."""
    return Result(path)


def open_combinations(path):
    """All combinations of a job: dictionary from their numbers to Results. Those of another deck than that of
    the latest, which an earlier run has left, are not among them.

    path: the results' name with the directory, as `out/chimney` or `out/chimney.h5`; the files are
    `chimney.1.h5`, `chimney.2.h5`, ..., or `chimney.h5` alone (number 0).
    """
    path = pathlib.Path(path)
    name = path.name.removesuffix(".h5")
    found = [Result(file) for file in result_files(path)]
    if not found:
        raise FileNotFoundError(f"no {name}.h5 or {name}.N.h5 in {path.parent}")
    own = [one for one in found if pathlib.PurePath(one.attributes.get("deck", "")).stem == name] or found  # else of another deck, or renamed
    latest = max(own, key=lambda one: one.path.stat().st_mtime_ns)
    found = [one for one in found if one.deck == latest.deck]
    return {result.combination: result for result in sorted(found, key=lambda one: one.combination)}


def result_files(path):
    """Files that may be results of a name, NAME.h5, NAME.1.h5, ...: a list. path: with the directory, with or without .h5"""
    path = pathlib.Path(path)
    pattern = re.compile(re.escape(path.name.removesuffix(".h5")) + r"(\.\d+)?\.h5")
    return [file for file in path.parent.iterdir() if pattern.fullmatch(file.name)]


def text_of(value):
    """A value of the file; bytes become text: UTF-8 or, of decks with other bytes in comments, Latin-1."""
    if not isinstance(value, bytes):
        return value
    try:
        text = value.decode("utf-8")
    except UnicodeDecodeError:
        text = value.decode("latin-1")
    return text.rstrip("\0")


def _datasets(file, group):
    """Paths of all datasets in a group."""
    found = []
    file[group].visititems(lambda name, item: found.append(f"{group}/{name}") if isinstance(item, h5py.Dataset) else None)
    return found


def _columns(names, values):
    return {name: values[..., k] for k, name in enumerate(names)}


def _place(point):
    return f"r = {point[0]:g}, z = {point[1]:g}"


def _places(owner):
    """1, 2, ... within each run of equal numbers."""
    start = np.flatnonzero(np.diff(owner, prepend=-1))
    return np.arange(len(owner)) - np.repeat(start, np.diff(start, append=len(owner))) + 1


def _filled(values, known, shape):
    """Values of the known points among all, nan elsewhere, in the shape of the points."""
    full = np.full((int(np.prod(shape)), values.shape[-1]), np.nan)
    full[known] = values
    return full.reshape(*shape, values.shape[-1])
