"""Runs the add-on's tests in Blender: blender_test.py PROGRAM [TEST …].

Exits with 77 (skipped) without Blender 3.4 or later. Installs, in a temporary folder, the package that
scripts/blender-package builds.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SKIPPED = 77


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def main(program, *tests):
    blender = shutil.which("blender") or skip("Blender is not installed")
    version = subprocess.run([blender, "--version"], capture_output=True, text=True, check=True).stdout
    found = re.search(r"Blender (\d+)\.(\d+)", version) or skip(f"{blender} does not tell its version")
    if (int(found[1]), int(found[2])) < (3, 4):
        skip(f"{found[0]} is older than 3.4")
    with tempfile.TemporaryDirectory(prefix="blender-test-") as folder:
        package = pathlib.Path(folder) / "package.zip"
        subprocess.run([sys.executable, ROOT / "scripts" / "blender-package", "-o", package], check=True, stdout=subprocess.DEVNULL)
        with zipfile.ZipFile(package) as archive:
            archive.extractall(pathlib.Path(folder) / "scripts" / "addons")
        temporary = pathlib.Path(folder) / "temporary"
        temporary.mkdir()
        # Debian's Blender uses the first Python in PATH, so put Blender's folder first.
        environment = os.environ | {"BLENDER_USER_SCRIPTS": str(pathlib.Path(folder) / "scripts"), "TMPDIR": str(temporary),
                                    "BLENDER_USER_CONFIG": folder, "DEFOCUS_PROGRAM": str(pathlib.Path(program).resolve()),
                                    "XDG_CACHE_HOME": f"{folder}/cache", "PATH": f"{pathlib.Path(blender).parent}:{os.environ['PATH']}"}
        sys.exit(subprocess.run([blender, "-b", "-noaudio", "--factory-startup", "--python-exit-code", "1", "-P", HERE / "in_blender.py", "--", *tests],
                                env=environment, stdout=subprocess.DEVNULL).returncode)


if __name__ == "__main__":
    main(*sys.argv[1:])
