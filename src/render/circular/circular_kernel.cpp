// Sources: Niemitalo 2010, Circularly symmetric convolution and lens blur; Garcia 2018, Circular Separable Convolution
// Depth of Field.

#include "render/circular/circular_kernel.h"

#include <array>

#include "core/error.h"

namespace defocus::engine {

namespace {

// Kernels of circularKernel(), fitted by `scripts/figures circular-fit`. A row is a component: decay a, frequency b,
// weights A and B. The kernel with n components begins at index n·(n − 1)/2.
constexpr std::array<CircularComponent, 45> components = {{
    // Kernel with one component: {decay a, frequency b, weight A, weight B}.
    {0.905657, 1.823553, 0.793950, 1.540016},
    // Kernel with two components; {a, b, A, B} for each.
    {1.533272, 2.044737, 0.550184, 2.623282},
    {0.360655, 7.170812, 0.316435, -0.145504},
    // Kernel with three components; {a, b, A, B} for each.
    {1.901800, 2.155754, 0.206577, 3.525693},
    {0.911445, 7.473262, 0.597307, -0.075285},
    {0.153853, 13.034717, 0.092122, -0.128752},
    // Kernel with four components; {a, b, A, B} for each.
    {2.162922, 2.225750, -0.161128, 4.317169},
    {1.250506, 7.619228, 0.833332, 0.039511},
    {0.617650, 13.405512, 0.211899, -0.146685},
    {0.048591, 19.026311, 0.028117, -0.094061},
    // Kernel with five components; {a, b, A, B} for each.
    {2.364944, 2.274987, -0.534475, 5.034161},
    {1.499117, 7.712878, 1.043718, 0.173502},
    {0.912005, 13.580187, 0.315547, -0.141809},
    {0.455003, 19.445180, 0.095083, -0.119015},
    {-0.016360, 25.081573, 0.002845, -0.069981},
    // Kernel with six components; {a, b, A, B} for each.
    {2.529588, 2.312070, -0.907465, 5.697236},
    {1.696517, 7.780111, 1.236727, 0.318104},
    {1.131983, 13.690699, 0.410952, -0.127311},
    {0.717989, 19.644405, 0.152613, -0.127555},
    {0.349328, 25.534390, 0.046110, -0.094187},
    {-0.061075, 31.176168, -0.008746, -0.053315},
    // Kernel with seven components; {a, b, A, B} for each.
    {2.668480, 2.341337, -1.277888, 6.319071},
    {1.860564, 7.831600, 1.416827, 0.469427},
    {1.309468, 13.769482, 0.501285, -0.107284},
    {0.916566, 19.770742, 0.205133, -0.129663},
    {0.589345, 25.752901, 0.083422, -0.104932},
    {0.273947, 31.654045, 0.021462, -0.075722},
    {-0.094086, 37.297785, -0.014395, -0.041356},
    // Kernel with eight components; {a, b, A, B} for each.
    {2.788547, 2.365228, -1.644877, 6.907987},
    {2.001009, 7.872761, 1.586742, 0.625344},
    {1.458953, 13.829533, 0.588116, -0.083532},
    {1.078173, 19.861016, 0.254625, -0.128283},
    {0.771832, 25.892363, 0.117209, -0.110529},
    {0.496233, 31.887826, 0.047965, -0.086545},
    {0.216821, 37.794910, 0.007657, -0.061939},
    {-0.119678, 43.439230, -0.017122, -0.032479},
    // Kernel with nine components; {a, b, A, B} for each.
    {2.894274, 2.385237, -2.008188, 7.469898},
    {2.123841, 7.906699, 1.748321, 0.784582},
    {1.588405, 13.877347, 0.672349, -0.057029},
    {1.215344, 19.929975, 0.302106, -0.124659},
    {0.921209, 25.992509, 0.148807, -0.113428},
    {0.666124, 32.038078, 0.071891, -0.092932},
    {0.424908, 38.041030, 0.027574, -0.072337},
    {0.171675, 43.951616, -0.000599, -0.051397},
    {-0.140223, 49.595900, -0.018297, -0.025707},
}};

// Kernels of Niemitalo 2010. A row is a component: decay a, frequency b, weights A and B. The kernel with n components
// begins at index n·(n − 1)/2. Garcia's slides print the kernel with two components. Garcia's filter generator has all
// kernels. However, it negates the second sine weight of the kernel with four components, which then does not
// approximate a disk.
constexpr std::array<CircularComponent, 15> published = {{
    // Kernel with one component: {decay a, frequency b, weight A, weight B}.
    {0.862325, 1.624835, 0.767583, 1.862321},
    // Kernel with two components; {a, b, A, B} for each.
    {0.886528, 5.268909, 0.411259, -0.548794},
    {1.960518, 1.558213, 0.513282, 4.561110},
    // Kernel with three components; {a, b, A, B} for each.
    {2.176490, 5.043495, 1.621035, -2.105439},
    {1.019306, 9.027613, -0.280860, -0.162882},
    {2.815110, 1.597273, -0.366471, 10.300301},
    // Kernel with four components; {a, b, A, B} for each.
    {4.338459, 1.553635, -5.767909, 46.164397},
    {3.839993, 4.693183, 9.795391, -15.227561},
    {2.791880, 8.178137, -3.048324, 0.302959},
    {1.342190, 12.328289, 0.010001, 0.244650},
    // Kernel with five components; {a, b, A, B} for each.
    {4.892608, 1.685979, -22.356787, 85.912460},
    {4.711870, 4.998496, 35.918936, -28.875618},
    {4.052795, 8.244168, -13.212253, -1.578428},
    {2.929212, 11.900859, 0.507991, 1.816328},
    {1.512961, 16.116382, 0.138051, -0.010000},
}};
constexpr std::array<double, publishedKernelLimit> publishedDiskRadius = {1.068, 1.097, 1.101, 1.101, 1.101};

// Returns the published kernels rescaled from disk radius ρ to disk radius 1. A component e^((−a + ib)·r²) becomes
// e^((−a + ib)·ρ²·u), where u = (r/ρ)² is the squared distance in disk radii. So a and b are multiplied by ρ².
std::array<CircularComponent, 15> rescaledToRadius1() {
    std::array<CircularComponent, 15> kernels = published;
    auto component = kernels.begin();
    for (std::size_t n = 1; n <= publishedDiskRadius.size(); ++n)
        for (std::size_t i = 0; i < n; ++i, ++component) {
            const double square = publishedDiskRadius[n - 1] * publishedDiskRadius[n - 1];
            component->decay *= square;
            component->frequency *= square;
        }
    return kernels;
}

}  // namespace

std::span<const CircularComponent> circularKernel(int count, KernelConstants constants) {
    static const std::array<CircularComponent, 15> rescaled = rescaledToRadius1();
    const bool fitted = constants == KernelConstants::fitted;
    const int limit = fitted ? circularKernelLimit : publishedKernelLimit;
    if (count < 1 || count > limit)
        fail("a {}circular kernel cannot have {} components; choose 1 to {}", fitted ? "" : "published ", count, limit);
    std::span<const CircularComponent> kernels = components;
    if (!fitted) kernels = constants == KernelConstants::rescaled ? rescaled : published;
    const auto n = static_cast<std::size_t>(count);
    return kernels.subspan(n * (n - 1) / 2, n);
}

std::complex<double> circularFactor(const CircularComponent& component, double offset) {
    return std::exp(std::complex<double>(-component.decay, component.frequency) * (offset * offset));
}

}  // namespace defocus::engine
