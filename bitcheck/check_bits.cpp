#include "bitcheck/check_bits.h"

#include <algorithm>

#include "numeric/text.h"

namespace etalon {
namespace {

// Where the first tile differs: index of the plane and of its tile.
struct TileIndex {
    size_t plane, tile;
};

std::optional<TileIndex> firstDifference(const CaseHashes& a, const CaseHashes& b) {
    for (size_t p = 0; p < a.planes.size(); p++) {
        const auto& tiles = a.planes[p].tiles;
        const auto place = std::ranges::mismatch(tiles, b.planes[p].tiles).in1;
        if (place != tiles.end()) return TileIndex{p, static_cast<size_t>(place - tiles.begin())};
    }
    return std::nullopt;
}

bool sameShape(const CaseHashes& a, const CaseHashes& b) {
    return std::ranges::equal(a.planes, b.planes, &PlaneHashes::sameShape);
}

// The first word of a tile, in rows of pixels, in which two planes of one shape differ.
std::optional<DifferentPixel> firstDifferentPixel(const BitPlane& expected, const BitPlane& found, int tileX,
                                                  int tileY) {
    for (int y = tileY; y < std::min(tileY + kHashTile, found.height); y++)
        for (int x = tileX; x < std::min(tileX + kHashTile, found.width); x++)
            for (int layer = 0; layer < found.layers; layer++)
                if (expected.at(x, y, layer) != found.at(x, y, layer))
                    return DifferentPixel{x, y, layer, expected.at(x, y, layer), found.at(x, y, layer)};
    return std::nullopt;
}

// What one way gave.
struct Attempt {
    BitWay way;
    CaseHashes hashes;
};

// Planes of this machine whose tile is as expected: of a way that was tried, or else of the simplest work at
// another level.
struct Agreement {
    BitWay way;
    std::vector<BitPlane> planes;
};
std::optional<Agreement> findAgreement(const BitCase& c, const std::vector<Attempt>& attempts,
                                       const TileIndex& place, uint64_t expected) {
    std::vector<BitWay> candidates;
    for (const Attempt& attempt : attempts)
        if (attempt.hashes.planes[place.plane].tiles[place.tile] == expected)
            candidates.push_back(attempt.way);
    for (const BitWay& way : waysOf({}, c))
        if (std::ranges::find(attempts, way, &Attempt::way) == attempts.end()) candidates.push_back(way);
    for (const BitWay& way : candidates) {
        std::vector<BitPlane> planes = runCase(c, way);
        if (hashPlane(planes[place.plane]).tiles[place.tile] == expected)
            return Agreement{way, std::move(planes)};
    }
    return std::nullopt;
}

std::string differenceText(const BitDifference& d, const BitCase& c, size_t differing, size_t tried) {
    std::string text =
        formatText("{}: plane {}, tile at ({}, {})", wayText(d.way, c), d.plane, d.tileX, d.tileY);
    if (d.pixel) {
        text += formatText(", pixel ({}, {})", d.pixel->x, d.pixel->y);
        text += formatText(" {} {}: {} instead of {}", d.layerName, d.pixel->layer,
                           wordText(d.kind, d.pixel->found), wordText(d.kind, d.pixel->expected));
        if (d.agreeingWay) text += formatText(" as with {}", wayText(*d.agreeingWay, c));
    } else {
        text += ": no way of this machine gives the expected hash";
    }
    return text + formatText("; {} of {} ways differ", differing, tried);
}

}  // namespace

const char* verdictName(BitVerdict verdict) {
    switch (verdict) {
        case BitVerdict::same:
            return "same";
        case BitVerdict::different:
            return "different";
        case BitVerdict::missing:
            return "missing";
        case BitVerdict::reshaped:
            return "reshaped";
        case BitVerdict::obsolete:
            return "obsolete";
    }
    return "?";
}

BitResult checkCase(const BitCase& c, const std::vector<BitWay>& ways, const BitReference& reference,
                    const std::vector<CasePlanes>* expected) {
    BitResult result{c.name, c.what, BitVerdict::same, {}, ways, {}, {}};
    const CaseHashes* hashes = reference.find(c.name);
    if (!hashes) {
        result.verdict = BitVerdict::missing;
        result.message = "the reference has no such case";
        return result;
    }
    std::vector<Attempt> attempts;
    std::vector<BitPlane> differentPlanes;  // of the first way that differs
    for (const BitWay& way : ways) {
        std::vector<BitPlane> planes = runCase(c, way);
        attempts.push_back({way, hashCase(c.name, planes)});
        if (!sameShape(attempts.back().hashes, *hashes)) {
            result.verdict = BitVerdict::reshaped;
            result.message = "the reference has other planes for it";
            return result;
        }
        if (attempts.back().hashes == *hashes) continue;
        if (result.differing.empty()) differentPlanes = std::move(planes);
        result.differing.push_back(way);
    }
    if (result.differing.empty()) return result;

    const BitWay& way = result.differing.front();
    const Attempt& attempt = *std::ranges::find(attempts, way, &Attempt::way);
    const TileIndex place = *firstDifference(attempt.hashes, *hashes);
    const PlaneHashes& plane = hashes->planes[place.plane];
    const auto column = static_cast<int>(place.tile) % plane.columns(),
               row = static_cast<int>(place.tile) / plane.columns();
    const BitPlane& found = differentPlanes[place.plane];
    BitDifference difference{
        way, plane.name, plane.kind, found.layerName, column * kHashTile, row * kHashTile, {}, {}};
    const auto comparePixels = [&](const BitPlane& with) {
        difference.pixel = firstDifferentPixel(with, found, difference.tileX, difference.tileY);
    };
    if (expected) {
        comparePixels(std::ranges::find(*expected, c.name, &CasePlanes::name)->planes[place.plane]);
    } else if (const auto agreement = findAgreement(c, attempts, place, plane.tiles[place.tile])) {
        difference.agreeingWay = agreement->way;
        comparePixels(agreement->planes[place.plane]);
    }
    result.verdict = BitVerdict::different;
    result.message = differenceText(difference, c, result.differing.size(), ways.size());
    result.difference = std::move(difference);
    return result;
}

std::vector<BitResult> findObsolete(const BitReference& reference, const std::vector<BitCase>& cases) {
    std::vector<BitResult> results;
    for (const CaseHashes& c : reference.cases)
        if (std::ranges::find(cases, c.name, &BitCase::name) == cases.end())
            results.push_back(
                {c.name, {}, BitVerdict::obsolete, "this program has no such case", {}, {}, {}});
    return results;
}

}  // namespace etalon
