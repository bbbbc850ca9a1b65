// The options that several verbs share, and how far a render of theirs is.
#pragma once

#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/output.h"
#include "ar/render_scene.h"
#include "files/probe_file.h"
#include "probes/names.h"

namespace etalon {

// Of a verb that computes: instruction set level, threads, tile size.
//
// --isa: selects the level when the arguments are read. A verb with this option does not run where the
// processor has none of the levels that are built (InputError).
Option addIsaOption(Verb& verb);

Option addThreadsOption(Verb& verb, int& threads);
Option addThreadsOption(Verb& verb, std::optional<int>& threads);
Option addTileOption(Verb& verb, int& tileSize);
Option addTileOption(Verb& verb, std::optional<int>& tileSize);

// Of a verb about a probe in a file.
struct ProbeInput {
    std::string file, mapping, layout;
    double ballDistance_radii = 0;  // not above 0: the file's

    void addTo(Verb& verb);
    // Says on the line that it reads.
    Probe load(ProgressLine& progress) const;
};

// Of a verb with a scene.
struct SceneOptions {
    std::string scene, profile;  // the profile as a name or a file; empty: the scene's
    std::vector<std::string> outputs;
    bool strict = false;
    RasterOptions raster;

    void addTo(Verb& verb);
    RenderOptions renderOptions() const;
};

// "shading (12 of 15): 40 %, 3 s left": the time left of the pass.
class RenderProgressText {
  public:
    std::string of(const RenderProgress& progress);

  private:
    size_t pass_ = SIZE_MAX;
    TimeLeft left_;
};

}  // namespace etalon
