// The elementary functions against MPFR, in all number types.
#include "numeric/elementary.h"
#include "numeric/text.h"

#include <doctest/doctest.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <vector>

#include "numeric/check.h"
#include "numeric/fp_environment.h"
#include "numeric/parallel.h"
#include "numeric/truth_elementary.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = 0x1.921fb54442d18p+1;

struct Arguments {
    double a, b;
};

// A function of two numbers (the second one is ignored by sin, cos and exp), and the same in MPFR.
using Computed = std::function<double(double, double)>;
using Exact = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
using Generator = std::function<Arguments(RandomNumbers&, int kind)>;

int exactSin(mpfr_ptr r, mpfr_srcptr a, mpfr_srcptr, mpfr_rnd_t m) { return mpfr_sin(r, a, m); }
int exactCos(mpfr_ptr r, mpfr_srcptr a, mpfr_srcptr, mpfr_rnd_t m) { return mpfr_cos(r, a, m); }
int exactExp(mpfr_ptr r, mpfr_srcptr a, mpfr_srcptr, mpfr_rnd_t m) { return mpfr_exp(r, a, m); }

struct Precision {
    int significandBits, minExponent, maxExponent;
};
constexpr Precision kDouble{53, -1022, 1023};
constexpr Precision kSingle{24, -126, 127};

// |computed - exact| in units in the last place of the exact value; negative where that is outside the normal
// range.
class ErrorMeter {
  public:
    ErrorMeter() {
        for (mpfr_ptr x : {a_, b_, r_}) mpfr_init2(x, kBits);
    }
    ~ErrorMeter() {
        for (mpfr_ptr x : {a_, b_, r_}) mpfr_clear(x);
    }
    ErrorMeter(const ErrorMeter&) = delete;
    ErrorMeter& operator=(const ErrorMeter&) = delete;

    double ulps(Exact exact, Arguments x, double computed, Precision p) {
        mpfr_set_d(a_, x.a, MPFR_RNDN);
        mpfr_set_d(b_, x.b, MPFR_RNDN);
        exact(r_, a_, b_, MPFR_RNDN);
        if (!mpfr_regular_p(r_)) return -1.0;
        // MPFR's significands are in [1/2, 1).
        const auto exponent = mpfr_get_exp(r_) - 1;
        if (exponent < p.minExponent || exponent >= p.maxExponent) return -1.0;
        if (!std::isfinite(computed)) return kInf;
        mpfr_sub_d(r_, r_, computed, MPFR_RNDN);
        mpfr_mul_2si(r_, r_, p.significandBits - 1 - exponent, MPFR_RNDN);
        return std::abs(mpfr_get_d(r_, MPFR_RNDN));
    }

  private:
    static constexpr int kBits = 80;
    mpfr_t a_, b_, r_;
};

struct Worst {
    double ulps = 0.0;
    Arguments at{};
    size_t measured = 0;
};

// Per function; where it is checked in double and in float, half of them each.
constexpr size_t kCases = 1 << 20;
constexpr size_t kBlock = 1 << 12;

// The largest error over kCases random arguments, of all kinds of the generator in turn.
Worst worstError(const Computed& computed, Exact exact, Precision p, const Generator& generator,
                 size_t cases = kCases) {
    std::vector<Worst> blocks(cases / kBlock);
    parallelFor(blocks.size(), 0, [&](size_t block) {
        RandomNumbers random(block);
        ErrorMeter meter;
        for (size_t i = 0; i < kBlock; i++) {
            const Arguments x = generator(random, static_cast<int>(i));
            const double e = meter.ulps(exact, x, computed(x.a, x.b), p);
            if (e < 0.0) continue;
            blocks[block].measured++;
            if (e > blocks[block].ulps) blocks[block].ulps = e, blocks[block].at = x;
        }
    });
    Worst worst;
    for (const Worst& b : blocks) {
        if (b.ulps > worst.ulps) worst.ulps = b.ulps, worst.at = b.at;
        worst.measured += b.measured;
    }
    return worst;
}

void checkBound(const char* name, const Worst& worst, double bound) {
    MESSAGE(formatText("{}: largest error {} ulp at {:a}, {:a} of {}", name, worst.ulps, worst.at.a,
                       worst.at.b, worst.measured));
    CHECK(worst.ulps <= bound);
    CHECK(worst.measured >= kCases / 2 * 99 / 100);
}

