// Directional lights that stand for the radiance of a probe.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace etalon {

// The texels [x0, x1) x [y0, y1) of an image.
struct TexelRegion {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }

    friend bool operator==(const TexelRegion&, const TexelRegion&) = default;
};

// A light far away or, where the probe stores distances, at a place.
struct ProbeLight {
    glm::dvec3 direction{0, 0, 1};         // of length 1, in the world, towards the light
    glm::dvec3 energy{0};                  // R G B: the radiance times its solid angle, W/m^2; what a surface
                                           // that faces the light receives
    double solidAngle_sr = 0;              // of the texels that it stands for
    TexelRegion region;                    // that holds these texels
    std::optional<glm::dvec3> position_m;  // in the world
};

// The energy of a colour, by which regions are compared [Pedersen2008, Eq. 5.8].
inline double energyOf(const glm::dvec3& rgb) { return 0.2125 * rgb.x + (0.7154 * rgb.y + 0.0721 * rgb.z); }

// The sum of the lights' energies, in their order.
inline glm::dvec3 totalEnergy(std::span<const ProbeLight> lights) {
    glm::dvec3 sum{0};
    for (const ProbeLight& light : lights) sum += light.energy;
    return sum;
}

}  // namespace etalon
