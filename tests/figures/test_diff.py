"""Tests the comparison of two results of the same bench."""

import csv
import io
import json
import math

import pytest

from figures import diff
from figures.files import csv_rows
from figures.results import RESULTS


def row(samples, median, low, high, flip=0.01, mse=1e-4, ssim=0.99, runs=3):
    """Returns a result row of `bench convergence`, as stored in its JSON file."""
    return {"method": "accumulation", "setting": "lod=off", "samples": samples, "runs": runs, "mse": mse, "ssim": ssim, "flip": flip,
            "psnr": -10 * math.log10(mse), "milliseconds": {"median": median, "low": low, "high": high}, "bias": None}


OLD = [row(8, 100, 90, 110), row(16, 200, 190, 210), row(32, 400, 390, 410), row(64, 800, 800, 800), row(256, 10, 9, 11)]
NEW = [row(32, 500, 411, 510),  # slower: all times (411 … 510 ms) are above the range of OLD (390 … 410 ms)
       row(16, 150, 130, 190, flip=0.015),  # equally fast: the ranges of times in OLD and NEW overlap at 190 ms
       row(8, 50, 40, 80),  # faster: all times (40 … 80 ms) are below the range of OLD (90 … 110 ms)
       row(128, 1, 1, 1),
       row(256, 20, 11, 30)]  # equally fast: the ranges of times in OLD and NEW overlap at 11 ms


def csv_of(rows):
    """Returns the rows as they are read from the CSV file of a bench."""
    text = io.StringIO()
    rows = [one | {f"milliseconds.{name}": value for name, value in one["milliseconds"].items()} for one in rows]
    writer = csv.DictWriter(text, [name for name in rows[0] if name not in ("bias", "milliseconds")], extrasaction="ignore")
    writer.writeheader()
    writer.writerows(rows)
    return csv_rows(io.StringIO(text.getvalue()))


def compared(old, new):
    unlike, rows = diff.compare(diff.parse(old), diff.parse(new))
    return unlike, {key: (time, errors) for key, time, errors in rows}


@pytest.mark.parametrize("old", [{"rows": OLD}, csv_of(OLD)], ids=["json", "csv"])
@pytest.mark.parametrize("new", [{"rows": NEW}, csv_of(NEW)], ids=["json", "csv"])
def test_changes_beyond_the_noise(old, new):
    unlike, rows = compared(old, new)
    assert not unlike
    assert {key.split()[-1]: time.verdict for key, (time, _) in rows.items()} == {
        "8": "faster", "16": "within noise", "32": "slower", "256": "within noise"}
    time, errors = rows["accumulation lod=off 8"]
    assert (time.old, time.new) == ([100, 90, 110], [50, 40, 80])
    assert {error.verdict for error in errors.values()} == {"equal"} and len(errors) == 4
    assert rows["accumulation lod=off 16"][1]["flip"] == (0.01, 0.015, "farther", False)


def test_table_counts_the_changes_and_names_missing_rows():
    lines = diff.table(diff.parse({"rows": OLD}), diff.parse(csv_of(NEW))).splitlines()
    assert lines[-2:] == ["4 times: 1 faster, 1 slower, 2 within noise, 0 unknown", "16 errors: 0 closer, 1 farther, 15 equal, 0 unknown"]
    assert lines[-4:-2] == ["only in old: accumulation lod=off 64", "only in new: accumulation lod=off 128"]
    (line,) = [line for line in lines if line.startswith("accumulation lod=off 8 ")]
    assert line.split()[3:] == ["100.0", "50.0", "0.500", "0.364", "to", "0.889", "faster", "equal"]
    assert any("flip 0.01 to 0.015 farther" in line for line in lines)


@pytest.mark.parametrize("runs, verdict", [(0, "unknown: number of runs is missing"), (1, "unknown: one run"), (2, "unknown: 2 runs"),
                                           (3, "slower")])
def test_few_runs_have_no_verdict(runs, verdict):
    _, rows = compared({"rows": [row(8, 100, 100, 100, runs=runs)]}, {"rows": [row(8, 101, 101, 101)]})
    assert rows["accumulation lod=off 8"][0].verdict == verdict


# Errors count as changed if they differ by 1 %. For the RMSE, this is a PSNR difference of 0.0864 dB; for 1 - SSIM at
# an SSIM of 0.99, it is 0.0001.
@pytest.mark.parametrize("column, change, verdict", [
    ("rmse", {"mse": 1e-4 * 1.009**2}, "equal"), ("rmse", {"mse": 1e-4 * 1.011**2}, "farther"), ("rmse", {"mse": 1e-4 / 1.011**2}, "closer"),
    ("psnr", {"mse": 1e-4 * 1.009**2}, "equal"), ("psnr", {"mse": 1e-4 * 1.011**2}, "farther"), ("psnr", {"mse": 1e-4 / 1.011**2}, "closer"),
    ("ssim", {"ssim": 0.99009}, "equal"), ("ssim", {"ssim": 0.99012}, "closer"), ("ssim", {"ssim": 0.98988}, "farther"),
    ("flip", {"flip": 0.01005}, "equal"), ("flip", {"flip": 0.0102}, "farther"), ("flip", {"flip": 0}, "closer")])
