"""Opens a page in headless Chromium: whether all its images show, it asks for nothing else, and it prints."""
import pathlib
import re
import shutil
import subprocess
import tempfile

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--host-resolver-rules=MAP * ~NOTFOUND")
# Put at the end of a copy of the page: it counts what the browser could show
PROBE = """<script>
addEventListener("load", () => {
   const page = document.documentElement, images = [...document.images];
   const shown = images.filter(image => image.complete && image.naturalWidth > 0 && image.naturalHeight > 0);
   page.dataset.found = [images.length, shown.length, page.scrollWidth - page.clientWidth,
      performance.getEntriesByType("resource").length].join(" ");
});
</script>
</body>"""


def check(path):
    """Open a page; returns what was found, in words, and whether it is as it should be."""
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        return "check: Chromium is not installed; as root: apt-get install chromium", False
    with tempfile.TemporaryDirectory() as folder:
        return _check(program, pathlib.Path(path).read_text(encoding="utf-8"), pathlib.Path(folder))


def _check(program, text, folder):
    page, probed, printed = (folder/name for name in ("page.html", "probed.html", "page.pdf"))
    page.write_text(text, encoding="utf-8")
    probed.write_text(text.replace("</body>", PROBE), encoding="utf-8")
    dom = _run(program, folder, "--dump-dom", probed.as_uri())
    _run(program, folder, "--no-pdf-header-footer", f"--print-to-pdf={printed}", page.as_uri())
    found = re.search(r'data-found="(\d+) (\d+) (-?\d+) (\d+)"', dom)
    if not found:
        return "check: Chromium did not open the page", False
    pages = len(re.findall(rb"/Type\s*/Page\b", printed.read_bytes())) if printed.exists() else 0
    images, shown, too_wide, fetched = map(int, found.groups())
    wide = "not wider than the window" if too_wide <= 0 else f"{too_wide} pixels wider than the window"
    return (f"check: {shown} of {images} images shown, {fetched} other files asked for, {pages} pages printed, {wide}",
            shown == images and not fetched and pages > 0 and too_wide <= 0)


def _run(program, folder, *arguments):
    profile = tempfile.mkdtemp(dir=folder)
    done = subprocess.run([program, *FLAGS, f"--user-data-dir={profile}", "--window-size=1200,900", *arguments],
                          capture_output=True, check=False, timeout=300)
    return done.stdout.decode("utf-8", "replace")