// C++ leaves the order of operands open: each random number is drawn in a statement of its own.
double sign(RandomNumbers& random) { return random.below(2) == 0 ? 1.0 : -1.0; }
// 2^[lo, hi) with a random significand.
double spread(RandomNumbers& random, int lo, int hi) {
    const double significand = random.uniform(1.0, 2.0);
    return std::ldexp(significand, lo + random.below(hi - lo));
}
double signedSpread(RandomNumbers& random, int lo, int hi) {
    const double s = sign(random);
    return s * spread(random, lo, hi);
}
double oneOf(RandomNumbers& random, std::initializer_list<double> values) {
    return values.begin()[random.below(static_cast<int>(values.size()))];
}
// 1 +- 2^[lo, hi).
double nearOne(RandomNumbers& random, int lo, int hi) { return 1.0 + signedSpread(random, lo, hi); }

// Plane vectors: in the unit square, of all magnitudes, near the ends of the intervals of the method, near
// the axes, and with small whole coordinates.
Arguments planeVector(RandomNumbers& random, int kind, int largestExponent) {
    switch (kind % 5) {
        case 0:
            return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
        case 1:
            return {signedSpread(random, -largestExponent, largestExponent),
                    signedSpread(random, -largestExponent, largestExponent)};
        case 2: {
            const double x = signedSpread(random, -20, 20);
            const double slope =
                oneOf(random, {0.25, 0.5, 0.75, 1.0, 4.0 / 3.0, 4.0}) * nearOne(random, -52, -2);
            return {sign(random) * slope * x, x};
        }
        case 3:
            return {signedSpread(random, -40, 0), sign(random)};
        default: {
            const double y = 1 + random.below(100), x = 1 + random.below(100);
            return {sign(random) * y, sign(random) * x};
        }
    }
}
Arguments planeVectorInDouble(RandomNumbers& random, int kind) { return planeVector(random, kind, 440); }
Arguments planeVectorInFloat(RandomNumbers& random, int kind) {
    const Arguments v = planeVector(random, kind, 60);
    return {static_cast<float>(v.a), static_cast<float>(v.b)};
}

// Bases and exponents: specular lobes, transfer curves, bases near 1 with large exponents, everything with a
// result in range, bases near the ends of the intervals of the method, and small whole numbers.
Arguments powerArguments(RandomNumbers& random, int kind, double log2Range) {
    // An exponent that gives a result anywhere in the range.
    const double log2Result = random.uniform(-1.0, 1.0) * log2Range;
    const auto withExponent = [=](double base) { return Arguments{base, log2Result / std::log2(base)}; };
    const int largestExponent = static_cast<int>(log2Range);
    switch (kind % 6) {
        case 0:
            return {random.uniform(0.5, 1.0), random.uniform(0.0, 0.9 * log2Range)};
        case 1:
            return {random.uniform(0.0, 1.0), oneOf(random, {2.4, 1.0 / 2.4, 2.2, 1.0 / 2.2})};
        case 2:
            return withExponent(nearOne(random, -23, -2));
        case 3:
            return withExponent(spread(random, -largestExponent, largestExponent));
        case 4: {
            const double end = oneOf(random, {0.8671875, 1.1171875, 0x1.6a09e667f3bcdp+0, 1.0});
            const double base = end * nearOne(random, -23, -9);
            return withExponent(std::ldexp(base, random.below(9) - 4));
        }
        default:
            return {static_cast<double>(2 + random.below(30)), static_cast<double>(random.below(41) - 20)};
    }
}
Arguments powerArgumentsInDouble(RandomNumbers& random, int kind) {
    return powerArguments(random, kind, 1021.0);
}
Arguments powerArgumentsInFloat(RandomNumbers& random, int kind) {
    const Arguments x = powerArguments(random, kind, 125.0);
    return {static_cast<float>(x.a), static_cast<float>(x.b)};
}

// Angles: near the origin, of all magnitudes, and next to multiples of pi/2 and pi/4.
Arguments angles(RandomNumbers& random, int kind) {
    if (kind % 4 == 0) return {random.uniform(-kPi, kPi), 0.0};
    if (kind % 4 == 1) return {signedSpread(random, -60, 20), 0.0};
    const int largest = 1 << (1 + random.below(20));
    const double multiple = (1 + random.below(largest)) * (kPi / 4.0);
    return {kind % 4 == 2 ? multiple : -multiple * nearOne(random, -52, -20), 0.0};
}

