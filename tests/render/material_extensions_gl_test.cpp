// Tests KHR_materials_anisotropy, _iridescence, _diffuse_transmission and _dispersion, and the compensation of multiple
// scattering. A wall's radiance is compared with equations and integrals in double precision.

#include <complex>

#include "render/glass_wall.h"

namespace defocus::engine {
namespace {

class MaterialExtensions : public Transmission {
protected:
    // Returns the mean of the four central pixels. The view axis passes through their common corner.
    static glm::dvec3 middleOf(const Image& image) {
        glm::dvec3 sum(0);
        for (const auto& [x, y] : {std::pair(15, 11), {16, 11}, {15, 12}, {16, 12}})
            for (int c = 0; c < 3; ++c) sum[c] += image.at(x, y)[c] / 4.0;
        return sum;
    }

    static Material metal(float roughness) { return {.roughnessFactor = roughness}; }
};

// The reference `single` is the single-scattering albedo of GGX with height-correlated masking at normal incidence,
// integrated by independent code.
TEST_F(MaterialExtensions, roughWhiteMetalKeepsItsLightWithMultipleScattering) {
    for (const auto& [roughness, single] : {std::pair(0.2f, 0.9986), {0.4f, 0.967}, {0.6f, 0.824}, {1.0f, 0.307}}) {
        EXPECT_NEAR(middleOf(furnaceImage(metal(roughness), 1)).x, single, 0.005) << roughness;
        for (const double cosine : {1.0, 0.5, 0.2}) {
            const glm::dvec3 all = middleOf(furnaceImage(metal(roughness), cosine, true));
            EXPECT_NEAR(all.x, 1, 0.01) << roughness << ' ' << cosine;
        }
    }
}

TEST_F(MaterialExtensions, whiteDielectricsKeepTheirLightWithMultipleScattering) {
    for (const float roughness : {0.2f, 0.6f, 1.0f}) {
        Material white = metal(roughness);
        white.metallicFactor = 0;
        EXPECT_NEAR(middleOf(furnaceImage(white, 0.7, true)).x, 1, 1e-5) << roughness;
    }
}

struct Widths {
    double along, across;
};

// Returns D·V, the distribution times the visibility, as defined in KHR_materials_anisotropy. The components of `v` and
// `l` are along the tangent, across it and along the normal.
double stretchedGgx(const Widths& widths, const glm::dvec3& v, const glm::dvec3& l) {
    const glm::dvec3 h = glm::normalize(v + l);
    const glm::dvec3 scaled(h.x / widths.along, h.y / widths.across, h.z);
    const double d = 1 / (std::numbers::pi * widths.along * widths.across * std::pow(glm::dot(scaled, scaled), 2));
    const auto length = [&](const glm::dvec3& w) {
        return glm::length(glm::dvec3(widths.along * w.x, widths.across * w.y, w.z));
    };
    return d * 0.5 / (l.z * length(v) + v.z * length(l));
}

TEST_F(MaterialExtensions, stretchedHighlightsFollowTheirEquations) {
    for (const double turn : {0.0, 0.6, -2.1}) {
        Material brushed = metal(0.5f);
        brushed.baseColorFactor = {0.9f, 0.6f, 0.3f, 1};
        brushed.anisotropyStrength = 0.7f;
        brushed.anisotropyRotation = static_cast<float>(turn);
        const auto small = litWall(brushed);
        small->world.lights = {sunFrom(fromWall(*small, {0.4, -0.2, -1}), 3),
                               sunFrom(fromWall(*small, {-2, 0.5, -1}), 5)};
        const Image image = wallImage(*small);
        const Widths widths{0.25 + 0.75 * 0.49, 0.25};
        const glm::dvec3 along = fromWall(*small, {std::cos(turn), std::sin(turn), 0});
        const glm::dvec3 across = fromWall(*small, {-std::sin(turn), std::cos(turn), 0});
        for (const WallPoint& point : wallPoints(*small)) {
            const auto local = [&](const glm::dvec3& w) {
                return glm::dvec3(glm::dot(w, along), glm::dot(w, across), glm::dot(w, point.normal));
            };
            glm::dvec3 expected(0);
            for (const PlacedLight& sun : small->world.lights) {
                const glm::dvec3 l = -glm::normalize(sun.direction);
                const glm::dvec3 base(0.9f, 0.6f, 0.3f);
                const double vh = glm::dot(point.toEye, glm::normalize(l + point.toEye));
                expected += (base + (1.0 - base) * std::pow(1 - vh, 5)) *
                            (sun.light.intensity * local(l).z * stretchedGgx(widths, local(point.toEye), local(l)));
            }
            ASSERT_NO_FATAL_FAILURE(expectRadiance(image, point, expected, 1e-3 * expected + 1e-5));
        }
    }
}

// Returns the albedo ∫ D·V·(n·l) dl of a white metal with anisotropic roughness, by the midpoint rule in the half
// vector's slopes.
double stretchedAlbedo(const Widths& widths, const glm::dvec3& v) {
    constexpr int rings = 400, sectors = 400;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < sectors; ++k) {
            // Half vectors with the density D·(n·h): for a uniform u, the slope is √(u/(1 − u)), scaled by the width
            // along each axis.
            const double u = (i + 0.5) / rings;
            const double azimuth = 2 * std::numbers::pi * (k + 0.5) / sectors;
            const double slope = std::sqrt(u / (1 - u));
            const glm::dvec3 h = glm::normalize(
                glm::dvec3(widths.along * slope * std::cos(azimuth), widths.across * slope * std::sin(azimuth), 1));
            const double vh = glm::dot(v, h);
            const glm::dvec3 l = 2 * vh * h - v;
            if (l.z <= 0 || vh <= 0) continue;
            const glm::dvec3 scaled(h.x / widths.along, h.y / widths.across, h.z);
            const double d =
                1 / (std::numbers::pi * widths.along * widths.across * std::pow(glm::dot(scaled, scaled), 2));
            sum += stretchedGgx(widths, v, l) * l.z / (d * h.z) * 4 * vh;
        }
    return sum / rings / sectors;
}

TEST_F(MaterialExtensions, stretchedMetalReflectsItsIntegralOfAFurnacesLight) {
    for (const float roughness : {0.2f, 0.5f})
        for (const float strength : {0.4f, 1.0f})
            for (const double turn : {0.0, std::numbers::pi / 2})
                for (const double cosine : {0.95, 0.5}) {
                    Material brushed = metal(roughness);
                    brushed.anisotropyStrength = strength;
                    brushed.anisotropyRotation = static_cast<float>(turn);
                    const double width = roughness * roughness;
                    const Widths widths{width + (1 - width) * strength * strength, width};
                    const double sine = std::sqrt(1 - cosine * cosine);
                    const glm::dvec3 eye(sine * std::cos(turn), sine * std::sin(turn), cosine);
                    EXPECT_NEAR(middleOf(furnaceImage(brushed, cosine)).x, stretchedAlbedo(widths, eye), 0.08)
                        << roughness << ' ' << strength << ' ' << turn << ' ' << cosine;
                }
}

// Returns the reflectance of a film in air on a dielectric with reflectance `base`, as linear Rec.709 relative to a
// white surface: Fresnel amplitudes of both polarisations, Airy's sum over all reflections, and the CIE 1931 observer
// as fitted by Wyman, Sloan and Shirley 2013.
glm::dvec3 filmColor(double cosine, double base, double film, double thickness) {
    using Complex = std::complex<double>;
    const double root = std::sqrt(base);
    const double inner = (1 + root) / (1 - root);
    const double sine2 = 1 - cosine * cosine;
    const double inFilm = std::sqrt(1 - sine2 / (film * film));
    const double inBase = std::sqrt(1 - sine2 / (inner * inner));
    const auto reflected = [&](double front, double back, double wavelength) {
        const Complex delay = std::polar(1.0, 4 * std::numbers::pi * film * thickness * inFilm / wavelength);
        return std::norm((front + back * delay) / (1.0 + front * back * delay));
    };
    const auto lobe = [](double x, double height, double middle, double below, double above) {
        const double t = (x - middle) / (x < middle ? below : above);
        return height * std::exp(-0.5 * t * t);
    };
    const glm::dmat3 rec709(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560,
                            1.0572252);
    glm::dvec3 seen(0), white(0);
    for (double w = 380; w <= 780; w += 2) {
        const double s = reflected((cosine - film * inFilm) / (cosine + film * inFilm),
                                   (film * inFilm - inner * inBase) / (film * inFilm + inner * inBase), w);
        const double p = reflected((film * cosine - inFilm) / (film * cosine + inFilm),
                                   (inner * inFilm - film * inBase) / (inner * inFilm + film * inBase), w);
        const glm::dvec3 xyz(
            lobe(w, 1.056, 599.8, 37.9, 31.0) + lobe(w, 0.362, 442.0, 16.0, 26.7) - lobe(w, 0.065, 501.1, 20.4, 26.2),
            lobe(w, 0.821, 568.8, 46.9, 40.5) + lobe(w, 0.286, 530.9, 16.3, 31.1),
            lobe(w, 1.217, 437.0, 11.8, 36.0) + lobe(w, 0.681, 459.0, 26.0, 13.8));
        seen += rec709 * xyz * (0.5 * (s + p));
        white += rec709 * xyz;
    }
    return seen / white;
}

Material filmed(float base, float ior, float thickness, float roughness = 0) {
    return {.baseColorFactor = glm::vec4(glm::vec3(base), 1),
            .roughnessFactor = roughness,
            .iridescenceFactor = 1,
            .iridescenceIor = ior,
            .iridescenceThicknessMaximum = thickness};
}

// KHR_materials_iridescence approximates spectra by Gaussians, and Fresnel's equations by Schlick's approximation. The
// reflectance differs from the spectral sum by up to 0.035 at normal incidence, and by up to 0.09 at 53°.
TEST_F(MaterialExtensions, filmsReflectTheColoursOfInterference) {
    for (const float base : {0.04f, 0.3f, 0.8f})
        for (const float ior : {1.3f, 1.8f})
            for (const float thickness : {150.0f, 300.0f, 550.0f})
                for (const double cosine : {1.0, 0.6}) {
                    const glm::dvec3 seen = middleOf(furnaceImage(filmed(base, ior, thickness), cosine));
                    const glm::dvec3 expected = filmColor(cosine, base, ior, thickness);
                    for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(seen[c], expected[c], cosine == 1 ? 0.035 : 0.09)
                            << base << ' ' << ior << ' ' << thickness << ' ' << cosine << ' ' << c;
                }
}

// If light comes from the eye's direction, the half vector also points to the eye.
TEST_F(MaterialExtensions, filmsColourTheHighlightsOfLights) {
    const float thickness = 300;
    const auto small = litWall(filmed(0.3f, 1.8f, thickness, 0.4f));
    small->world.lights = {sunFrom(fromWall(*small, {0, 0, -1}), 3)};
    const glm::dvec3 seen = middleOf(wallImage(*small));
    // Radiance of a white metal without a film: the sun's illuminance of 3 times the GGX terms D·V for n = v = l.
    const double unfilmed = 3 / (4 * std::numbers::pi * 0.16 * 0.16);
    const glm::dvec3 expected = filmColor(1, 0.3, 1.8, thickness) * unfilmed;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 0.035 * unfilmed) << c;
}

