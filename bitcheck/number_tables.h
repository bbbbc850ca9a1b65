// Tables of arguments for numbers and samplers, and what every level computes from them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitcheck/plane.h"
#include "raster/texture.h"

namespace etalon {

// Arguments of a function of two numbers, side by side; a multiple of 64 of each.
struct ArgumentTable {
    std::vector<double> a, b;
};
inline constexpr int kTableWidth = 64;

struct NumberTables {
    ArgumentTable plain;    // finite, at most 2^14 in magnitude, nothing that gives NaN
    ArgumentTable special;  // with zeros, infinities, NaN, numbers beyond and below every 16-bit format
    ArgumentTable powers;   // x >= 0 and exponents
    ArgumentTable angles;   // y and x of atan2, with zeros and infinities
    ArgumentTable texture;  // u and v, inside, outside, on texel borders, NaN and infinite
    std::array<std::vector<double>, 3>
        directions;  // x, y, z; axes, edges and corners of a cube, degenerate ones
};

// What is compiled once per level (numeric/isa.h): the number types of the kernel texts, in lanes.
struct NumberPasses {
    std::vector<BitPlane> (*arithmetic)(const NumberTables& tables);
    std::vector<BitPlane> (*elementary)(const NumberTables& tables);
    std::vector<BitPlane> (*sampling)(const NumberTables& tables, const TextureView& image);
    std::vector<BitPlane> (*cubeSampling)(const NumberTables& tables, const TextureView& cube,
                                          const TextureView& latLong);
    // fp16 and bf16, in this order: how many results of + - * /, powers, the square root and floor have other bits in
    // Narrow than in Rounded. a: the 16-bit patterns first ... last - 1; b: every step-th one.
    std::array<size_t, 2> (*narrowMismatches)(uint32_t first, uint32_t last, uint32_t step);
};

}  // namespace etalon
