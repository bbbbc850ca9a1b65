// What the fuzz harnesses share. A harness is one file with LLVMFuzzerTestOneInput: libFuzzer calls it with
// inputs that it makes up, replay.cpp with the kept ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "numeric/check.h"
#include "tests/support/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

// Ends the program, which the fuzzer and ctest count as a crash, unless a property holds. Active in every
// build.
#define FUZZ_CHECK(condition)                                                                   \
    do {                                                                                        \
        if (!(condition)) {                                                                     \
            std::fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition); \
            std::abort();                                                                       \
        }                                                                                       \
    } while (false)

namespace etalon::fuzz {

// Takes values off an input from the front; after its end every value is 0.
class ByteReader {
  public:
    ByteReader(const uint8_t* data, size_t size) : rest_(data, size) {}

    bool atEnd() const { return rest_.empty(); }
    template <class T>
    T take() {
        T value{};
        const size_t count = rest_.size() < sizeof value ? rest_.size() : sizeof value;
        if (count > 0) std::memcpy(&value, rest_.data(), count);
        rest_ = rest_.subspan(count);
        return value;
    }
    // In low ... high, both included; high - low < 256.
    int integer(int low, int high) { return low + take<uint8_t>() % (high - low + 1); }
    bool boolean() { return (take<uint8_t>() & 1) != 0; }
    template <class T, size_t N>
    const T& pick(const T (&values)[N]) {
        return values[static_cast<size_t>(integer(0, static_cast<int>(N) - 1))];
    }

  private:
    std::span<const uint8_t> rest_;
};

inline void writeFile(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}
inline std::string_view textOf(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// Calls read() on a file made of the input. True when it returns; false when it refuses the input as it
// should: with an InputError of one line that begins with `place`. Any other exception is a defect and ends
// the program.
template <class Read>
bool isAccepted(const std::filesystem::path& place, Read read) {
    try {
        read();
        return true;
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        if (!message.starts_with(place.string()) || message.find('\n') != std::string_view::npos) {
            std::fprintf(stderr, "not one line with its place: %s\n", error.what());
            std::abort();
        }
    }
    return false;
}

}  // namespace etalon::fuzz