Arguments exponents(RandomNumbers& random, int kind) {
    switch (kind % 3) {
        case 0:
            return {random.uniform(-10.0, 1.0), 0.0};
        case 1:
            return {random.uniform(-708.0, 709.0), 0.0};
        default:
            return {signedSpread(random, -60, 9), 0.0};
    }
}

double atan2InFloat(double y, double x) { return atan2Of(static_cast<float>(y), static_cast<float>(x)); }
double powInFloat(double x, double y) { return powOf(static_cast<float>(x), static_cast<float>(y)); }

// Random arguments, and the special ones in all pairs; made without functions of the C library that round.
template <class S>
std::vector<std::array<S, 2>> mixedArguments() {
    const double least = std::numeric_limits<S>::min();
    const double largest = std::numeric_limits<S>::max();
    const double special[] = {0.0,  -0.0,  1.0,  -1.0,    2.0,          0.5,           least, -least,
                              kInf, -kInf, kNan, largest, 0.25 * least, -0.25 * least, 3.0,   1e-30};
    std::vector<std::array<S, 2>> r;
    for (double a : special)
        for (double b : special) r.push_back({static_cast<S>(a), static_cast<S>(b)});
    RandomNumbers random(1);
    for (int i = 0; i < 1 << 16; i++) {
        const double a = (i % 4 == 0 ? -1.0 : 1.0) * spread(random, -30, 30);
        const double b = i % 2 == 0 ? random.uniform(-4.0, 4.0) : signedSpread(random, -30, 30);
        r.push_back({static_cast<S>(a), static_cast<S>(b)});
    }
    return r;
}

// FNV-1a over the bits.
class Hash {
  public:
    template <class S>
    void add(S value) {
        for (std::byte b : std::bit_cast<std::array<std::byte, sizeof(S)>>(value))
            hash_ = (hash_ ^ static_cast<uint64_t>(b)) * 0x100000001b3u;
    }
    uint64_t value() const { return hash_; }

  private:
    uint64_t hash_ = 0xcbf29ce484222325u;
};

template <class S>
uint64_t scalarHash() {
    Hash hash;
    for (auto [a, b] : mixedArguments<S>()) {
        hash.add(atan2Of(a, b));
        hash.add(powOf(a, b));
        hash.add(ElementaryFunctions<S>::sinOf(b));
        hash.add(ElementaryFunctions<S>::cosOf(b));
    }
    return hash.value();
}

template <class L>
uint64_t laneHash() {
    using S = typename L::Scalar;
    const auto arguments = mixedArguments<S>();
    Hash hash;
    forEachLaneGroup<L::size>(arguments.size(), [&](size_t first, int active) {
        const auto at = [&](int i) {
            return arguments[first + static_cast<size_t>(std::min(i, active - 1))];
        };
        const L a = L::generate([&](int i) { return at(i)[0]; });
        const L b = L::generate([&](int i) { return at(i)[1]; });
        const L angle = atan2Of(a, b), power = powOf(a, b), sine = ElementaryFunctions<L>::sinOf(b),
                cosine = ElementaryFunctions<L>::cosOf(b);
        for (int i = 0; i < active; i++) {
            hash.add(angle[i]);
            hash.add(power[i]);
            hash.add(sine[i]);
            hash.add(cosine[i]);
        }
    });
    return hash.value();
}

// Two neighbours narrowed to float and widened again.
[[gnu::noinline]] void addNarrowed(const double* from, double* to) {
    const float a = static_cast<float>(from[0]), b = static_cast<float>(from[1]);
    to[0] = 1.0 + a;
    to[1] = 1.0 + b;
}

}  // namespace

// g++ 12 drops both conversions from -O2 on where it makes vectors of straight-line code
// (-ftree-slp-vectorize): every float of this project would sometimes be a double. The numeric flags switch
// that off.
TEST_CASE("TheCompilerKeepsTheRoundingOfNeighbours") {
    volatile double source = 0.1;  // so that nothing is computed by the compiler itself
    const double from[2] = {source, 3.0 * source};
    double to[2];
    addNarrowed(from, to);
    CHECK(to[0] == 1.0 + 0x1.99999ap-4);
    CHECK(to[1] == 1.0 + 0x1.333334p-2);
}

