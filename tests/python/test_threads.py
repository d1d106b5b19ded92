"""Tests that other Python threads run while C++ code renders, and that Ctrl-C interrupts the C++ code."""

import subprocess
import sys
import textwrap
import threading
import time

import numpy
import pytest

import defocus

pytestmark = pytest.mark.usefixtures("gl")


def test_progress_is_told_of_the_samples(small):
    told = []
    defocus.render(**small, wave=2, progress=lambda *report: told.append(report))
    assert all(isinstance(stage, str) and 0 <= done <= total for stage, done, total in told)
    counts = [(done, total) for stage, done, total in told if stage == "samples"]
    assert {total for _, total in counts} == {8}
    assert [done for done, _ in counts] == sorted(done for done, _ in counts) and len(set(counts)) >= 4


def test_what_progress_raises_ends_the_work_and_reaches_the_caller(small):
    class Enough(Exception):
        pass

    reason = Enough("seen enough")

    def stop(stage, done, total):
        if stage == "samples" and done >= 2:
            raise reason

    with defocus.Renderer(**small, wave=2) as renderer:
        with pytest.raises(Enough) as caught:
            renderer.render(progress=stop)
        assert caught.value is reason
        assert 0 < renderer.samples < renderer.sample_total
        assert numpy.array_equal(renderer.render(), defocus.render(**small))


# Rendering releases the GIL. With an endless switch interval, a thread runs only if another thread releases the GIL. A
# second thread increments a counter. The progress function does not release the GIL, so the counter grows between two
# of its calls only if C++ renders without the GIL.
def test_python_goes_on_while_c_plus_plus_renders(small):
    count = 0
    finished = threading.Event()
    started = threading.Event()

    def counting():
        nonlocal count
        started.set()
        while not finished.is_set():
            count += 1
            time.sleep(1e-4)  # releases the GIL

    interval = sys.getswitchinterval()
    other = threading.Thread(target=counting)
    other.start()
    started.wait()
    sys.setswitchinterval(1e4)
    try:
        with defocus.Renderer(**small, wave=1) as renderer:
            for _ in range(1000):  # repeats, since the operating system decides when the other thread runs
                counts = []
                renderer.render(progress=lambda *_: counts.append(count))
                if counts[-1] > counts[0]:
                    break
        assert counts[-1] > counts[0]
    finally:
        sys.setswitchinterval(interval)
        finished.set()
        other.join()


def test_a_progress_function_may_wait_for_another_thread(small):
    asked, answered = threading.Event(), threading.Event()

    def answering():
        asked.wait()
        answered.set()

    other = threading.Thread(target=answering)
    other.start()

    def progress(stage, done, total):
        asked.set()
        answered.wait()

    defocus.render(**small, progress=progress)
    other.join()
    assert answered.is_set()


def test_threads_that_share_a_renderer_take_turns(small):
    with defocus.Renderer(**small) as renderer:
        wanted = {f_stop: renderer.render(f_stop=f_stop) for f_stop in (1.0, 4.0)}
        faults = []

        def work(f_stop):
            for _ in range(3):
                if not numpy.array_equal(renderer.render(f_stop=f_stop), wanted[f_stop]):
                    faults.append(f_stop)

        threads = [threading.Thread(target=work, args=(f_stop,)) for f_stop in wanted]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert not faults


def test_threads_may_have_a_renderer_each(small):
    wanted = defocus.render(**small)
    images = {}
    threads = [threading.Thread(target=lambda n=n: images.update({n: defocus.render(**small)})) for n in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(images) == 3
    assert all(numpy.array_equal(image, wanted) for image in images.values())


def test_a_renderer_is_not_used_from_its_own_progress_function(small):
    with defocus.Renderer(**small) as renderer:
        for use in (lambda *_: renderer.image(), lambda *_: renderer.close()):
            with pytest.raises(defocus.UsageError, match="from its own progress function"):
                renderer.render(progress=use)
        assert renderer.render().shape == (48, 64, 4)


# Ctrl-C ends a render without a progress function. The signal comes soon after the start of a frame that would take
# minutes. The test checks only that the frame was not finished, not how soon the signal takes effect.
def test_ctrl_c_ends_a_render(small):
    script = textwrap.dedent(f"""
        import signal
        import defocus

        signal.signal(signal.SIGALRM, signal.default_int_handler)
        with defocus.Renderer(**{ {**small, "size": (640, 480), "samples": 65536}!r}) as renderer:
            try:
                signal.setitimer(signal.ITIMER_REAL, 0.3)
                renderer.render()
            except KeyboardInterrupt:
                print("interrupted" if renderer.samples < renderer.sample_total else "finished first")
    """)
    outcome = subprocess.run([sys.executable, "-B", "-c", script], capture_output=True, text=True, check=False)
    assert outcome.stdout == "interrupted\n", outcome.stderr


def test_ctrl_c_in_a_progress_function_is_a_keyboard_interrupt(small):
    script = textwrap.dedent(f"""
        import os, signal
        import defocus

        pressed = []

        def press(*_):  # presses once: a second Ctrl-C would interrupt the code after the render
            if not pressed:
                pressed.append(True)
                os.kill(os.getpid(), signal.SIGINT)

        try:
            defocus.render(**{small!r}, progress=press)
        except KeyboardInterrupt:
            print("interrupted")
    """)
    outcome = subprocess.run([sys.executable, "-B", "-c", script], capture_output=True, text=True, check=False)
    assert outcome.stdout == "interrupted\n", outcome.stderr
