"""Decks written in Python: the cards are the program's, nothing is lost on them, and what is wrong is refused"""
import contextlib
import gc
import inspect
import io
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import jobs
import numpy as np

import axijoint
from axijoint.deck import Deck, DeckError, fields, make

PROGRAM = os.environ["AXIJOINT"]
DECKS = sorted([*(jobs.ROOT/"test/decks/good").glob("*.dat"),
                *(jobs.ROOT/f"inputs/{name}.dat" for name in ("case3", "chimney", "first", "monopile", "peg"))])
# Cards that these have not, put into one of them
MORE = {"keep": ("monopile", "KEEP", "  STRESSES      ONLY    3    6", "  DISPLACE     EVERY    2", "OLDLISTING", "    1    1    2"),
        "printed": ("first", "PRINT", "    TOTALS      UPTO       200", "    STATES       ALL              1       0.0       0.0       1.0       0.5"),
        "spun": ("chimney", "CASE", "    9 Spun", "ROTATION", "      12.5", "COMBINE", "    1    9       1.0"),
        "goal": ("first", "ERROR", "      20.0    ENERGY    2", "SWEEP", "       0.0     180.0   20")}
# Cards that no method writes, and one whose file is not read here
NO_METHOD = {"TITLE", "END"}
NOT_READ = {"INCLUDE"}
KINDS = {"integer": int, "real": lambda text: float(re.sub(r"(?<=[\d.])([+-])", r"E\1", text.upper().replace("D", "E"))
                                                   if not re.search("[ED]", text.upper()) else
                                                   text.upper().replace("D", "E"))}
WRONG = [(lambda deck: deck.materials(1, 2.1e5, 0.5), "poisson is 0.5: out of range; allowed: 0 ≤ ν < 0.5"),
         (lambda deck: deck.materials(1, "steel", 0.3), "young is 'steel': no number; allowed: > 0"),
         (lambda deck: deck.materials(1.0, 1.0, 0.3), "material is 1.0: no integer"),
         (lambda deck: deck.materials(True, 1.0, 0.3), "material is True: no integer"),
         (lambda deck: deck.materials(1, float("nan"), 0.3), "young is nan: no finite number"),
         (lambda deck: deck.materials(1, 1e-31, 0.3), "young is 1e-31: too small"),
         (lambda deck: deck.laws(1, 1.0, 1.0, 1.0, kind="PAPR"), "'PAPR': not known; allowed: PAPER, ELASTIC"),
         (lambda deck: deck.faces(1, first=(0.0,), last=(1.0, 1.0)), r"first\[1\] must be given: z of the first point"),
         (lambda deck: deck.faces(1, first=(0, 0, 0), last=(1, 1)), "first takes 2 values at most; there are 3"),
         (lambda deck: deck.fixedfaces(1, 111.0), "three digits for u, v, w"),
         (lambda deck: deck.interfaces(face_a=1, face_b=2, name="a,b"), "without commas"),
         (lambda deck: deck.points(1, (0, 0), name="x"*17), "more than 16 letters"),
         (lambda deck: deck.gravity(), "nothing is given"),
         (lambda deck: (deck.control(1), deck.control(1)), "CONTROL stands once"),
         (lambda deck: deck.include("/etc/deck"), "must not be absolute"),
         (lambda deck: deck.gmsh("../a.msh"), "must not contain"),
         (lambda deck: Deck("x"*81), "the title has 81 letters"),
         (lambda deck: Deck("END"), "the title 'END' is a keyword alone"),
         (lambda deck: Deck("control   12"), "is a keyword alone"),
         (lambda deck: deck.materials(10**9, 1.0, 0.3), "material is 1000000000: out of range; allowed: 1 … 999999999$"),
         (lambda deck: deck.elements(10**9, 1, nodes=(1, 2, 3)), "out of range; allowed: 1 … 999999999$"),
         (lambda deck: deck.materials(1, 1e31, 0.3), r"young is 1e\+31: too large; allowed: magnitudes up to 1E30$")]


