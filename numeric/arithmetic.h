// Arithmetics: which number type a pass computes in and, for the emulated one, in which format.
#pragma once

#include <cstdint>
#include <optional>
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

// A value: a format that a user makes up is one too. Made of a format, it computes in that format, digit for
// digit; fp32, fp64 and truth are made by name.
struct Arithmetic {
    std::optional<Format> format;  // none: native numbers, or truth

    constexpr Arithmetic() = default;  // fp32
    constexpr explicit Arithmetic(Format of) : format(of) {}
    friend constexpr bool operator==(const Arithmetic& a, const Arithmetic& b) {
        return a.format == b.format && (a.format || a.native_ == b.native_);
    }

    // What passes run over: the fastest of the types whose numbers are these.
    constexpr NumberType type() const {
        if (!format) return native_;
        return *format == kFp16 || *format == kBf16 ? NumberType::narrow : NumberType::emulated;
    }

    static const Arithmetic truth, fp64, fp32;
    // The formats of numeric/format.h.
    static const Arithmetic fp32Flush, fp32Nv40, fp16, fp16Nv40, bf16, fp24R300;

  private:
    static constexpr Arithmetic ofNative(NumberType type) {
        Arithmetic arithmetic;
        arithmetic.native_ = type;
        return arithmetic;
    }
    NumberType native_ = NumberType::fp32;  // without a format
};
inline constexpr Arithmetic Arithmetic::truth = ofNative(NumberType::truth);
inline constexpr Arithmetic Arithmetic::fp64 = ofNative(NumberType::fp64);
inline constexpr Arithmetic Arithmetic::fp32 = ofNative(NumberType::fp32);
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
