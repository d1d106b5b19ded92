// Attributes of a surface that the vertex stage computes and the fragment stage reads. The stages exchange only the
// attributes that the material needs, as the varyings of surface_varyings.glsl.

struct Surface {
    vec4 color;
    // Min and max of the vertex colours of all triangles that share this vertex, per channel. Fragments read the values
    // of the triangle's last vertex and clamp `color` to them.
    vec4 minColor;
    vec4 maxColor;
    vec3 normal;          // in world axes, like all directions in this struct
    float agreement;      // coarse levels: length of the mean of the unit normals that `normal` represents
    vec3 toEye;           // vector from the surface to this sample's lens point (m)
    vec3 position;        // position relative to the camera (m)
    vec2 lens;            // lens point (u, k·v) of the sample; k: aspect ratio
    float bandShift;      // change in the CoC coefficients b₁ and b₂ (lens.glsl) due to the sample's wavelength
    vec4 uv;              // texture coordinates of both UV sets
    vec4 tangent;
    vec2 ownBlur;         // the surface's blur factor, and its added blur as a fraction of the image's width
    int facet;            // index of the triangle's last vertex, used as its id; set only with CHOOSES_BY_ALPHA
    float sampleNumber;   // index of the lens sample within the frame
    float layer;
    vec3 opening;         // pinhole clip position (x, y, w) when the shutter opens; set only with MOTION_SLOT
    vec3 closing;         // pinhole clip position (x, y, w) when the shutter closes; set only with MOTION_SLOT
};