def values_of(card, lines):
    """Arguments of an entry, from its cards."""
    found, k, texts = {}, 0, []
    for number, line in enumerate(lines, 1):
        here = [field for field in fields.described()[card]["fields"] if field["card"] == number]
        if "," in line:
            parts = line.split(",")
            texts += parts + [""]*(len(here) - len(parts))
        else:
            texts += [line[field["columns"][0] - 1:field["columns"][1]] for field in here]
    for name, of_row in fields.rows(card):
        row = [KINDS.get(field["kind"], str)(text.strip()) if text.strip() else None
               for field, text in zip(of_row, texts[k:])]
        k += len(of_row)
        found[name] = row[0] if len(row) == 1 else row
    return {name: value for name, value in found.items() if value is not None and value != [None]*len(of_row)}


def rewritten(path):
    """A deck read card by card and written anew by a Deck."""
    lines = [line.split("!")[0].rstrip() if k else line for k, line in
             enumerate(path.read_text(encoding="utf-8").splitlines())]
    lines = [line for line in lines if line and not line.startswith("$")]
    title = lines[lines.index("TITLE") + 1] if "TITLE" in lines else ""
    deck, card, waiting, begun = Deck(title), "", [], False
    for line in lines[lines.index("TITLE") + 2 if "TITLE" in lines else 0:]:
        keyword = re.match("[A-Za-z]*", line)[0].upper()
        if keyword in fields.described():
            if begun and fields.described()[card]["alone"]:
                getattr(deck, make.method_name(card))()
            card, begun = keyword, True
            if fields.described()[card]["form"] == "file":
                deck.gmsh(line[10:].strip())
            continue
        begun = False
        waiting.append(line)
        if len(waiting) == max(field["card"] for field in fields.described()[card]["fields"]):
            getattr(deck, make.method_name(card))(**values_of(card, waiting))
            waiting = []
    return deck


class Cards(unittest.TestCase):
    """What is on cards"""

    def test_they_are_those_of_the_program(self):
        mend = "run python -m axijoint.deck.make PROGRAM"
        self.assertEqual((make.FOLDER/"cards.json").read_text(encoding="utf-8"), make.listed(PROGRAM), mend)
        self.assertEqual((make.FOLDER/"cards.py").read_text(encoding="utf-8"), make.methods(), mend)
        for card in set(fields.described()) - NO_METHOD:
            self.assertTrue(inspect.getdoc(getattr(Deck, make.method_name(card))).startswith(f"{card}: "))

    def test_decks_written_anew_give_the_same_bits(self):
        used = set()
        with tempfile.TemporaryDirectory() as folder:
            old, new, given = (pathlib.Path(folder)/name for name in ("old", "new", "given"))
            new.mkdir()
            given.mkdir()
            shutil.copy(jobs.ROOT/"inputs/peg.msh", new)
            decks = [path for path in DECKS if not re.search("^INCLUDE", path.read_text(encoding="utf-8"), re.M)
                     and (path.parent.name == "inputs" or not re.search("^GMSH", path.read_text(encoding="utf-8"), re.M))]
            for name, cards in MORE.items():
                decks.append(given/f"{name}.dat")
                decks[-1].write_text(jobs.input_deck(*cards), encoding="utf-8")
            for path in decks:
                text = rewritten(path).write(new/path.name).read_text(encoding="utf-8")
                used |= set(re.findall("^[A-Z]+", text, re.M))
            for where, paths in ((old, decks), (new, [new/path.name for path in decks])):
                done = subprocess.run([PROGRAM, "run", "--quiet", "-o", where, *paths], capture_output=True, check=False)
                self.assertIn(done.returncode, (0, 3, 4), done.stderr)
            found = sorted(path.name for path in old.glob("*.h5"))
            self.assertEqual(found, sorted(path.name for path in new.glob("*.h5")))
            for name in found:
                with h5py.File(old/name) as one, h5py.File(new/name) as other:
                    for dataset in ("displacement", "stress/amplitude", "joints/stress", "history/reacted"):
                        np.testing.assert_array_equal(one[dataset][()], other[dataset][()], f"{name} {dataset}")
        self.assertEqual(set(fields.described()) - used, NOT_READ)

    def test_reals_keep_all_digits(self):
        draw = random.Random(1)
        for _ in range(1000):
            value = draw.choice((1, -1))*draw.random()*10.0**draw.randint(-28, 28)
            deck = Deck()
            deck.nodes(1, 0.1, value)
            line = deck.text.splitlines()[3]
            self.assertEqual(values_of("NODES", [line])["z"], value, line)
            self.assertTrue("," in line or len(line) <= 25)

    def test_what_is_wrong_is_refused_at_once(self):
        for call, words in WRONG:
            with self.assertRaisesRegex(DeckError, words):
                call(Deck())
        with self.assertRaisesRegex(TypeError, "rho"):
            Deck().materials(1, 1.0, 0.3, rho=1.0)
        deck = Deck()
        deck.include("mesh/nodes.inc")
        self.assertIn("\nINCLUDE   mesh/nodes.inc\n", deck.text)
        for title in ("END of a job", " END", "The END", "Ends"):
            self.assertEqual(Deck(title).title, title)
        with self.assertRaises(AttributeError):
            Deck().materialz(1, 1.0, 0.3)

    def test_texts_may_fill_their_columns(self):
        deck = Deck()
        deck.points(1, (0, 0), body=1, name="x"*16)
        deck.points(2, (0, 0), body=1, name="y"*15)
        deck.case(1, name="z"*75)
        self.assertEqual(deck.text.splitlines()[3:-1], [
            "    1, 0.0, 0.0, 1, xxxxxxxxxxxxxxxx", "    2       0.0       0.0    1 yyyyyyyyyyyyyyy",
            "CASE", f"    1, {'z'*75}"])

    def test_a_title_may_be_blank(self):
        self.assertEqual(Deck().text.splitlines(), ["TITLE", "", "END"])
        self.assertEqual(Deck("").title, "")

    def test_ends_of_ranges_are_those_of_the_program(self):
        def told(poisson, friction):
            deck = Deck()
            deck.materials(1, 1.0, poisson)
            deck.laws(1, 1.0, 1.0, 1.0, friction=friction)
        told(0, 0.0)
        told(np.float64(0.4999999), 89.9)
        for wrong in ((-1e-9, 0.0), (0.3, 90.0)):
            self.assertRaises(DeckError, told, *wrong)


