"""Calls functions on Blender's main thread.

F12 renders on a thread of its own. Operators such as the exporter, and new data-blocks, need the main thread.
"""

import threading

import bpy


def on_main_thread(function):
    """Returns function() of the main thread; exceptions are passed on."""
    if threading.current_thread() is threading.main_thread():
        return function()
    done, outcome = threading.Event(), {}

    def call():
        try:
            outcome["value"] = function()
        except BaseException as error:  # passed on to the waiting thread
            outcome["error"] = error
        done.set()

    bpy.app.timers.register(call)
    done.wait()
    if "error" in outcome:
        raise outcome["error"]
    return outcome["value"]
