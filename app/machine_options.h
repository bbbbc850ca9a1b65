// The options of a verb that computes: instruction set level, threads, tile size.
#pragma once

#include "app/command_line.h"

namespace etalon {

// --isa: selects the level when the arguments are read. A verb with this option does not run where the
// processor has none of the levels that are built (InputError).
Option addIsaOption(Verb& verb);

Option addThreadsOption(Verb& verb, int& threads);
Option addThreadsOption(Verb& verb, std::optional<int>& threads);
Option addTileOption(Verb& verb, int& tileSize);
Option addTileOption(Verb& verb, std::optional<int>& tileSize);

}  // namespace etalon
