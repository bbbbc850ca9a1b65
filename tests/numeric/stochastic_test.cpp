// Stochastic rounding against MPFR with draws of its own, and what draws must be: without bias, and the same whatever
// computes next to them.
#include <doctest/doctest.h>
#include <mpfr.h>

#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "numeric/arithmetic.h"
#include "numeric/emulated.h"
#include "numeric/parallel.h"
#include "tests/numeric/format_cases.h"
#include "tests/numeric/mpfr_reference.h"

using namespace etalon;
using namespace etalon::test;

namespace {

using E = Emulated<double>;
using Op = EmulatedOperation;

constexpr int kDrawnBits = 24;

// The definition in numeric/emulated_format.h, once more: an oracle, independent of numeric/random.h.
uint64_t step(uint64_t state) {
    state += 0x9e3779b97f4a7c15u;
    uint64_t z = state;
    z ^= z >> 30;
    z *= 0xbf58476d1ce4e5b9u;
    z ^= z >> 27;
    z *= 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}
uint64_t draw(uint64_t seed, Op operation, uint64_t item, double a, double b) {
    const uint64_t first = step(seed + static_cast<uint64_t>(operation));
    const uint64_t second = step(first ^ item);
    const uint64_t third = step(second ^ std::bit_cast<uint64_t>(a));
    return step(third ^ std::bit_cast<uint64_t>(b)) >> (64 - kDrawnBits);
}
double boundOf(uint64_t draw) { return std::ldexp(static_cast<double>(draw) + 0.5, -kDrawnBits); }

// What MPFR and these draws say of an operation.
class StochasticReference {
  public:
    explicit StochasticReference(Format f) : f_(f), exact_(f) {}

    void setItem(uint64_t item) { item_ = item; }
    double sum(double a, double b) {
        exact_.setOperands(a, b);
        return exact_.binary(mpfr_add, bound(Op::sum, a, b));
    }
    double product(double a, double b) {
        exact_.setOperands(a, b);
        return exact_.binary(mpfr_mul, bound(Op::product, a, b));
    }
    double quotient(double a, double b) {
        if (f_.division == Division::reciprocal) return product(a, reciprocal(b));
        exact_.setOperands(a, b);
        return exact_.binary(mpfr_div, bound(Op::quotient, a, b));
    }
    double root(double a) {
        if (f_.division == Division::reciprocal) return reciprocal(reciprocalRoot(a));
        exact_.setOperands(a, 0.0);
        return exact_.root(bound(Op::root, a, 0.0));
    }
    double converted(double x) {
        return exact_.converted(x, boundOf(draw(f_.seed, Op::conversion, 0, x, 0.0)));
    }

  private:
    double bound(Op operation, double a, double b) const {
        return boundOf(draw(f_.seed, operation, item_, a, b));
    }
    double reciprocal(double a) {
        exact_.setOperands(1.0, a);
        return exact_.binary(mpfr_div, bound(Op::reciprocal, a, 0.0));
    }
    double reciprocalRoot(double a) {
        // MPFR gives +infinity for -0.
        if (a == 0.0) return reciprocal(a);
        exact_.setOperands(a, 0.0);
        return exact_.unary(mpfr_rec_sqrt, bound(Op::reciprocalRoot, a, 0.0));
    }

