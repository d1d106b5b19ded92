// Lens cells (src/plan/lens_cells.h): the sums of what pixels show by how much its image is blurred, one layer a class. The first
// CELLS_IN_FRONT layers hold what lies in front of the focus, the others what lies behind it, from the least blurred to the most.
// RGB is radiance, and alpha counts samples.

const int cellClasses = CELLS_IN_FRONT + CELLS_BEHIND;

// px², of class k: cellClassVariance() of src/plan/lens_cells.h. Class −1 isn't blurred.
float classVariance(int k) { return k < 0 ? 0.0 : exp2(float(2 * k + 2)) / 3.0 + 1.0 / 6.0; }

// How far a variance lies from that of class k − 1 to that of class k, 0 to 1.
float reachOfClass(float variance, int k) {
    return clamp((variance - classVariance(k - 1)) / (classVariance(k) - classVariance(k - 1)), 0.0, 1.0);
}

// How much of what a pixel shows, blurred by `variance`, belongs to class k of `classes`.
float shareOfClass(float variance, int k, int classes) {
    return reachOfClass(variance, k) - (k + 1 < classes ? reachOfClass(variance, k + 1) : 0.0);
}
