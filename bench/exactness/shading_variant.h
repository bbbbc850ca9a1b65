// The shading loop that exists in several arithmetics, each in a shared library of its own: the kernel texts
// compiled with other flags have the same names, and must never meet in one program image.
#pragma once

#include <cstddef>

namespace etalon::bench {

// Pixels and lights as separate arrays per component. count is a multiple of 16. Normals and directions to
// the viewer are unit vectors; reflectances and irradiances are positive; exponent >= 1.
struct ShadingInput {
    size_t count = 0, lights = 0;
    const float* normal[3] = {};
    const float* toEye[3] = {};
    float* radiance[3] = {};  // written
    const float* toLight[3] = {};
    const float* irradiance[3] = {};
    double diffuse[3] = {}, specular[3] = {};
    double exponent = 1, scale = 1;  // scale: (exponent + 8) / (8 pi)
};

}  // namespace etalon::bench

// Radiance of each pixel: Lambert plus Blinn-Phong, each summed over the lights first.
extern "C" {
// The kernel texts as the library has them.
void etalonShadeExact(const etalon::bench::ShadingInput* input);
// Multiplications and additions contracted to fused ones.
void etalonShadeFused(const etalon::bench::ShadingInput* input);
// Division and square root from the processor's approximations of 1/x and 1/sqrt(x).
void etalonShadeApproximate(const etalon::bench::ShadingInput* input);
// Both, and the power in float arithmetic.
void etalonShadeFast(const etalon::bench::ShadingInput* input);
// AVX-512 intrinsics written by hand: the operations of the exact texts, but for a power in double.
void etalonShadeByHand(const etalon::bench::ShadingInput* input);
}
