"""Tests that scenes made of arrays render, keep no references to the arrays, and reject invalid arrays."""

import gc
import math
import pathlib
import weakref

import numpy
import pytest

import defocus

CORNERS = numpy.array([[-0.5, -0.25, -2], [0.25, -0.25, -2], [0.25, 0.5, -2], [-0.5, 0.5, -2]])
TRIANGLES = numpy.array([[0, 1, 2], [0, 2, 3]])
UVS = numpy.array([[0, 1], [1, 1], [1, 0], [0, 0]])
CAMERA = defocus.Camera(yfov=2 * math.atan(0.5))
SETTINGS = {"size": (64, 64), "samples": 4, "dof_enabled": False, "background": "none", "no_cache": True}


def square(**changes):
    material = defocus.Material(base_color=(0.5, 0.25, 0.125), unlit=True)
    return defocus.Mesh(**{"positions": CORNERS, "indices": TRIANGLES, "material": material, "name": "Square", **changes})


@pytest.mark.usefixtures("gl")
def test_a_square_covers_its_pixels():
    scene = defocus.Scene.create([square()], cameras=[CAMERA], name="Wall")
    assert scene.name == "Wall" and scene.nodes == ["Square", ""] and scene.triangles == 2
    wanted = numpy.zeros((64, 64, 4), numpy.float32)
    wanted[16:40, 16:40] = 0.5, 0.25, 0.125, 1
    assert numpy.array_equal(defocus.render(scene, **SETTINGS), wanted)


@pytest.mark.usefixtures("gl")
def test_layouts_and_types_of_arrays_do_not_matter():
    wanted = defocus.render(defocus.Scene.create([square(uvs=UVS)], cameras=[CAMERA]), **SETTINGS)
    wide = numpy.zeros((4, 6))
    wide[:, ::2] = CORNERS
    for changes in ({"positions": CORNERS.astype(numpy.float32)}, {"positions": CORNERS.tolist()},
                    {"positions": numpy.asfortranarray(CORNERS)}, {"positions": wide[:, ::2]},
                    {"positions": CORNERS[::-1], "indices": 3 - TRIANGLES},
                    {"indices": TRIANGLES.astype(numpy.uint8)}, {"indices": TRIANGLES.ravel().tolist()},
                    {"indices": numpy.asfortranarray(TRIANGLES.astype(numpy.int16))},
                    {"positions": CORNERS[TRIANGLES.ravel()], "indices": None},
                    {"uvs": UVS.astype(numpy.float32)}, {"colors": numpy.ones((4, 3))}):
        scene = defocus.Scene.create([square(**changes)], cameras=[CAMERA])
        assert numpy.array_equal(defocus.render(scene, **SETTINGS), wanted), changes


@pytest.mark.usefixtures("gl")
def test_arrays_are_copied():
    positions = CORNERS.astype(numpy.float32)
    indices = TRIANGLES.astype(numpy.uint32)
    picture = numpy.full((4, 4, 3), 0.5, numpy.float32)
    material = defocus.Material(base_color_texture=defocus.Texture(picture), unlit=True)
    scene = defocus.Scene.create([square(positions=positions, indices=indices, uvs=UVS, material=material)],
                                 cameras=[CAMERA])
    wanted = defocus.render(scene, **SETTINGS)
    assert wanted[20, 20, 0] == pytest.approx(0.5, rel=0.02)
    freed = [weakref.ref(array) for array in (positions, indices, picture)]
    positions[:] = indices[:] = picture[:] = 0
    del positions, indices, picture, material
    gc.collect()
    assert [array() for array in freed] == [None] * 3
    assert numpy.array_equal(defocus.render(scene, **SETTINGS), wanted)


@pytest.mark.usefixtures("gl")
def test_transforms_move_instances_cameras_and_lights():
    moved = numpy.eye(4)
    moved[:3, 3] = 0.25, 0, 0  # translation by 8 pixels to the right
    mesh = square()
    scene = defocus.Scene.create([mesh, defocus.Instance(mesh, moved, name="Right")], cameras=[CAMERA])
    assert scene.nodes == ["Square", "Right", ""] and scene.triangles == 2
    image = defocus.render(scene, **SETTINGS)
    assert image[20, 16:48, 3].min() == 1 and image[20, 48:, 3].max() == 0
    # Seen from behind, the square is invisible, because it is single-sided.
    behind = defocus.Camera(defocus.look_at((0, 0, -4), (0, 0, -2)))
    image = defocus.render(defocus.Scene.create([mesh], cameras=[behind]), **SETTINGS)
    assert image[..., 3].max() == 0
    # A lamp on the camera's side of the square illuminates the side that the camera sees.
    lamp = defocus.Light("point", moved, intensity=50)
    grey = square(material=defocus.Material(metallic=0))
    lit = defocus.render(defocus.Scene.create([grey], cameras=[CAMERA], lights=[lamp]), **SETTINGS)
    assert lit[20, 20, 0] > 1


