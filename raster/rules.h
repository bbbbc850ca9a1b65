// The version of the rules in docs/specification.md. Written into every output and golden entry.
#pragma once

namespace etalon {

inline constexpr int kRulesVersion = 4;

}  // namespace etalon
