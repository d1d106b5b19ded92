"""Runs the program `defocus`, reports its progress and messages, and cancels it on request."""

import os
import queue
import re
import signal
import subprocess
import threading

from .failure import Cancelled, Failure

PROGRESS = re.compile(r"^(.+): (\d+) %")
SECONDS_TO_STOP = 5


def read_lines(stream, lines):
    for line in stream:
        lines.put(line.strip())
    lines.put(None)


def stop(process):
    """Ends a process with SIGTERM, or kills it if it does not stop within SECONDS_TO_STOP."""
    process.send_signal(signal.SIGTERM)
    try:
        process.wait(SECONDS_TO_STOP)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def run(words, folder, on_progress, is_cancelled):
    """Runs `defocus` in `folder` and returns its messages.

    on_progress(stage, share) receives the finished share of a stage, from 0 to 1. If `defocus` fails, raises Failure
    with its last message. Raises Cancelled once is_cancelled() is true.
    """
    try:
        process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True, encoding="utf-8", errors="replace")
    except OSError as error:
        raise Failure(f"{words[0]} does not start: {error.strerror}") from error
    lines, messages = queue.Queue(), []
    threading.Thread(target=read_lines, args=(process.stderr, lines), daemon=True).start()
    while True:
        if is_cancelled():
            stop(process)
            raise Cancelled
        try:
            line = lines.get(timeout=0.1)
        except queue.Empty:
            continue
        if line is None:
            break
        if found := PROGRESS.match(line):
            on_progress(found[1], int(found[2]) / 100)
        elif line:
            messages.append(line)
    if process.wait() != 0:
        last = messages[-1] if messages else f"it ended with code {process.returncode}"
        raise Failure(f"defocus failed: {last.removeprefix('defocus: ').replace(folder + os.sep, '')}")
    return messages
