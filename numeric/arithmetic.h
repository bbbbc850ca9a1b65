// Arithmetics: which number type a pass computes in and, for the emulated one, in which format.
#pragma once

#include <cstdint>
#include <string>

#include "numeric/format.h"

namespace etalon {

// The number types that passes are compiled for.
enum class NumberType : uint8_t {
    fp32,      // float, in lanes
    fp64,      // double, in lanes
    narrow,    // fp16 or bf16, over lanes of float (numeric/narrow.h)
    emulated,  // any format (numeric/emulated.h), over lanes of double
    truth,     // 192 bits (numeric/truth.h), one at a time
};

// A value: a format that a user makes up is one too.
struct Arithmetic {
    NumberType type = NumberType::fp32;
    Format format = kFp32;  // of the narrow and the emulated type

    constexpr Arithmetic() = default;
    constexpr explicit Arithmetic(NumberType numberType) : type(numberType) {}
    constexpr explicit Arithmetic(Format emulated)
        : type(emulated == kFp16 || emulated == kBf16 ? NumberType::narrow : NumberType::emulated),
          format(emulated) {}
    friend constexpr bool operator==(const Arithmetic&, const Arithmetic&) = default;

    // Whether numbers are those of `format`.
    constexpr bool hasFormat() const { return type == NumberType::narrow || type == NumberType::emulated; }

    static const Arithmetic truth, fp64, fp32;
    // The formats of numeric/format.h.
    static const Arithmetic fp32Flush, fp32Nv40, fp16, fp16Nv40, bf16, fp24R300;
};
inline constexpr Arithmetic Arithmetic::truth{NumberType::truth};
inline constexpr Arithmetic Arithmetic::fp64{NumberType::fp64};
inline constexpr Arithmetic Arithmetic::fp32{NumberType::fp32};
inline constexpr Arithmetic Arithmetic::fp32Flush{kFp32Flush};
inline constexpr Arithmetic Arithmetic::fp32Nv40{kFp32Nv40};
inline constexpr Arithmetic Arithmetic::fp16{kFp16};
inline constexpr Arithmetic Arithmetic::fp16Nv40{kFp16Nv40};
inline constexpr Arithmetic Arithmetic::bf16{kBf16};
inline constexpr Arithmetic Arithmetic::fp24R300{kFp24R300};

// "fp64", "truth", the name of a named format (numeric/format.h), or a format's digits: "11 bits, exponents -14 to
// 15, nearest-even, subnormals kept, infinity", then "division by reciprocal", "power by exp2 and log2" and "seed 7"
// where the format has them.
std::string arithmeticName(const Arithmetic& arithmetic);

}  // namespace etalon