TEST_CASE("Atan2IsWithinItsBound") {
    checkBound("atan2, double",
               worstError(atan2Of<double>, mpfr_atan2, kDouble, planeVectorInDouble, kCases / 2),
               kAtan2ErrorUlp);
    checkBound("atan2, float", worstError(atan2InFloat, mpfr_atan2, kSingle, planeVectorInFloat, kCases / 2),
               kFloatErrorUlp);
}

TEST_CASE("PowIsWithinItsBound") {
    checkBound("pow, double",
               worstError(powOf<double>, mpfr_pow, kDouble, powerArgumentsInDouble, kCases / 2),
               kPowErrorUlp);
    checkBound("pow, float", worstError(powInFloat, mpfr_pow, kSingle, powerArgumentsInFloat, kCases / 2),
               kFloatErrorUlp);
}

TEST_CASE("Log2AndExp2InDoubleAreWithinTheirBounds") {
    const Computed logarithm = [](double a, double) { return log2InDouble(a); };
    const Computed exponential = [](double a, double) { return exp2InDouble(a); };
    const auto exactLog2 = [](mpfr_ptr r, mpfr_srcptr a, mpfr_srcptr, mpfr_rnd_t m) {
        return mpfr_log2(r, a, m);
    };
    const auto exactExp2 = [](mpfr_ptr r, mpfr_srcptr a, mpfr_srcptr, mpfr_rnd_t m) {
        return mpfr_exp2(r, a, m);
    };
    // Numbers of the widest formats, near 1, and next to the ends of the intervals of the method.
    const Generator numbers = [](RandomNumbers& random, int kind) {
        if (kind % 3 == 0) return Arguments{spread(random, -423, 401), 0.0};
        if (kind % 3 == 1) return Arguments{nearOne(random, -24, -1), 0.0};
        const double end =
            oneOf(random, {0.8671875, 1.1171875, 0x1.6a09e667f3bcdp+0, 0x1.6a09e667f3bcdp-1, 1.25});
        return Arguments{end * nearOne(random, -50, -9), 0.0};
    };
    const Generator powers = [](RandomNumbers& random, int kind) {
        if (kind % 3 == 0) return Arguments{random.uniform(-1000.0, 1000.0), 0.0};
        if (kind % 3 == 1) return Arguments{signedSpread(random, -60, 9), 0.0};
        return Arguments{random.below(1000) - 500 + 0.5 + signedSpread(random, -45, -2), 0.0};
    };
    // An ulp is at most 2^-52 of a number.
    checkBound("log2 in double", worstError(logarithm, exactLog2, kDouble, numbers),
               kLog2InDoubleError * 0x1p52);
    checkBound("exp2 in double", worstError(exponential, exactExp2, kDouble, powers),
               kExp2InDoubleError * 0x1p52);
    for (int k = -423; k <= 423; k++) {
        CHECK(log2InDouble(std::ldexp(1.0, k)) == k);
        CHECK(exp2InDouble(static_cast<double>(k)) == std::ldexp(1.0, k));
    }
    CHECK(log2InDouble(0.0) == -kInf);
    CHECK(log2InDouble(-0.0) == -kInf);
    CHECK(log2InDouble(kInf) == kInf);
    CHECK(std::isnan(log2InDouble(-1.0)));
    CHECK(std::isnan(log2InDouble(-kInf)));
    CHECK(std::isnan(log2InDouble(kNan)));
    CHECK(exp2InDouble(kInf) == kInf);
    CHECK(exp2InDouble(-kInf) == 0.0);
    CHECK(exp2InDouble(1e6) == 0x1p1000);
    CHECK(exp2InDouble(-1e6) == 0x1p-1000);
    CHECK(std::isnan(exp2InDouble(kNan)));
    const Lanes<double, 4> some = Lanes<double, 4>::generate([](int i) { return 0.3 + i; });
    for (int i = 0; i < 4; i++) {
        CHECK(log2InDouble(some)[i] == log2InDouble(some[i]));
        CHECK(exp2InDouble(some)[i] == exp2InDouble(some[i]));
    }
}

