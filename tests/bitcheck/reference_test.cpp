#include "bitcheck/reference.h"

#include <doctest/doctest.h>

#include <array>

namespace etalon {
namespace {

BitReference smallReference() {
    const std::array<double, 40> numbers = {1, 2, 3};
    return {1,
            "a reason",
            {hashCase("a/one", {planeOf("p", Image<float>(70, 33)),
                                planeOf("q", std::span<const double>(numbers), 8)}),
             hashCase("b", {planeOf("p", Image<uint8_t>(1, 1, 4))})}};
}

std::string errorOf(const std::string& text) {
    try {
        readReference(text, "bits.txt");
    } catch (const InputError& error) {
        const std::string what = error.what();
        CHECK(what.starts_with("bits.txt:"));
        CHECK(what.find('\n') == std::string::npos);
        return what;
    }
    return "none";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("ReferencesAreReadAsWritten") {
    const BitReference reference = smallReference();
    const BitReference read = readReference(referenceText(reference), "bits.txt");
    CHECK(read.rulesVersion == 1);
    CHECK(read.reason == "a reason");
    CHECK(read.cases == reference.cases);
    CHECK(read.find("b") != nullptr);
    CHECK(read.find("c") == nullptr);
}

TEST_CASE("ReferencesThatEndEarlyAreRefused") {
    const std::string text = referenceText(smallReference());
    for (size_t length = 0; length < text.size(); length++) {
        CAPTURE(length);
        CHECK(errorOf(text.substr(0, length)) != "none");
    }
}

TEST_CASE("AChangedDigitIsNoticed") {
    std::string text = referenceText(smallReference());
    size_t changed = 0;
    for (size_t i = text.find("case"); i < text.size(); i++) {
        if (text[i] < '0' || text[i] > '8') continue;
        text[i]++;
        CHECK(errorOf(text) != "none");
        text[i]--;
        changed++;
    }
    CHECK(changed > 50);
}

TEST_CASE("BadReferencesAreNamedByLine") {
    const std::string text = referenceText(smallReference());
    CHECK(errorOf("") == "bits.txt:1: the first line is not \"etalon bits 1\"");
    CHECK(errorOf(replaced(text, "rules 1", "rules one")) == "bits.txt:2: \"rules\" must be a whole number");
    CHECK(errorOf(replaced(text, "reason a reason", "why not")) == "bits.txt:3: \"reason\" is missing");
    CHECK(errorOf(replaced(text, "float32", "float31")) == "bits.txt:5: unknown kind \"float31\"");
    CHECK(errorOf(replaced(text, "70x33x1", "70x33")) == "bits.txt:5: \"70x33\" is not a size");
    CHECK(errorOf(replaced(text, "70x33x1", "0x33x1")) == "bits.txt:5: \"0x33x1\" is not a size");
    CHECK(errorOf(replaced(text, "70x33x1", "100x33x1")) ==
          "bits.txt:6: must be the 4 hashes of a row of tiles");
    CHECK(errorOf(replaced(text, "case b", "case a/one")).ends_with("the case \"a/one\" stands there twice"));
    CHECK(errorOf(replaced(text, "plane q", "plane p")).ends_with("the plane \"p\" stands there twice"));
    CHECK(errorOf(text + "more\n").ends_with("nothing may follow \"all\""));
    CHECK(errorOf(text + "more").ends_with("nothing may follow \"all\""));
}

}  // namespace etalon
