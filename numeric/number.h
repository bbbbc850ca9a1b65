// Number<T>: how host code reads and writes numbers of any type of the kernel texts, in lanes or not.
#pragma once

#include <algorithm>
#include <type_traits>

#include "numeric/kernel_types.h"

namespace etalon {

// Lane i as a double (exact for every format; Truth is rounded once).
template <class T>
double numberLane(const T& a, int i) {
    if constexpr (requires { a.toDouble(); })
        return a.toDouble();
    else if constexpr (requires { a[i]; })
        return static_cast<double>(a[i]);
    else if constexpr (requires { a.v[i]; })
        return a.v[i];
    else if constexpr (requires { a.v; })
        return a.v;
    else
        return static_cast<double>(a);
}

template <class T>
struct Number {
    static constexpr int lanes = NumberTraits<T>::lanes;
    using Integer = typename NumberTraits<T>::Integer;
    // The scalar that images and results hold: float for float, fp16 and bf16, else double; exact for every
    // format, truth is rounded once.
    using Stored = typename NumberTraits<T>::Stored;
    // The scalar that holds each lane exactly between the steps of a sum: Stored, but Truth keeps itself.
    using Kept = std::conditional_t<lanes == 1, T, Stored>;
    // Whether operations are instructions: float, double and their lanes.
    static constexpr bool isNative = std::is_same_v<T, Stored> || std::is_same_v<T, Lanes<Stored, lanes>>;

    // The number whose lane i is f(i) (a double), rounded once to T.
    template <class F>
    static T generate(F&& f) {
        if constexpr (lanes == 1)
            return static_cast<T>(f(0));
        else if constexpr (requires { T::generate(f); })
            return T::generate(f);
        else
            return T(Lanes<double, lanes>::generate(f));
    }

    // One scalar per lane, contiguous from `from`, each rounded once to T.
    template <class S>
    static T load(const S* from) {
        if constexpr (lanes == 1)
            return static_cast<T>(static_cast<double>(*from));
        else if constexpr (std::is_same_v<T, Lanes<S, lanes>>)
            return T::load(from);
        else if constexpr (std::is_same_v<T, Lanes<float, lanes>>)
            return inHalves([&](int half) { return convertLanes<float>(Half::load(from + half)); });
        else if constexpr (std::is_constructible_v<T, Lanes<S, lanes>>)
            return T(Lanes<S, lanes>::load(from));
        else
            return T(convertLanes<double>(Lanes<S, lanes>::load(from)));
    }
    // The first `active` (at least one) of them; the lanes behind repeat the last one.
    template <class S>
    static T load(const S* from, int active) {
        if (active == lanes) return load(from);
        return generate([&](int i) { return static_cast<double>(from[std::min(i, active - 1)]); });
    }
    // The first `active` lanes, each rounded once to S; touches nothing behind them.
    template <class S>
    static void store(const T& value, S* to, int active = lanes) {
        if constexpr (std::is_same_v<T, Lanes<S, lanes>>)
            storeActive(value, to, active);
        else if constexpr (requires { storeActive(value.v, to, active); })
            storeActive(value.v, to, active);
        else if constexpr (lanes > 1 && std::is_same_v<T, Lanes<float, lanes>> && std::is_same_v<S, double>) {
            constexpr int kHalf = lanes / 2;
            storeActive(convertLanes<double>(lowerLanes(value)), to, std::min(active, kHalf));
            if (active > kHalf)
                storeActive(convertLanes<double>(upperLanes(value)), to + kHalf, active - kHalf);
        } else if constexpr (requires(T t) { T::ofRepresentable(t.v); })
            Number<decltype(T::v)>::store(value.v, to, active);
        else
            for (int i = 0; i < active; i++) to[i] = static_cast<S>(numberLane(value, i));
    }

    // Numbers of T that were kept, one per lane; nothing is rounded.
    static T loadKept(const Kept* from) {
        if constexpr (lanes == 1)
            return *from;
        else if constexpr (requires(T t) { T::ofRepresentable(t.v); })
            return T::ofRepresentable(decltype(T::v)::load(from));
        else
            return T::load(from);
    }
    static void storeKept(const T& value, Kept* to) {
        if constexpr (lanes == 1)
            *to = value;
        else
            store(value, to);
    }
    // A kept number in every lane.
    static T broadcast(const Kept& value) {
        if constexpr (lanes == 1)
            return value;
        else if constexpr (requires(T t) { T::ofRepresentable(t.v); })
            return T::ofRepresentable(decltype(T::v)(value));
        else
            return T(static_cast<double>(value));
    }

  private:
    // Doubles are moved a register at a time.
    using Half = Lanes<double, std::max(1, lanes / 2)>;
    template <class F>
    static T inHalves(const F& f) {
        return joinLanes(f(0), f(lanes / 2));
    }
};

}  // namespace etalon
