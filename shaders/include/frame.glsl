// Declares the uniforms of the frame, the object and the material. The C++ counterparts are GpuFrame in
// frame_uniforms.cpp, GpuObject in surface_draws.h and GpuMaterial in material_blocks.h, all in src/render/gpu_scene/.

layout(std140, binding = 0) uniform FrameBlock {
    vec4 projection;      // 1/tan(θx/2), 1/tan(θy/2) for angles of view θ; near plane (m); unused
    // Coefficients of the circle of confusion (CoC) as a fraction of the image's width. It is a/depth + b₁·q in front
    // of the focus plane and a₂/depth + b₂·q behind it, where q is 1 unless the focus surface is tilted or curved
    // (src/lens/circle_of_confusion.h). x: a; y: b₁; z: image width (px); w: b₂. For a₂, see cocOther.
    vec4 coc;
    vec4 cocField;        // xy: tilt t of the focus plane; z: field curvature κ; w: radial blur gain g
    // xy: max CoC in front of and behind the focus plane, as fractions of the image's width; z: 1/k² with the image's
    // aspect ratio k; w: max error (px) of interpolating the CoC linearly in a triangle.
    vec4 cocLimits;
    // x: coefficient a₂ of the CoC behind the focus plane (see `coc`); y: fraction of the image's width per mm on the
    // sensor, for added vertex blur; zw: coefficients A of astigmatism and B of coma (src/lens/aberrations.h).
    vec4 cocOther;
    vec4 window;          // xy: position of the layers' pixel (0, 0) within the image; zw: image size (px)
    mat4 worldFromView;   // rotation from view space to world space
    vec4 lightPositions[maxLights];  // xyz: relative to the camera, in m, world axes; w: range (m), 0: unlimited
} frame;

// Plain uniforms instead of a block, because most draws change the object. llvmpipe copies 33 KB of state for each draw
// that changes a uniform block.
struct Object {
    mat4 viewFromObject;
    mat3 normalMatrix;    // inverse transpose of the upper 3×3 of viewFromObject
    // x: fractional level of detail λ; y: fraction of the pixels that draw the coarser level in the boundary sample
    // (the lens sample that mixes two levels); z: object index; w: blur factor.
    vec4 values;
    // x: number of texels per pose; y: number of joints; z: number of active morph targets; w: number of texels per
    // attribute of a morph target.
    ivec4 posing;
    // x: max deviation of the drawn levels from full detail (m); y: max number of parts into which tessellation divides
    // an edge (refined.tesc).
    vec2 levels;
};
layout(location = 96) uniform Object object;   // uniform locations 96 to 100

layout(std140, binding = 2) uniform MaterialBlock {
    vec4 baseColor;
    vec4 emissiveCutoff;  // rgb: emissive radiance; w: alpha cutoff
    vec4 surface;         // metallic, roughness, normal scale, occlusion strength
    vec4 reflectance;     // rgb: dielectric reflectance at normal incidence, without specularFactor; w: specularFactor
    vec4 transmission;    // fraction, thickness (object units), 1/ior, factor on roughness for the background's blur
    vec4 absorption;      // rgb: absorption coefficient (1/m); w: dispersion, 20 / Abbe number
    vec4 coat;            // coated fraction, roughness, normal scale
    vec4 sheen;           // rgb: colour; w: roughness
    vec4 anisotropy;      // strength; cosine and sine of the rotation
    vec4 film;            // iridescence: factor, ior, min and max thickness (nm)
    vec4 through;         // diffuse transmission: rgb colour; w: factor
#ifdef UV_TRANSFORMS
    vec4 uvRows[38];      // per texture slot: two rows of a 2×3 matrix; w of the first row: index of the UV set
#endif
} material;
