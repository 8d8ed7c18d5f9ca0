"""Scenes for the estimates of errors, as decks on any mesh: corners, edges of contact, stiff and soft bodies, bonds,
friction, heat, histories. Lengths in m, forces in MN."""
import os
import sys
from dataclasses import dataclass, replace

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path.insert(0, os.path.join(ROOT, "test", "decks"))
from hard_scenes import eccentric_disc

RESULTANT = ("RESULTANT", "REVERSIBLE")
BOND = ("RESULTANT", "BOND")


@dataclass(frozen=True)
class Setting:
    """How a scene is computed: kind of element ("8R": reduced rule, "4B": B-bar), elements of the coarse mesh along
    each side times `n`, ratio of the largest to the least element towards corners, `slender`: elements along r
    times so many; M, planes, tolerance, method"""
    kind: str = "8"
    n: float = 1.0
    grade: float = 1.0
    slender: float = 1.0
    harmonic: int = 4
    planes: int = 17
    tolerance: float = 1e-8
    method: str = "NEWTON"

    @property
    def nodes(self):
        """Nodes of an element"""
        return int(self.kind[0])

    def fine(self, n=5.0, grade=30.0):
        """The setting of a reference: 8-node elements, many, small at corners"""
        return replace(self, kind="8", n=n, grade=grade, slender=1.0)


class Scene:
    """A deck that is being written"""

    def __init__(self, title, setting):
        self.setting = setting
        order = (3 if setting.kind == "4B" else 2, 2 if setting.kind.endswith("R") else 3)
        self.lines = ["TITLE", title, "CONTROL", f"{setting.harmonic}, {setting.planes}, 2, {order[1]}, , "
                      f"{'BBAR' if setting.kind == '4B' else ''}, {setting.method}"]

    def add(self, section, *cards):
        """Cards of a section"""
        self.lines.append(section)
        self.lines += [card if "," in card else card + "," for card in cards]
        return self

    def block(self, body, material, n1, n2, corners, towards=(0, 0)):
        """A block; `towards` is 1 or 2 along each direction where elements are small at the first or second end"""
        s = self.setting
        counts = [max(1, round(n1*s.n*s.slender)), max(1, round(n2*s.n))]
        ratios = [{0: 1.0, 1: s.grade, 2: 1/s.grade}[side] for side in towards]
        return self.add("BLOCKS", f"{body}, {material}, {s.nodes}, {counts[0]}, {counts[1]}, {ratios[0]:.6g}, "
                        f"{ratios[1]:.6g}", ", ".join(f"{x:.10g}" for x in corners))

    def cuts(self, body, first, last, n):
        """Cuts through a body"""
        return self.add("CUTS", f"1, {first}, {body}, {last}, {n}")

    def sections(self, *lines):
        """Lines along which stresses are looked at, from r, z to r, z, at angles all round"""
        self.add("SECTIONS", *(f"{k}, {', '.join(f'{x:.10g}' for x in line)}, 13" for k, line in enumerate(lines, 1)))
        angles = [f"{5*k}" for k in range(72)]
        return self.add("OUTPUT", *(", ".join(angles[k:k + 8]) for k in range(0, 72, 8)))

    def law(self, number, k, cohesion=None, friction=None, details=None):
        """A law with k along xi and theta, 2 k along eta; elastic without cohesion"""
        if cohesion is None:
            return self.add("LAWS", f"{number}, {k:g}, {2*k:g}, {k:g}, , , ELASTIC, GAUSS")
        self.add("LAWS", f"{number}, {k:g}, {2*k:g}, {k:g}, {cohesion:g}, {friction:g}, PAPER, GAUSS")
        return self.add("LAWDETAILS", f"{number}, {', '.join(details)}") if details else self

    def text(self, *increments):
        """The deck; increments are factors, perhaps with a load case"""
        cards = [f"{factor:g}, {self.setting.tolerance:g}, , {case}" for factor, case in increments or ((1, ""),)]
        return "\n".join(self.add("INCREMENTS", *cards).lines) + "\nEND\n"