TEST_CASE("SinCosAndExpAreWithinTheirBounds") {
    const Computed sine = [](double a, double) { return sinOf(a); };
    const Computed cosine = [](double a, double) { return cosOf(a); };
    const Computed exponential = [](double a, double) { return expOf(a); };
    checkBound("sin", worstError(sine, exactSin, kDouble, angles), kSinErrorUlp);
    checkBound("cos", worstError(cosine, exactCos, kDouble, angles), kCosErrorUlp);
    checkBound("exp", worstError(exponential, exactExp, kDouble, exponents), kExpErrorUlp);
}

TEST_CASE("AResultOneUnitOffIsBeyondEveryBound") {
    const Computed off = [](double y, double x) { return std::nextafter(atan2Of(y, x), 4.0); };
    CHECK(worstError(off, mpfr_atan2, kDouble, planeVectorInDouble, kBlock).ulps > 1.0);
}

// Arguments whose results are nearer to halfway between two floats than those of all others: found by trying all.
TEST_CASE("HardArgumentsAreWithinTheBounds") {
    ErrorMeter meter;
    for (double s : {1.0, -1.0}) {
        const double t = s * 0x1.1ad646p-4;
        CHECK(meter.ulps(mpfr_atan2, {t, 1.0}, atan2InFloat(t, 1.0), kSingle) <= kFloatErrorUlp);
        const double angle = s * 0x1.33333p13;
        CHECK(meter.ulps(exactSin, {angle, 0.0}, ElementaryFunctions<float>::sinOf(static_cast<float>(angle)),
                         kSingle) <= kFloatErrorUlp);
        CHECK(meter.ulps(exactSin, {angle, 0.0}, sinOf(angle), kDouble) <= kSinErrorUlp);
    }
    for (double x : {0x1.853a6ep-9, -0x1.e7526ep-6})
        CHECK(meter.ulps(mpfr_pow, {2.0, x}, powInFloat(2.0, x), kSingle) <= kFloatErrorUlp);
}

TEST_CASE("ExactPowersAreExact") {
    for (int base = 1; base <= 10; base++) {
        double product = 1.0;
        for (int k = 0; k <= 15; k++, product *= base) {
            CHECK(powOf(static_cast<double>(base), static_cast<double>(k)) == product);
            if (product < 0x1p24) CHECK(powOf(static_cast<float>(base), static_cast<float>(k)) == product);
        }
    }
    for (int k = -1022; k <= 1023; k++) CHECK(powOf(2.0, static_cast<double>(k)) == std::ldexp(1.0, k));
    for (int k = -126; k <= 127; k++) CHECK(powOf(2.f, static_cast<float>(k)) == std::ldexp(1.f, k));
}

TEST_CASE_TEMPLATE("Atan2SpecialCases", S, float, double) {
    const S inf = static_cast<S>(kInf), zero = 0, one = 1, pi = static_cast<S>(kPi);
    const S least = std::numeric_limits<S>::min();
    for (S z : {zero, -zero}) {
        CHECK(std::bit_cast<std::array<std::byte, sizeof(S)>>(atan2Of(z, zero)) ==
              std::array<std::byte, sizeof(S)>{});
        CHECK(atan2Of(z, -zero) == zero);
        CHECK(atan2Of(z, one) == zero);
        CHECK(atan2Of(z, -one) == pi);
        CHECK(atan2Of(one, z) == pi / 2);
        CHECK(atan2Of(-one, z) == -pi / 2);
    }
    CHECK(atan2Of(one, one) == pi / 4);
    CHECK(atan2Of(inf, one) == pi / 2);
    CHECK(atan2Of(-inf, -one) == -pi / 2);
    CHECK(atan2Of(one, inf) == zero);
    CHECK(atan2Of(-one, -inf) == -pi);
    CHECK(atan2Of(inf, inf) == pi / 4);
    CHECK(atan2Of(-inf, -inf) == static_cast<S>(-0.75 * kPi));
    CHECK(atan2Of(least, one) == (sizeof(S) == 4 ? least : zero));
    CHECK(atan2Of(least, S(1.5)) == zero);
    CHECK(atan2Of(least / 2, -one) == pi);
    CHECK(std::isnan(atan2Of(static_cast<S>(kNan), one)));
    CHECK(std::isnan(atan2Of(one, static_cast<S>(kNan))));
}

