#!/usr/bin/env python3
"""Makes a data set for depth from defocus: renders a scene's lens images once, and computes all other images from them.

A lens image is the view from one point on the lens.

    python3 examples/defocus_data_set.py meshes/chess.glb chess-set

Files in the output folder: scene.lens.exr (lens images), sharp.exr (all surfaces in focus), depth.exr (m), stack.00.exr
… (focal stack), coc.00.exr … (signed circle of confusion in px for each image of the stack), and lens.json (camera,
lens, and the focus distances of the stack). The script needs the package `defocus` (docs/python.md).
"""

import argparse
import json
from pathlib import Path

import defocus

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("scene", type=Path, help="glTF file")
parser.add_argument("output", type=Path, help="folder of the data set")
parser.add_argument("--size", default="640x480", help="size of the pictures in px")
parser.add_argument("--samples", type=int, default=128, help="number of lens images")
parser.add_argument("--f-stop", type=float, default=1.4, help="f-number")
parser.add_argument("--pictures", type=int, default=8, help="number of pictures in the focal stack")
arguments = parser.parse_args()
arguments.output.mkdir(parents=True, exist_ok=True)

with defocus.LightField.render(arguments.output / "scene.lens.exr", arguments.scene, size=arguments.size,
                               samples=arguments.samples, f_stop=arguments.f_stop) as field:
    defocus.write_image(arguments.output / "sharp.exr", field.all_in_focus())
    defocus.write_image(arguments.output / "depth.exr", field.depth())
    stack = field.stack(arguments.pictures)
    for i, (distance, picture) in enumerate(zip(stack.focus_distances, stack.pictures)):
        defocus.write_image(arguments.output / f"stack.{i:02}.exr", picture)
        defocus.write_image(arguments.output / f"coc.{i:02}.exr", field.coc(focus_distance=distance))
    lens = {**field.info._asdict(), "focus_distances": stack.focus_distances}
    (arguments.output / "lens.json").write_text(json.dumps(lens, indent=2) + "\n")
print(f"{arguments.output}: {arguments.pictures} pictures with focus from {stack.focus_distances[0]:.3g} to "
      f"{stack.focus_distances[-1]:.3g} m")