def test_errors_change_by_more_than_a_hundredth(column, change, verdict):
    _, rows = compared({"rows": [row(8, 1, 1, 1)]}, {"rows": [row(8, 1, 1, 1, **change)]})
    assert rows["accumulation lod=off 8"][1][column].verdict == verdict


SUBJECT = {"scene": "fish.glb", "camera": "main", "width": 64, "height": 48, "lens": {"fStop": 1.4}, "device": "a device",
           "driver": "a driver", "machine": {"processor": "a processor", "threads": 2}, "reference": {"samples": 64, "hash": "0"}}


@pytest.mark.parametrize("name, change, times, errors, bias", [
    ("", {"commit": "another"}, True, True, True),
    ("scene", {"scene": "bird.glb"}, False, False, False),
    ("camera", {"camera": "other"}, False, False, False),
    ("size", {"width": 160}, False, False, False),
    ("lens fStop", {"lens": {"fStop": 2.8}}, False, False, False),
    ("device", {"device": "another"}, False, False, False),
    ("driver", {"driver": "another"}, False, False, False),
    ("machine", {"machine": {"processor": "another", "threads": 2}}, False, True, True),
    ("reference", {"reference": {"samples": 128, "hash": "0"}}, True, False, True)])
def test_other_subjects_have_no_verdict(name, change, times, errors, bias):
    old, new = row(8, 100, 90, 110), row(8, 50, 40, 60, flip=0.005)
    old["bias"], new["bias"] = {"flip": 0.01}, {"flip": 0.005}
    unlike, rows = compared({"rows": [old], **SUBJECT}, {"rows": [new], **SUBJECT, **change})
    assert list(unlike) == ([name] if name else [])
    time, changes = rows["accumulation lod=off 8"]
    assert time.verdict == ("faster" if times else "unknown: not comparable")
    assert changes["flip"].verdict == ("closer" if errors else "unknown")
    assert changes["biasFlip"].verdict == ("closer" if bias else "unknown")


def speedup_row(**more):
    return {"sweep": "samples", "samples": 64, "fStop": 2.8, "focusDistance": 1 / 3, "lod": "off", "runs": 3,
            "milliseconds": {"median": 10, "low": 9, "high": 11}, "fromFullDetail": {"flip": 0.02}, "fromReference": {"flip": 0.02},
            "referenceSamples": 512} | more


def test_rows_with_another_reference_keep_the_other_errors():
    errors = {"fromFullDetail": {"flip": 0.01}, "fromReference": {"flip": 0.01}}
    for samples, verdict in ((512, "closer"), (1024, "unknown")):
        _, rows = compared({"rows": [speedup_row()]}, {"rows": [speedup_row(**errors, referenceSamples=samples)]})
        (_, changes), = rows.values()
        assert (changes["flipFull"].verdict, changes["flipReference"].verdict) == ("closer", verdict)


def test_presets_and_methods_of_speedup_are_rows_of_their_own():
    rows = [speedup_row(), speedup_row(method="accumulation", preset="jeong2011"), speedup_row(method="circular:far-components=2", preset="")]
    assert [one.key for one in diff.parse({"rows": rows}).rows] == [
        "samples 64 2.8 0.333333 off", "samples 64 2.8 0.333333 off jeong2011", "samples circular:far-components=2 64 2.8 0.333333 off"]


def test_infinite_psnr_and_missing_bias_of_csv_rows_are_skipped():
    speedup = csv_rows(["sweep,samples,lod,runs,milliseconds.median,milliseconds.low,milliseconds.high,fromFullDetail.psnr,fromFullDetail.flip",
                        "samples,64,off,3,10,9,11,,0", "samples,64,fractional,3,5,4,6,40,0.01"])
    _, rows = compared(speedup, speedup)
    assert {key: list(errors) for key, (_, errors) in rows.items()} == {
        "samples 64 off": ["flipFull"], "samples 64 fractional": ["flipFull", "psnrFull"]}
    convergence = csv_rows(["method,setting,samples,flip,bias.mse,bias.flip", "accumulation,lod=off,8,0.01,,", "blur,default,1,0.02,1e-4,0.01"])
    _, rows = compared(convergence, convergence)
    assert {key: list(errors) for key, (_, errors) in rows.items()} == {
        "accumulation lod=off 8": ["flip"], "blur default 1": ["biasFlip", "flip"]}