@pytest.mark.usefixtures("gl")
def test_a_camera_has_a_lens():
    camera = defocus.Camera(yfov=2 * math.atan(0.5), focus_distance=1, lens={"f_stop": 0.5, "blade_count": 5})
    settings = {**SETTINGS, "dof_enabled": None}
    scene = defocus.Scene.create([square()], cameras=[camera])
    plain = defocus.Scene.create([square()], cameras=[CAMERA])
    image = defocus.render(scene, **settings)
    assert numpy.array_equal(image, defocus.render(plain, **settings, f_stop=0.5, blade_count=5, focus_distance=1))
    assert 0 < image[20, 16, 3] < 1


def test_look_at_returns_the_camera_s_axes():
    matrix = defocus.look_at((0, 4, 0), (0, 0, 0), up=(0, 0, -1))
    assert matrix.shape == (4, 4) and matrix.flags.c_contiguous
    assert numpy.array_equal(matrix[:3, 3], (0, 4, 0)) and numpy.array_equal(matrix[:3, 2], (0, 1, 0))
    with pytest.raises(defocus.UsageError, match="look_at: position and target are equal"):
        defocus.look_at((0, 0, 0), (0, 0, 0))
    with pytest.raises(defocus.UsageError, match="look_at: target is 5, not 3 numbers"):
        defocus.look_at((0, 0, 0), 5)


@pytest.mark.usefixtures("gl")
def test_the_program_of_the_documentation_runs(tmp_path, monkeypatch):
    page = (pathlib.Path(__file__).resolve().parents[2] / "docs" / "python.md").read_text()
    section = page[page.index("## Scenes from arrays"):]
    program = section[section.index("```python\n") + len("```python\n"):section.index("\n```\n")]
    monkeypatch.chdir(tmp_path)
    exec(compile(program, "python.md", "exec"), {})
    image = defocus.read_image(tmp_path / "wave.png")
    assert image.shape[:2] == (320, 480) and image[200:, 100:380].std() > 0.05


def bad(**changes):
    return lambda: defocus.Scene.create([square(**changes)])


def bad_material(**changes):
    return bad(material=defocus.Material(**changes, name="Paint"), uvs=UVS)


NAN = CORNERS.copy()
NAN[1, 2] = math.nan
SHEARED = numpy.eye(4)
SHEARED[3, 0] = 2


