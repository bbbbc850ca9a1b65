#include "bitcheck/way.h"

#include <algorithm>

#include "numeric/text.h"

namespace etalon {
namespace {

// One thread, few, and an odd number of more threads than a small machine has.
constexpr int kThreadCounts[] = {1, 2, 7};
constexpr int kTileSizes[] = {64, 32, 16};

// Selects a level and puts the old one back.
class LevelScope {
  public:
    explicit LevelScope(IsaLevel level) : before_(activeIsa()) { selectIsa(level); }
    ~LevelScope() { selectIsa(before_); }
    LevelScope(const LevelScope&) = delete;
    LevelScope& operator=(const LevelScope&) = delete;

  private:
    IsaLevel before_;
};

// The one asked for, or the first of the list where the case is not cut by it, or the whole list.
template <class T, class List>
std::vector<T> choices(const std::optional<T>& only, bool isVaried, const List& all) {
    if (only) return {*only};
    if (!isVaried) return {*std::begin(all)};
    return {std::begin(all), std::end(all)};
}

}  // namespace

std::string wayText(const BitWay& way, const BitCase& c) {
    std::string text = isaName(way.level);
    if (c.hasThreads) text += formatText(", {} thread{}", way.threads, way.threads == 1 ? "" : "s");
    if (c.hasTiles) text += formatText(", tile {}", way.tileSize);
    return text;
}

std::vector<BitWay> waysOf(const WaySelection& selection, const BitCase& c) {
    std::vector<IsaLevel> widestFirst(usableIsaLevels().rbegin(), usableIsaLevels().rend());
    const auto levels = choices(selection.level, c.hasLevels, widestFirst);
    const auto threadCounts = choices(selection.threads, c.hasThreads, kThreadCounts);
    const auto tileSizes = choices(selection.tileSize, c.hasTiles, kTileSizes);
    std::vector<BitWay> ways;
    for (const IsaLevel level : levels) {
        if (selection.everyCombination || level == levels.front()) {
            for (const int threads : threadCounts)
                for (const int tileSize : tileSizes) ways.push_back({level, threads, tileSize});
        } else {
            // Each number of threads and each tile size once.
            for (size_t i = 0; i < std::max(threadCounts.size(), tileSizes.size()); i++)
                ways.push_back({level, threadCounts[std::min(i, threadCounts.size() - 1)],
                                tileSizes[std::min(i, tileSizes.size() - 1)]});
        }
    }
    return ways;
}

std::vector<BitPlane> runCase(const BitCase& c, const BitWay& way) {
    const LevelScope level(way.level);
    return c.run({way.threads, way.tileSize});
}

}  // namespace etalon
