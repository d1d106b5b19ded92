// Attributes of a surface as the vertex stage computes them and the fragment stage reads them. The stages exchange only
// those that the material needs, as the varyings of surface_varyings.glsl.

struct Surface {
    vec4 color;
    vec4 minColor;        // min over the adjacent corners
    vec4 maxColor;
    vec3 normal;          // in world axes, like all directions here
    float agreement;      // coarse levels: length of the mean of the represented normals, ≤ 1
    vec3 toEye;           // towards this sample's lens point
    vec3 position;        // relative to the camera
    vec2 lens;            // lens point (u, k·v) of the sample
    float bandShift;      // as in lens.glsl
    vec4 uv;              // both UV sets
    vec4 tangent;
    vec2 ownBlur;         // the surface's blur factor, and its added blur as a fraction of the image's width
    float ditherOffset;
    float layer;
};
