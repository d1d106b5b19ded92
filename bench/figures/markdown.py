"""Makes Markdown for the documents: tables, and the sentence that describes the run behind a table."""

from figures.results import command_of, run_of


def table(header, rows):
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in [header, ["---"] * len(header), *rows]) + "\n"


def source(command, held_equal, file, commit=""):
    """Returns the sentence under a table: the command, the file of the run, and what was equal in all rows."""
    run = f"the run, commit {commit}" if commit else "the run"
    return f"\nCommand: `{command}` ([{run}](../bench/results/{file})). Held equal: {held_equal.rstrip('.')}.\n"


def run_source(name, held_equal=None):
    """Returns the sentence under a table made from a JSON result."""
    results = run_of(name)
    if held_equal is None:
        return source(command_of(name, results), results["heldEqual"], f"{name}.json", results["commit"])
    return source(command_of(name, results), held_equal, f"{name}.json")


def run_table(name, header, rows, held_equal=None):
    return table(header, rows) + run_source(name, held_equal)
