#pragma once
// Draws points and lines as triangles that face the camera. Source: glTF 2.0 specification, 3.7.2.1 (mesh primitives):
// a width of one pixel, and no lighting without normals.

#include "scene/pose.h"

namespace defocus::engine {

// Camera for which points and lines are drawn one pixel wide.
struct StrokeView {
    glm::dmat4 worldFromCamera{1.0};
    double pixelTangent = 0;  // width of a pixel at depth 1
    double nearPlane = 0;     // depth in m; points nearer than this are as wide as points at this depth
};

[[nodiscard]] bool hasStrokes(const Scene& scene);

// Returns the scene with the points and lines of its meshes as triangles. They are one pixel wide only for `view` and
// `pose`: the width is part of the mesh, so it changes with other poses and distances. A mesh with points or lines is
// copied for each of its nodes; all instances of a node get the width of the first instance. Points and lines do not
// follow skins and morph targets.
Scene withStrokes(const Scene& scene, const Pose& pose, const StrokeView& view);

}  // namespace defocus::engine