    Format f_;
    ExactReference exact_;
    uint64_t item_ = 0;
};

std::vector<Format> stochasticFormats() {
    std::vector<Format> formats;
    for (const Division division : {Division::exact, Division::reciprocal})
        for (int bits = 2; bits <= kMaxSignificandBits; bits++)
            for (const Subnormals subnormals : {Subnormals::keep, Subnormals::flush})
                for (const Overflow overflow : {Overflow::infinity, Overflow::saturate}) {
                    Format f{bits, -2 * bits - 7, 3 * bits, Rounding::stochastic, subnormals, overflow};
                    if (bits % 3 == 0) f.minExponent = -400, f.maxExponent = 400;
                    f.division = division;
                    f.seed = formats.size() * 0x123456789u;
                    formats.push_back(f);
                }
    return formats;
}

constexpr size_t kBlock = 2048;
using Numbers = std::array<double, kBlock>;

uint64_t itemOf(size_t i) { return i * i * 0x9e3779b97f4a7c15u; }

// of(a, b) for each pair in lanes; lane i works on the item of its pair.
template <class D, class F>
Numbers computed(const Numbers& a, const Numbers& b, F&& of) {
    constexpr int kWidth = NumberTraits<D>::lanes;
    Numbers results;
    for (size_t i = 0; i < kBlock; i += kWidth) {
        uint64_t keys[kWidth];
        for (size_t k = 0; k < kWidth; k++) keys[k] = itemOf(i + k);
        setEmulatedItems(keys, kWidth);
        Emulated<D> x, y;
        std::memcpy(&x.v, &a[i], sizeof(x.v));
        std::memcpy(&y.v, &b[i], sizeof(y.v));
        const Emulated<D> r = of(x, y);
        std::memcpy(&results[i], &r.v, sizeof(r.v));
    }
    return results;
}

// Results that are not the expected ones, over lanes of several widths.
template <class F>
size_t differences(const Numbers& a, const Numbers& b, const Numbers& expected, F&& of) {
    const EmulatedItemsScope items;
    size_t count = 0;
    for (const Numbers& results :
         {computed<double>(a, b, of), computed<Lanes<double, 1>>(a, b, of),
          computed<Lanes<double, 4>>(a, b, of), computed<Lanes<double, 8>>(a, b, of)})
        for (size_t i = 0; i < kBlock; i++) count += !agree(results[i], expected[i]);
    return count;
}

// An item of which the operation draws the number.
uint64_t itemThatDraws(uint64_t drawn, uint64_t seed, Op operation, double a, double b) {
    for (uint64_t item = 1;; item++)
        if (draw(seed, operation, item, a, b) == drawn) return item;
}

constexpr Format formatWithSeed(Format format, uint64_t seed) {
    format.rounding = Rounding::stochastic;
    format.seed = seed;
    return format;
}

}  // namespace

TEST_CASE("StochasticOperationsEqualMpfrWithTheSameDrawsInAnyLanes") {
    REQUIRE(mpfr_buildopt_tls_p() != 0);
    const std::vector<Format> formats = stochasticFormats();
    const size_t stride = kCases < (size_t{1} << 20) ? 16 : 1;
    std::vector<size_t> found(formats.size());
    parallelFor(formats.size() / stride, 0, [&](size_t index) {
        index *= stride;
        const Format format = formats[index];
        REQUIRE(isSupported(format));
        const EmulatedScope scope(format);
        StochasticReference reference(format);
        FormatCases generator(format, index);
        Numbers a, b, sums, differencesOf, products, quotients, roots;
        for (size_t i = 0; i < kBlock; i++) {
            const auto [x, y] = generator.pair();
            a[i] = x, b[i] = y;
            reference.setItem(itemOf(i));
            sums[i] = reference.sum(x, y);
            differencesOf[i] = reference.sum(x, -y);
            products[i] = reference.product(x, y);
            quotients[i] = reference.quotient(x, y);
            roots[i] = reference.root(x);
            const double any = generator.anyDouble();
            found[index] += !agree(E(any).v, reference.converted(any));
        }
        found[index] += differences(a, b, sums, [](auto x, auto y) { return x + y; });
        found[index] += differences(a, b, differencesOf, [](auto x, auto y) { return x - y; });
        found[index] += differences(a, b, products, [](auto x, auto y) { return x * y; });
        found[index] += differences(a, b, quotients, [](auto x, auto y) { return x / y; });
        found[index] += differences(a, b, roots, [](auto x, auto) { return squareRoot(x); });
    });
    for (size_t i = 0; i < formats.size(); i++) {
        CAPTURE(arithmeticName(Arithmetic(formats[i])));
        CHECK(found[i] == 0);
    }
}

