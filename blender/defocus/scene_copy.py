"""Copies the evaluated scene, so that Blender's glTF exporter writes the scene as a render shows it.

Without a copy, the exporter would use the modifiers, instances and visibility of the viewport instead of the render.
"""

import contextlib

import bpy
from mathutils import Matrix

from .materials import changes_with_time, material_notes, posed_material
from .motion import instance_key

SURFACES = {"MESH", "CURVE", "SURFACE", "META", "FONT"}
INVISIBLE = {"EMPTY", "CAMERA", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE"}
NAMES = {"VOLUME": "volume", "POINTCLOUD": "point cloud", "CURVES": "hair", "GPENCIL": "grease pencil"}
LIGHT_VALUES = ("energy", "color", "spot_size", "spot_blend", "use_custom_distance", "cutoff_distance")
CAMERA_VALUES = ("lens", "sensor_width", "sensor_height", "sensor_fit", "clip_start", "clip_end")


class SceneCopy:
    """A copied scene, the user's names of its objects, and a message for each item that is not exported."""

    def __init__(self):
        self.scene = bpy.data.scenes.new("defocus export")
        self.material_names = {}  # name of a copied material → the user's name
        self.names = {}  # name of a copied object → the user's name
        self.moving = {}  # name of a copied object → (key of its instance, whether the exporter rotates its axes)
        self.notes = []
        self.light_angles = set()  # angles of the sun lights, rad
        self.light_radii = set()  # radii of the point and spot lights, m
        self.made = []  # data-blocks to remove together with the scene
        self.materials = {}  # material that changes with time → its copy
        self.meshes = {}  # key of an object's evaluated mesh and materials → copied mesh
        self.noted = set()

    def note(self, *lines):
        for line in lines:
            if line not in self.noted:
                self.noted.add(line)
                self.notes.append(line)

    def add(self, name, data, matrix, key=None, turned=False):
        thing = bpy.data.objects.new(name, data)
        self.made.append(thing)
        self.scene.collection.objects.link(thing)
        thing.matrix_world = matrix
        self.names[thing.name] = name
        self.moving[thing.name] = key, turned
        return thing

    def remove(self):
        bpy.data.batch_remove(self.made)
        bpy.data.scenes.remove(self.scene)


def is_sheared(matrix):
    """Returns whether a matrix is sheared. A glTF node cannot represent shear by translation, rotation and scale."""
    x, y, z = matrix.to_3x3().col
    scale = max(x.length, y.length, z.length) ** 2
    return max(abs(x.dot(y)), abs(y.dot(z)), abs(z.dot(x))) > 1e-5 * scale


def new_mesh(thing, depsgraph):
    """Returns a new mesh data-block with the geometry of an evaluated object."""
    source = thing.original.evaluated_get(depsgraph)
    if thing.type != "MESH" or source.data.as_pointer() == thing.data.as_pointer():
        # preserve_all_data_layers=True would evaluate the modifiers again, without unfinished changes in edit mode.
        return bpy.data.meshes.new_from_object(source, preserve_all_data_layers=False, depsgraph=depsgraph)
    mesh = thing.data.copy()  # geometry nodes have created this mesh and its instances
    for index, material in enumerate(mesh.materials):
        mesh.materials[index] = material.original if material else None
    return mesh


def material_of(copy, material, depsgraph):
    """Returns the material; if it is animated, returns a copy with its values in the current frame."""
    if not changes_with_time(material):
        return material
    if material not in copy.materials:
        copy.materials[material] = posed_material(material, material.evaluated_get(depsgraph))
        copy.made.append(copy.materials[material])
        copy.material_names[copy.materials[material].name] = material.name
    return copy.materials[material]


def mesh_of(copy, thing, depsgraph):
    """Returns the mesh of an evaluated object, shared by instances; None if it has no faces."""
    slots = tuple(slot.material.original if slot.link == "OBJECT" and slot.material else None for slot in thing.material_slots)
    key = thing.data.as_pointer(), thing.type, slots
    if key not in copy.meshes:
        mesh = new_mesh(thing, depsgraph)
        copy.made.append(mesh)
        for index, material in enumerate(slots):
            if material is not None:
                while len(mesh.materials) <= index:
                    mesh.materials.append(None)
                mesh.materials[index] = material
        for index, material in enumerate(mesh.materials):
            if material is not None:
                copy.note(*material_notes(material))
                mesh.materials[index] = material_of(copy, material, depsgraph)
        copy.meshes[key] = mesh if len(mesh.polygons) else None
    return copy.meshes[key]


def add_surface(copy, instance, depsgraph):
    thing = instance.object
    mesh = mesh_of(copy, thing, depsgraph)
    for system in thing.particle_systems if not instance.is_instance else ():
        if system.settings.type == "HAIR" and system.settings.render_type == "PATH":
            copy.note(f"the hair of '{thing.name}' is not exported")
    if mesh is None:
        if thing.type == "MESH" and len(thing.data.edges):
            copy.note(f"'{thing.name}' has edges but no faces and is not exported")
        return
    matrix, key = instance.matrix_world.copy(), instance_key(instance)
    if is_sheared(matrix):
        mesh = mesh.copy()
        copy.made.append(mesh)
        mesh.transform(matrix)
        matrix, key = Matrix.Identity(4), ()
    copy.add(thing.name, mesh, matrix, key)
    if thing.is_holdout or thing.is_shadow_catcher:
        copy.note(f"'{thing.name}' is a holdout or shadow catcher; it is drawn as a usual object")
    if not thing.visible_camera or not thing.visible_shadow:
        copy.note(f"'{thing.name}' is hidden from the camera or casts no shadow, which is ignored")


def add_light(copy, instance):
    thing, light = instance.object, instance.object.data
    if light.type == "AREA":
        copy.note(f"the area light '{thing.name}' is not exported: glTF has only point, spot and sun lights")
        return
    data = light.original.copy()
    copy.made.append(data)
    for name in LIGHT_VALUES:
        if hasattr(light, name):
            setattr(data, name, getattr(light, name))
    if data.type == "SPOT":
        data.spot_blend = max(data.spot_blend, 1e-3)  # glTF's inner cone must be smaller than the outer cone
    if data.use_nodes:
        data.use_nodes = False
        copy.note(f"the nodes of the light '{thing.name}' are ignored; its strength and colour are used")
    if light.type == "SUN":
        copy.light_angles.add(round(light.angle, 6))
    else:
        copy.light_radii.add(round(light.shadow_soft_size, 6))
    if light.type == "SPOT" and light.spot_blend > 0:
        copy.note(f"the edge of the spot light '{thing.name}' falls off as in glTF, not as in Blender")
    if not light.use_shadow:
        copy.note(f"the light '{thing.name}' casts no shadow, which is ignored")
    copy.add(thing.name, data, instance.matrix_world.copy(), instance_key(instance), turned=True)


def add_camera(copy, camera, view):
    data = camera.data.original.copy()
    copy.made.append(data)
    for name in CAMERA_VALUES:
        setattr(data, name, getattr(camera.data, name))
    for name, value in camera.data.items():
        data[name] = value
    data.shift_x = data.shift_y = 0
    # The field of view is that of the canvas, which is sensor_width wide on the sensor.
    data.sensor_fit, data.sensor_width = "HORIZONTAL", view.sensor_width
    copy.scene.camera = copy.add(camera.name, data, camera.matrix_world.copy(), turned=True)
    render = copy.scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = view.width, view.height, 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1


@contextlib.contextmanager
def scene_copy(depsgraph, camera, view):
    """Yields a SceneCopy of the objects that a render of the depsgraph shows. Removes the copy at the end."""
    copy = SceneCopy()
    try:
        add_camera(copy, camera, view)
        for instance in depsgraph.object_instances:
            thing = instance.object
            # Blender lists the mesh of a curve or text a second time, as an instance of the type MESH.
            is_repeated = thing.type == "MESH" and thing.original.type != "MESH"
            if not instance.show_self or is_repeated:
                continue
            if thing.type in SURFACES:
                add_surface(copy, instance, depsgraph)
            elif thing.type == "LIGHT":
                add_light(copy, instance)
            elif thing.type not in INVISIBLE:
                copy.note(f"'{thing.name}' is not exported: glTF has no {NAMES.get(thing.type, thing.type.lower())}")
        yield copy
    finally:
        copy.remove()