def pile(setting, *, k=1e4, cohesion=None, friction=None, details=RESULTANT, young=(2e4, 2e4), head=False,
         loads=("1, LATERAL, 0.4", "1, MOMENT, 0.8"), springs=False):
    """The paper's pile in its socket; `head`: the joint on its head opens and slips like the shaft"""
    scene = Scene("Pile in a socket", setting)
    scene.add("MATERIALS", f"1, {young[0]:g}, 0.17", f"2, {young[1]:g}, 0.17")
    scene.law(1, k, cohesion, friction, details if cohesion is not None else None).law(2, k)
    scene.block(1, 1, 4, 2, (0, -.5, .5, 0), (2, 2)).block(1, 1, 4, 8, (0, 0, .5, 1), (2, 0))
    scene.block(2, 2, 6, 8, (.5, 0, 2, 1), (1, 0)).block(2, 2, 4, 4, (0, 1, .5, 2), (2, 1))
    scene.block(2, 2, 6, 4, (.5, 1, 2, 2), (1, 1))
    scene.add("FACES", "1, 1, 0, -.5, .5, -.5", "2, 1, .5, 0, .5, 1", "3, 2, .5, 0, .5, 1", "4, 1, 0, 1, .5, 1",
              "5, 2, 0, 1, .5, 1", "6, 2, 0, 2, 2, 2")
    scene.add("INTERFACES", "1, 2, 3", f"{1 if head else 2}, 4, 5")
    scene.sections((.25, -.45, .25, .95), (0, .45, 2, .45))
    if springs:
        scene.add("SPRINGS", "6, 2e4, 1e4, 1e4")
    else:
        scene.add("FIXEDFACES", "6, 111")
    return scene.cuts(1, 0, 0.93, 12).add("RESULTANTS", *loads).text()


def notch(setting, m=1, ratio=1.0):
    """A ring with a re-entrant corner, pressed by cos m theta; its flange perhaps of another material"""
    scene = Scene("Notch", setting).add("HARMONICS", str(m))
    scene.add("MATERIALS", "1, 2e4, 0.3", f"2, {2e4*ratio:g}, 0.2")
    scene.block(1, 1, 4, 4, (.5, -1, 1, 0), (2, 2)).block(1, 1, 4, 4, (.5, 0, 1, 1), (2, 1))
    scene.block(1, 1 if ratio == 1.0 else 2, 6, 4, (1, 0, 2, 1), (1, 1))
    scene.add("FACES", "1, 1, .5, -1, 1, -1", "2, 1, .5, 1, 2, 1", "3, 1, 2, 0, 2, 1").add("FIXEDFACES", "1, 111")
    scene.sections((.5, -.55, 1, -.55), (.5, .55, 2, .55))
    return scene.add("PRESSURES", f"3, {m}, 1, 1", f"2, {m}, .5, .5").text()


def built_in(setting, poisson=0.3):
    """A thick tube built in at its foot, pushed sideways at its top: corners of a support"""
    scene = Scene("Built in", setting).add("HARMONICS", "1").add("MATERIALS", f"1, 2e4, {poisson:g}")
    scene.block(1, 1, 4, 8, (.5, 0, 1, 2), (2, 1)).add("FACES", "1, 1, .5, 0, 1, 0", "2, 1, .5, 2, 1, 2")
    scene.sections((.5, 1.05, 1, 1.05), (.6, .3, .6, 2))
    return scene.add("FIXEDFACES", "1, 111").add("RESULTANTS", "2, LATERAL, 1").text()


def held_twice(setting, springs=False):
    """A thick tube held at its foot and beside its top, or there by springs, pushed sideways between"""
    scene = Scene("Held twice", setting).add("HARMONICS", "0, 1").add("MATERIALS", "1, 2e4, 0.3")
    scene.block(1, 1, 2, 4, (.5, 0, 1, 1), (2, 1)).block(1, 1, 2, 4, (.5, 1, 1, 2), (2, 0)).block(1, 1, 2, 4, (.5, 2, 1, 3), (2, 1))
    scene.add("FACES", "1, 1, .5, 0, 1, 0", "2, 1, 1, 2, 1, 3", "3, 1, 1, 1, 1, 2", "4, 1, .5, 3, 1, 3").add("FIXEDFACES", "1, 111")
    scene.sections((.5, 1.45, 1, 1.45), (.6, .3, .6, 1.7))
    scene.add("SPRINGS" if springs else "FIXEDFACES", "2, 1e3, 3e4, 1e3" if springs else "2, 101")
    return scene.cuts(1, 0, 3, 13).add("RESULTANTS", "3, LATERAL, 1", "4, AXIAL, -1", "4, TORQUE, 0.3").text()