TEST_CASE_TEMPLATE("PowSpecialCases", S, float, double) {
    const S inf = static_cast<S>(kInf), nan = static_cast<S>(kNan), zero = 0, one = 1, two = 2, half = S(0.5);
    const S least = std::numeric_limits<S>::min();
    for (S x : {zero, -zero, half, one, two, inf, least / 2}) CHECK(powOf(x, zero) == one);
    for (S x : {zero, -zero, least / 2}) {
        CHECK(powOf(x, half) == zero);
        CHECK(powOf(x, -half) == inf);
        CHECK(powOf(x, inf) == zero);
    }
    CHECK(powOf(inf, half) == inf);
    CHECK(powOf(inf, -half) == zero);
    CHECK(powOf(two, inf) == inf);
    CHECK(powOf(two, -inf) == zero);
    CHECK(powOf(half, inf) == zero);
    CHECK(powOf(one, inf) == one);
    CHECK(powOf(two, least / 2) == one);
    for (S x : {-one, -inf, -least}) CHECK(std::isnan(powOf(x, two)));
    CHECK(std::isnan(powOf(nan, zero)));
    CHECK(std::isnan(powOf(one, nan)));
    // The ends of the range.
    const S lowest = std::numeric_limits<S>::min_exponent - 1, beyond = std::numeric_limits<S>::max_exponent;
    CHECK(powOf(two, lowest) == least);
    CHECK(powOf(two, lowest - S(0.001)) == zero);
    CHECK(powOf(two, beyond) == inf);
    CHECK(powOf(two, beyond - S(0.001)) < inf);
    CHECK(powOf(std::numeric_limits<S>::max(), one) == std::numeric_limits<S>::max());
}

TEST_CASE("SinCosAndExpSpecialCases") {
    CHECK(sinOf(0.0) == 0.0);
    CHECK(cosOf(0.0) == 1.0);
    CHECK(expOf(0.0) == 1.0);
    CHECK(expOf(kInf) == kInf);
    CHECK(expOf(709.79) == kInf);
    CHECK(expOf(709.78) < kInf);
    CHECK(expOf(-708.4) == 0.0);
    CHECK(expOf(-708.39) > 0.0);
    CHECK(expOf(-kInf) == 0.0);
    CHECK(std::isnan(expOf(kNan)));
    for (double bad : {std::nextafter(kMaxAngle, kInf), -kInf, kNan}) {
        CHECK_THROWS_AS(sinOf(bad), PreconditionError);
        CHECK_THROWS_AS(cosOf(bad), PreconditionError);
    }
    for (double x = -40.0; x < 40.0; x += kPi / 16.0) {
        CHECK(sinOf(-x) == -sinOf(x));
        CHECK(cosOf(-x) == cosOf(x));
    }
}

TEST_CASE("ResultsHaveTheSameBitsEverywhere") {
    CHECK(scalarHash<float>() == 14410543788529588957u);
    CHECK(scalarHash<double>() == 8849395424656536945u);
    RandomNumbers random(1);
    Hash hash;
    for (int i = 0; i < 1 << 16; i++) {
        const double angle = angles(random, i).a;
        hash.add(sinOf(angle));
        hash.add(cosOf(angle));
        hash.add(expOf(exponents(random, i).a));
    }
    CHECK(hash.value() == 3225495395883808657u);
}

TEST_CASE_TEMPLATE("LanesGiveTheBitsOfTheScalar", L, Lanes<float, 1>, Lanes<float, 2>, Lanes<float, 4>,
                   Lanes<float, 16>, Lanes<double, 1>, Lanes<double, 2>, Lanes<double, 4>,
                   Lanes<double, 16>) {
    CHECK(laneHash<L>() == scalarHash<typename L::Scalar>());
}

// Lanes take a shorter text where every lane is a fraction with a plain exponent: here all are, on and around
// the limits.
TEST_CASE_TEMPLATE("LanesOfFractionsGiveTheBitsOfTheScalarPower", L, Lanes<float, 4>, Lanes<float, 16>,
                   Lanes<double, 2>, Lanes<double, 8>) {
    using S = typename L::Scalar;
    constexpr S kSmallest = std::numeric_limits<S>::min(), kHalfStep = std::numeric_limits<S>::epsilon() / 2;
    const S exponents[] = {S(0x1p70), S(1000), S(150),   S(126),     S(32),      S(1),
                           S(0.5),    S(1e-3), S(1e-20), S(0x1p-99), S(0x1p-100)};
    const S edges[] = {S(0), -S(0), kSmallest / 2, kSmallest, 2 * kSmallest, S(0.5), S(1) - kHalfStep, S(1)};
    RandomNumbers random(3);
    for (const S exponent : exponents)
        for (int group = 0; group < 256; group++) {
            const L x = L::generate([&](int i) {
                const S fraction = static_cast<S>(random.uniform(0.0, 1.0));
                return group % 2 == 0 ? fraction : edges[(group / 2 + i) % std::ssize(edges)];
            });
            const L power = powOf(x, L(static_cast<double>(exponent)));
            for (int i = 0; i < L::size; i++) {
                const S scalar = powOf(x[i], exponent), lane = power[i];
                CHECK(std::memcmp(&scalar, &lane, sizeof(S)) == 0);
            }
        }
}

