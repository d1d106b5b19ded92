#pragma once
// Texture coordinates of a level, fitted so that it shows the texture where level 0 does. Those at seams stay as they
// are, so that each chart keeps its rim. No triangle turns over in texture space, or becomes less than half or more
// than twice as large there.

#include "lod/simplify/level_fit.h"

namespace defocus {

// Fills uv0 and uv1 of `fit`, if the mesh has them.
void fitCoordinates(const FitSource& source, const LevelMesh& level, const Numbered<MeshVertexNumber, Anchor>& anchors,
                    LevelFit& fit);

}  // namespace defocus
