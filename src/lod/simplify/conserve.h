#pragma once
// Makes a fitted level keep what a wide blur shows of a surface.

#include "lod/simplify/level_fit.h"

namespace defocus {

// Corrects a fitted level until it keeps what a wide blur would show of level 0:
// - the area that it covers, where it is so coarse that it may lose any: what lies at its outlines moves (outline.h);
// - the mean colour over its area, alpha included: all colours are shifted alike.
// What fitLevel promises of places and of normals that are shared still holds; a triangle turns by at most 60° more.
void conserve(const FitSource& source, const LevelMesh& level, LevelFit& fit);

}  // namespace defocus
