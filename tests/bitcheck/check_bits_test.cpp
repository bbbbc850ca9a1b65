#include "bitcheck/check_bits.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "raster/rules.h"

namespace etalon {
namespace {

constexpr const char* kReference = "golden/bits.txt";

// Every way; one for each level where that would take minutes.
#ifdef ETALON_ONE_WAY
constexpr WaySelection kWays{.level = {}, .threads = 7, .tileSize = 32};
#else
constexpr WaySelection kWays{};
#endif

BitReference committedReference() {
    std::ifstream file(kReference, std::ios::binary);
    REQUIRE(file.good());
    return readReference(std::string(std::istreambuf_iterator<char>(file), {}), kReference);
}

// A case of 70 x 50 pixels in two layers, of numbers that follow a rule; where `isPlanted` one word is one
// more.
constexpr int kPlantedX = 66, kPlantedY = 33, kPlantedLayer = 1;
template <class Condition>
BitCase countingCase(Condition isPlanted) {
    return {
        "counting", "a rule", true, true, true, [isPlanted](const RasterOptions& options) {
            Image<float> image(70, 50, 2);
            for (size_t i = 0; i < image.values().size(); i++) image.values()[i] = static_cast<float>(i);
            if (isPlanted(options)) image.at(kPlantedX, kPlantedY, kPlantedLayer) += 1;
            return std::vector<BitPlane>{planeOf("zeros", Image<uint32_t>(40, 1)), planeOf("numbers", image)};
        }};
}

BitReference referenceOf(const BitCase& c) {
    return {kRulesVersion, "test", {hashCase(c.name, runCase(c, waysOf({}, c).front()))}};
}

bool never(const RasterOptions&) { return false; }
bool always(const RasterOptions&) { return true; }

}  // namespace

TEST_CASE("EveryWayOfThisMachineGivesTheReferenceBits") {
    const BitReference reference = committedReference();
    CHECK(reference.rulesVersion == kRulesVersion);
    const std::vector<BitCase> cases = bitCases();
    std::set<std::string> names;
    for (const BitCase& c : cases) {
        const BitResult result = checkCase(c, waysOf(kWays, c), reference);
        CHECK_MESSAGE(result.verdict == BitVerdict::same, c.name, ": ", result.message);
        CHECK_MESSAGE(names.insert(c.name).second, c.name, " stands there twice");
    }
    CHECK(findObsolete(reference, cases).empty());
}

TEST_CASE("OneChangedWordIsFoundAndNamed") {
    const BitReference reference = referenceOf(countingCase(never));
    const BitCase c = countingCase([](const RasterOptions& options) { return options.threads == 2; });
    const std::vector<BitWay> ways = waysOf({}, c);
    const BitResult result = checkCase(c, ways, reference);
    REQUIRE(result.verdict == BitVerdict::different);
    REQUIRE(result.difference);
    CHECK(result.differing.size() == 3 + usableIsaLevels().size() - 1);
    CHECK(result.difference->way.threads == 2);
    CHECK(result.difference->plane == "numbers");
    CHECK(result.difference->tileX == 64);
    CHECK(result.difference->tileY == 32);
    REQUIRE(result.difference->pixel);
    CHECK(result.difference->pixel->x == kPlantedX);
    CHECK(result.difference->pixel->y == kPlantedY);
    CHECK(result.difference->pixel->layer == kPlantedLayer);
    REQUIRE(result.difference->agreeingWay);
    CHECK(result.difference->agreeingWay->threads != 2);
    CHECK(result.message.find("channel 1: 45b7a800 (5877) instead of 45b7a000 (5876)") != std::string::npos);
}

TEST_CASE("AWayThatWasNotAskedForNamesThePixel") {
    const BitReference reference = referenceOf(countingCase(never));
    const BitCase c = countingCase([](const RasterOptions& options) { return options.threads == 2; });
    WaySelection selection;
    selection.threads = 2;
    const BitResult result = checkCase(c, waysOf(selection, c), reference);
    REQUIRE(result.difference);
    CHECK(result.difference->pixel);
    CHECK(result.differing.size() == result.ways.size());
}

TEST_CASE("WithoutAnAgreeingWayTheTileIsNamedAndWordsNameThePixel") {
    const BitCase good = countingCase(never), bad = countingCase(always);
    const BitReference reference = referenceOf(good);
    const BitResult result = checkCase(bad, waysOf({}, bad), reference);
    REQUIRE(result.difference);
    CHECK(result.difference->tileX == 64);
    CHECK_FALSE(result.difference->pixel);
    CHECK(result.message.find("no way of this machine gives the expected hash") != std::string::npos);

    const std::vector<CasePlanes> words = {{good.name, runCase(good, waysOf({}, good).front())}};
    const BitResult named = checkCase(bad, waysOf({}, bad), reference, &words);
    REQUIRE(named.difference);
    REQUIRE(named.difference->pixel);
    CHECK(named.difference->pixel->x == kPlantedX);
}

TEST_CASE("CasesThatTheReferenceLacksOrHasOtherwiseAreNotTheSame") {
    const BitCase c = countingCase(never);
    BitReference reference = referenceOf(c);
    reference.cases[0].planes[1].width++;
    CHECK(checkCase(c, waysOf({}, c), reference).verdict == BitVerdict::reshaped);
    reference.cases[0].name = "other";
    CHECK(checkCase(c, waysOf({}, c), reference).verdict == BitVerdict::missing);
    const std::vector<BitResult> obsolete = findObsolete(reference, {c});
    REQUIRE(obsolete.size() == 1);
    CHECK(obsolete[0].name == "other");
    CHECK(obsolete[0].verdict == BitVerdict::obsolete);
}

TEST_CASE("WaysCoverLevelsThreadsAndTiles") {
    const BitCase c = countingCase(never);
    const size_t levels = usableIsaLevels().size();
    CHECK(waysOf({}, c).size() == 9 + 3 * (levels - 1));
    for (const IsaLevel level : usableIsaLevels())
        for (const int threads : {1, 2, 7}) {
            const auto ways = waysOf({}, c);
            CHECK(std::ranges::any_of(
                ways, [&](const BitWay& way) { return way.level == level && way.threads == threads; }));
        }
    WaySelection selection;
    selection.everyCombination = true;
    CHECK(waysOf(selection, c).size() == 9 * levels);
    selection.threads = 5;
    selection.tileSize = 8;
    selection.level = usableIsaLevels().front();
    CHECK(waysOf(selection, c) == std::vector<BitWay>{{usableIsaLevels().front(), 5, 8}});
    BitCase plain = c;
    plain.hasThreads = plain.hasTiles = false;
    CHECK(waysOf({}, plain).size() == levels);
}

TEST_CASE("TileHashesSeeEveryWordOfTheirTileAndNoOther") {
    Image<uint32_t> image(65, 33, 2);
    const PlaneHashes before = hashPlane(planeOf("p", image));
    REQUIRE(before.tiles.size() == 6);
    for (const auto& [x, y, tile] : {std::array{0, 0, 0}, {31, 31, 0}, {32, 31, 1}, {64, 0, 2}, {64, 32, 5}})
        for (const int layer : {0, 1}) {
            image.at(x, y, layer) = 1;
            const PlaneHashes after = hashPlane(planeOf("p", image));
            for (int t = 0; t < 6; t++)
                CHECK((after.tiles[static_cast<size_t>(t)] != before.tiles[static_cast<size_t>(t)]) ==
                      (t == tile));
            image.at(x, y, layer) = 0;
        }
}

}  // namespace etalon