def tube(setting, thickness=0.5, height=2.0, shape="TABLE, -45, 0, 0, 1, 45, 0"):
    """A tube that stands on its end and is pressed on a part of the circle"""
    scene = Scene("Tube", setting).add("MATERIALS", "1, 2e5, 0.3")
    scene.block(1, 1, max(1, round(6*thickness)), 8, (1, 0, 1 + thickness, height))
    scene.add("FACES", f"1, 1, {1 + thickness}, 0, {1 + thickness}, {height}", f"2, 1, 1, 0, {1 + thickness}, 0").add("FIXEDFACES", "2, 111")
    scene.sections((1, .45*height, 1 + thickness, .45*height), (1, .2*height, 1, height))
    return scene.add("SHAPES", f"1, {shape}").add("PRESSURES", "1, , 1, , , 1").text()


def chimney(setting, m=1, thickness=0.05):
    """A thin tube in elements far longer than what bends at its ends, pressed round its rim like cos m theta"""
    scene = Scene("Chimney", setting).add("HARMONICS", str(m)).add("MATERIALS", "1, 2e5, 0.3")
    scene.block(1, 1, 1, 6, (2 - thickness, 0, 2, 12), (0, 0)).add("FACES", f"1, 1, {2 - thickness}, 0, 2, 0", f"2, 1, {2 - thickness}, 12, 2, 12")
    scene.sections((2, 2, 2, 11), (2 - thickness, 6.3, 2, 6.3))
    return scene.add("FIXEDFACES", "1, 111").add("TRACTIONS", f"2, {m}, 1, .2").text()


def rim(setting, m=0, thickness=0.001, across=1, along=32):
    """A very thin tube whose elements are about as long as what bends at its rim, which is pressed like cos m theta"""
    scene = Scene("Rim", setting).add("HARMONICS", str(m)).add("MATERIALS", "1, 1e5, 0.3")
    inner, outer = 1 - thickness/2, 1 + thickness/2
    scene.block(1, 1, across, along, (inner, 0, outer, 1), (0, 1 if setting.grade > 1 else 0))
    scene.add("FACES", f"1, 1, {inner}, 0, {outer}, 0", f"2, 1, {inner}, 1, {outer}, 1")
    scene.sections((outer, 0, outer, .8))
    return scene.add("FIXEDFACES", "2, 111" if m else "2, 010").add("TRACTIONS", f"1, {m}, {1/thickness:g}").text()


def plate(setting, m=2):
    """A thin disc, held at its rim and pressed by cos m theta: one or two elements bend"""
    scene = Scene("Plate", setting).add("HARMONICS", str(m)).add("MATERIALS", "1, 2e5, 0.3")
    scene.block(1, 1, 8, 1, (0, 0, 2, .2), (2, 0)).add("FACES", "1, 1, 2, 0, 2, .2", "2, 1, 0, .2, 2, .2")
    scene.sections((.1, .2, 1.6, .2), (.9, 0, .9, .2))
    return scene.add("FIXEDFACES", "1, 111").add("PRESSURES", f"2, {m}, 1").text()


def ring(setting, m=6, outer=1.2, poisson=0.3):
    """A ring in plane strain, pressed by cos m theta outside"""
    scene = Scene("Ring", setting).add("HARMONICS", str(m)).add("MATERIALS", f"1, 3e4, {poisson:g}")
    scene.block(1, 1, 6, 1, (1, 0, outer, (outer - 1)/6)).add("FACES", f"1, 1, {outer}, 0, {outer}, {(outer - 1)/6:.10g}",
                                                               f"2, 1, 1, 0, {outer}, 0", f"3, 1, 1, {(outer - 1)/6:.10g}, {outer}, {(outer - 1)/6:.10g}")
    scene.sections((1, (outer - 1)/12, outer, (outer - 1)/12))
    return scene.add("FIXEDFACES", "2, 010", "3, 010").add("PRESSURES", f"1, {m}, 1").text()