class Runs(unittest.TestCase):
    """Runs from Python"""

    def peg(self, lateral, held=True):
        deck = Deck("A peg in a block (MN, m, MPa)")
        deck.comment("A comment\nof two lines")
        deck.control(4)
        deck.materials(1, young=2.0e4, poisson=0.17)
        deck.laws(1, 1e4, 2e4, 1e4, friction=30)
        deck.blocks(material=1, nodes=4, n1=4, n2=12, corners=[(0, -0.5), (0.5, 1)])
        deck.blocks(body=2, material=1, nodes=4, n1=6, n2=8, corners=[(0.5, 0), (2, 1)])
        deck.faces(1, first=(0, -0.5), last=(0.5, -0.5))
        deck.faces(2, first=(0.5, 0), last=(0.5, 1))
        deck.faces(3, body=2, first=(0.5, 0), last=(0.5, 1))
        deck.faces(4, body=2, first=(0.5, 1), last=(2, 1))
        deck.interfaces(law=1, face_a=2, face_b=3)
        if held:
            deck.fixedfaces(4, "111")
        deck.resultants(1, "LATERAL", lateral)
        return deck

    def test_a_run_is_that_of_the_deck(self):
        with tempfile.TemporaryDirectory() as folder:
            path = jobs.run(folder, "first", jobs.input_deck("first"))
            wanted = axijoint.open(f"{path}.h5").displacement_amplitude
            for deck, more in ((self.peg(0.4), {}), (self.peg(0.4), {"directory": f"{folder}/a/b", "threads": 1}),
                               (f"{folder}/first.dat", {})):
                result = axijoint.run(deck, **more)
                np.testing.assert_array_equal(result.displacement_amplitude, wanted)
            self.assertTrue(pathlib.Path(f"{folder}/a/b/job.dat").exists())

    def test_the_example_is_the_deck(self):
        sys.path.append(str(jobs.ROOT/"python/examples"))
        import monopile
        deck = monopile.pile_and_ground()
        monopile.load(deck)
        with tempfile.TemporaryDirectory() as folder:
            path = jobs.run(folder, "monopile", jobs.input_deck("monopile"))
            wanted, found = axijoint.open(f"{path}.h5"), axijoint.run(deck)
            for name in ("displacement", "history/cuts", "history/joint_resultants"):
                np.testing.assert_array_equal(found.read(name), wanted.read(name))
            with contextlib.redirect_stdout(io.StringIO()) as said:
                monopile.report(found)
        self.assertIn("ground holds 5.000000 MN of 5.000000 MN", said.getvalue())

    def test_files_go_with_the_result(self):
        result = axijoint.run(self.peg(0.4))
        path = result.path
        self.assertTrue(path.exists())
        view = result.at(1)
        del result
        self.assertTrue(view.path.exists())
        del view
        gc.collect()
        self.assertFalse(path.exists())

    def test_failures_have_the_messages(self):
        deck = self.peg(0.4)
        deck.fixedfaces(7, "111")
        with self.assertRaisesRegex(axijoint.RunError, r"\(exit code 2\)(.|\n)*face 7 is not defined") as caught:
            axijoint.run(deck)
        self.assertEqual((caught.exception.exit_code, caught.exception.results), (2, {}))
        deck = self.peg(0.4)
        deck.increments(1.0, tolerance=1e-9, iterations=1)
        with self.assertRaises(axijoint.RunError) as caught:
            axijoint.run(deck)
        self.assertEqual(caught.exception.exit_code, 3)
        self.assertEqual(caught.exception.results[0].status, "not_converged")

    def test_results_are_those_of_the_run(self):
        """Results of an earlier run of the folder are not those of one that has none"""
        wrong, free = self.peg(0.4), self.peg(0.8, held=False)
        wrong.fixedfaces(7, "111")
        with tempfile.TemporaryDirectory() as folder:
            for deck, exit_code in ((wrong, 2), (free, 4)):
                axijoint.run(self.peg(0.4), folder)
                with self.assertRaises(axijoint.RunError) as caught:
                    axijoint.run(deck, folder)
                self.assertEqual((caught.exception.exit_code, caught.exception.results), (exit_code, {}))

    def test_results_that_are_there(self):
        """--resume leaves what is complete, also where another deck of the name was run since"""
        chimney = (jobs.ROOT/"inputs/chimney.dat").read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)/"job.dat"
            for text, numbers in ((chimney, [1, 2]), (chimney.replace("    1    1       1.0\n", ""), [0]), (chimney, [1, 2])):
                path.write_text(text, encoding="utf-8")
                found = axijoint.run_combinations(path, folder, options=["--resume"])
                self.assertEqual((list(found), {one.deck for one in found.values()}), (numbers, {text}))
            self.assertEqual(list(axijoint.run_combinations(path, folder, options=["--resume"])), [1, 2])
            made = axijoint.run(self.peg(0.4), folder, name="peg")
            again = [axijoint.run(deck, folder, options=["--resume"]) for deck in [made.path.with_suffix(".dat")]]
            self.assertEqual([one.attributes["run"] for one in again], [made.attributes["run"]])
            deck = self.peg(0.4)
            deck.increments(1.0, tolerance=1e-9, iterations=1)
            for options in ([], ["--resume"]):
                with self.assertRaises(axijoint.RunError) as caught:
                    axijoint.run(deck, folder, name="short", options=options)
                self.assertEqual(caught.exception.results[0].status, "not_converged")

    def test_combinations(self):
        path = jobs.ROOT/"inputs/chimney.dat"
        self.assertEqual(list(axijoint.run_combinations(path)), [1, 2])
        with self.assertRaisesRegex(ValueError, "combinations 1, 2"):
            axijoint.run(path)

    def test_no_program(self):
        with unittest.mock.patch.dict(os.environ, {"AXIJOINT": "", "PATH": ""}):
            with self.assertRaisesRegex(FileNotFoundError, "AXIJOINT"):
                axijoint.run(self.peg(0.4))


if __name__ == "__main__":
    unittest.main()
