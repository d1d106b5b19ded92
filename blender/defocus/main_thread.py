"""Calls functions on Blender's main thread.

F12 renders on a thread of its own. Operators such as the exporter, and new data-blocks, need the main thread.
"""

import threading

import bpy

from .failure import Cancelled

SECONDS_BETWEEN_CHECKS = 0.1


def on_main_thread(function, is_cancelled):
    """Returns function() of the main thread; exceptions are passed on.

    Throws Cancelled if is_cancelled() before the function begins: the main thread may wait for this one to end.
    """
    if threading.current_thread() is threading.main_thread():
        return function()
    lock, done, outcome = threading.Lock(), threading.Event(), {}

    def call():
        with lock:
            if "given up" in outcome:
                return
            outcome["begun"] = True
        try:
            outcome["value"] = function()
        except BaseException as error:  # the waiting thread raises the error again
            outcome["error"] = error
        done.set()

    bpy.app.timers.register(call)
    while not done.wait(SECONDS_BETWEEN_CHECKS):
        with lock:
            if "begun" not in outcome and is_cancelled():
                outcome["given up"] = True
                raise Cancelled
    if "error" in outcome:
        raise outcome["error"]
    return outcome["value"]
