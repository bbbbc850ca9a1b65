#include "numeric/hash.h"

#include <algorithm>
#include <bit>

namespace etalon {
namespace {

// The constants of XXH64 [xxHash].
constexpr uint64_t kPrime1 = 0x9e3779b185ebca87u, kPrime2 = 0xc2b2ae3d27d4eb4fu,
                   kPrime3 = 0x165667b19e3779f9u, kPrime4 = 0x85ebca77c2b2ae63u,
                   kPrime5 = 0x27d4eb2f165667c5u;

// Little-endian on every machine.
template <class T>
T readWord(const std::byte* bytes) {
    T value = 0;
    for (size_t i = 0; i < sizeof(T); ++i) value |= static_cast<T>(std::to_integer<T>(bytes[i]) << (8 * i));
    return value;
}

template <class T>
std::array<std::byte, sizeof(T)> bytesOf(T number) {
    std::array<std::byte, sizeof(T)> bytes;
    for (size_t i = 0; i < sizeof(T); ++i) bytes[i] = static_cast<std::byte>(number >> (8 * i) & 255u);
    return bytes;
}

uint64_t roundOf(uint64_t lane, uint64_t word) { return std::rotl(lane + word * kPrime2, 31) * kPrime1; }

}  // namespace

void Xxh64::addNumber(uint32_t number) { add(bytesOf(number)); }

void Xxh64::addNumber(uint64_t number) { add(bytesOf(number)); }

void Xxh64::addText(std::string_view text) {
    addNumber(static_cast<uint32_t>(text.size()));
    add(std::as_bytes(std::span(text)));
}

void Xxh64::add(std::span<const std::byte> bytes) {
    const auto consume = [this](const std::byte* stripe) {
        for (size_t i = 0; i < 4; ++i) lanes_[i] = roundOf(lanes_[i], readWord<uint64_t>(stripe + 8 * i));
    };
    const size_t held = length_ % kStripe;
    length_ += bytes.size();
    if (held > 0) {
        const size_t taken = std::min(kStripe - held, bytes.size());
        std::copy_n(bytes.begin(), taken, pending_.begin() + static_cast<ptrdiff_t>(held));
        bytes = bytes.subspan(taken);
        if (held + taken < kStripe) return;
        consume(pending_.data());
    }
    for (; bytes.size() >= kStripe; bytes = bytes.subspan(kStripe)) consume(bytes.data());
    std::copy(bytes.begin(), bytes.end(), pending_.begin());
}

uint64_t Xxh64::digest() const {
    uint64_t hash = kPrime5;
    if (length_ >= kStripe) {
        hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) +
               std::rotl(lanes_[3], 18);
        for (const uint64_t lane : lanes_) hash = (hash ^ roundOf(0, lane)) * kPrime1 + kPrime4;
    }
    hash += length_;
    const std::byte* rest = pending_.data();
    const std::byte* end = rest + length_ % kStripe;
    for (; end - rest >= 8; rest += 8)
        hash = std::rotl(hash ^ roundOf(0, readWord<uint64_t>(rest)), 27) * kPrime1 + kPrime4;
    for (; end - rest >= 4; rest += 4)
        hash = std::rotl(hash ^ readWord<uint32_t>(rest) * kPrime1, 23) * kPrime2 + kPrime3;
    for (; rest < end; ++rest)
        hash = std::rotl(hash ^ std::to_integer<uint64_t>(*rest) * kPrime5, 11) * kPrime1;
    hash = (hash ^ hash >> 33) * kPrime2;
    hash = (hash ^ hash >> 29) * kPrime3;
    return hash ^ hash >> 32;
}

}  // namespace etalon