TEST_CASE("StochasticElementaryFunctionsAreTheSameInAnyLanes") {
    for (const Power power : {Power::exact, Power::exp2log2}) {
        Format format = formatWithSeed(kFp16, 5);
        format.power = power;
        const EmulatedScope scope(format);
        FormatCases generator(format, 9);
        Numbers a, b;
        for (size_t i = 0; i < kBlock; i++) {
            const auto [x, y] = generator.pair();
            a[i] = x, b[i] = y;
        }
        const auto compare = [&](auto of) {
            const EmulatedItemsScope items;
            CHECK(differences(a, b, computed<double>(a, b, of), of) == 0);
        };
        compare([](auto x, auto y) { return powOf(x, y); });
        compare([](auto x, auto y) { return atan2Of(x, y); });
        compare([](auto x, auto) { return ElementaryFunctions<decltype(x)>::sinOf(x); });
        compare([](auto x, auto) { return ElementaryFunctions<decltype(x)>::cosOf(x); });
    }
}

// Where double alone would put the exact value on the bound of the draw, from above: the larger magnitude is right.
TEST_CASE("WhatDoubleRoundsOntoTheBoundOfADrawIsRoundedByTheExactValue") {
    constexpr Format kFormat = formatWithSeed(kFp32, 1);
    const EmulatedScope scope(kFormat);
    const EmulatedItemsScope items;
    StochasticReference reference(kFormat);
    // The draw whose bound is the double, in (1, 2); -1 if none is.
    const auto drawnAt = [](double x) {
        const double place = std::ldexp(x, 23) - std::floor(std::ldexp(x, 23));
        const double whole = std::ldexp(place, kDrawnBits) - 0.5;
        return whole >= 0.0 && whole == std::floor(whole) ? static_cast<int64_t>(whole) : -1;
    };
    const auto check = [&](Op operation, double a, double b, double inDouble, auto&& of) {
        CAPTURE(static_cast<int>(operation));
        const int64_t drawn = drawnAt(std::abs(inDouble));
        REQUIRE(drawn >= 0);
        const uint64_t item = itemThatDraws(static_cast<uint64_t>(drawn), kFormat.seed, operation, a, b);
        setEmulatedItems(&item, 1);
        reference.setItem(item);
        const double result = of(E(a), E(b)).v;
        CHECK(std::abs(result) > std::abs(inDouble));
        CHECK(result == (operation == Op::sum        ? reference.sum(a, b)
                         : operation == Op::quotient ? reference.quotient(a, b)
                                                     : reference.root(a)));
    };

    const double small = std::ldexp(1.0 + 0x1p-23, -48);
    check(Op::sum, 1.0, small, 1.0 + small, [](E x, E y) { return x + y; });

    // The first numbers whose quotient and root are such, from above.
    mpfr_t exact;
    mpfr_init2(exact, 200);
    const auto isBelowExact = [&](double x) { return mpfr_cmp_d(exact, x) > 0; };
    double a = 1.5, b = 1.0;
    while (true) {
        b += 0x1p-23;
        mpfr_set_d(exact, a, MPFR_RNDN);
        mpfr_div_d(exact, exact, b, MPFR_RNDN);
        if (drawnAt(a / b) >= 0 && isBelowExact(a / b)) break;
    }
    check(Op::quotient, a, b, a / b, [](E x, E y) { return x / y; });
    check(Op::quotient, a, -b, a / -b, [](E x, E y) { return x / y; });
    check(Op::quotient, -a, -b, a / b, [](E x, E y) { return x / y; });
    a = 1.0;
    while (true) {
        a += 0x1p-23;
        mpfr_set_d(exact, a, MPFR_RNDN);
        mpfr_sqrt(exact, exact, MPFR_RNDN);
        if (drawnAt(std::sqrt(a)) >= 0 && isBelowExact(std::sqrt(a))) break;
    }
    check(Op::root, a, 0.0, std::sqrt(a), [](E x, E) { return squareRoot(x); });
    mpfr_clear(exact);
}

