// Evaluates the specular part of KHR_materials_anisotropy: GGX with different widths in two directions along the
// surface (Burley 2012, Physically-Based Shading at Disney; masking: Heitz 2014, Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs).

// Returns π·(n·l)·D·V, with the normal n, the distribution of normals D and the visibility V, for light from the unit
// direction l = `toLight`. `spread`: 2σ², where σ² is the variance of the normals' slopes over the sample's footprint.
// `spread` is added to the squared GGX widths of the distribution D, but not to those of the masking, as in lobeOf().
float anisotropicReflection(SurfacePoint point, float nl, float nv, float spread, vec3 toLight) {
    if (nl <= 0.0 || nv <= 0.0) return 0.0;
    vec2 widths2 = point.widths * point.widths;
    vec2 wide2 = clamp(widths2 + spread, 1e-6, 1.0);
    mat2x3 axes = mat2x3(point.stretch, point.across);
    vec3 middle = normalize(toLight + point.toEye);
    vec2 h = middle * axes;
    float nh = dot(point.normal, middle);
    float slope = dot(h * h, 1.0 / wide2) + nh * nh;
    vec2 v = point.toEye * axes;
    vec2 l = toLight * axes;
    float masking = nl * sqrt(dot(v * v, widths2) + nv * nv) + nv * sqrt(dot(l * l, widths2) + nl * nl);
    return nl * 0.5 / (max(masking, 1e-4) * sqrt(wide2.x * wide2.y) * slope * slope);
}

// Returns the perceptual roughness of isotropic GGX with nearly the same directional albedo. Where n·v ≥ 0.5, the
// albedo differs by at most 0.075.
float isotropicRoughness(SurfacePoint point) { return sqrt(sqrt(0.5 * dot(point.widths, point.widths))); }

// Returns the normal for reflections of the environment. The normal is bent along the direction in which highlights are
// stretched, as in Khronos's glTF Sample Viewer (McAuley 2015, Rendering the World of Far Cry 4).
vec3 stretchedNormal(SurfacePoint point, float strength) {
    vec3 inPlane = cross(cross(point.across, point.toEye), point.across);
    float kept = 1.0 - strength * (1.0 - point.roughness);
    return normalize(mix(inPlane, point.normal, kept * kept * kept * kept));
}