TEST_F(MaterialExtensions, filmsOnWhiteDielectricsKeepAllLight) {
    Material white = filmed(1, 1.3f, 0);
    white.metallicFactor = 0;
    const glm::dvec3 seen = middleOf(furnaceImage(white, 1));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 1, 0.01);
}

Material sheet(float share) {
    return {.metallicFactor = 0, .diffuseTransmissionFactor = share};
}

TEST_F(MaterialExtensions, aWhiteSheetPassesOnAllLight) {
    for (const float share : {0.25f, 1.0f}) EXPECT_NEAR(middleOf(furnaceImage(sheet(share), 0.8)).x, 1, 1e-5) << share;
}

// A thin surface with the diffuse transmission t that neither reflects specularly nor absorbs divides the irradiance
// E·cos θ between its sides. The lit side has the radiance (1 − t)·E·cos θ/π, the other side t·E·cos θ/π.
TEST_F(MaterialExtensions, aSheetDividesTheLightOfASunBetweenItsSides) {
    for (const float side : {-1.0f, 1.0f})
        for (const float share : {0.25f, 1.0f}) {
            Material paper = sheet(share);
            paper.specularFactor = 0;
            paper.baseColorFactor = {0.5f, 0.25f, 1, 1};
            paper.diffuseTransmissionColorFactor = {1, 0.5f, 0.125f};
            const auto small = litWall(paper);
            small->world.lights = {sunFrom(fromWall(*small, {0.6, 0, 0.8 * side}), 3)};
            const glm::dvec3 seen = middleOf(wallImage(*small));
            const glm::dvec3 expected =
                side < 0 ? glm::dvec3(0.5, 0.25, 1) * (1.0 - share) : glm::dvec3(1, 0.5, 0.125) * double(share);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(seen[c], expected[c] * 3 * 0.8 / std::numbers::pi, 1e-5) << side << ' ' << share << c;
        }
}

