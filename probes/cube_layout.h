// The six faces of a cube map in one image.
#pragma once

#include "raster/image.h"

namespace etalon {

// Of faces of n x n texels:
//   openExrStrip: n x 6n, +X -X +Y -Y +Z -Z downwards as [OpenEXR, ImfEnvmap.h] stores an ENVMAP_CUBE. Its
//     faces show the cube from inside to a right-handed observer, so they are mirror images of the face
//     table (raster/cube_face.h): +-X and +-Z are stored left to right, +-Y upside down. (OpenEXR's own
//     pixel positions put the centres of the first and last texel on a face's border; that is not followed.)
//   verticalStrip: n x 6n, the faces downwards as the face table has them.
//   horizontalCross: 4n x 3n, +Y above and -Y below the second of -X +Z +X -Z.
//   verticalCross: 3n x 4n, downwards +Y, the row -X +Z +X, -Y, and -Z turned by half a turn, so that it goes
//     on from -Y: its upper border is the lower one of -Y and +X is on its right.
// In both crosses the faces are as the face table has them and meet along the cube's edges: an image without
// seams that, seen from inside, is a mirror image. Texels outside the faces are 0.
enum class CubeLayout { openExrStrip, verticalStrip, horizontalCross, verticalCross };

// width and height of the layout for faces of size x size texels.
struct LayoutSize {
    int width, height;
    friend bool operator==(const LayoutSize&, const LayoutSize&) = default;
};
LayoutSize layoutSize(CubeLayout layout, int size);

// The texel of the layout that holds texel (x, y) of a face.
struct LayoutTexel {
    int x, y;
};
LayoutTexel layoutTexel(CubeLayout layout, int size, int face, int x, int y);

// All channels, bit for bit, and back. The image has a layoutSize() for some size >= 1 (PreconditionError
// otherwise).
Image<float> packCube(const CubeMap<float>& cube, CubeLayout layout);
CubeMap<float> unpackCube(const Image<float>& image, CubeLayout layout);

}  // namespace etalon