def soft(setting, shape="pier", poisson=0.49):
    """A soft pier on ground that is nearly incompressible, a soft layer on it, or a ring of that in a soft one; pressed and pushed
    sideways"""
    scene = Scene(f"Soft, {shape}", setting).add("MATERIALS", "1, 500, 0.3", f"2, 1e4, {poisson:g}")
    if shape == "ring":
        scene.block(1, 2, 4, 6, (1, 0, 1.5, 1), (0, 2)).block(1, 1, 6, 6, (1.5, 0, 3, 1), (2, 2))
        scene.add("FACES", "1, 1, 1, 1, 1.5, 1", "2, 1, 3, 0, 3, 1")
    else:
        scene.block(1, 1, 6, 4, (0, 0, 1, .5), (2, 1)).block(1, 2, 6, 8, (0, -2, 1, 0), (2, 2))
        if shape == "layer":
            scene.block(1, 1, 6, 4, (1, 0, 3, .5), (1, 1))
        scene.block(1, 2, 6, 8, (1, -2, 3, 0), (1, 2)).add("FACES", "1, 1, 0, .5, 1, .5", "2, 1, 0, -2, 3, -2")
    if shape != "ring":
        scene.sections((0, -.9, 3, -.9), (0, .3, 1, .3))
    else:
        scene.sections((1, .55, 3, .55))
    return scene.add("FIXEDFACES", "2, 111").add("RESULTANTS", "1, AXIAL, -4", "1, LATERAL, 1").text()


def jacks(setting):
    """A lining in ground that presses on it, and two jacks that press on parts of it"""
    scene = Scene("Jacks", setting).add("MATERIALS", "1, 3e4, 0.2", "2, 1e3, 0.3").law(1, 2e3, 0.0, 30.0, RESULTANT)
    scene.block(1, 1, 4, 1, (2, 0, 2.2, .2)).block(2, 2, 16, 1, (2.2, 0, 20, .2), (0, 0))
    scene.add("FACES", "1, 1, 2.2, 0, 2.2, .2", "2, 2, 2.2, 0, 2.2, .2", "3, 1, 2, 0, 2, .2", "4, 1, 2, 0, 2.2, 0",
              "5, 1, 2, .2, 2.2, .2", "6, 2, 2.2, 0, 20, 0", "7, 2, 2.2, .2, 20, .2", "8, 2, 20, 0, 20, .2")
    scene.add("INTERFACES", "1, 1, 2").add("FIXEDFACES", *(f"{face}, 010" for face in (4, 5, 6, 7)), "8, 111, 1, 9999")
    scene.sections((2, .1, 4, .1))
    scene.add("SHAPES", "1, PATCH, -20, 20", "2, PATCH, 160, 200")
    return scene.add("PRESSURES", "8, 0, 1.5", "3, , 1, , , 1", "3, , 1, , , 2").text()


def lining(setting, k=1e3):
    """A lining in ground that presses it unequally round the circle"""
    scene = Scene("Lining", setting).add("MATERIALS", "1, 3e4, 0.2", "2, 200, 0.3").law(1, k, 0.0, 20.0, RESULTANT)
    scene.block(1, 1, 2, 1, (2.7, 0, 3, .5)).block(2, 2, 12, 1, (3, 0, 20, .5))
    scene.add("FACES", "1, 1, 3, 0, 3, .5", "2, 2, 3, 0, 3, .5", "3, 2, 20, 0, 20, .5", "4, 1, 2.7, 0, 3, 0", "5, 1, 2.7, .5, 3, .5",
              "6, 2, 3, 0, 20, 0", "7, 2, 3, .5, 20, .5").add("INTERFACES", "1, 1, 2")
    scene.sections((2.7, .25, 6, .25))
    scene.add("FIXEDFACES", *(f"{face}, 010" for face in (4, 5, 6, 7)))
    return scene.add("TRACTIONS", "3, 0, -1.0, 0, 0", "3, 2, 0.6, 0, -0.6").text()


def raft(setting):
    """A raft on ground under its weight, and a column on a part of it"""
    scene = Scene("Raft", setting).add("MATERIALS", "1, 3e4, 0.2", "2, 50, 0.3").law(1, 200, 0.0, 30.0, RESULTANT)
    scene.block(1, 1, 4, 2, (0, 0, 3, .6)).block(1, 1, 2, 2, (3, 0, 4, .6)).block(1, 1, 2, 2, (4, 0, 5, .6))
    for first, last, n in ((0, 3, 4), (3, 4, 2), (4, 5, 2), (5, 20, 6)):
        scene.block(2, 2, n, 6, (first, -15, last, 0), (1 if first == 5 else 0, 2))
    scene.add("FACES", "1, 1, 0, 0, 5, 0", "2, 2, 0, 0, 5, 0", "3, 1, 0, .6, 5, .6", "4, 1, 3, .6, 4, .6", "5, 2, 0, -15, 20, -15",
              "6, 2, 20, -15, 20, 0").add("INTERFACES", "1, 1, 2").add("FIXEDFACES", "5, 111", "6, 101")
    scene.sections((0, .3, 5, .3), (0, -2, 10, -2))
    return scene.add("SHAPES", "1, PATCH, -12, 12").add("PRESSURES", "3, 0, .1", "4, , 1, , , 1").text()