// Where double alone would put 1 / sqrt(a) on the bound of the draw or beyond it: its two roundings do either.
TEST_CASE("ReciprocalRootsAreRoundedByTheExactValue") {
    Format format = formatWithSeed(kFp32, 1);
    format.division = Division::reciprocal;
    const EmulatedScope scope(format);
    const EmulatedItemsScope items;
    StochasticReference reference(format);
    constexpr int kWanted = 4, kBoundExponent = -49;  // bounds in (1/2, 1) are odd multiples of 2^-49
    int onBound = 0, beyondBound = 0;
    mpfr_t exact;
    mpfr_init2(exact, 200);
    for (double a = 1.0 + 0x1p-23; a < 4.0 && (onBound < kWanted || beyondBound < kWanted); a += 0x1p-23) {
        const double inDouble = 1.0 / std::sqrt(a);
        const auto half = static_cast<int64_t>(std::floor(std::ldexp(inDouble, -kBoundExponent - 1)));
        const double bound = std::ldexp(static_cast<double>(2 * half + 1), kBoundExponent);
        if (std::abs(inDouble - bound) > 0x1p-52) continue;
        mpfr_set_d(exact, a, MPFR_RNDN);
        mpfr_rec_sqrt(exact, exact, MPFR_RNDN);
        const bool isAbove = mpfr_cmp_d(exact, bound) > 0;
        if (isAbove == (inDouble > bound) && inDouble != bound) continue;
        int& count = inDouble == bound ? onBound : beyondBound;
        if (count++ >= kWanted) continue;
        const uint64_t drawn = static_cast<uint64_t>(half) & ((1u << kDrawnBits) - 1);
        const uint64_t item = itemThatDraws(drawn, format.seed, Op::reciprocalRoot, a, 0.0);
        setEmulatedItems(&item, 1);
        reference.setItem(item);
        CAPTURE(a);
        CHECK(squareRoot(E(a)).v == reference.root(a));
    }
    CHECK(onBound >= kWanted);
    CHECK(beyondBound >= kWanted);
    mpfr_clear(exact);
}

TEST_CASE("TheMeanOfManyDrawsIsTheExactResult") {
    constexpr int kDraws = 1 << 16;
    constexpr double kBias = 0x1p-25;    // of a quantum: half a step of the draws
    constexpr double kDeviations = 5.0;  // of the mean of so many draws
    const auto check = [](Format format, double a, double b, double exact, auto&& of) {
        const EmulatedScope scope(format);
        const EmulatedItemsScope items;
        const int exponent = std::max(std::ilogb(exact), format.minExponent);
        const double quantum = std::ldexp(epsilonOf(format), exponent);
        double up = 0.0;
        int outside = 0;
        for (uint64_t item = 0; item < kDraws; item++) {
            setEmulatedItems(&item, 1);
            const double excess = (of(E::ofRepresentable(a), E::ofRepresentable(b)).v - exact) / quantum;
            outside += std::abs(excess) >= 1.0;
            up += excess;
        }
        const double fraction = exact / quantum - std::floor(exact / quantum);
        const double deviation = std::sqrt(fraction * (1.0 - fraction) / kDraws);
        CAPTURE(a);
        CAPTURE(b);
        CHECK(outside == 0);
        CHECK(std::abs(up / kDraws) <= kBias + kDeviations * deviation);
    };
    for (const uint64_t seed : {0, 1, 77}) {
        const Format half = formatWithSeed(kFp16, seed), old = formatWithSeed(kFp24R300, seed);
        for (int k = 1; k < 32; k += 3) {
            const double x = 1.0 + k * 0x1p-10;
            check(half, 1.0, k * 0x1p-15, 1.0 + k * 0x1p-15, [](E a, E b) { return a + b; });
            check(half, -1.0, -k * 0x1p-15, -1.0 - k * 0x1p-15, [](E a, E b) { return a + b; });
            check(half, x, x, x * x, [](E a, E b) { return a * b; });
            check(half, 1.0, x, 1.0 / x, [](E a, E b) { return a / b; });
            check(half, x, 0.0, std::sqrt(x), [](E a, E) { return squareRoot(a); });
            check(half, k * 0x1p-24, 0.375, k * 0x1p-24 * 0.375, [](E a, E b) { return a * b; });
            check(old, x, 3.0, x / 3.0, [](E a, E b) { return a / b; });
        }
    }
}

