// Defines the blur classes of lens cells (src/plan/lens_cells/lens_cells.h). Each lens sample represents a part of the
// lens, its cell, and the sample's image is blurred as this part of the lens would blur it. The pixel values of these
// images are sorted by this blur into classes of increasing blur, separately in front of and behind the focus plane.
// The array texture of sums has one layer per class.
//
// Each layer sums all pixel values beyond some depth, because compositing needs the pixel values that nearer classes do
// not hide. Layer k < cellsInFront sums all pixel values except those in front of the focus plane that belong to class
// k or to a class of larger blur. Layer cellsInFront + k sums the pixel values behind the focus plane that belong to
// class k or to a class of larger blur. A class is the difference of two adjacent layers. RGB is radiance, and alpha
// counts samples.

const int cellClasses = cellsInFront + cellsBehind;
// Number of blur classes whose sums are colour attachments. OpenGL guarantees 8 attachments; the sum of all samples
// takes one. The sums of further classes are written with imageStore.
const int drawnClasses = min(cellClasses, 7);

// Side in px of the tiles. For each tile, a bit mask records which blur classes (groups of pixel values with similar
// blur) occur in it, so that passes skip the other classes.
const int cellTile = 8;
// spread_classes.frag packs two bit masks of blur classes into an integer: the classes that a tile reads, and the
// classes that must be written in it. This is the index of the first bit of the second mask.
const int besideSpread = 16;

// Returns the blur variance of blur class k in px², like cellClassVariance() in src/plan/lens_cells/lens_cells.h. Class
// −1 is unblurred.
float classVariance(int k) { return k < 0 ? 0.0 : exp2(float(2 * k)) / 3.0 + 1.0 / 6.0; }

// Returns the total weight, 0 … 1, with which a pixel value of blur variance `variance` is counted in blur class k and
// all classes of larger blur. It increases linearly from 0 at the variance of class k − 1 to 1 at the variance of class
// k.
float reachOfClass(float variance, int k) {
    return clamp((variance - classVariance(k - 1)) * (1.0 / (classVariance(k) - classVariance(k - 1))), 0.0, 1.0);
}

// All blur classes share one texture for their means over squares of pixels. Returns the lower left texel of class k:
// class 0 is on the left, and the other classes are on its right, one above another. `firstSquares`: number of columns
// and rows of squares of class 0. One texture or mip level for each class would be slower, because software drivers
// query the size of each texture for each pixel.
ivec2 meansOrigin(ivec2 firstSquares, int k) {
    return k == 0 ? ivec2(0) : ivec2(firstSquares.x, firstSquares.y - (firstSquares.y >> (k - 1)));
}
