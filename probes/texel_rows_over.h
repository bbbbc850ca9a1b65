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

// The texels of a checked probe as T adds them.
template <class T>
struct ScaledTexels {
    ScaledTexels(const Probe& of, int threads)
        : probe(of),
          grid(of.shape),
          weights(texelWeightsOf(of, grid, TermLimits<T>::largest(), threads)),
          scale(fluxScaleOf<T>(weights)) {}
    size_t rowCount() const { return static_cast<size_t>(probe.shape.layers() * probe.shape.height); }

    const Probe& probe;
    TexelGrid grid;
    TexelWeights weights;
    FluxScale scale;
};

// A row of them, directions in the world.
template <class T>
TexelRow readTexels(const ScaledTexels<T>& texels, size_t r) {
    const Probe& probe = texels.probe;
    const TexelGrid& grid = texels.grid;
    const int layer = static_cast<int>(r) / probe.shape.height, y = static_cast<int>(r) % probe.shape.height;
    TexelRow row = readRadiance(probe, layer, y);
    readWeights(texels.weights, r * static_cast<size_t>(probe.shape.width), texels.scale.weight, row);
    if (probe.shape.mapping == Mapping::cube)
        readCubeDirections<Native<double>>(probe.shape.width, layer, y, row);
    else
        readDirections(grid, layer, y, row);
    turnDirections(probe.rotation, row);
    return row;
}

}  // namespace etalon
