// The frame, the object and the material as uniform blocks, for C++ in frame_uniforms.cpp, surface_pass.cpp and
// gpu_scene.h.

layout(std140, binding = 0) uniform FrameBlock {
    vec4 projection;      // 1/tan(θx/2), 1/tan(θy/2), near plane (m), unused
    vec4 coc;             // a, b₁ of C; image width (px); b₂        (src/lens/circle_of_confusion.h)
    vec4 cocField;        // tilt t (2), κ, g
    vec4 cocLimits;       // R₁, R₂; 1/k²; px by which C may differ from its interpolation in a triangle
    vec4 cocOther;        // a₂ of C; a millimetre on the sensor as a share of the image's width, of blur that vertices have themselves
    vec4 window;          // where pixel (0, 0) of the layers lies in the image, and the image's size (px)
    mat4 worldFromView;   // rotation
    vec4 lightPositions[MAX_LIGHTS];  // from the camera along the world's axes, m; w: range, 0 is unlimited
} frame;

layout(std140, binding = 1) uniform ObjectBlock {
    mat4 viewFromObject;
    mat4 normalMatrix;    // inverse transpose, of the upper 3×3
    vec4 values;          // fractional level λ, share of its boundary sample that draws the coarser level, its number,
                          // factor on its blur
    ivec4 posing;         // texels a pose, joints, morph targets that count, texels an attribute of a morph target
    vec4 levels;          // x: m by which what is drawn lies off full detail
} object;

layout(std140, binding = 2) uniform MaterialBlock {
    vec4 baseColor;
    vec4 emissiveCutoff;  // rgb: emissive radiance; w: alpha cutoff
    vec4 surface;         // metallic, roughness, normal scale, occlusion strength
    vec4 reflectance;     // of what isn't metal: rgb at normal incidence, before specularFactor (w)
    vec4 transmission;    // share, thickness (object units), 1/ior, by how much roughness spreads what lies behind
    vec4 absorption;      // rgb: per metre
    vec4 coat;            // share, roughness, normal scale
    vec4 sheen;           // rgb; w: roughness
    vec4 uvRows[28];      // two rows of a 2×3 matrix a texture; w of the first row: the UV set
} material;