def point_force(setting, body="tube", direction="0, 0, 1"):
    """A force at one point: on the edge of a tube, along its circle, or of a pile in ground without joints"""
    scene = Scene("Point force", setting)
    if body == "tube":
        scene.add("MATERIALS", "1, 2e5, 0.3").block(1, 1, 1, 8, (1.9, 0, 2, 8)).add("FACES", "1, 1, 1.9, 0, 2, 0").add("FIXEDFACES", "1, 111")
        return scene.add("POINTLOADS", f"43, 20, {direction}").text()
    scene.add("MATERIALS", "1, 2e5, 0.3", "2, 2e3, 0.3").block(1, 1, 2, 4, (0, -4, .6, 0)).block(1, 1, 2, 2, (0, 0, .6, 1)).block(1, 2, 4, 4, (.6, -4, 6, 0), (1, 0))
    scene.add("FACES", "1, 1, 0, -4, .6, -4", "2, 1, .6, -4, 6, -4", "3, 1, 6, -4, 6, 0").add("FIXEDFACES", "1, 111", "2, 111", "3, 111")
    return scene.add("POINTLOADS", f"53, 20, {direction}").text()


def skew(setting, m=2):
    """Four distorted blocks"""
    scene = Scene("Distorted quadrilaterals", setting).add("HARMONICS", str(m)).add("MATERIALS", "1, 2e4, 0.3")
    for corners in ((.5, 0, .9, .1, .8, .7, .5, .5), (.9, .1, 1.6, 0, 1.5, .6, .8, .7),
                    (.5, .5, .8, .7, 1, 1.2, .5, 1.1), (.8, .7, 1.5, .6, 1.4, 1.2, 1, 1.2)):
        scene.block(1, 1, 4, 4, corners)
    scene.add("FACES", "1, 1, .5, 0, .9, .1", "2, 1, 1.5, .6, 1.4, 1.2").add("FIXEDFACES", "1, 111")
    scene.sections((.65, .3, 1.4, .4), (.6, .9, 1.3, .9))
    return scene.add("PRESSURES", f"2, {m}, 1, 1").text()


def cone(setting, share=0.8):
    """An elastic plug in a cone, pressed and twisted: an inclined joint that slips in part"""
    scene = Scene("Plug in a cone", replace(setting, harmonic=0, planes=2)).add("MATERIALS", "1, 2e4, 0.2")
    scene.law(1, 2e4, 0.0, 30.0, RESULTANT)
    scene.block(1, 1, 3, 8, (0, 0, .3, 0, .6, .6, 0, .6), (2, 2))
    scene.block(2, 1, 3, 8, (.3, 0, .9, 0, 1.2, .6, .6, .6), (1, 2))
    scene.add("FACES", "1, 1, .3, 0, .6, .6", "2, 1, 0, .6, .6, .6", "3, 2, .3, 0, .6, .6", "4, 2, .9, 0, 1.2, .6")
    scene.add("INTERFACES", "1, 1, 3").add("FIXEDFACES", "4, 111").cuts(1, 0.05, 0.55, 6)
    scene.sections((0, .27, 1, .27))
    scene.add("CASE", "1, pressed").add("RESULTANTS", "2, AXIAL, -1").add("CASE", "2, twisted")
    scene.add("RESULTANTS", f"2, TORQUE, {0.3*share:g}").add("COMBINE", "1, 1, 1, 2, 1")
    return scene.text((1, 1), (1, 2))