TEST_CASE_TEMPLATE("FlushingSubnormalsChangesNoBit", S, float, double) {
    const uint64_t kept = scalarHash<S>();
    const uint64_t keptInLanes = laneHash<Lanes<S, 4>>();
    const FlushToZeroScope flush;
    CHECK(scalarHash<S>() == kept);
    CHECK(laneHash<Lanes<S, 4>>() == keptInLanes);
}

TEST_CASE("EmulatedFormatsRoundOnce") {
    using R = Rounded<kFp16>;
    using F = Rounded<kFp32>;
    using RL = Rounded<kFp16, Lanes<double, 8>>;
    constexpr Precision kHalf{kFp16.significandBits, kFp16.minExponent, kFp16.maxExponent};
    const auto halves = [](const Generator& generator) {
        return [=](RandomNumbers& random, int kind) {
            const Arguments x = generator(random, kind);
            return Arguments{R(x.a).v + 0.0, R(x.b).v + 0.0};  // MPFR would see the sign of a zero
        };
    };
    const Computed angleInHalf = [](double y, double x) { return atan2Of(R(y), R(x)).v; };
    const Computed powerInHalf = [](double x, double y) { return powOf(R(x), R(y)).v; };
    CHECK(worstError(angleInHalf, mpfr_atan2, kHalf, halves(planeVectorInFloat), 1 << 16).ulps <=
          kOtherErrorUlp);
    CHECK(worstError(powerInHalf, mpfr_pow, kHalf, halves(powerArgumentsInFloat), 1 << 16).ulps <=
          kOtherErrorUlp);
    // A subnormal of a format that keeps them is a number like any other.
    CHECK(powOf(R(0x1p-24), R(0.5)).v == 0x1p-12);
    CHECK(atan2Of(R(0x1p-20), R(1.0)).v == 0x1p-20);

    RandomNumbers random(5);
    for (int i = 0; i < 4096; i++) {
        const Arguments v = planeVectorInFloat(random, i), p = powerArgumentsInFloat(random, i);
        CHECK(atan2Of(F(v.a), F(v.b)).v == atan2InFloat(v.a, v.b));
        const double power = powInFloat(p.a, p.b);
        if (power > 0.0) CHECK(powOf(F(p.a), F(p.b)).v == power);
        CHECK(powOf(RL(p.a), RL(p.b)).v[i % 8] == powOf(R(p.a), R(p.b)).v);
    }
}

namespace {
template <class T>
struct KernelUser {
#include "numeric/kernel_scope.inc"
    real lobe(real x, real y) { return powOf(x, y) + atan2Of(y, x); }
};
}  // namespace

TEST_CASE("KernelTextsReachTheFunctionsInEveryNumberType") {
    const double truth = KernelUser<Truth>{}.lobe(Truth(0.75), Truth(2.5)).toDouble();
    const double inDouble = KernelUser<double>{}.lobe(0.75, 2.5);
    CHECK(std::abs(inDouble - truth) < 0x1p-51);
    CHECK(KernelUser<Lanes<double, 4>>{}.lobe(Lanes<double, 4>(0.75), Lanes<double, 4>(2.5))[3] == inDouble);
    const float inFloat = KernelUser<float>{}.lobe(0.75f, 2.5f);
    CHECK(std::abs(inFloat - truth) < 0x1p-22);
    CHECK(KernelUser<Rounded<kFp32>>{}.lobe(Rounded<kFp32>(0.75), Rounded<kFp32>(2.5)).v == inFloat);
    CHECK(std::isnan(powOf(Truth(-1.0), Truth(2.0)).toDouble()));
    CHECK(atan2Of(Truth(-0.0), Truth(-1.0)) > Truth(0.0));
}
