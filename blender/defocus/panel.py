"""Adds panels with the engine's settings, and shows Blender's own panels that apply to the engine."""

import textwrap

import bpy

from .engine import DefocusEngine, reports
from .passes import PROPERTIES

LETTER_WIDTH = 6.5  # mean width of a letter in Blender's font, px

# Names of panels that Blender shows for Eevee; this engine exports the data that they edit.
EEVEE_PANELS = {"EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface", "EEVEE_MATERIAL_PT_settings", "EEVEE_WORLD_PT_surface",
                "DATA_PT_EEVEE_light"}
# Names of Blender's generic panels (engine BLENDER_RENDER) for features that this engine lacks.
NOT_FOR_US = {"VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes", "RENDER_PT_gpencil", "RENDER_PT_freestyle", "RENDER_PT_stereoscopy",
              "DATA_PT_light", "DATA_PT_area", "DATA_PT_spot", "DATA_PT_falloff_curve"}


class DefocusPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {DefocusEngine.bl_idname}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class DEFOCUS_PT_sampling(DefocusPanel, bpy.types.Panel):
    bl_label = "Defocus"

    def draw(self, context):
        settings, layout = context.scene.defocus, self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(settings, "preset")
        layout.prop(settings, "samples")
        row = layout.row()
        row.active = settings.samples == 0 and settings.preset == "none"
        row.prop(settings, "quality")
        layout.prop(settings, "target_error")
        layout.prop(settings, "method")
        layout.prop(settings, "levels")
        layout.prop(settings, "shadows")
        layout.prop(context.scene.render, "film_transparent", text="Transparent")
        layout.prop(settings, "further")
        layout.operator("defocus.view", icon="WINDOW")


class DEFOCUS_PT_motion(DefocusPanel, bpy.types.Panel):
    bl_label = "Motion Blur"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.render, "motion_blur_shutter", text="Shutter")
        self.layout.prop(context.scene.defocus, "shutter_position")


class DEFOCUS_PT_report(DefocusPanel, bpy.types.Panel):
    bl_label = "Not Exported"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(reports.get(context.scene.name))

    def draw(self, context):
        letters = int(context.region.width / (LETTER_WIDTH * context.preferences.system.ui_scale)) - 6
        for note in reports[context.scene.name]:
            column = self.layout.column(align=True)
            for index, line in enumerate(textwrap.wrap(note, max(letters, 20))):
                column.label(text=line, icon="BLANK1" if index else "ERROR")


class DEFOCUS_PT_passes(DefocusPanel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        self.layout.use_property_split = True
        for name in PROPERTIES:
            self.layout.prop(context.view_layer, name)


CLASSES = (DEFOCUS_PT_sampling, DEFOCUS_PT_motion, DEFOCUS_PT_report, DEFOCUS_PT_passes)


def blender_panels():
    """Yields Blender's own panels that apply to this engine."""
    for panel in bpy.types.Panel.__subclasses__():
        engines, name = getattr(panel, "COMPAT_ENGINES", ()), panel.__name__
        if name in EEVEE_PANELS or ("BLENDER_RENDER" in engines and name not in NOT_FOR_US):
            yield panel


def register():
    for panel in CLASSES:
        bpy.utils.register_class(panel)
    for panel in blender_panels():
        panel.COMPAT_ENGINES.add(DefocusEngine.bl_idname)


def unregister():
    for panel in blender_panels():
        panel.COMPAT_ENGINES.discard(DefocusEngine.bl_idname)
    for panel in reversed(CLASSES):
        bpy.utils.unregister_class(panel)