def footing(setting, e=0.4):
    """A footing that stands on soil without tension, pressed beyond the middle: an edge of contact"""
    scene = Scene("Footing", setting).add("MATERIALS", "1, 3e4, 0.2", "2, 50, 0.3").law(1, 1e3, 0.0, 30.0, RESULTANT)
    scene.block(1, 1, 6, 2, (0, 0, 1, .4), (2, 1)).block(2, 2, 6, 6, (0, -3, 1, 0), (2, 2))
    scene.block(2, 2, 6, 6, (1, -3, 4, 0), (1, 2))
    scene.add("FACES", "1, 1, 0, 0, 1, 0", "2, 1, 0, .4, 1, .4", "3, 2, 0, 0, 1, 0", "4, 2, 0, -3, 4, -3",
              "5, 2, 4, -3, 4, 0")
    scene.add("INTERFACES", "1, 3, 1").add("FIXEDFACES", "4, 111", "5, 111")
    scene.sections((0, .2, 1, .2), (0, -1, 3, -1))
    return scene.add("RESULTANTS", "2, AXIAL, -1", f"2, MOMENT, {e:g}").text()


def soil_pile(setting, steps=((1, 1), (1, 2))):
    """A pile in the ground: stress of the ground and weight, then a lateral load on its head"""
    scene = Scene("Pile in the ground", setting).add("MATERIALS", "1, 2e4, 0.2, 0.02", "2, 50, 0.3, 0.02")
    scene.law(1, 2e3, 0.0, 25.0, RESULTANT).law(2, 2e3)
    scene.block(1, 1, 2, 8, (0, -4, .5, 0), (2, 2)).block(2, 2, 6, 8, (.5, -4, 4, 0), (1, 2))
    scene.block(2, 2, 2, 3, (0, -6, .5, -4), (2, 2)).block(2, 2, 6, 3, (.5, -6, 4, -4), (1, 2))
    scene.add("FACES", "1, 1, 0, 0, .5, 0", "2, 1, .5, -4, .5, 0", "3, 2, .5, -4, .5, 0", "4, 1, 0, -4, .5, -4",
              "5, 2, 0, -4, .5, -4", "6, 2, 0, -6, 4, -6", "7, 2, 4, -6, 4, 0")
    scene.add("INTERFACES", "1, 2, 3", "2, 4, 5").add("FIXEDFACES", "6, 111", "7, 111").cuts(1, -3.9, 0, 14).add("CASE", "1, weight")
    scene.sections((.25, -3.5, .25, -.2), (0, -1.9, 3, -1.9))
    scene.add("GRAVITY", "-1").add("INSITU", "1, 0, 0.02, 0.5", "2, 0, 0.02, 0.5").add("CASE", "2, lateral")
    scene.add("RESULTANTS", "1, LATERAL, 0.04").add("COMBINE", "1, 1, 1, 2, 1")
    return scene.text(*steps)


def pipe_pile(setting, steps=((1, 1), (1, 2))):
    """A steel tube driven into ground, slipping inside and outside and open behind: weight, then a lateral load on its head"""
    scene = Scene("Pipe pile", setting).add("MATERIALS", "1, 2e5, 0.3, 0.007", "2, 40, 0.3, 0.01")
    scene.law(1, 200, 0.0, 25.0, RESULTANT)
    scene.block(1, 1, 1, 6, (.95, -9, 1, 0)).block(1, 1, 1, 2, (.95, 0, 1, 3))
    scene.block(2, 2, 5, 6, (1, -9, 8, 0), (1, 0)).block(2, 2, 5, 3, (1, -14, 8, -9), (1, 2))
    scene.block(2, 2, 1, 3, (.95, -14, 1, -9), (0, 2)).block(2, 2, 2, 3, (0, -14, .95, -9), (0, 2)).block(2, 2, 2, 6, (0, -9, .95, 0))
    scene.add("FACES", "1, 1, .95, 3, 1, 3", "2, 1, 1, -9, 1, 0", "3, 2, 1, -9, 1, 0", "4, 1, .95, -9, .95, 0", "5, 2, .95, -9, .95, 0",
              "6, 1, .95, -9, 1, -9", "7, 2, .95, -9, 1, -9", "8, 2, 0, -14, 8, -14", "9, 2, 8, -14, 8, 0")
    scene.add("INTERFACES", "1, 2, 3", "1, 4, 5", "1, 6, 7").add("FIXEDFACES", "8, 111", "9, 101").cuts(1, -8.9, 0, 14)
    scene.sections((1, -8, 1, -1), (.95, .5, .95, 2.8))
    scene.add("CASE", "1, weight")
    scene.add("GRAVITY", "-1").add("INSITU", "2, 0, 0.01, 0.5", "1, 0, 0.01, 0.5, 0, 1, MEANT").add("CASE", "2, lateral")
    scene.add("RESULTANTS", "1, LATERAL, 0.2", "1, MOMENT, -1").add("COMBINE", "1, 1, 1, 2, 1")
    return scene.text(*steps)


