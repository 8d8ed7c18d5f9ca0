"""The gallery: its jobs agree with calculations by hand, and the page is that of the decks"""
import pathlib
import subprocess
import sys
import unittest

import jobs


class Gallery(unittest.TestCase):
    """doc/gallery.md"""

    def test_it_is_up_to_date(self):
        done = subprocess.run([sys.executable, "-B", jobs.ROOT/"python/examples/make_gallery.py", "--check"],
                              capture_output=True, encoding="utf-8", check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_every_deck_is_shown(self):
        text = (jobs.ROOT/"doc/gallery.md").read_text(encoding="utf-8")
        for path in pathlib.Path(jobs.ROOT/"inputs/gallery").glob("*.dat"):
            self.assertIn(f"`inputs/gallery/{path.name}`", text)


if __name__ == "__main__":
    unittest.main()