// Each colour channel is refracted with its own index: n for green, and n ∓ (n − 1)·dispersion/40 for red and blue.
TEST_F(MaterialExtensions, dispersionRefractsEachChannelByItsIndex) {
    Material prism = clear();
    prism.ior = 1.7f;
    prism.thicknessFactor = 0.5f;
    prism.dispersion = 3;
    const auto small = litWall(prism);
    const glm::dmat4 placed = glm::rotate(small->world.pose.objects[0].worldFromObject, 0.5, glm::dvec3(0, 1, 0));
    small->world.pose.objects[0].worldFromObject = placed;
    addWall(*small, 4, unlitMaterial(glm::vec4(1)), 2);
    // All colour channels of the wall behind increase from left to right, so that a colour identifies a position.
    for (glm::vec4& color : small->scene.meshes[1].vertices.colors) color = glm::vec4(glm::vec3(color.r), 1);
    finish(*small);
    const Image image = wallImage(*small);
    const glm::dmat4 cameraFromWorld = glm::inverse(small->view.worldFromCamera);
    const glm::dvec3 normal(placed[2]);
    int compared = 0;
    for (const WallPoint& point : wallPoints(*small)) {
        if (std::abs(point.x - 16) > 5 || std::abs(point.y - 12) > 5) continue;
        const glm::dvec3 eye(small->view.worldFromCamera[3]);
        const double along = glm::dot(glm::dvec3(placed[3]) - eye, normal) / glm::dot(-point.toEye, normal);
        const glm::dvec3 entry = eye - point.toEye * along;
        for (int c = 0; c < 3; ++c) {
            const double ior = 1.7 + (c - 1) * 0.7 * 3 / 40;
            const glm::dvec3 exit = entry + 0.5 * glm::refract(-point.toEye, normal, 1 / ior);
            const glm::dvec3 seen(cameraFromWorld * glm::dvec4(exit, 1));
            ASSERT_NEAR(image.at(point.x, point.y)[c], (4 * seen.x / -seen.z / 2 + 1) / 2, 3e-4)
                << point.x << ' ' << point.y << ' ' << c;
        }
        ++compared;
    }
    EXPECT_GT(compared, 80);
}

}  // namespace
}  // namespace defocus::engine
