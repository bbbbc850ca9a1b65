#include "app/machine_options.h"

#include "numeric/isa.h"

namespace etalon {
namespace {

template <class Integer>
Option addThreads(Verb& verb, Integer& threads) {
    return verb.add("--threads", threads, "Threads; 0: all. Changes no bit").range(0, 1024);
}
template <class Integer>
Option addTile(Verb& verb, Integer& tileSize) {
    return verb.add("--tile", tileSize, "Tile size in pixels, a multiple of 8. Changes no bit")
        .range(8, 256)
        .multipleOf(8, "tile size");
}

}  // namespace

Option addIsaOption(Verb& verb) {
    verb.beforeRun([] { activeIsa(); });
    std::vector<std::string> names;
    for (const IsaLevel level : usableIsaLevels()) names.push_back(isaName(level));
    return verb
        .addCall(
            "--isa", [](const std::string& name) { selectIsa(*findIsa(name)); },
            "Instruction set level of the inner loops; default: the widest. Changes no bit")
        .oneOf(names);
}

Option addThreadsOption(Verb& verb, int& threads) { return addThreads(verb, threads); }
Option addThreadsOption(Verb& verb, std::optional<int>& threads) { return addThreads(verb, threads); }
Option addTileOption(Verb& verb, int& tileSize) { return addTile(verb, tileSize); }
Option addTileOption(Verb& verb, std::optional<int>& tileSize) { return addTile(verb, tileSize); }

}  // namespace etalon
