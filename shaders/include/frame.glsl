// Uniform blocks of the frame, the object and the material. The C++ counterparts are in frame_uniforms.cpp,
// surface_pass.cpp and gpu_scene.h.

layout(std140, binding = 0) uniform FrameBlock {
    vec4 projection;      // 1/tan(θx/2), 1/tan(θy/2), near plane (m), unused
    vec4 coc;             // a, b₁ of C; image width (px); b₂        (src/lens/circle_of_confusion.h)
    vec4 cocField;        // tilt t (2), κ, g
    vec4 cocLimits;       // R₁, R₂; 1/k²; px, max interpolation error of C in a triangle
    // a₂ of C; fraction of the image's width per mm on the sensor, for added vertex blur.
    vec4 cocOther;
    vec4 window;          // position of the layers' pixel (0, 0) in the image; image size (px)
    mat4 worldFromView;   // rotation
    vec4 lightPositions[maxLights];  // m from the camera along the world's axes; w: range, 0: unlimited
} frame;

layout(std140, binding = 1) uniform ObjectBlock {
    mat4 viewFromObject;
    mat4 normalMatrix;    // inverse transpose of the upper 3×3
    // Fractional level λ; share of the boundary sample that draws the coarser level; object number; blur factor.
    vec4 values;
    ivec4 posing;         // texels per pose, joints, active morph targets, texels per attribute of a morph target
    vec4 levels;          // x: m, max deviation of the drawn level from full detail
} object;

layout(std140, binding = 2) uniform MaterialBlock {
    vec4 baseColor;
    vec4 emissiveCutoff;  // rgb: emissive radiance; w: alpha cutoff
    vec4 surface;         // metallic, roughness, normal scale, occlusion strength
    vec4 reflectance;     // dielectric part: rgb at normal incidence; w: specularFactor, not included in rgb
    vec4 transmission;    // share, thickness (object units), 1/ior, blur of the background per roughness
    vec4 absorption;      // rgb: per metre
    vec4 coat;            // share, roughness, normal scale
    vec4 sheen;           // rgb; w: roughness
    vec4 uvRows[28];      // two rows of a 2×3 matrix per texture; w of the first row: the UV set
} material;
