"""Runs the command line of scripts/figures."""

import argparse
import importlib
import sys

COMMANDS = {  # each name is a module of this package, with "-" for "_"
    "diff": "compare two results of one bench",
    "report": "draw index.html from results of benches, as --report does",
    "tables": "write the tables of README.md and docs/ from bench/results",
    "repeat": "run the commands of text results again",
    "plots": "draw docs/plots from bench/results",
    "concepts": "draw docs/concepts, the figures of docs/concepts.md",
    "lens": "render bench/results/lens, with the page that shows it",
    "first-pictures": "render docs/first-pictures.jpg",
    "materials": "render docs/materials.jpg: Khronos' feature models beside the pictures of their authors",
    "artefacts": "render known artefacts of image-space methods for a report",
    "lines": "compare line samples with points, in pictures and runs of bench/results/line-samples.md",
    "cycles": "compare lit, textured scenes with Blender's Cycles",
    "peers": "compare the time to an equal error with Embree's, Cycles' and EEVEE's",
    "copies": "write a glTF scene of many copies of another, a load for the benches",
    "levels": "compare levels with full detail on copies of thin parts or of models",
    "quality": "measure how well the automatic number of samples meets its quality",
    "positions": "measure what four pixel positions per lens sample save and change",
    "refocus": "compare refocused with rendered pictures",
    "blending": "measure the noise of alpha-blended surfaces",
    "circular-fit": "fit the complex kernels of method circular to a disk",
    "endurance": "measure long films, kills, fuzzing and files of many parts",
    "latency": "measure how fast the window answers the mouse",
    "cold": "measure the time to the first picture of a scene, with empty caches",
    "layers": "measure the processor time that data layers add to a picture",
    "lighting": "measure the processor time that lighting adds to a picture",
}


def main(words):
    lines = "\n".join(f"  {name:16}{text}" for name, text in COMMANDS.items())
    parser = argparse.ArgumentParser(
        prog="scripts/figures", usage="scripts/figures WHAT [options]",
        description="Makes tables, plots and pictures of the documents, and compares results of benches.",
        epilog=f"WHAT:\n{lines}\n\nscripts/figures WHAT --help lists the options.",
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=COMMANDS, metavar="WHAT", help=argparse.SUPPRESS)
    parser.add_argument("options", nargs=argparse.REMAINDER, help=argparse.SUPPRESS)
    arguments = parser.parse_args(words or ["--help"])
    importlib.import_module(f"figures.{arguments.what.replace('-', '_')}").main(arguments.options)


if __name__ == "__main__":
    main(sys.argv[1:])
