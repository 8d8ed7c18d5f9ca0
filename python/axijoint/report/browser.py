"""Opens a page in headless Chromium: whether all its images and views show, it asks for nothing else, and it prints."""
import pathlib
import re
import shutil
import subprocess
import tempfile

PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ("--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=20000")
# Widths at which the page is looked at [pixel]: a desk, and a phone, as a frame in a page
DESK, PHONE = 1200, 390
# Put at the end of a copy of the page: it counts what the browser could show
PROBE = """<script>
addEventListener("load", async () => {
   const page = document.documentElement, images = [...document.images], views = [...document.querySelectorAll(".view")];
   const shown = images.filter(image => image.complete && image.naturalWidth > 0 && image.naturalHeight > 0);
   const busy = view => !view.dataset.drawn && !view.dataset.failed;
   for (let k = 0; k < 100 && views.some(busy); ++k) await new Promise(done => setTimeout(done, 100));
   const drawn = views.filter(view => view.dataset.drawn && view.querySelector("canvas") && Number(view.dataset.vertices) > 0
      && view.dataset.faults === "0");
   const found = [images.length, shown.length, page.scrollWidth - page.clientWidth,
      performance.getEntriesByType("resource").length, views.length, drawn.length].join(" ");
   page.dataset.found = found;
   if (parent !== window) parent.postMessage(found, "*");
});
</script>
</body>"""
FRAME = """<!DOCTYPE html><html><body>
<script>addEventListener("message", event => { document.documentElement.dataset.found = event.data; });</script>
<iframe src="probed.html" style="width: %dpx; height: 844px; border: 0"></iframe></body></html>
"""


def check(path):
    """Open a page; returns what was found, in words, and whether it is as it should be."""
    program = next(filter(None, map(shutil.which, PROGRAMS)), None)
    if program is None:
        return "check: Chromium is not installed; as root: apt-get install chromium", False
    with tempfile.TemporaryDirectory() as folder:
        return _check(program, pathlib.Path(path).read_text(encoding="utf-8"), pathlib.Path(folder))


def _check(program, text, folder):
    page, probed, phone, printed = (folder/name for name in ("page.html", "probed.html", "phone.html", "page.pdf"))
    page.write_text(text, encoding="utf-8")
    before, after = text.rsplit("</body>", 1)
    probed.write_text(before + PROBE + after, encoding="utf-8")
    phone.write_text(FRAME % PHONE, encoding="utf-8")
    said, good = [], True
    for width, opened in ((DESK, probed), (PHONE, phone)):
        found = re.search(r'data-found="(\d+) (\d+) (-?\d+) (\d+) (\d+) (\d+)"', _run(program, folder, "--dump-dom", opened.as_uri()))
        if not found:
            return f"check: Chromium did not open the page at a width of {width} pixels", False
        images, shown, too_wide, fetched, views, drawn = map(int, found.groups())
        wide = "not wider than the window" if too_wide <= 0 else f"{too_wide} pixels wider than the window"
        seen = f", {drawn} of {views} views drawn" if views else ""
        said.append(f"at {width} pixels {shown} of {images} images shown{seen}, {fetched} other files asked for, {wide}")
        good = good and shown == images and drawn == views and not fetched and too_wide <= 0
    _run(program, folder, "--no-pdf-header-footer", f"--print-to-pdf={printed}", page.as_uri())
    pages = len(re.findall(rb"/Type\s*/Page\b", printed.read_bytes())) if printed.exists() else 0
    return f"check: {'; '.join(said)}; {pages} pages printed", good and pages > 0


def _run(program, folder, *arguments):
    profile = tempfile.mkdtemp(dir=folder)
    done = subprocess.run([program, *FLAGS, f"--user-data-dir={profile}", f"--window-size={DESK},900", *arguments],
                          capture_output=True, check=False, timeout=300)
    return done.stdout.decode("utf-8", "replace")
