// Other libraries that make a cube map of a lat-long image, bilinear, on one thread.
#pragma once

#include <functional>

#include "probes/probe.h"

namespace etalon::bench {

// A call writes the faces of `cube`, a probe of the mapping cube, from the source that the maker was given.
using CubeMaker = std::function<void(Probe& cube)>;

// TextureSystem::environment, once per texel, of a tiled file that is in its cache.
CubeMaker openImageIoCubes(const Probe& latLong);
// remap with tables of source positions, which are made before, in float.
CubeMaker openCvCubes(const Probe& latLong, const ProbeShape& cube);

}  // namespace etalon::bench
