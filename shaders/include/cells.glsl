// Lens cells (src/plan/lens_cells/lens_cells.h): sums of what pixels show by how much its image is blurred, one layer a class and from the least
// blurred to the most. The first CELLS_IN_FRONT layers are of what lies in front of the focus: layer k holds what isn't blurred as much
// as class k. The others are of what lies behind it: theirs hold class k and what is blurred more. So a sum holds the samples that
// are open to something, which show nothing in front of it, and its difference from the next one is a class. RGB is radiance, and
// alpha counts samples.

const int cellClasses = CELLS_IN_FRONT + CELLS_BEHIND;
const int drawnClasses = min(cellClasses, 7);   // the first, which a target holds beside the sum of all samples

// Squares of so many px a side know which classes they hold anything of, bit k of class k: most hold few.
const int cellTile = 8;
const int besideSpread = 16;   // first bit of what spread_classes.frag says of the tiles beside

// px², of class k: cellClassVariance() of src/plan/lens_cells/lens_cells.h. Class −1 isn't blurred.
float classVariance(int k) { return k < 0 ? 0.0 : exp2(float(2 * k)) / 3.0 + 1.0 / 6.0; }

// How much of what a pixel shows, blurred by `variance`, belongs to class k or to one that is blurred more.
float reachOfClass(float variance, int k) {
    return clamp((variance - classVariance(k - 1)) * (1.0 / (classVariance(k) - classVariance(k - 1))), 0.0, 1.0);
}

// Where the means of class k begin, in texels: those of class 0 on the left, the others above each other beside them. (A texture of its
// own for each, or a mipmap, is slower: software drivers look up a texture's size anew for each pixel where the level isn't known.)
ivec2 meansOrigin(ivec2 firstSquares, int k) {
    return k == 0 ? ivec2(0) : ivec2(firstSquares.x, firstSquares.y - (firstSquares.y >> (k - 1)));
}