@pytest.mark.parametrize("create, message", [
    (bad(positions=CORNERS[:, :2]), "mesh 'Square' (0): positions is 4×2, not N×3"),
    (bad(positions=CORNERS.ravel()), "mesh 'Square' (0): positions is 12 values, not N×3"),
    (bad(positions=CORNERS[:0]), "mesh 'Square' (0): positions is empty"),
    (bad(positions=[["a", "b", "c"]] * 3), "mesh 'Square' (0): positions holds <U1, not numbers"),
    (bad(positions=NAN), "mesh 'Square' (0): positions[1] is not finite (NaN or infinite)"),
    (bad(positions=CORNERS * 1e39), "mesh 'Square' (0): positions[0] is not finite (NaN or infinite)"),
    (bad(normals=CORNERS[:3]), "mesh 'Square' (0): it has 3 normals for 4 positions; give one for each position, or none"),
    (bad(uvs=CORNERS), "mesh 'Square' (0): uvs is 4×3, not N×2"),
    (bad(colors=numpy.ones((4, 2))), "mesh 'Square' (0): colors is 4×2, not N×3 or N×4"),
    (bad(colors=numpy.ones((4, 3), numpy.uint8)),
     "mesh 'Square' (0): colors are linear floats; divide integers by the range and decode first"),
    (bad(indices=TRIANGLES + 0.5), "mesh 'Square' (0): indices are integers, not float64"),
    (bad(indices=TRIANGLES[:, :2]), "mesh 'Square' (0): indices is 2×2, not M×3"),
    (bad(indices=TRIANGLES[:0]), "mesh 'Square' (0): indices is empty, so the mesh has no triangles"),
    (bad(indices=TRIANGLES - 1), "mesh 'Square' (0): index -1 is not from 0 to 4294967295"),
    (bad(indices=TRIANGLES + 14), "mesh 'Square' (0): index 14 is out of range for 4 vertices"),
    (bad(indices=[0, 1, 2, 3]), "mesh 'Square' (0): it has 4 indices, not a multiple of 3; each triangle needs three"),
    (bad(material="red"), "Scene.create: 'red' is not a defocus.Material"),
    (bad_material(metallic=2), "material 'Paint' (0): metallic is 2; it must be from 0 to 1"),
    (bad_material(roughness="rough"), "material 'Paint' (0): roughness is 'rough', not a number"),
    (bad_material(base_color=0.5), "material 'Paint' (0): base_color is 0.5, not 3 or 4 numbers"),
    (bad_material(alpha_mode="clip"),
     "material 'Paint' (0): alpha_mode is 'clip'; it must be one of opaque, mask, blend"),
    (bad_material(base_color_texture=defocus.Texture(numpy.ones((2, 2, 3), numpy.uint8))),
     "texture 0: an image holds linear floats, not uint8; divide by the range and decode first"),
    (bad_material(base_color_texture=defocus.Texture(numpy.ones(3))), "texture 0: an image is H×W or H×W×channels, not 3 values"),
    (bad_material(base_color_texture=defocus.Texture(numpy.ones((2, 2, 2)), name="Grain")),
     "texture 'Grain' (0): its image has 2 channels; give 1, 3 or 4"),
    (bad_material(normal_texture=defocus.Texture(numpy.ones((2, 2, 3)))),
     "material 'Paint' (0): texture 0 holds colours; as normal_texture it must hold data"),
    (lambda: defocus.Scene.create([]), "the scene is empty; add an instance of a mesh"),
    (lambda: defocus.Scene.create(5), "Scene.create: 5 is not a list of parts"),
    (lambda: defocus.Scene.create([defocus.Instance(square(), numpy.eye(3))]),
     "instance 0: transform is 3×3 of float64, not 4×4 numbers"),
    (lambda: defocus.Scene.create([defocus.Instance(square(), SHEARED, name="Left")]),
     "instance 'Left' (0): the last row of transform is [2.0, 0.0, 0.0, 1.0], not 0, 0, 0, 1; the translation stands in "
     "the last column"),
    (lambda: defocus.Scene.create([square()], cameras=[defocus.Camera(yfov=4)]),
     "camera 0: yfov is 4; it must be between 0 and π radians"),
    (lambda: defocus.Scene.create([square()], cameras=[defocus.Camera(lens={"f_stop": 0}, name="Main")]),
     "camera 'Main' (0): f_stop: '0' is not a number from 0.001 to 1e+06"),
    (lambda: defocus.Scene.create([square()], cameras=[defocus.Camera(lens={"samples": 3})]),
     "camera 0: 'samples' is no setting of the lens"),
    (lambda: defocus.Scene.create([square()], lights=[defocus.Light("sun")]),
     "light 0: type is 'sun'; it must be one of directional, point, spot"),
    (lambda: defocus.Scene.create([square()], lights=[defocus.Light(intensity=-1)]),
     "light 0: intensity is -1; it must be a finite number of at least 0"),
    (lambda: defocus.Scene.create([square()], metres_per_unit=0),
     "the scene: metres_per_unit is 0; it must be from 1e-09 to 1000000000"),
])
def test_wrong_parts_are_refused_by_name(create, message):
    with pytest.raises(defocus.UsageError) as caught:
        create()
    assert str(caught.value) == message


def test_the_classes_have_the_defaults_of_c_plus_plus():
    native = defocus._defocus
    for kind, made in ((defocus.Material(), native.MaterialData()), (defocus.Light(), native.LightData()),
                       (defocus.Camera(), native.CameraData())):
        for name, value in vars(kind).items():
            if name in ("transform", "lens", "alpha_mode", "type"):
                continue
            wanted = getattr(made, name)
            if name.endswith("_texture"):
                assert value is None and wanted == -1
            elif isinstance(value, tuple):
                assert list(value) == wanted, name
            else:
                assert value == pytest.approx(wanted), name
