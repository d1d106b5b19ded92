"""Runs the tests in this folder inside Blender, started by blender_test.py.

Arguments after -- select tests by parts of their names. Results go to stderr, because Blender writes its progress to
stdout.
"""

import os
import pathlib
import sys
import unittest

import addon_utils
import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

addon_utils.enable("defocus_engine", default_set=True)
bpy.context.preferences.addons["defocus_engine"].preferences.program = os.environ["DEFOCUS_PROGRAM"]
import test_bad_input  # noqa: E402
import test_layers  # noqa: E402
import test_pictures  # noqa: E402

loader = unittest.TestLoader()
loader.testNamePatterns = [f"*{word}*" for word in sys.argv[sys.argv.index("--") + 1:]] or None
suite = unittest.TestSuite(loader.loadTestsFromModule(module) for module in (test_bad_input, test_pictures, test_layers))  # test_layers is last because it resets Blender
if not unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful():
    raise SystemExit(1)
