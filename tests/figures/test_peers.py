"""Tests the comparison of render times of Defocus, Embree, Cycles and EEVEE at equal error."""

import pytest

from figures import peers
from figures.peers import Point, Time
from figures.results import RESULTS


def power_law(cost, counts=peers.COUNTS):
    """Returns points whose error is 0.1 / samples and whose CPU time is cost · samples."""
    return [Point(cost * count, cost * count / 2, 0.1 / count, 0.3 / count) for count in counts]


def test_times_follow_a_power_law_between_two_numbers_of_samples():
    for samples in (3, 20, 200):
        time = peers.time_to(power_law(0.5), "rmse", 0.1 / samples)
        assert time == (pytest.approx(0.5 * samples), pytest.approx(0.25 * samples), False)
        assert peers.time_to(power_law(0.5), "flip", 0.3 / samples) == time


def test_times_beyond_the_numbers_of_samples():
    assert peers.time_to(power_law(1), "rmse", 0.06) == Time(2, 1, True)
    assert peers.time_to(power_law(1), "rmse", 0.0003) is None


def test_the_overhead_of_an_image_is_subtracted():
    images = [{"samples": count, "seconds": 3 + 0.5 * count, "cpuSeconds": 2 + 0.25 * count} for count in (1, 4, 16)]
    assert peers.without_overhead(images) == [
        {"samples": count, "seconds": pytest.approx(0.5 * count), "cpuSeconds": pytest.approx(0.25 * count)} for count in (4, 16)]


def test_the_first_has_the_least_cpu_time():
    rival = Time(4, 1)
    assert peers.winner({"auto": Time(2, 9), "embree-shared": rival, "cycles": None}) == "auto, 2.0x"
    assert peers.winner({"auto": Time(5, 1), "embree-shared": rival}) == "embree-shared"
    assert peers.winner({"auto": Time(2, 9), "embree-shared": None}) == "auto"
    assert peers.winner({"auto": Time(2, 9, True), "embree-shared": rival}) == "auto"
    assert peers.winner({"auto": Time(2, 9), "embree-shared": Time(4, 1, True)}) == "undecided"
    assert peers.winner({"auto": None}) == "none"


def test_rows_fit_the_header():
    lines = peers.table({"auto": power_law(1), "embree-shared": power_law(4), "cycles": power_law(9, (2, 4))})
    assert {len(line) for line in lines} == {24 + 18 * len(peers.TARGETS)}
    assert lines[-1].split() == ["first"] + ["auto,", "4.0x"] * len(peers.TARGETS)
    assert lines[3].count("not reached") == len(peers.TARGETS)


def test_unknown_scenes_are_named(capsys):
    with pytest.raises(SystemExit):
        peers.main(["herring", "--program", __file__])
    assert "there is no scene 'herring'; the scenes are: school, helmets" in capsys.readouterr().err


def test_the_committed_record_has_tables_of_the_command():
    record = (RESULTS / "llvmpipe-peers.txt").read_text()
    assert "-changed" not in record and " /" not in record
    header, *_ = peers.table({"auto": power_law(1)})
    assert "\nschool: " in record and header in record and record.count("\nfirst ") == record.count(header)