def shrunk_on(setting, torque=0.5):
    """A shaft in a hub shrunk on by an initial pressure, twisted: slip from the mouth inwards"""
    scene = Scene("Hub on a shaft", replace(setting, harmonic=0, planes=2)).add("MATERIALS", "1, 2e4, 0.3")
    scene.add("LAWS", "1, 5e4, 1e5, 5e4, 0, 20, PAPER, GAUSS")
    scene.add("LAWDETAILS", "1, RESULTANT, REVERSIBLE, , , , , -1.0")
    scene.block(1, 1, 3, 4, (0, -1, .5, 0), (2, 2)).block(1, 1, 3, 8, (0, 0, .5, 1), (2, 1))
    scene.block(2, 1, 3, 8, (.5, 0, 1, 1), (1, 1))
    scene.add("FACES", "1, 1, 0, -1, .5, -1", "2, 1, .5, 0, .5, 1", "3, 2, .5, 0, .5, 1", "4, 2, 1, 0, 1, 1")
    scene.add("INTERFACES", "1, 2, 3").add("FIXEDFACES", "4, 111").cuts(1, 0, 0.875, 8)
    scene.sections((.1, .45, 1, .45))
    return scene.add("RESULTANTS", f"1, TORQUE, {torque:g}").text()


def heated(setting):
    """A plug that is heated, more on one side, in a block: pressed round its mouth, open beside"""
    scene = Scene("Heated plug", setting).add("MATERIALS", "1, 2e4, 0.2, , 1e-5", "2, 2e4, 0.2, , 1e-5")
    scene.law(1, 1e4, 0.0, 30.0, RESULTANT).law(2, 1e4)
    scene.block(1, 1, 3, 6, (0, 0, .5, 1), (2, 2)).block(2, 2, 5, 6, (.5, 0, 2, 1), (1, 2))
    scene.block(2, 2, 3, 3, (0, -.5, .5, 0), (2, 2)).block(2, 2, 5, 3, (.5, -.5, 2, 0), (1, 2))
    scene.add("FACES", "1, 1, .5, 0, .5, 1", "2, 2, .5, 0, .5, 1", "3, 1, 0, 0, .5, 0", "4, 2, 0, 0, .5, 0",
              "5, 2, 0, -.5, 2, -.5")
    scene.add("INTERFACES", "1, 1, 2", "2, 3, 4").add("FIXEDFACES", "5, 111")
    scene.sections((0, .45, 2, .45))
    return scene.add("TEMPERATURES", "1, 0, 20, , ", "1, 1, 0, 60, ").text()


def peg(setting, mesh=None):
    """The peg of inputs/peg.dat, on blocks or on a mesh of Gmsh"""
    scene = Scene("Peg", setting).add("MATERIALS", "1, 2e4, 0.17").law(1, 1e4, 0.0, 30.0)
    if mesh:
        scene.lines += [f"GMSH, {mesh}"]
        scene.add("GROUPS", "BODY, 1, 1, peg", "BODY, 2, 1, block", "FACE, 1, , free end", "FACE, 2, , top of the block",
                  "JOINT, 1, , shaft")
    else:
        scene.block(1, 1, 4, 2, (0, -.5, .5, 0), (2, 2)).block(1, 1, 4, 8, (0, 0, .5, 1), (2, 0))
        scene.block(2, 1, 6, 8, (.5, 0, 2, 1), (1, 0))
        scene.add("FACES", "1, 1, 0, -.5, .5, -.5", "2, 2, .5, 1, 2, 1", "3, 1, .5, 0, .5, 1", "4, 2, .5, 0, .5, 1")
        scene.add("INTERFACES", "1, 3, 4")
    scene.sections((0, .45, 2, .45))
    return scene.add("FIXEDFACES", "2, 111").add("RESULTANTS", "1, LATERAL, 0.4").text()


def disc(setting, e=0.5, young=1e4):
    """A rigid disc on a joint without tension, pressed beyond the middle"""
    return eccentric_disc(e, n=round(4*setting.n), planes=setting.planes, harmonic=setting.harmonic, young=young,
                          nodes=setting.nodes, method=setting.method, tolerance=setting.tolerance)
