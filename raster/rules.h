// The version of the rules in docs/specification.md. Written into every output and golden entry.
#pragma once

namespace etalon {

inline constexpr int kRulesVersion = 5;

}  // namespace etalon
