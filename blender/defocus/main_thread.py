"""Calls functions on Blender's main thread.

Blender renders on a separate thread, but operators, such as the exporter, and the creation of data-blocks need the main
thread.
"""

import threading

import bpy

from .failure import Cancelled

SECONDS_BETWEEN_CHECKS = 0.1


def on_main_thread(function, is_cancelled):
    """Calls function() on the main thread and returns its result; its exceptions are raised here.

    Raises Cancelled if is_cancelled() is true before the call begins. In that case the main thread may be waiting for
    the calling thread to end, and would never begin the call.
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
