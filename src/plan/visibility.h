#pragma once
// What no lens sample of a frame can show: boxes outside the frustum widened by the lens, and clusters of triangles
// that lie outside or face away for every point (u, v) of the lens and every time t of the exposure.
//
// The determinant of a triangle's three clip positions (x, y, w) is positive where its front shows (counter-clockwise).
// The shear p + C·(u, k·v, 0) makes it
//   det + u·Nx + k·v·Ny,   Nx, Ny the first two components of Σ Cᵢ·pⱼ × pₖ   (i, j, k cyclic),
// linear in (u, v), as two parallel columns have no volume: over the unit disk the back shows throughout where
// det + √(Nx² + (k·Ny)²) ≤ 0 (Munkberg, Toth and Akenine-Möller 2012, Appendix A, Eq. 5, with the opposite sign of
// det). Where C is one linear function α + g·(x, y, w), Σ Cᵢ·pⱼ × pₖ = α·n + det·g with n = Σ pⱼ × pₖ. For the thin
// lens, whose g leads along w, that is det + |α|·√(nx² + (k·ny)²) ≤ 0 (Eq. 6): each point of the lens, a disk of radius
// |α|·tan(θx/2), lies behind the triangle's plane. A tilted plane's g widens the disk by 1/(1 − |(gx, k·gy)|). So a
// cluster faces away if all of that disk lies behind all of its planes, whatever the t; this is decided in object
// space, where mirrored objects need no exception, from the cone of the cluster's normals. What C makes of several
// linear pieces, or curved, inside the cluster's box is never taken to face away.
//
// A renderer's positions are rounded (to 1/256 px at best), by which a narrow triangle may turn over: planes must lie
// in front of the lens by so much that no triangle of the cluster does. So nothing that is left out would have drawn a
// pixel. (What stays may: Mesa's llvmpipe takes a triangle narrower than 1/256 px for its front or its back according
// to whether another one among those it was handed together is clipped. With other runs of indices, one pixel of a
// sample may differ where an object crosses the image's border.)

#include "plan/frame_plan.h"

namespace defocus {

// The box as the lens sees it, in front of the near plane, of surfaces whose blur is scaled so.
CocBox cocBoxOf(const Bounds& viewBox, double scaleLeast, double scaleMost, const FramePlan& plan);

// No lens sample sees any of the box; `largest`: CoC of what is in it, at most, px.
bool outsideWidenedFrustum(const Bounds& viewBox, const FramePlan& plan, double largest);

// Fills object.visible and lowers the triangle counts of its draws, for objects whose vertices don't move against each
// other.
void leaveOutClusters(ObjectPlan& object, const World& world, const FramePlan& plan);

}  // namespace defocus
