// Lens cells (src/plan/lens_cells/lens_cells.h): sums of pixels by the blur of their images. Each class has one layer,
// ordered from the least blurred to the most.
//
// The first cellsInFront layers are in front of the focus; layer k sums all samples blurred less than class k. The
// other layers are behind the focus; their layer k sums class k and everything blurred more. A layer therefore counts
// the samples that nearer classes don't hide. The difference of adjacent layers is a class. RGB is radiance, and alpha
// counts samples.

const int cellClasses = cellsInFront + cellsBehind;
// Number of layers that a render target holds, beside the sum of all samples.
const int drawnClasses = min(cellClasses, 7);

// Side in px of the tiles that record which classes they contain, as bit k for class k. Most tiles contain few classes.
const int cellTile = 8;
const int besideSpread = 16;   // first bit of the neighbours' classes in spread_classes.frag

// Returns the variance of class k in px², like cellClassVariance() in src/plan/lens_cells/lens_cells.h. Class −1 is
// unblurred.
float classVariance(int k) { return k < 0 ? 0.0 : exp2(float(2 * k)) / 3.0 + 1.0 / 6.0; }

// Returns the share of a pixel with blur variance `variance` that belongs to class k or a more blurred class.
float reachOfClass(float variance, int k) {
    return clamp((variance - classVariance(k - 1)) * (1.0 / (classVariance(k) - classVariance(k - 1))), 0.0, 1.0);
}

// Returns the texel where the means of class k begin. Class 0 is on the left; the others are stacked beside it.
// Separate textures or mip levels are slower, because software drivers query their size for each pixel.
ivec2 meansOrigin(ivec2 firstSquares, int k) {
    return k == 0 ? ivec2(0) : ivec2(firstSquares.x, firstSquares.y - (firstSquares.y >> (k - 1)));
}
