// Interpolates surface attributes between a triangle's corners, at the point that a ray hits. Stores them in the global
// variable `surface` (surface.glsl).

vec3 hitWeights(vec3 edges) { return edges / (edges.x + edges.y + edges.z); }

// Reads the surface of triangle `triangle` where the ray through lens point `lens` to image position `place` hits it.
// `time`: time within the current part of the exposure, [0, 1].
void readHit(uint triangle, float time, vec2 lens, vec2 place) {
    uvec3 vertices = triangles[triangle].xyz;
    vec4 a = clipAt(vertices.x, time);
    vec4 b = clipAt(vertices.y, time);
    vec4 c = clipAt(vertices.z, time);
    vec3 edges = edgeFunctions(a, b, c, lens, place);
    vec2 pixel = 2.0 / vec2(imageSize);
    vec3 here = hitWeights(edges);
    vec3 right = hitWeights(edgeFunctions(a, b, c, lens, place + vec2(pixel.x, 0.0)));
    vec3 up = hitWeights(edgeFunctions(a, b, c, lens, place + vec2(0.0, pixel.y)));
    Attributes p = attributes[vertices.x];
    Attributes q = attributes[vertices.y];
    Attributes r = attributes[vertices.z];
    surface.color = material.baseColor * (here.x * p.color + here.y * q.color + here.z * r.color);
    surface.uv = here.x * p.uv + here.y * q.uv + here.z * r.uv;
    surface.uvRight = mix(surface.uv, right.x * p.uv + right.y * q.uv + right.z * r.uv, wave.footprint);
    surface.uvUp = mix(surface.uv, up.x * p.uv + up.y * q.uv + up.z * r.uv, wave.footprint);
    surface.showsFront = edges.x + edges.y + edges.z > 0.0;
    vec4 normal = here.x * p.normal + here.y * q.normal + here.z * r.normal;
    surface.normal = normal.xyz;
    surface.agreement = normal.w;
    surface.normalRight = right.x * p.normal.xyz + right.y * q.normal.xyz + right.z * r.normal.xyz;
    surface.normalUp = up.x * p.normal.xyz + up.y * q.normal.xyz + up.z * r.normal.xyz;
    surface.tangent = here.x * p.tangent + here.y * q.tangent + here.z * r.tangent;
    surface.position = here.x * p.position.xyz + here.y * q.position.xyz + here.z * r.position.xyz;
}
