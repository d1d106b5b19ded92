"""Fits the complex kernels of src/render/circular/circular_kernel.h to a disk and compares them with circular_kernel.cpp.

    scripts/figures circular-fit

Variable projection (Golub and Pereyra 1973): for given decays and frequencies, the weights solve a linear least-squares
problem with the constraint that kernel and disk have equal integrals. The Levenberg-Marquardt method (Levenberg 1944,
Marquardt 1963) fits the 2n decays and frequencies. It starts from evenly spread frequencies, and from the best kernel
with one component fewer. The minimum is flat, so rounding changes the last printed digits.

Also prints the disk radius that suits each of Niemitalo's kernels best. Needs numpy; takes ten seconds.
"""

import re

import numpy

from figures.command import ROOT, parser_of

CORNER_GUARD = 0.2  # weight of the penalty on the kernel in the corners of its square (circular_kernel.h)
ROUGH, FINE = 1e-4, 1e-10  # min relative gain of a step that counts as progress: in rough fits, and in the final fit
DIFFERENCE = 1e-6  # step of numerical derivatives
MAX_DAMPING = 1e12
X, WEIGHTS = numpy.polynomial.legendre.leggauss(64)


def nodes_of(extent, edge):
    """Returns u = r² and area of quadrature nodes over the square, for functions of u that may jump at r = edge."""
    square, disk = extent**2, edge**2
    middle, corner = min(disk, square), min(max(disk - square, 0) ** 0.5, extent)
    circles, arcs = ([((begin + end + (end - begin) * X) / 2, (end - begin) / 2 * WEIGHTS) for begin, end in pieces if begin < end]
                     for pieces in (((0, middle), (middle, square)), ((0, corner), (corner, extent))))
    # Integrate by u = r² up to extent², and beyond by t with u = extent² + t², because the area is smooth in t. Beyond,
    # each side of the square cuts an arc of the angle 2·arctan(t / extent) off the circle of radius √u.
    return (numpy.concatenate([u for u, _ in circles] + [square + t * t for t, _ in arcs]),
            numpy.concatenate([numpy.pi * du for _, du in circles]
                              + [(numpy.pi - 4 * numpy.arctan(t / extent)) * 2 * t * dt for t, dt in arcs]))


def profile(kernel, u):
    """Returns the values of a kernel at u = r². kernel: rows of decay, frequency, cosine, sine."""
    decay, frequency, cosine, sine = numpy.transpose(kernel)
    factors = numpy.exp(numpy.outer(u, -decay + 1j * frequency))
    return factors.real @ cosine + factors.imag @ sine


def error_of(kernel, extent, radius):
    """Returns the RMS difference of kernel and disk, relative to the disk. Scales the kernel to the disk's integral."""
    u, area = nodes_of(extent, radius)
    values, disk = profile(kernel, u), u < radius**2
    total = numpy.pi * radius**2
    squares = area @ (total / (area @ values) * values - disk) ** 2
    return ((squares + max(0, total - area @ disk)) / total) ** 0.5


def fitted(count):
    """Yields the kernels with 1 to count components, of extent 1 and disk radius 1."""
    u, area = nodes_of(1, 1)
    rings = numpy.where(u > 1, numpy.pi / (numpy.pi - 4 * numpy.arctan(numpy.sqrt(numpy.maximum(u - 1, 0)))), 0)
    root = numpy.sqrt(area * (1 + CORNER_GUARD * rings))
    target = root * (u < 1)

    def weights_of(shape):
        """Returns the best weights (cosines, then sines) and the residual. shape: alternating decays, frequencies."""
        factors = numpy.exp(numpy.outer(u, -shape[::2] + 1j * shape[1::2]))
        basis = numpy.hstack([factors.real, factors.imag])
        q, r = numpy.linalg.qr(root[:, None] * basis)
        along = numpy.linalg.solve(r.T, area @ basis)
        best = q.T @ target
        best += (numpy.pi - along @ best) / (along @ along) * along
        return numpy.linalg.solve(r, best), q @ best - target

    def fit(shape, tolerance):
        """Returns the squared error and the shape once three steps in a row gain less than the fraction `tolerance`."""
        residual, damping, idle = weights_of(shape)[1], 1e-3, 0
        while idle < 3 and damping < MAX_DAMPING:
            before = residual @ residual
            slopes = numpy.array([weights_of(shape + step)[1] - residual for step in DIFFERENCE * numpy.eye(len(shape))]) / DIFFERENCE
            normal = slopes @ slopes.T
            while damping < MAX_DAMPING and residual @ residual == before:
                moved = shape - numpy.linalg.solve(normal + damping * numpy.diag(numpy.diag(normal)), slopes @ residual)
                if (after := weights_of(moved)[1]) @ after < before:
                    shape, residual, damping = moved, after, damping / 64
                damping *= 4
            idle = 0 if before - residual @ residual > tolerance * before else idle + 1
        return residual @ residual, shape

    shape = numpy.array([])
    for n in range(1, count + 1):
        starts = [numpy.ravel([(decay, spacing * (k + 0.5)) for k in range(n)]) for spacing in (3, 4.5, 6, 7.5) for decay in (0.5, 2)]
        starts += [numpy.append(shape, (0.5, frequency)) for frequency in (1, 6 * n)]
        shape = fit(min((fit(start, ROUGH) for start in starts), key=lambda result: result[0])[1], FINE)[1]
        kernel = numpy.column_stack([shape[::2], shape[1::2], *weights_of(shape)[0].reshape(2, n)])
        kernel[kernel[:, 1] < 0] *= (1, -1, 1, -1)
        yield kernel[numpy.argsort(kernel[:, 1])]


def best_radius(kernel):
    """Returns the best disk radius near 1.15, to within 0.001. Also optimises the kernel's extent in [1, 2]."""
    extent, radius = 1.5, 1.15
    for step in (0.025, 0.005, 0.001):
        tried = [(min(max(extent + i * step, 1), 2), radius + j * step) for i in range(-20, 21) for j in range(-20, 21)]
        extent, radius = min(tried, key=lambda pair: error_of(kernel, *pair))
    return radius


def main(words):
    parser_of("circular-fit", __doc__).parse_args(words)
    source = (ROOT / "src/render/circular/circular_kernel.cpp").read_text().split("published = {{")
    ours, published = ([[float(value) for value in row.split(", ")] for row in re.findall(r"^    \{(.*)\},$", part, re.MULTILINE)]
                       for part in source)
    print("Decay, frequency, cosine, sine; RMS error, and largest difference from circular_kernel.cpp")
    for n, kernel in enumerate(fitted(9), 1):
        table = ours[n * (n - 1) // 2:n * (n + 1) // 2]
        print(f"    // {n}: {error_of(kernel, 1, 1):.5f}, {abs(kernel - table).max():.0e}")
        print(*("    {" + ", ".join(f"{value:.6f}" for value in row) + "}," for row in kernel), sep="\n", flush=True)
    print("\nNiemitalo's kernels: best disk radius")
    for n in range(1, 6):
        print(f"    // {n}: {best_radius(published[n * (n - 1) // 2:n * (n + 1) // 2]):.3f}", flush=True)
