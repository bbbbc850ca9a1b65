#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "numeric/hash.h"

namespace etalon {
namespace {

uint64_t hashText(std::string_view text) {
    Xxh64 hash;
    hash.add(std::as_bytes(std::span(text)));
    return hash.digest();
}

}  // namespace

TEST_CASE("HashIsXxh64") {
    // Test vectors of the reference implementation, seed 0 [xxHash].
    CHECK(hashText("") == 0xef46db3751d8e999u);
    CHECK(hashText("a") == 0xd24ec4f1a98c6e5bu);
    CHECK(hashText("abc") == 0x44bc2cf5ad770999u);
    CHECK(hashText("Nobody inspects the spammish repetition") == 0xfbcea83c8a378bf1u);
}

TEST_CASE("HashDoesNotDependOnThePieces") {
    std::string text;
    for (int i = 0; i < 200; ++i) text += static_cast<char>(i * 7);
    for (size_t piece = 1; piece < 70; ++piece) {
        Xxh64 hash;
        for (size_t at = 0; at < text.size(); at += piece)
            hash.add(std::as_bytes(std::span(text).subspan(at, std::min(piece, text.size() - at))));
        CHECK(hash.digest() == hashText(text));
    }
}

TEST_CASE("HashOfNumbersIsThatOfTheirLittleEndianBytes") {
    Xxh64 numbers;
    numbers.addNumber(uint32_t{0x64636261});
    numbers.addNumber(uint64_t{0x6c6b6a6968676665});
    CHECK(numbers.digest() == hashText("abcdefghijkl"));
    Xxh64 text;
    text.addText("a");
    CHECK(text.digest() == hashText(std::string("\1\0\0\0a", 5)));
}

}  // namespace etalon
