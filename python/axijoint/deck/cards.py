"""A method for each card. Written by `python -m axijoint.deck.make PROGRAM`: change nothing here."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Literal, Union

Integers = Union[int, Sequence[int]]
Reals = Union[float, Sequence[Union[float, None]], Sequence[Sequence[float]]]
Path = Union[str, os.PathLike[str]]

class Cards:
    """The cards of a deck."""

    def _entry(self, card: str, *values: object) -> None:
        raise NotImplementedError

    def _path(self, card: str, path: Path) -> None:
        raise NotImplementedError

    def control(self, highest: int, *, planes: int | None = None, gauss: int | None = None,
                gauss_quadratic: int | None = None,
                solver: Literal["AUTO", "BAND", "SKYLINE", "SPARSE"] | None = None,
                formulation: Literal["PLAIN", "BBAR"] | None = None,
                method: Literal["NEWTON", "TOTAL", "ANDERSON", "TRANSFER"] | None = None,
                body_method: Literal["ANDERSON", "NEWTON", "LBFGS", "TRANSFER"] | None = None,
                body_planes: int | None = None) -> None:
        """CONTROL: harmonics, planes, rules of integration, solver, methods.

        highest: highest harmonic M; allowed: 0 … 9999
        planes: planes θ from 0 to π on which the joint law is checked; if not given: 4M+1, at least 2; allowed:
            2 … 100000; at least M+1 if a joint can open or slip
        gauss: Gauss points per direction of 4-node elements; 3-node triangles: 2 for three points, 3 for seven;
            if not given: 2; allowed: 2, 3
        gauss_quadratic: the same of 8- and 9-node elements and 6-node triangles; if not given: 3; allowed: 2, 3
        solver: solver; if not given: AUTO; allowed: AUTO, BAND, SKYLINE, SPARSE
        formulation: 4-node elements; if not given: PLAIN; allowed: PLAIN, BBAR
        method: method for joints that open or slip; if not given: NEWTON; allowed: NEWTON, TOTAL, ANDERSON,
            TRANSFER
        body_method: method for bodies that yield; if not given: ANDERSON; allowed: ANDERSON, NEWTON, LBFGS,
            TRANSFER
        body_planes: planes θ from 0 to π on which the criteria of these are checked; if not given: 2M+1, at
            least 5; allowed: 2 … 100000; at least M+1
        """
        self._entry("CONTROL", highest, planes, gauss, gauss_quadratic, solver, formulation, method, body_method,
                    body_planes)

    def increments(self, factor: float, *, tolerance: float | None = None, iterations: int | None = None,
                   case: int | None = None, control: Literal["LOAD", "DISPLACEMENT"] | None = None) -> None:
        """INCREMENTS: steps of the load, one card each; without the section one step of factor 1.

        factor: factor on all loads, added to those of earlier increments; allowed: any
        tolerance: tolerance ε on residual forces: of the whole over the applied, and of each part in each
            harmonic over what its joints would carry; the largest counts; if not given: 1E-6; allowed: 0 < ε <
            1
        iterations: most iterations; if not given: 500; allowed: ≥ 1
        case: load case that the factor belongs to; if not given: all; allowed: of CASE, or 1
        control: whether the factor is given, or the displacement that it would give elastic bodies; if not
            given: LOAD; allowed: LOAD, DISPLACEMENT
        """
        self._entry("INCREMENTS", factor, tolerance, iterations, case, control)

    def output(self, angles: Reals) -> None:
        """OUTPUT: angles at which totals are listed.

        angles: angles θ [degree] at which totals are listed; if not given: without the section 0, 90, 180;
            allowed: −360 … 360
        """
        self._entry("OUTPUT", angles)

    def materials(self, material: int, young: float, poisson: float, *, density: float | None = None,
                  expansion: float | None = None) -> None:
        """MATERIALS: isotropic solids.

        material: material
        young: Young's modulus E [stress]; allowed: > 0
        poisson: Poisson's ratio ν; allowed: 0 ≤ ν < 0.5 (negative ratios are not accepted)
        density: density [mass/volume]; if not given: 0; allowed: ≥ 0
        expansion: thermal expansion [1/temperature]; if not given: 0
        """
        self._entry("MATERIALS", material, young, poisson, density, expansion)

    def orthotropic(self, material: int, young: Reals, *, angle: float | None = None,
                    density: float | None = None, expansion: Reals | None = None, poisson: Reals,
                    shear: Reals, expansion_3: float | None = None) -> None:
        """ORTHOTROPIC: solids with three moduli, along 1 and 2 in the r-z plane and along θ.

        material: material
        young: E_1 E_2 E_3 [stress]; allowed: > 0
        angle: angle from r to direction 1, counterclockwise [degree]; if not given: 0; allowed: −360 … 360
        density: density [mass/volume]; if not given: 0; allowed: ≥ 0
        expansion: thermal expansion along 1 and 2 [1/temperature]; if not given: 0
        poisson: ν_12 ν_23 ν_13; allowed: the elasticity must be positive definite
        shear: G_12 G_23 G_13 [stress]; allowed: > 0
        expansion_3: thermal expansion along 3 [1/temperature]; if not given: 0
        """
        self._entry("ORTHOTROPIC", material, young, angle, density, expansion, poisson, shear, expansion_3)

    def yield_(self, material: int, criterion: Literal["TRESCA", "MISES", "MOHR", "DRUCKER"],
               strength: float, *, friction: float | None = None, dilation: float | None = None,
               hardening: float | None = None, tension: float | None = None) -> None:
        """YIELD: solids that yield: criterion, strength, friction, dilation, hardening.

        material: material; allowed: of MATERIALS
        criterion: criterion: TRESCA, MISES; MOHR (Mohr and Coulomb), DRUCKER (Drucker and Prager, the cone
            through MOHR in triaxial compression); allowed: TRESCA, MISES, MOHR, DRUCKER
        strength: strength [stress]: of TRESCA and MISES the uniaxial yield stress (2 s_u and √3 s_u for an
            undrained shear strength s_u), of MOHR and DRUCKER the cohesion c; allowed: ≥ 0; > 0 without
            friction
        friction: friction angle φ of MOHR and DRUCKER [degree]; if not given: 0; allowed: 0 ≤ φ < 90
        dilation: angle of dilation ψ of MOHR and DRUCKER [degree]; if not given: 0; allowed: 0 ≤ ψ ≤ φ
        hardening: hardening H' [stress]: what the strength gains by a uniaxial plastic strain of one, TRESCA
            and MISES; of MOHR the cohesion gains 2 cos φ/(1 − sin ψ) H' by one in axial compression; if not
            given: 0; allowed: H' ≥ 0
        tension: tension that is borne at most [stress]: of TRESCA and MOHR the largest principal stress, of
            MISES and DRUCKER the mean stress; if not given: what the criterion allows; allowed: ≥ 0; below the
            apex of MOHR and DRUCKER
        """
        self._entry("YIELD", material, criterion, strength, friction, dilation, hardening, tension)

    def yielddepth(self, material: int, gradient: float, z: float) -> None:
        """YIELDDEPTH: strength of solids that yield, growing with depth.

        material: material; allowed: of YIELD
        gradient: what the strength of YIELD gains by a unit of depth below z_s [stress/length]; allowed: > 0
        z: z_s [length]; above it the strength is that of YIELD; allowed: any
        """
        self._entry("YIELDDEPTH", material, gradient, z)

    def laws(self, law: int, k_xi: float, k_eta: float, k_theta: float, *, cohesion: float | None = None,
             friction: float | None = None, kind: Literal["PAPER", "ELASTIC"] | None = None,
             rule: Literal["CENTROID", "GAUSS", "LOBATTO"] | None = None) -> None:
        """LAWS: joint laws: relative displacements to stresses.

        law: law
        k_xi: k_ξ [stress/length]; allowed: ≥ 0
        k_eta: k_η [stress/length]; allowed: > 0
        k_theta: k_θ [stress/length]; allowed: ≥ 0
        cohesion: cohesion C [stress]; if not given: 0; allowed: ≥ 0; blank if ELASTIC
        friction: friction angle φ [degree]; if not given: 0; allowed: 0 ≤ φ < 90; blank if ELASTIC
        kind: PAPER: opens in tension, slips at C − σ tan φ; ELASTIC: neither; if not given: PAPER; allowed:
            PAPER, ELASTIC
        rule: rule: GAUSS, LOBATTO (points at the nodes), CENTROID (one point; 4-node joints only); if not
            given: GAUSS; allowed: CENTROID, GAUSS, LOBATTO
        """
        self._entry("LAWS", law, k_xi, k_eta, k_theta, cohesion, friction, kind, rule)

    def lawdetails(self, law: int, *, slip: Literal["COMPONENTS", "RESULTANT"] | None = None,
                   opening: Literal["REVERSIBLE", "BOND"] | None = None,
                   residual_cohesion: float | None = None, residual_friction: float | None = None,
                   dilation: float | None = None, gap: float | None = None,
                   initial_stress: float | None = None) -> None:
        """LAWDETAILS: slip by resultant, bonds, residual strength, dilation, gap, initial stress of a law.

        law: law; allowed: of LAWS
        slip: slip: COMPONENTS (τ_ξ and τ_θ are each cut to C − σ tan φ, as in the paper), RESULTANT (their
            resultant is); if not given: COMPONENTS; allowed: COMPONENTS, RESULTANT
        opening: opening: REVERSIBLE (a point that closes has its cohesion as before, as in the paper), BOND
            (holds tension until it breaks for good; then C = 0); if not given: REVERSIBLE; allowed: REVERSIBLE,
            BOND
        residual_cohesion: residual cohesion, once a point has slipped [stress]; if not given: C; allowed: 0 … C
        residual_friction: residual friction angle [degree]; if not given: φ; allowed: 0 … φ
        dilation: angle of dilation ψ [degree]: slip s opens the joint by s tan ψ, either way; a joint that
            stands open by less presses; if not given: 0; allowed: 0 … φ; only with RESULTANT
        gap: gap before loading [length]; if not given: 0; allowed: ≥ 0
        initial_stress: initial normal stress, in equilibrium with what is not modelled [stress]; if not given:
            0; allowed: ≤ 0; not with a gap
        """
        self._entry("LAWDETAILS", law, slip, opening, residual_cohesion, residual_friction, dilation, gap, initial_stress)

    def gmsh(self, path: Path) -> None:
        """GMSH: path of a mesh file of Gmsh or its .geo file, from column 11 on; GROUPS says what groups mean."""
        self._path("GMSH", path)

    def groups(self, kind: Literal["BODY", "FACE", "JOINT"], number: int, *, material: int | None = None,
               name: str) -> None:
        """GROUPS: bodies, faces and joints of the physical groups of the mesh file.

        kind: kind; allowed: BODY, FACE, JOINT
        number: number of the body or face; law of the joints; allowed: body: 1 … 9999; law: of LAWS
        material: material; if not given: none; allowed: BODY: of MATERIALS or ORTHOTROPIC; else blank
        name: name of the physical group, or its number; allowed: the name may have blanks inside, and stand in
            quotation marks
        """
        self._entry("GROUPS", kind, number, material, name)

    def nodes(self, node: int, r: float, z: float) -> None:
        """NODES: nodes one by one.

        node: node
        r: r [length]; allowed: ≥ 0
        z: z [length]; allowed: any
        """
        self._entry("NODES", node, r, z)

    def lines(self, first: int, last: int, *, step: int | None = None, ratio: float | None = None) -> None:
        """LINES: nodes first + step, first + 2 step, … on the straight line between two nodes.

        first: first node; allowed: of a NODES card or an earlier LINES card
        last: last node; may be less than the first; allowed: the same
        step: step; if not given: 1; allowed: divides the difference of the numbers
        ratio: ratio of the last to the first interval (geometric progression); if not given: 1; allowed: 1E-6 …
            1000000
        """
        self._entry("LINES", first, last, step, ratio)

    def elements(self, element: int, material: int, *, body: int | None = None, nodes: Integers) -> None:
        """ELEMENTS: elements one by one.

        element: element
        material: material; allowed: of MATERIALS or ORTHOTROPIC
        body: body; if not given: 1; allowed: 1 … 9999
        nodes: nodes; allowed: 3, 4, 6, 8 or 9
        """
        self._entry("ELEMENTS", element, material, body, nodes)

    def blocks(self, *, body: int | None = None, material: int, nodes: int, n1: int, n2: int,
               ratio1: float | None = None, ratio2: float | None = None, corners: Reals) -> None:
        """BLOCKS: quadrilaterals or triangles in a quadrilateral with straight sides.

        body: body; if not given: 1; allowed: 1 … 9999
        material: material; allowed: of MATERIALS or ORTHOTROPIC
        nodes: nodes per element; allowed: 3, 4, 6, 8, 9
        n1: n1: elements along side 1-2; allowed: 1 … 100000
        n2: n2: elements along side 2-3; allowed: 1 … 100000
        ratio1: ratio of the last to the first element along 1-2; if not given: 1; allowed: 1E-6 … 1000000
        ratio2: the same along 2-3; if not given: 1; allowed: 1E-6 … 1000000
        corners: r1 z1 r2 z2 r3 z3 r4 z4: corners, counterclockwise; or r1 z1 r3 z3 alone: opposite corners of a
            rectangle; allowed: r ≥ 0
        """
        self._entry("BLOCKS", body, material, nodes, n1, n2, ratio1, ratio2, corners)

    def kinds(self, *, body: int | None = None, material: int | None = None, gauss: int | None = None,
              formulation: Literal["PLAIN", "BBAR"] | None = None) -> None:
        """KINDS: rule and formulation of elements that differ from CONTROL.

        body: body; if not given: all; allowed: 1 … 9999; one card an element
        material: material: of the body's elements of this material alone; if not given: all; allowed: of
            MATERIALS or ORTHOTROPIC
        gauss: Gauss points per direction, as in CONTROL; if not given: CONTROL's; allowed: 2, 3
        formulation: formulation, as in CONTROL; if not given: CONTROL's; allowed: PLAIN, BBAR
        """
        self._entry("KINDS", body, material, gauss, formulation)

    def faces(self, face: int, *, body: int | None = None, first: Reals, last: Reals) -> None:
        """FACES: faces of all outer edges of a body on a straight line.

        face: face
        body: body; if not given: 1; allowed: 1 … 9999
        first: r1 z1: first point; allowed: r ≥ 0
        last: r2 z2: last point; allowed: r ≥ 0
        """
        self._entry("FACES", face, body, first, last)

    def chains(self, face: int, nodes: Integers) -> None:
        """CHAINS: faces along chains of corner nodes.

        face: face
        nodes: corner nodes, two at least
        """
        self._entry("CHAINS", face, nodes)

    def joints(self, joint: int, law: int, nodes: Integers) -> None:
        """JOINTS: joints one by one.

        joint: joint
        law: law; allowed: of LAWS
        nodes: nodes 1 2 3 4, or 1 2 3 4 5 6
        """
        self._entry("JOINTS", joint, law, nodes)

    def interfaces(self, *, law: int | None = None, face_a: int, face_b: int,
                   kind: Literal["JOINTS", "BONDED"] | None = None, name: str | None = None) -> None:
        """INTERFACES: joints along two coinciding faces of two bodies, or a bond.

        law: law; if not given: none; allowed: of LAWS; blank if BONDED
        face_a: face a
        face_b: face b
        kind: JOINTS: joints of the law; BONDED: the bodies share the nodes of both faces; if not given: JOINTS;
            allowed: JOINTS, BONDED
        name: name, without commas; if not given: "interface n", n the card
        """
        self._entry("INTERFACES", law, face_a, face_b, kind, name)

    def harmonics(self, first: int, *, last: int | None = None, step: int | None = None) -> None:
        """HARMONICS: harmonics in use; without the section all from 0 to M.

        first: first harmonic; allowed: 0 … M
        last: last harmonic; if not given: the first; allowed: first … M
        step: step; if not given: 1; allowed: divides the difference
        """
        self._entry("HARMONICS", first, last, step)

    def shapes(self, shape: int, kind: Literal["PATCH", "COSINE", "TABLE"], values: Reals) -> None:
        """SHAPES: functions f(θ) by which loads go round the circle.

        shape: shape
        kind: kind; allowed: PATCH, COSINE, TABLE
        values: PATCH: θ1 θ2 [degree], f = 1 between them; COSINE: m θ0, f = cos m(θ − θ0); TABLE: θ f θ f θ f,
            linear between; further cards of the same number go on; if not given: θ0 of COSINE: 0; allowed: θ:
            −360 … 360; m: 0, 1, …, 9999
        """
        self._entry("SHAPES", shape, kind, values)

    def restraints(self, node: int, code: str, *, last: int | None = None, step: int | None = None,
                   first_harmonic: int | None = None, last_harmonic: int | None = None,
                   family: Literal["S", "A"] | None = None) -> None:
        """RESTRAINTS: fixed displacements of nodes.

        node: node
        code: code: three digits for u, v, w; 1 fixed, 0 free; allowed: 001 … 111
        last: last node: node, node + step, …; if not given: the node alone
        step: step; if not given: 1; allowed: divides the difference
        first_harmonic: first harmonic that it holds in; if not given: every harmonic; allowed: 0 … M
        last_harmonic: last harmonic; it may be above M; if not given: the first; allowed: first … 9999
        family: family S or A; if not given: both; allowed: S, A
        """
        self._entry("RESTRAINTS", node, code, last, step, first_harmonic, last_harmonic, family)

    def fixedfaces(self, face: int, code: str, *, first_harmonic: int | None = None,
                   last_harmonic: int | None = None, family: Literal["S", "A"] | None = None) -> None:
        """FIXEDFACES: fixed displacements of faces.

        face: face
        code: code: three digits for u, v, w; 1 fixed, 0 free; allowed: 001 … 111
        first_harmonic: first harmonic that it holds in; if not given: every harmonic; allowed: 0 … M
        last_harmonic: last harmonic; it may be above M; if not given: the first; allowed: first … 9999
        family: family S or A; if not given: both; allowed: S, A
        """
        self._entry("FIXEDFACES", face, code, first_harmonic, last_harmonic, family)

    def case(self, case: int, *, name: str | None = None) -> None:
        """CASE: begins a load case: the loads below it, up to the next CASE, belong to it.

        case: load case; allowed: each number once
        name: name, without commas; allowed: blanks inside are allowed
        """
        self._entry("CASE", case, name)

    def tractions(self, face: int, *, harmonic: int | None = None, first: Reals | None = None,
                  last: Reals | None = None, family: Literal["S", "A"] | None = None,
                  shape: int | None = None) -> None:
        """TRACTIONS: tractions on faces, linear along them.

        face: face
        harmonic: harmonic m; if not given: given by the shape; allowed: of those in use; blank if a shape is
            given
        first: t_r t_z t_θ [stress] at the first point of the face; if not given: 0; allowed: one at least of
            all six must be given
        last: the same at its last point; if not given: each as at the first point
        family: family S or A; if not given: S; allowed: blank if a shape is given
        shape: shape; if not given: none; allowed: of SHAPES
        """
        self._entry("TRACTIONS", face, harmonic, first, last, family, shape)

    def pressures(self, face: int, *, harmonic: int | None = None, first: float, last: float | None = None,
                  family: Literal["S", "A"] | None = None, shape: int | None = None) -> None:
        """PRESSURES: pressures on faces, linear along them.

        face: face
        harmonic: harmonic m; if not given: given by the shape; allowed: of those in use; blank if a shape is
            given
        first: p [stress] at the first point of the face, positive into the body; allowed: any
        last: p at its last point; if not given: as at the first; allowed: any
        family: family S or A; if not given: S; allowed: blank if a shape is given
        shape: shape; if not given: none; allowed: of SHAPES
        """
        self._entry("PRESSURES", face, harmonic, first, last, family, shape)

    def resultants(self, face: int, kind: Literal["LATERAL", "MOMENT", "AXIAL", "TORQUE"], value: float, *,
                   direction: float | None = None) -> None:
        """RESULTANTS: tractions on faces with a given resultant.

        face: face
        kind: kind; allowed: LATERAL, MOMENT, AXIAL, TORQUE
        value: value [force], [force × length] of MOMENT and TORQUE; allowed: any
        direction: direction θ0 [degree] of LATERAL and MOMENT; if not given: 0; allowed: −360 … 360
        """
        self._entry("RESULTANTS", face, kind, value, direction)

    def ringloads(self, node: int, *, harmonic: int | None = None, force: Reals | None = None,
                  family: Literal["S", "A"] | None = None, shape: int | None = None) -> None:
        """RINGLOADS: forces on nodal circles, per length.

        node: node
        harmonic: harmonic m; if not given: given by the shape; allowed: of those in use; blank if a shape is
            given
        force: q_r q_z q_θ: amplitudes of the force per length of the nodal circle [force/length]; if not given:
            0; allowed: one at least must be given
        family: family S or A; if not given: S; allowed: blank if a shape is given
        shape: shape; if not given: none; allowed: of SHAPES; not on the axis
        """
        self._entry("RINGLOADS", node, harmonic, force, family, shape)

    def pointloads(self, node: int, theta: float, *, force: Reals | None = None) -> None:
        """POINTLOADS: forces at points of nodal circles, in all harmonics.

        node: node
        theta: θ [degree]; allowed: −360 … 360
        force: F_r F_z F_θ [force]; if not given: 0; allowed: one at least must be given
        """
        self._entry("POINTLOADS", node, theta, force)

    def gravity(self, *, vertical: float | None = None, lateral: float | None = None,
                direction: float | None = None) -> None:
        """GRAVITY: weight along z and sideways, of what has a density.

        vertical: g_z [length/time²], positive upwards: usually negative; if not given: 0; allowed: one of both
            must not be 0
        lateral: lateral g; if not given: 0
        direction: its direction θ0 [degree]; if not given: 0; allowed: −360 … 360
        """
        self._entry("GRAVITY", vertical, lateral, direction)

    def rotation(self, speed: float) -> None:
        """ROTATION: centrifugal forces of what has a density.

        speed: angular velocity ω about the axis [radian/time]; allowed: any
        """
        self._entry("ROTATION", speed)

    def temperatures(self, *, body: int | None = None, harmonic: int | None = None,
                     values: Reals | None = None, family: Literal["S", "A"] | None = None,
                     shape: int | None = None) -> None:
        """TEMPERATURES: changes of temperature of bodies, linear in r and z.

        body: body; if not given: all; allowed: 1 … 9999
        harmonic: harmonic m; if not given: given by the shape; allowed: of those in use; blank if a shape is
            given
        values: T0, dT/dr, dT/dz: T = T0 + r dT/dr + z dT/dz; if not given: 0; allowed: one at least must be
            given
        family: family S or A; if not given: S; allowed: blank if a shape is given
        shape: shape; if not given: none; allowed: of SHAPES
        """
        self._entry("TEMPERATURES", body, harmonic, values, family, shape)

    def nodetemps(self, node: int, *, last: int | None = None, step: int | None = None,
                  harmonic: int | None = None, value: float, family: Literal["S", "A"] | None = None,
                  shape: int | None = None) -> None:
        """NODETEMPS: changes of temperature of nodes.

        node: node
        last: last node: node, node + step, …; if not given: the node alone
        step: step; if not given: 1; allowed: divides the difference
        harmonic: harmonic m; if not given: given by the shape; allowed: of those in use; blank if a shape is
            given
        value: T; allowed: any
        family: family S or A; if not given: S; allowed: blank if a shape is given
        shape: shape; if not given: none; allowed: of SHAPES
        """
        self._entry("NODETEMPS", node, last, step, harmonic, value, family, shape)

    def movednodes(self, node: int, *, harmonic: int | None = None, values: Reals | None = None,
                   family: Literal["S", "A"] | None = None, last: int | None = None,
                   step: int | None = None, hold: Literal["EVERY", "ONLY"] | None = None) -> None:
        """MOVEDNODES: given displacements of nodes.

        node: node
        harmonic: harmonic m; if not given: must be given; allowed: of those in use
        values: u v w: amplitudes [length]; if not given: not held by this card; allowed: one at least must be
            given
        family: family S or A; if not given: S; allowed: S, A
        last: last node: node, node + step, …; if not given: the node alone
        step: step; if not given: 1; allowed: divides the difference
        hold: EVERY: held in all harmonics; ONLY: in this harmonic and family; if not given: EVERY; allowed:
            EVERY, ONLY
        """
        self._entry("MOVEDNODES", node, harmonic, values, family, last, step, hold)

    def movedfaces(self, face: int, *, harmonic: int | None = None, first: Reals | None = None,
                   last: Reals | None = None, family: Literal["S", "A"] | None = None,
                   hold: Literal["EVERY", "ONLY"] | None = None) -> None:
        """MOVEDFACES: given displacements of faces, linear along them.

        face: face
        harmonic: harmonic m; if not given: must be given; allowed: of those in use
        first: u v w [length] at the first point of the face; if not given: not held by this card; allowed: one
            at least must be given
        last: the same at its last point; if not given: as at the first
        family: family S or A; if not given: S; allowed: S, A
        hold: EVERY: held in all harmonics; ONLY: in this harmonic and family; if not given: EVERY; allowed:
            EVERY, ONLY
        """
        self._entry("MOVEDFACES", face, harmonic, first, last, family, hold)

    def insitu(self, *, body: int | None = None, z: float, gamma: float, k0: float,
               stress: float | None = None, material: int | None = None,
               balance: Literal["CHECK", "MEANT"] | None = None) -> None:
        """INSITU: stress before all loads, σ_z = σ_zs + γ (z − z_s), σ_r = σ_θ = K0 σ_z.

        body: body; if not given: all; allowed: 1 … 9999; one card an element and load case
        z: z_s [length]; allowed: any
        gamma: γ [stress/length]; allowed: any
        k0: K0; allowed: ≥ 0
        stress: σ_zs [stress]; if not given: 0; allowed: any
        material: material: of the body's elements of this material alone; if not given: all; allowed: of
            MATERIALS or ORTHOTROPIC
        balance: CHECK, or MEANT: out of balance on purpose; if not given: CHECK; allowed: CHECK, MEANT
        """
        self._entry("INSITU", body, z, gamma, k0, stress, material, balance)

    def springs(self, face: int, *, stiffness: Reals | None = None) -> None:
        """SPRINGS: springs between faces and the ground, in all harmonics and load cases.

        face: face
        stiffness: k_n k_s k_θ [stress/length]: normal to the face, along it in the r-z plane, along θ; if not
            given: 0; allowed: ≥ 0, one above 0
        """
        self._entry("SPRINGS", face, stiffness)

    def combine(self, combination: int, *, factors: Mapping[int, float] | None = None) -> None:
        """COMBINE: combinations of load cases; without the section each is one of its own.

        combination: combination; further cards with the same number go on with it
        factors: five pairs, one at least: load case I5, factor F10; if not given: none; allowed: each case once
        """
        self._entry("COMBINE", combination, factors)

    def sections(self, section: int, first: Reals, last: Reals, *, points: int | None = None,
                 angles: Reals | None = None) -> None:
        """SECTIONS: results along straight lines in the r-z plane.

        section: section; allowed: each number once
        first: r1 z1: first point; allowed: r ≥ 0
        last: r2 z2: last point; allowed: r ≥ 0; not the first point
        points: number of points, at equal distances; if not given: 11; allowed: 2 … 100000
        angles: angles θ [degree]; if not given: those of OUTPUT; allowed: −360 … 360
        """
        self._entry("SECTIONS", section, first, last, points, angles)

    def cuts(self, cut: int, z: float, *, body: int | None = None, last: float | None = None,
             number: int | None = None) -> None:
        """CUTS: resultants on cuts z = const..

        cut: cut; several are numbered on from it; allowed: each number once
        z: z [length]; allowed: lowest … highest z of the body
        body: body; if not given: all; allowed: 1 … 9999
        last: z of the last of several cuts at equal distances; if not given: one cut; allowed: as z; another
            height
        number: number of these cuts; if not given: 11; allowed: 2 … 100000
        """
        self._entry("CUTS", cut, z, body, last, number)

    def points(self, point: int, place: Reals, *, body: int | None = None, name: str | None = None) -> None:
        """POINTS: points with names whose displacements are followed through the increments.

        point: point; allowed: each number once
        place: r z: place [length]; allowed: in the mesh
        body: body; if not given: the lowest there; allowed: 1 … 9999
        name: name; if not given: point and its number; allowed: each once
        """
        self._entry("POINTS", point, place, body, name)

    def keep(self, what: Literal["SERIES", "DISPLACE", "JOINTS", "STRESSES"],
             when: Literal["ALL", "EVERY", "LAST", "ONLY"], *, increments: Integers | None = None) -> None:
        """KEEP: of which increments results are kept; without the section all but stresses.

        what: what: SERIES resultants, energies, named points; DISPLACE displacements; JOINTS stresses, relative
            displacements and states of joints; STRESSES of solids; allowed: SERIES, DISPLACE, JOINTS, STRESSES
        when: of which increments; always of the last, too; allowed: ALL, EVERY n-th, LAST alone, ONLY those
            that follow
        increments: n of EVERY, or increments of ONLY; several cards of ONLY add up; if not given: none;
            allowed: increments of the deck
        """
        self._entry("KEEP", what, when, increments)

    def print(self,
              table: Literal["DECK", "COORDS", "INCIDENCE", "JOINTNODES", "LOADS", "PATH", "AMPLITUDE", "TOTALS", "STRESSES", "NODAL", "STATES", "REACTIONS", "ORDERS", "TABLES"],
              rows: Literal["ALL", "EVERY", "UPTO", "NONE"], *, number: int | None = None,
              body: int | None = None, rectangle: Reals | None = None) -> None:
        """PRINT: how much of long tables the listing shows; without it tables of up to 1000 rows, but not ORDERS.

        table: table: DECK; COORDS, INCIDENCE, JOINTNODES of the mesh; LOADS; PATH of iterations; AMPLITUDE,
            TOTALS of displacements; STRESSES at Gauss points; NODAL ones; STATES of joints; REACTIONS; ORDERS
            of the nodes, side by side; all TABLES; allowed: DECK, COORDS, INCIDENCE, JOINTNODES, LOADS, PATH,
            AMPLITUDE, TOTALS, STRESSES, NODAL, STATES, REACTIONS, ORDERS, TABLES
        rows: its rows; allowed: ALL, EVERY n-th, UPTO n: all if they are so many at most, NONE
        number: n of EVERY and UPTO; if not given: 1000
        body: of which body; if not given: any; allowed: 1 … 9999
        rectangle: least r, least z, largest r, largest z of a rectangle: of places in it; if not given:
            anywhere; allowed: all four, or none
        """
        self._entry("PRINT", table, rows, number, body, rectangle)

    def oldlisting(self, amount: int, *, first: int | None = None, last: int | None = None) -> None:
        """OLDLISTING: what the listing of --listing owen-hinton shows of increments; without the section all of
            all.

        amount: NOUTP: 0 nothing, 1 displacements, 2 reactions, too, 3 stresses, too; allowed: 0 … 3
        first: first increment; if not given: 1; allowed: increments of the deck
        last: last increment; if not given: the first; of all, if that is blank, too; allowed: increments from
            the first on
        """
        self._entry("OLDLISTING", amount, first, last)

    def sweep(self, *, first: float | None = None, last: float | None = None, sectors: int | None = None) -> None:
        """SWEEP: files for ParaView: bodies and joints swept through θ; alone, the whole circle.

        first: first angle θ [degree]; if not given: 0; allowed: −360 … 360
        last: last angle; if not given: 360; allowed: above the first by 360 at most
        sectors: number of sectors; if not given: 16 for each wave of the highest harmonic solved, at least 36
            for the circle; allowed: at least one for 120 degrees
        """
        self._entry("SWEEP", first, last, sectors)

    def error(self, target: float, *,
              quantity: Literal["JOINTS", "DISPL", "ENERGY", "POINTS", "CUTS", "SECTIONS"] | None = None,
              rounds: int | None = None, unknowns: int | None = None,
              division: Literal["GRADED", "UNIFORM"] | None = None) -> None:
        """ERROR: the job is solved again, refined, until its error is below a target.

        target: target [%]; allowed: 0 < … ≤ 100
        quantity: of what: JOINTS (joint stress), DISPL (displacements), ENERGY (stresses in the energy norm),
            POINTS (displacements at points of POINTS), CUTS (resultants on CUTS), SECTIONS (stresses along
            SECTIONS); if not given: DISPL; allowed: JOINTS, DISPL, ENERGY, POINTS, CUTS, SECTIONS
        rounds: most rounds; if not given: 8; allowed: 1 … 99
        unknowns: most unknowns in all: no round is begun that could have more; if not given: 1000000; allowed:
            1 … 1000000000
        division: elements of BLOCKS: GRADED (more of them where the error is), UNIFORM (all divided alike); if
            not given: GRADED; allowed: GRADED, UNIFORM
        """
        self._entry("ERROR", target, quantity, rounds, unknowns, division)

    def include(self, path: Path) -> None:
        """INCLUDE: path of a file, from column 11 on, whose cards take the place of this one."""
        self._path("INCLUDE", path)
