"""Helps all commands of this folder: finds the repository root, parses options, runs programs."""

import argparse
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def parser_of(name, text):
    """Returns the option parser of `scripts/figures NAME`. text: description, the module's docstring."""
    return argparse.ArgumentParser(prog=f"scripts/figures {name}", description=text,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)


def path(text):
    """Returns the absolute path, because programs run in the repository root instead of the user's folder."""
    return pathlib.Path(text).resolve()


def executable(text):
    if not path(text).exists():
        raise argparse.ArgumentTypeError(f"{text} does not exist; scripts/demo builds the program")
    return path(text)


def add_program(parser):
    parser.add_argument("--program", type=executable, default=str(ROOT / "build/release/defocus"),
                        help="the program (default: build/release/defocus)")


OPTIONS = {"runs": "runs of each image", "size": "image size, WIDTHxHEIGHT in px", "samples": "lens samples",
           "reference-samples": "lens samples of the reference", "options": "further options of the program's command"}


def add_options(parser, options):
    """Adds options that several figures have. options: {name in OPTIONS: default}."""
    for name, default in options.items():
        parser.add_argument(f"--{name}", type=type(default), default=default,
                            help=OPTIONS[name] + (" (default: %(default)s)" if default else ""))


def run(*words, cwd=ROOT):
    """Runs a program in a folder (default: repository root). Returns its output, or exits with its error message."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, cwd=cwd)
    if done.returncode != 0:
        sys.exit(done.stderr.strip())
    return done.stdout