def test_rows_of_version_0_1_have_the_settings_default():
    old = csv_rows(["method,setting,samples,flip", "blur,standard,1,0.02"])
    assert list(compared(old, {"rows": [{"method": "blur", "setting": "default", "samples": 1, "flip": 0.02}]})[1]) == ["blur default 1"]


def test_scaling_takes_the_number_of_runs_from_the_head():
    def document(*times):
        return {"runs": 3, "rows": [{"axis": "blur", "value": 1 / 3, "lod": "off", "samples": 8, "width": 64, "height": 48,
                                     "milliseconds": dict(zip(("low", "median", "high"), times))}]}
    _, rows = compared(document(10, 11, 12), document(20, 21, 22))
    assert [(time.verdict, errors) for time, errors in rows.values()] == [("slower", {})]


def test_popping_compares_the_worst_of_a_movement():
    def document(frames, worst):
        return {"frames": frames, "rows": [{"movement": "dolly", "samples": 8, "lod": "fractional", "stepRmse": {"worst": worst},
                                            "changeRmse": {"worst": 0.1}}]}
    _, rows = compared(document(48, 0.02), document(48, 0.01))
    assert {name: change.verdict for name, change in rows["dolly 8 fractional"][1].items()} == {"stepRmse": "closer", "changeRmse": "equal"}
    assert list(compared(document(48, 0.02), document(24, 0.01))[0]) == ["frames"]
    frame = {"movement": "dolly", "samples": "8", "lod": "fractional", "frame": "3", "stepRmse": "0.02"}
    with pytest.raises(SystemExit, match="no row of OLD is in NEW"):
        compared(document(48, 0.02), [frame])


def test_stability_names_errors_beyond_their_limits():
    def document(error, diameter):
        return {"cases": [{"area": "sums", "case": "one", "errorOf": "sum", "limit": 1e-6, "error": error, "leftOut": False}],
                "lensHonesty": [{"method": "accumulation", "varied": "f/2", "expectedDiameter": 10, "measuredDiameter": diameter, "energy": 1},
                                {"method": "line", "leftOut": "no driver"}]}
    old, new = document(2e-7, 10.1), document(2e-6, 9.8)
    _, rows = compared(old, new)
    assert rows["sums one sum"][1]["error"].beyond_limit
    assert rows["accumulation f/2"][1]["diameterError"].new == pytest.approx(0.2)
    assert {name: change.verdict for name, change in rows["accumulation f/2"][1].items()} == {"diameterError": "farther", "energyError": "equal"}
    for old, new in ((old, new), (document(0.9999e-6, 10), document(1.0001e-6, 10))):
        text = diff.table(diff.parse(old), diff.parse(new))
        assert ", BEYOND ITS LIMIT" in text and text.endswith("1 errors are beyond their limits in new but not in old\n")


def test_pictures_of_the_window_are_compared_by_their_rmse():
    _, rows = compared({"rows": [{"method": "line", "movingPsnr": 40, "stillPsnr": 50}]},
                       {"rows": [{"method": "line", "movingPsnr": 34, "stillPsnr": 50.01}]})
    (_, errors), = rows.values()
    assert {name: error.verdict for name, error in errors.items()} == {"movingPsnr": "farther", "stillPsnr": "equal"}


@pytest.mark.parametrize("file", sorted(RESULTS.glob("*.json")), ids=lambda file: file.stem)
def test_a_committed_result_equals_itself(file):
    results = diff.read(file)
    unlike, rows = diff.compare(results, results)
    assert not unlike and len(rows) == len(results.rows)
    for _, time, errors in rows:
        assert time is None or time.verdict == "within noise" or time.verdict.startswith("unknown")
        assert all(error.verdict == "equal" for error in errors.values())


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", "{", "{}", '{"rows": [1]}', '{"rows": [{"samples": 1}]}',
                                  "method,setting,samples\na,b,1\n"])
def test_other_files_are_named(tmp_path, text):
    file = tmp_path / "other"
    file.write_text(text)
    with pytest.raises(SystemExit, match=str(file)):
        diff.main([str(file), str(file)])
    with pytest.raises(SystemExit, match="missing"):
        diff.main([str(tmp_path / "missing"), str(file)])


def test_the_command_prints_the_table(tmp_path, capsys):
    for name, rows in (("old", OLD), ("new", NEW)):
        (tmp_path / name).write_text(json.dumps({"rows": rows, **SUBJECT}))
    diff.main([str(tmp_path / "old"), str(tmp_path / "new")])
    assert capsys.readouterr().out.startswith("old: fish.glb, 64, 48, a device, a driver\nnew: fish.glb")
