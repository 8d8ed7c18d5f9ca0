"""Time and memory of reading large jobs: how `axijoint check` grows with the number of nodes, over shapes of meshes that
are made of blocks or card by card. See scripts/bench."""
import argparse
import math
import os
import resource
import subprocess
import sys
import tempfile
import time

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
# Between two sizes ten times apart time may grow by ten times the ratio of the logarithms, and by so much more that
# a memory in several levels costs, before it counts as more than n log n
SLACK = 1.6
# Sizes below are of the order of the program's own start
LEAST_SECONDS = 0.05
HEAD = "TITLE\n{title}\nCONTROL\n    0\nMATERIALS\n1, 1E4, 0.2\nLAWS\n1, 1E3, 1E3, 1E3, 0, 30\n"
LONGEST = 100000  # elements of a block along a side


class Mesh:
    """Rectangles (body, columns, rows, r1, z1, r2, z2) of 4-node elements, faces and interfaces between bodies"""

    def __init__(self, title, rectangles, interfaces=()):
        self.title, self.rectangles, self.interfaces = title, rectangles, interfaces

    def frame(self, mesh):
        """A deck with a mesh, held below and pressed above"""
        last = self.rectangles[-1]
        faces = [f"{2*k + side + 3}, {body}, {', '.join(map(repr, ends))}" for k, pair in enumerate(self.interfaces)
                 for side, (body, ends) in enumerate(pair)]
        body, _, _, r1, z1, r2, _ = self.rectangles[0]
        faces += [f"1, {body}, {r1!r}, {z1!r}, {r2!r}, {z1!r}",
                  f"2, {last[0]}, {last[3]!r}, {last[6]!r}, {last[5]!r}, {last[6]!r}"]
        text = HEAD.format(title=self.title) + mesh + "FACES\n" + "\n".join(faces) + "\n"
        if self.interfaces:
            text += "INTERFACES\n" + "\n".join(f"1, {2*k + 3}, {2*k + 4}" for k in range(len(self.interfaces))) + "\n"
        return text + "FIXEDFACES\n1, 111\nPRESSURES\n2, 0, 1.0, 1.0\nEND\n"

    def by_blocks(self):
        """Made of blocks"""
        cards = []
        for body, n1, n2, *corners in self.rectangles:
            cards += [f"{body}, 1, 4, {n1}, {n2}", ", ".join(map(repr, corners))]
        return self.frame("BLOCKS\n" + "\n".join(cards) + "\n")

    def by_cards(self):
        """Made of nodes and elements"""
        nodes, elements, numbers = [], [], {}
        for body, n1, n2, r1, z1, r2, z2 in self.rectangles:
            grid = []
            for j in range(n2 + 1):
                for i in range(n1 + 1):
                    place = (body, f"{r1 + (r2 - r1)*i/n1:.10g}", f"{z1 + (z2 - z1)*j/n2:.10g}")
                    if place not in numbers:
                        numbers[place] = len(nodes) + 1
                        nodes.append(f"{len(nodes) + 1}, {place[1]}, {place[2]}")
                    grid.append(numbers[place])
            for j in range(n2):
                for i in range(n1):
                    a = j*(n1 + 1) + i
                    elements.append(f"{len(elements) + 1}, 1, {body}, {grid[a]}, {grid[a + 1]}, {grid[a + n1 + 2]}, {grid[a + n1 + 1]}")
        return self.frame("NODES\n" + "\n".join(nodes) + "\nELEMENTS\n" + "\n".join(elements) + "\n")


def square(n):
    """As many nodes along r as along z"""
    side = round(math.sqrt(n)) - 1
    return Mesh("square", [(1, side, side, 1, 0, 2, 1)])


def strip(n, width):
    """A few nodes along r, all others along z, in blocks that are not too long"""
    rows = n//width - 1
    blocks, done = [], 0
    while done < rows:
        step = min(LONGEST, rows - done)
        blocks.append((1, width - 1, step, 1, done, 2, done + step))
        done += step
    return Mesh(f"strip of {width} nodes", blocks)


def small_blocks(n):
    """One body of blocks of four by four elements"""
    side = max(1, round(math.sqrt(n)/4))
    return Mesh("small blocks", [(1, 4, 4, 1 + i, j, 2 + i, j + 1) for j in range(side) for i in range(side)])


def bodies(n):
    """A thousand bodies upon one another, joints between them"""
    many = 1000 if n >= 100000 else 100
    cells = max(2, round(math.sqrt(n/many)) - 1)
    return Mesh("bodies", [(k + 1, cells, cells, 1, k, 2, k + 1) for k in range(many)],
                [((k, (1, k, 2, k)), (k + 1, (1, k, 2, k))) for k in range(1, many)])


def long_joint(n):
    """Two bodies side by side, joints all along"""
    rows = n//10 - 1
    return Mesh("long joint", [(1, 4, rows, 1, 0, 2, rows), (2, 4, rows, 2, 0, 3, rows)],
                [((1, (2, 0, 2, rows)), (2, (2, 0, 2, rows)))])


SHAPES = {"square": square, "strip of 10": lambda n: strip(n, 10), "strip of 2": lambda n: strip(n, 2),
          "small blocks": small_blocks, "bodies": bodies, "long joint": long_joint}


def measured(program, *words):
    """Seconds of the processor, and MiB at the peak, of a call that must end with exit code 0"""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        ran = subprocess.run([program, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        os.write(write, f"{ran.returncode} {used.ru_utime + used.ru_stime} {used.ru_maxrss/1024}\n{ran.stderr.decode()[:500]}".encode())
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as pipe:
        code, seconds, memory = pipe.readline().split()
        words = pipe.read()
    os.waitpid(child, 0)
    if code != "0":
        raise SystemExit(f"exit code {code}: {words}")
    return float(seconds), float(memory)


def main():
    """A table: a row for each shape, way and size; exit code 1 if one grows faster than n log n"""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("--quick", action="store_true", help="to 100,000 nodes")
    parser.add_argument("--only", default="", help="shapes whose names contain this")
    parser.add_argument("-o", default=".")
    options = parser.parse_args()
    sizes = (10**4, 10**5) if options.quick else (10**4, 10**5, 10**6)
    bad = 0
    print(f"{'shape':14} {'made by':8} {'nodes':>9} {'seconds':>8} {'MiB':>7} {'us a node':>10} {'over n log n':>13}")
    with tempfile.TemporaryDirectory(prefix="axijoint-sizes-") as folder:
        for name, shape in SHAPES.items():
            for way in ("blocks", "cards"):
                if options.only not in name:
                    continue
                before = None
                for n in sizes:
                    path = os.path.join(folder, "job.dat")
                    with open(path, "w", encoding="ascii") as file:
                        file.write(getattr(shape(n), f"by_{way}")())
                    seconds, memory = measured(options.axijoint, "check", path)
                    growth, verdict = "", ""
                    if before and before[1] > LEAST_SECONDS:
                        ratio = seconds/before[1]/((n*math.log(n))/(before[0]*math.log(before[0])))
                        growth = f"{ratio:.2f}"
                        if ratio > SLACK:
                            bad += 1
                            verdict = "  FAILED"
                    before = (n, seconds)
                    print(f"{name:14} {way:8} {n:9} {seconds:8.2f} {memory:7.0f} {1e6*seconds/n:10.2f} {growth:>13}{verdict}", flush=True)
    print(f"{bad} grow faster than {SLACK:g} n log n from one size to the next")
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