TEST_CASE("SeedsItemsAndOperationsDrawIndependently") {
    const EmulatedItemsScope items;
    // The same sum, which is up with probability 1/2, under pairs of keys: they agree in half of the cases.
    constexpr int kDraws = 1 << 14;
    int seeds = 0, neighbours = 0, operands = 0, operations = 0;
    for (uint64_t item = 0; item < kDraws; item++) {
        const uint64_t next = item + 1;
        const auto isUp = [](uint64_t seed, const uint64_t& key, auto&& of) {
            const EmulatedScope scope(formatWithSeed(kFp16, seed));
            setEmulatedItems(&key, 1);
            return of();
        };
        const auto sum = [] { return (E::ofRepresentable(1.0) + E::ofRepresentable(0x1p-11)).v > 1.0; };
        const auto other = [] { return (E::ofRepresentable(2.0) + E::ofRepresentable(0x1p-10)).v > 2.0; };
        const auto product = [] {
            return (E::ofRepresentable(1.5) * E::ofRepresentable(1.0 + 0x1p-10)).v > 1.5 + 0x1p-10;
        };
        const bool one = isUp(3, item, sum);
        seeds += one == isUp(4, item, sum);
        neighbours += one == isUp(3, next, sum);
        operands += one == isUp(3, item, other);
        operations += one == isUp(3, item, product);
    }
    const double deviation = 0.5 * std::sqrt(kDraws);
    for (const int count : {seeds, neighbours, operands, operations})
        CHECK(std::abs(count - kDraws / 2) < 5.0 * deviation);
}

// 4096 terms of 1/16 + 2^-9 in 8 bits: rounded to nearest the sum stays at 32.
TEST_CASE("SumsWithTheTermInTheKeyDoNotStandStill") {
    constexpr int kTerms = 4096, kSums = 64;
    constexpr double kTerm = 0x1p-4 + 0x1p-9;
    {
        const EmulatedScope scope(kBf16);
        E sum(0.0);
        for (int i = 0; i < kTerms; i++) sum = sum + E(kTerm);
        CHECK(sum.v == 32.0);
    }
    const EmulatedScope scope(formatWithSeed(kBf16, 11));
    const EmulatedItemsScope items;
    double mean = 0.0;
    for (uint64_t k = 0; k < kSums; k++) {
        E sum(0.0);
        for (uint64_t i = 0; i < kTerms; i++) {
            const uint64_t key = k << 32 | i;
            setEmulatedItems(&key, 1);
            sum = sum + E(kTerm);
        }
        mean += sum.v / kSums;
    }
    // Below 512 the quantum is at most 2; a sum of so many draws deviates by less than 0.5 * 2 * sqrt(terms).
    CHECK(std::abs(mean - kTerms * kTerm) < 5.0 * std::sqrt(kTerms) / std::sqrt(kSums));
}

TEST_CASE("ItemsOfAThreadAreSetAndEndWithTheirScope") {
    const auto key = [](int lane) { return emulatedItems.keys[static_cast<size_t>(lane)]; };
    const uint64_t keys[] = {7, 8, 9};
    {
        const EmulatedItemsScope scope;
        setEmulatedItems(keys, 3);
        CHECK(key(0) == 7);
        CHECK(key(2) == 9);
        CHECK(key(3) == 0);
        for (const int threads : {1, 3}) {
            std::atomic<int> stale = 0;
            parallelFor(64, threads, [&](size_t) {
                stale += key(0) != 0 || key(2) != 0;
                setEmulatedItems(keys, 3);
                parallelFor(2, 1, [&](size_t) { stale += key(1) != 0; });
                stale += key(1) != 8;
            });
            CHECK(stale == 0);
            CHECK(key(0) == 7);
        }
    }
    CHECK(key(0) == 0);
}

TEST_CASE("ThreadsAndTheOrderOfWorkChangeNoDraw") {
    constexpr size_t kPixels = 4096;
    const EmulatedScope scope(formatWithSeed(kFp16, 23));
    const auto shade = [](size_t pixel) {
        const uint64_t key = pixel;
        setEmulatedItems(&key, 1);
        const E x(0.3 + 1e-4 * static_cast<double>(pixel % 7));
        return (squareRoot(x) * x + x / E(3.0)).v;
    };
    std::vector<double> once(kPixels), again(kPixels);
    parallelFor(kPixels, 1, [&](size_t i) { once[i] = shade(i); });
    for (const int threads : {2, 5}) {
        // Some pixels twice, in another order.
        parallelFor(kPixels, threads, [&](size_t i) {
            const size_t pixel = kPixels - 1 - i;
            if (i % 3 == 0) shade(i);
            again[pixel] = shade(pixel);
        });
        CHECK(once == again);
    }
}
