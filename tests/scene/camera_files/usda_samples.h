#pragma once
// Contains USD text files with cameras, for tests and as seeds of the fuzzer.

namespace defocus::engine::usda_samples {

// USD text of a camera with lengths in centimetres and y up, as in USD's documentation: 50 mm on 36 × 24 mm.
inline constexpr const char* plain = R"(#usda 1.0
(
    doc = """A "plain" camera."""
    metersPerUnit = 0.01
    upAxis = "Y"
)

def Xform "World"
{
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]

    def Camera "cam" (
        prepend apiSchemas = ["ShadowAPI"]
    )
    {
        float2 clippingRange = (10, 100000)
        float focalLength = 50
        float focusDistance = 250
        float fStop = 1.4
        float horizontalAperture = 36
        float verticalAperture = 24
        token projection = "perspective"
        double3 xformOp:translate = (0, 20, 300)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
)";

// USD text of a camera with lengths in metres, z up, time samples of its transform and focus distance, and a shutter.
inline constexpr const char* animated = R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
    timeCodesPerSecond = 24
    startTimeCode = 0
    endTimeCode = 48
)
def Camera "cam"
{
    float focalLength = 0.5
    float horizontalAperture = 0.36
    float verticalAperture = 0.2025
    float fStop.timeSamples = { 0: 2, 48: 4, }
    float focusDistance.timeSamples = {
        0: 1,
        24: 3,
    }
    double shutter:open = -0.25
    double shutter:close = 0.25
    float3 xformOp:rotateXYZ = (90, 0, 30)
    double3 xformOp:translate.timeSamples = { 0: (0, 0, 1), 48: (2, 4, 1) }
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
)";

// USD text with content that a reader must skip: comments, dictionaries, relationships, variants, list edits, assets
// and other prims.
inline constexpr const char* everything = R"(#usda 1.0
( # a comment
    customLayerData = { string a = "b"; int[] c = [1, 2]; dictionary d = { double e = 1e-3 } }
    subLayers = [@sky.usda@ (offset = 10; scale = 2), @@@odd@name.usda@@@]
    timeCodesPerSecond = 25
)
over "Light" { float intensity = 3 }
class "_class_Lens" { }
def "Stage" (
    active = true
    prepend references = [@set.usda@</Set> (offset = 1), </Other>]
    variants = { string look = "red" }
    add variantSets = "look"
) {
    reorder nameChildren = ["a", "b"]
    variantSet "look" = { "red" ( doc = 'x}' ) { def Camera "hidden" { } } "blue" { } }
    rel material:binding = </Materials/Red> ( bindMaterialAs = "weak" )
    prepend rel proxyPrim = [</a>, </b>]
    def Mesh "Mesh" {
        point3f[] points = [(0, 0, 0), (1, 0, 0), (-1e3, .5, inf)]
        int[] faceVertexCounts = []
        float2[] primvars:st ( interpolation = "vertex" )
        asset map = @tex.png@ ( doc = "a ) b" )
        color3f color.connect = </Shader.outputs:rgb>
        custom uniform bool flag = true
        timecode t = None
    }
    def Camera "cam" {
        custom double defocus:bladeCount = 7
        float horizontalApertureOffset = 1
        float exposure = None
        matrix4d xformOp:transform:first = ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (5, 6, 7, 1) )
        quatf xformOp:orient.timeSamples = { 0: (1, 0, 0, 0), 25: (0, 0, 1, 0) }
        float xformOp:rotateY:pivot = 90
        float3 xformOp:scale = (2, 2, 2)
        uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:transform:first", "xformOp:orient", "xformOp:rotateY:pivot", "xformOp:scale", "!invert!xformOp:rotateY:pivot"]
    }
}
)";

}  // namespace defocus::engine::usda_samples
