// Rows of texels of a probe, for sources that are compiled per level.
#pragma once

#include "numeric/lanes.h"
#include "probes/flux.h"
#include "raster/cube_face.h"

namespace etalon {

// Directions of a row of a cube face in lanes: the operations of TexelGrid::direction.
template <class D>
void readCubeDirections(int size, int layer, int y, TexelRow& row) {
    constexpr int kWidth = Number<D>::lanes;
    for (auto& component : row.direction) component.resize(static_cast<size_t>(row.padded));
    CubeFaceKernel<D> kernel;
    const D width(static_cast<double>(size)), t((y + 0.5) / size);
    for (int x = 0; x < row.padded; x += kWidth) {
        const D s = Number<D>::generate([&](int lane) { return x + lane + 0.5; }) / width;
        const auto d = kernel.cubeDirection(typename CubeFaceKernel<D>::integer(layer), s, t);
        const D length = kernel.sqrt(d.x * d.x + (d.y * d.y + d.z * d.z));
        for (int c = 0; c < 3; c++)
            Number<D>::storeKept(d[c] / length, row.direction[static_cast<size_t>(c)].data() + x);
    }
}

// A row of a checked probe, directions in the world.
inline TexelRow readTexels(const Probe& probe, const TexelGrid& grid, int layer, int y) {
    TexelRow row = readRadiance(probe, layer, y);
    readWeights(grid, layer, y, row);
    if (probe.shape.mapping == Mapping::cube)
        readCubeDirections<Native<double>>(probe.shape.width, layer, y, row);
    else
        readDirections(grid, layer, y, row);
    turnDirections(probe.rotation, row);
    return row;
}

}  // namespace etalon
