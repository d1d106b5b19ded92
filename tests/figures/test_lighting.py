"""Tests figures.lighting, which compares lit with unlit scenes."""

import json
import struct

from figures import lighting

DOCUMENT = {"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_ior"],
            "materials": [{"name": "a", "extensions": {"KHR_materials_ior": {"ior": 1.4}}}, {}]}


def check(document):
    assert document["extensionsUsed"] == ["KHR_materials_ior", "KHR_materials_unlit"]
    assert [material["extensions"]["KHR_materials_unlit"] for material in document["materials"]] == [{}, {}]
    assert document["materials"][0]["extensions"]["KHR_materials_ior"] == {"ior": 1.4}


def test_a_binary_file_keeps_its_buffer(tmp_path):
    text = json.dumps(DOCUMENT).encode()
    text += b" " * (-len(text) % 4)
    buffer = struct.pack("<I4s4s", 4, b"BIN\0", b"abcd")
    source = tmp_path / "a.glb"
    source.write_bytes(struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(buffer), len(text), b"JSON") + text + buffer)
    folder = tmp_path / "unlit"
    folder.mkdir()
    data = lighting.write_unlit(source, folder).read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    assert struct.unpack_from("<I", data, 8)[0] == len(data)
    assert data[20 + length:] == buffer
    check(json.loads(data[20:20 + length]))


def test_a_text_file_finds_its_other_files(tmp_path):
    source = tmp_path / "scene"
    source.mkdir()
    (source / "a.gltf").write_text(json.dumps(DOCUMENT))
    (source / "a.bin").write_bytes(b"abcd")
    folder = tmp_path / "unlit"
    folder.mkdir()
    written = lighting.write_unlit(source / "a.gltf", folder)
    check(json.loads(written.read_text()))
    assert (folder / "a.bin").read_bytes() == b"abcd"


def test_the_ratio_is_of_medians():
    assert lighting.row_of("skull", {"lit": [3, 9, 4], "unlit": [2, 1, 8]}).split() == ["skull", "4.00", "2.00", "2.00"]
