#pragma once
// Culls geometry that no lens sample of a frame sees: boxes outside the frustum, which the lens widens, and clusters of
// triangles. A cluster is culled if it lies outside or faces away for every lens point (u, v) and every time t of the
// exposure.
//
// One triangle. The determinant det of its three clip positions (x, y, w) is positive if its front face is visible
// (counter-clockwise). A lens point (u, v) shears the positions to p + C·(u, k·v, 0), where C is the clip-space blur
// (circle_of_confusion.h) and k the image's aspect ratio. The determinant is then
//   det + u·Nx + k·v·Ny,   where Nx, Ny are the first two components of Σ Cᵢ·pⱼ × pₖ   (i, j, k cyclic).
// This is linear in (u, v), because a determinant with two parallel columns is zero. So the back face is visible from
// the whole unit disk if det + √(Nx² + (k·Ny)²) ≤ 0. Source: Munkberg, Toth and Akenine-Möller 2012, Appendix A, Eq. 5,
// with the opposite sign of det.
//
// Where C is one linear function α + g·(x, y, w), Σ Cᵢ·pⱼ × pₖ = α·n + det·g with n = Σ pⱼ × pₖ. The g of a thin lens
// points along w, so the condition becomes det + |α|·√(nx² + (k·ny)²) ≤ 0 (Eq. 6). In words: every point of the lens
// lies behind the plane of the triangle. The lens is a disk of radius |α|·tan(θx/2), with the horizontal field of view
// θx. A tilted focus plane widens this disk by the factor 1/(1 − |(gx, k·gy)|).
//
// Clusters. A cluster faces away if the whole disk lies behind the planes of all its triangles at every t. The test
// uses the cone of the cluster's normals in object space, where mirrored objects need no special case. The cone test
// needs a C that is one linear function inside the cluster's box, and the same blur modifiers at all vertices. Other
// clusters are culled only outside the frustum. Skins and morph targets move vertices out of the stored bounds, so
// deforming objects are culled only as a whole.
//
// Rounding. A renderer rounds positions, to 1/256 px at best, and this may flip a narrow triangle. The lens must
// therefore lie behind the planes by a margin larger than any rounding. Then no culled triangle would have drawn a
// pixel.
//
// The remaining triangles may still rasterize differently. For a triangle narrower than 1/256 px, Mesa's llvmpipe
// decides front or back depending on whether another triangle of the same batch is clipped. Culling changes the index
// ranges, and thus the batches. Where an object crosses the image border, one pixel of a sample may therefore differ
// from the image without culling.

#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns what bounds the CoC in `viewBox`, a box in view space that must lie beyond the near plane: its ranges of
// depth and image position, and the bounds `own` of its surfaces' blur modifiers (factor and added blur).
CocBox cocBoxOf(const Bounds& viewBox, const OwnBlur& own, const FramePlan& plan);

// Returns true if no lens sample sees any part of the box. `own` bounds the blur modifiers (factor and added blur) of
// the surfaces in the box. `largest` is an upper bound of the surfaces' CoC in px.
bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, const OwnBlur& own, double largest);
// Returns true if no lens sample sees any part of the box inside the rectangle `area` of the image.
bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, const OwnBlur& own, double largest,
                           const PixelRectangle& area);

// Culls those clusters of a rigid object that are visible in no lens sample. Fills object.visible and reduces the
// triangle counts of object.coarse and object.fine.
void leaveOutClusters(ObjectPlan& object, const World& world, const FramePlan& plan);

}  // namespace defocus::engine
