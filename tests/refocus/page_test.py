"""Compares the page of `defocus refocus --html`, in headless Chromium, with images of `defocus refocus`.

page_test.py PROGRAM. Exits with 77 (skipped) without Chromium.

The test focuses by clicks on two fish, and shows a lamp with a radiance of 50 out of focus. The page stores lossy
images of 8 bits, so the required PSNR is only 32 dB.
"""

import base64
import http.server
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading

SKIPPED = 77
MIN_PSNR = 32
SIZE = (320, 240)
FISH = ((180, 112), (25, 215))  # positions in px of two fish at different distances

# Performs `action` once the page has loaded the lens images (views from lens points), and requests /drawn after the
# next frame. Chromium takes the screenshot after the page's load event. The hidden image /wait delays this event until
# /drawn has been requested. The loading bar is hidden, because it may not have faded out yet.
SCRIPT = """<style>#wait { display: none }</style>
<img src="http://127.0.0.1:%(port)d/wait" style="display: none">
<script>
function whenReady() {
  if (!ready) return setTimeout(whenReady, 50);
  %(action)s
  requestAnimationFrame(() => requestAnimationFrame(() => fetch('http://127.0.0.1:%(port)d/drawn', { mode: 'no-cors' })));
}
whenReady();
</script>"""

# Clicks on a pixel. Simulated events have no pointer that the page can capture, so setPointerCapture() must do nothing.
CLICK = """canvas.setPointerCapture = () => {};
  for (const type of ['pointerdown', 'pointerup'])
    canvas.dispatchEvent(new PointerEvent(type, { clientX: %d + .5, clientY: %d + .5, bubbles: true }));"""


class Waiting(http.server.BaseHTTPRequestHandler):
    """Answers a request for /wait only once /drawn has been requested, or after two minutes."""

    def do_GET(self):
        if self.path == "/drawn":
            self.server.drawn.set()
        elif self.path == "/wait":
            self.server.drawn.wait(120)
        self.send_response(204)
        self.end_headers()

    def log_message(self, *words):
        pass


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout


def screenshot(chromium, page, path, fragment="", action=""):
    """Runs the JavaScript `action` in the page, and writes a screenshot without the page's controls to `path`."""
    with tempfile.TemporaryDirectory() as folder, http.server.ThreadingHTTPServer(("127.0.0.1", 0), Waiting) as server:
        server.drawn = threading.Event()
        threading.Thread(target=server.serve_forever, daemon=True).start()
        acting = pathlib.Path(folder) / "page.html"
        acting.write_text(page.read_text() + SCRIPT % {"port": server.server_port, "action": action})
        run(chromium, "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
            "--force-color-profile=srgb", "--hide-scrollbars", f"--user-data-dir={folder}/profile",
            f"--window-size={SIZE[0]},{SIZE[1]}", f"--screenshot={path}", f"file://{acting}#panel=0{fragment}")
        if not server.drawn.is_set():
            sys.exit("the page was not drawn")
        server.shutdown()


def compare(program, reference, shown, what):
    psnr = float(re.search(r"psnr\s+([\d.]+|inf)", run(program, "compare", reference, shown))[1])
    print(f"{what}: {psnr:.1f} dB")
    if psnr < MIN_PSNR:
        sys.exit(f"{what}: the page differs from the picture of the program")


def lamp_scene(path):
    """Writes a scene with a grey wall at 4 m and a lamp of radiance 50 at 2 m."""
    def square(side, z):
        return [(-side, -side, z), (side, -side, z), (side, side, z), (-side, side, z)]

    places = square(3, -4) + square(0.03, -2)
    data = b"".join(struct.pack("<3f", *place) for place in places) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    bounds = [{"min": list(map(min, zip(*part))), "max": list(map(max, zip(*part)))} for part in (places[:4], places[4:])]
    primitives = [{"attributes": {"POSITION": i}, "indices": 2, "material": i} for i in range(2)]
    path.write_text(json.dumps({
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"mesh": 1}],
        "meshes": [{"primitives": [primitive]} for primitive in primitives],
        "materials": [{"emissiveFactor": [0.05, 0.05, 0.06], "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}},
                      {"emissiveFactor": [1, 0.9, 0.8], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 50}}}],
        "accessors": [{"bufferView": 0, "byteOffset": 48 * i, "componentType": 5126, "count": 4, "type": "VEC3", **bounds[i]}
                      for i in range(2)] + [{"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 12}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }))


def main(program):
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if not chromium:
        print("skipped: Chromium is not installed")
        sys.exit(SKIPPED)
    program = pathlib.Path(program).resolve()
    with tempfile.TemporaryDirectory(prefix="defocus-page-") as name:
        folder = pathlib.Path(name)
        lens, page, reference, shown = (folder / file for file in ("a.lens.exr", "a.html", "reference.png", "shown.png"))
        rendering = [program, "render", "--size", "x".join(map(str, SIZE)), "--no-cache", "--samples", "48", "--quiet"]

        run(*rendering, "--fish", "6", "--fish-triangles", "2000", "--fstop", "0.95", "--lens-images", lens)
        run(program, "refocus", lens, "--html", page, "--quiet")
        for x, y in FISH:
            screenshot(chromium, page, shown, action=CLICK % (x, y))
            run(program, "refocus", lens, "--focus-pixel", f"{x},{y}", "--no-fill-gaps", "-o", reference, "--quiet")
            compare(program, reference, shown, f"click on pixel {x},{y}")

        scene = folder / "lamp.gltf"
        lamp_scene(scene)
        run(*rendering, scene, "--camera-position", "0,0,0", "--camera-target", "0,0,-1", "--fstop", "0.95", "--focus-distance", "4",
            "--focus-range", "2:4", "--lens-images", lens, "--exposure", "0")
        run(program, "refocus", lens, "--html", page, "--quiet")
        screenshot(chromium, page, shown, "&focus=3.2&fstop=1.4&shape=3")
        run(program, "refocus", lens, "--focus-distance", "3.2", "--fstop", "1.4", "--blades", "6", "--no-fill-gaps", "-o", reference,
            "--quiet")
        compare(program, reference, shown, "lamp")


if __name__ == "__main__":
    main(sys.argv[1])
