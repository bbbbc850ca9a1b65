// Names of enumerations: one table each, in the room where the enumeration lives, for all that reads or writes a name.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace etalon {

// The names of the members of E, which count from 0, in their order. A specialisation is a std::array of them.
template <class E>
inline constexpr std::array<std::string_view, 0> kNames{};

// An enumeration that has names.
template <class E>
concept Named = std::is_enum_v<E> && !kNames<E>.empty();

template <Named E>
constexpr std::string_view nameOf(E value) {
    return kNames<E>[static_cast<size_t>(value)];
}

// The member of that name, if there is one.
template <Named E>
constexpr std::optional<E> memberOf(std::string_view name) {
    const auto found = std::find(kNames<E>.begin(), kNames<E>.end(), name);
    if (found == kNames<E>.end()) return std::nullopt;
    return static_cast<E>(found - kNames<E>.begin());
}

// Whether `last` is the last member that has a name: for a static_assert beside the names.
template <Named E>
constexpr bool isLastName(E last) {
    return static_cast<size_t>(last) + 1 == kNames<E>.size();
}

}  // namespace etalon
