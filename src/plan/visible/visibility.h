#pragma once
// Finds what no lens sample of a frame can show: boxes outside the frustum that the lens widens, and clusters of
// triangles that lie outside or face away for every point (u, v) of the lens and every time t of the exposure.
//
// One triangle. The determinant det of its three clip positions (x, y, w) is positive if its front shows
// (counter-clockwise). After the shear p + C·(u, k·v, 0), the determinant is
//   det + u·Nx + k·v·Ny,   where Nx, Ny are the first two components of Σ Cᵢ·pⱼ × pₖ   (i, j, k cyclic).
// This is linear in (u, v), because a determinant with two parallel columns is zero. So the back shows over the whole
// unit disk if det + √(Nx² + (k·Ny)²) ≤ 0 (Munkberg, Toth and Akenine-Möller 2012, Appendix A, Eq. 5, with the opposite
// sign of det).
//
// Where C is one linear function α + g·(x, y, w), Σ Cᵢ·pⱼ × pₖ = α·n + det·g with n = Σ pⱼ × pₖ. The g of a thin lens
// points along w, so the condition becomes det + |α|·√(nx² + (k·ny)²) ≤ 0 (Eq. 6). In words: every point of the lens, a
// disk of radius |α|·tan(θx/2), lies behind the plane of the triangle. A tilted focus plane widens this disk by
// 1/(1 − |(gx, k·gy)|).
//
// A cluster faces away if the whole disk lies behind the planes of all its triangles at every t. The test uses the cone
// of the cluster's normals in object space, where mirrored objects need no exception. If C consists of several linear
// pieces inside the cluster's box, or is curved there, or if vertices have a blur of their own or move against each
// other (skins, morph targets), each triangle of the cluster is tested by its corners, posed on the CPU: by Eq. 5, and
// while they move by Eq. 7 and 8 (lens_facing.h). That holds for triangles that are drawn as they are. An object whose
// triangles are divided along C keeps those clusters, and so does a large mesh, whose test would take too long.
//
// Rounding. A renderer rounds positions, to 1/256 px at best, and this may turn a narrow triangle over. So the lens
// must lie behind the planes by a margin that no rounding bridges. Then nothing that is left out would have drawn a
// pixel. (What is kept may still differ: Mesa's llvmpipe decides between front and back of a triangle narrower than
// 1/256 px according to whether another triangle of the same batch is clipped. With other runs of indices, one pixel of
// a sample may differ where an object crosses the border of the image.)

#include "plan/frame_plan.h"

namespace defocus::engine {

// Returns the part of `viewBox` in front of the near plane as the lens sees it; `own` is what its surfaces make of the
// blur.
CocBox cocBoxOf(const Bounds& viewBox, const OwnBlur& own, const FramePlan& plan);

// Returns whether no lens sample sees any part of the box, whose surfaces make `own` of the blur. No CoC in the box is
// larger than `largest` px.
bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, const OwnBlur& own, double largest);
// The same of a part of the image.
bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, const OwnBlur& own, double largest,
                           const PixelRectangle& area);

// Fills object.visible and lowers the triangle counts of its draws.
void leaveOutClusters(ObjectPlan& object, const World& world, const FramePlan& plan);

}  // namespace defocus::engine
