// Ambient occlusion and bent normals [Landis2002]: which part of the surroundings a point sees over its
// surface, from what the rasterizer draws around it.
//
// open = 1/pi times the integral of V(w) max(0, n . w) over directions, V = 1 where nothing is (nearer than
// maxDistance_m). It is the factor on the irradiance of a constant environment; times the irradiance in the
// bent normal it approximates that of another.
//
// Two ways:
//   - hemicubeOcclusion draws the scene on the five faces of a hemicube around each point [Cohen85]. Texel
//     centres decide; the weights of texels are exact integrals. For few points, and as the measure of the
//     other way. On a knot's vertices 16 texels along the top are off by 0.004 (root mean square), 64 by
//     0.0004. A border between open and covered that passes straight through the hemicube costs at most half
//     the weight of the texels it crosses: 1 / size of a face in the mean (kHemicubeError).
//   - directionalOcclusion draws one depth map of the scene from each of many directions and looks all points
//     up in each. For vertices and pixels by the thousand. Its error is that of a sum over directions, and of
//     the texels of the maps, in which a point is looked up at the nearest texel, moved off its surface. The
//     maps show the outermost surface only, so that no distance limits what covers.
// Points without occluders have open = 1 exactly. The same bits for any number of threads and tile size;
// computed in double, whatever the profile's arithmetic.
//
// What occlusion does not do:
//   - return light: what is covered is dark, whatever covers it;
//   - take out single lights: it weighs all directions by the cosine, not by what comes from them;
//   - let part of the light through: a direction is covered or open.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/occlusion.h"
#include "raster/image.h"
#include "raster/rasterizer.h"

namespace etalon {

// The vertices of a placed mesh, normals made unit.
std::vector<OcclusionPoint> occlusionPointsOf(const PlacedMesh& placed);

// What a view shows, row by row: from the images `normals` and `distance` that shading makes.
std::vector<OcclusionPoint> occlusionPointsOf(const View& view, const Image<float>& normals,
                                              const Image<float>& distance);

// The form factors of the texels of a hemicube from its centre: the integrals of cos / pi over their solid
// angles. They add up to 1.
struct HemicubeWeights {
    // size: texels along the top's side, even.
    explicit HemicubeWeights(int size);

    int size;
    std::vector<double> top;   // size x size
    std::vector<double> side;  // of each side: size x size / 2, row 0 uppermost
};

struct HemicubeOptions {
    int size = 64;  // texels along the top's side; even, 2 to 4096
    double offset_m =
        1e-4;  // eyes are this far above their points, so that these see their own surface edge-on
    double maxDistance_m =
        std::numeric_limits<double>::infinity();  // up to 1e-4 of it, beyond nothing covers
    int threads = 0;
};

// Bound on the error of `open` for a straight border, as a multiple of 1 / size.
inline constexpr double kHemicubeError = 1.0;

std::vector<Occlusion> hemicubeOcclusion(std::span<const PlacedMesh> placed,
                                         std::span<const OcclusionPoint> points,
                                         const HemicubeOptions& options);

struct DirectionalOptions {
    int directions = 256;  // over the whole sphere, on a golden spiral [Swinbank2006]
    int mapSize = 512;     // texels of a depth map along a side; it holds the scene's bounding sphere
    RasterOptions raster;
};

// The i-th of n directions, unit: n bands of equal area, each turned by the golden angle.
glm::dvec3 spiralDirection(int i, int n);

// Bound on the root mean square error of `open` over the vertices of a knot for n directions, 64 to 1024.
// Measured against hemicubes: 0.036 (64), 0.012 (256), 0.005 (1024), with maps of 256 and of 1024 alike.
inline double directionalErrorBound(int n) { return 0.3 / std::sqrt(n); }

// With every direction d that n . d > 0 weighted by n . d.
std::vector<Occlusion> directionalOcclusion(std::span<const PlacedMesh> placed,
                                            std::span<const OcclusionPoint> points,
                                            const DirectionalOptions& options);

}  // namespace etalon
