"""Defines the render settings of a scene, and converts them to command-line options of `defocus`."""

import shlex

import bpy

from .failure import Failure


def choices(*rows):
    return [(value, name, text) for value, name, text in rows]


QUALITIES = choices(("draft", "Draft", "FLIP difference of about 0.03 from the converged image"),
                    ("good", "Good", "FLIP difference of about 0.01 from the converged image"),
                    ("fine", "Fine", "FLIP difference of about 0.005 from the converged image"))
METHODS = choices(("auto", "Automatic", "Multirate if at least 1 % of the image is blurred by 8 px or more, else accumulation"),
                  ("accumulation", "Accumulation", "Mean of one image for each lens sample"),
                  ("multirate", "Multirate", "Each lens sample stands for a part of the lens; needs fewer samples for wide blurs"),
                  ("layered", "Layered", "Lens rays through the depth layers of one pinhole image"),
                  ("circular", "Circular", "Blur of one pinhole image with separable circular kernels"),
                  ("scheuermann", "Scheuermann", "Blur of one pinhole image with the samples of a Poisson disk"),
                  ("stochastic", "Stochastic", "Stochastic lens samples for each pixel"),
                  ("line", "Line", "Line samples on the lens"))
LEVELS = choices(("auto", "Automatic", "Full detail if building the levels of a still image takes longer than they save, else fractional"),
                 ("fractional", "Fractional", "The lens samples are split between two levels of detail"),
                 ("continuous", "Continuous", "One sample draws both levels, each in some of its pixels"),
                 ("nearest", "Nearest", "One level of detail"),
                 ("off", "Off", "Full detail"))
POSITIONS = choices(("start", "Start on Frame", "The shutter opens at the frame"),
                    ("centre", "Center on Frame", "The shutter is half open at the frame"),
                    ("end", "End on Frame", "The shutter closes at the frame"))
PRESETS = choices(("none", "None", "No preset"),
                  ("jeong2011", "Jeong 2011", "Accumulation with levels of detail by the ratio of blur to object size"),
                  ("tzeng2012", "Tzeng 2012", "Line samples with a buffer of fixed size"),
                  ("scheuermann2004", "Scheuermann 2004", "Blur of one pinhole image with the samples of a Poisson disk"),
                  ("garcia2018", "Garcia 2018", "Blur of one pinhole image with separable circular kernels"),
                  ("lee2010", "Lee 2010", "Lens rays through the depth layers of one pinhole image"),
                  ("munkberg2012", "Munkberg 2012", "Stochastic lens samples for each pixel"))


class DefocusSettings(bpy.types.PropertyGroup):
    preset: bpy.props.EnumProperty(name="Preset", items=PRESETS, default="none",
                                   description="Settings as published in a paper; changed settings below override them")
    samples: bpy.props.IntProperty(name="Samples", min=0, max=65536, default=0,
                                   description="Number of lens samples. 0: the number that the quality needs, 16 to 1,024")
    quality: bpy.props.EnumProperty(name="Quality", items=QUALITIES, default="good",
                                    description="Quality of an image with an automatic number of samples")
    target_error: bpy.props.FloatProperty(
        name="Target Error", min=0, max=1, default=0, precision=4, step=0.1,
        description="Add samples until the estimated root mean square error of the encoded image is smaller. 0: off")
    method: bpy.props.EnumProperty(name="Method", items=METHODS, default="auto", description="Rendering method")
    levels: bpy.props.EnumProperty(name="Levels of Detail", items=LEVELS, default="auto",
                                   description="Use of simplified meshes for blurred objects")
    shadows: bpy.props.BoolProperty(name="Shadows", default=True, description="Soft shadows of the lights and of the world")
    shutter_position: bpy.props.EnumProperty(name="Position", items=POSITIONS, default="centre",
                                             description="Position of the frame within the exposure")
    further: bpy.props.StringProperty(
        name="Further Options", default="",
        description="More options of 'defocus render', such as --cat-eye 0.5; 'defocus render --help-all' lists them")


def setting_words(settings, for_view=False):
    """Returns the command-line options of `defocus`, without options for default values, so that the preset can set
    these.

    If a file of another version stores an unknown choice, Blender returns an empty string, which means the default.
    """
    words = []
    preset = settings.preset if settings.preset != "none" else ""
    if preset:
        words += ["--preset", preset]
    if settings.samples:
        words += ["--samples", str(settings.samples)]
    elif not for_view and not preset and settings.quality:
        words += ["--quality", settings.quality]
    if settings.target_error > 0:
        words += ["--target-error", f"{settings.target_error:.7g}"]
    if settings.method not in ("", "auto"):
        words += ["--method", settings.method]
    if settings.levels not in ("", "auto"):
        words += ["--lod", settings.levels]
    words += ["--shadows", "on" if settings.shadows else "off"]
    try:
        return words + shlex.split(settings.further)
    except ValueError as error:
        raise Failure(f"The further options of Defocus cannot be read: {error}") from error


def register():
    bpy.utils.register_class(DefocusSettings)
    bpy.types.Scene.defocus = bpy.props.PointerProperty(type=DefocusSettings)


def unregister():
    del bpy.types.Scene.defocus
    bpy.utils.unregister_class(DefocusSettings)
