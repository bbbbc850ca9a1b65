#include "probes/cube_layout.h"

#include "numeric/check.h"

namespace etalon {
namespace {

// Columns and rows of faces of a layout, and where each face stands.
struct Arrangement {
    int columns, rows;
    LayoutTexel cells[6];
};

Arrangement arrangementOf(CubeLayout layout) {
    switch (layout) {
        case CubeLayout::horizontalCross:
            return {4, 3, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};
        case CubeLayout::verticalCross:
            return {3, 4, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}};
        case CubeLayout::openExrStrip:
        case CubeLayout::verticalStrip:
            break;
    }
    return {1, 6, {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}};
}

constexpr int kPlusY = 2, kMinusY = 3, kMinusZ = 5;

// Calls body(face, x, y, texel of the layout) for every texel.
template <class F>
void forEachTexel(CubeLayout layout, int size, F&& body) {
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++) body(face, x, y, layoutTexel(layout, size, face, x, y));
}

}  // namespace

LayoutSize layoutSize(CubeLayout layout, int size) {
    const Arrangement a = arrangementOf(layout);
    return {a.columns * size, a.rows * size};
}

LayoutTexel layoutTexel(CubeLayout layout, int size, int face, int x, int y) {
    bool flipsX = false, flipsY = false;
    if (layout == CubeLayout::openExrStrip) {
        flipsY = face == kPlusY || face == kMinusY;
        flipsX = !flipsY;
    }
    if (layout == CubeLayout::verticalCross) flipsX = flipsY = face == kMinusZ;
    const LayoutTexel cell = arrangementOf(layout).cells[face];
    return {cell.x * size + (flipsX ? size - 1 - x : x), cell.y * size + (flipsY ? size - 1 - y : y)};
}

Image<float> packCube(const CubeMap<float>& cube, CubeLayout layout) {
    const LayoutSize size = layoutSize(layout, cube.size());
    Image<float> image(size.width, size.height, cube.channels());
    forEachTexel(layout, cube.size(), [&](int face, int x, int y, LayoutTexel to) {
        for (int c = 0; c < cube.channels(); c++)
            image.at(to.x, to.y, c) = cube.faces[static_cast<size_t>(face)].at(x, y, c);
    });
    return image;
}

CubeMap<float> unpackCube(const Image<float>& image, CubeLayout layout) {
    const int size = image.width() / arrangementOf(layout).columns;
    ETALON_CHECK(size >= 1 && layoutSize(layout, size) == (LayoutSize{image.width(), image.height()}),
                 "no faces fit {}x{}", image.width(), image.height());
    CubeMap<float> cube(size, image.channels());
    forEachTexel(layout, size, [&](int face, int x, int y, LayoutTexel from) {
        for (int c = 0; c < image.channels(); c++)
            cube.faces[static_cast<size_t>(face)].at(x, y, c) = image.at(from.x, from.y, c);
    });
    return cube;
}

}  // namespace etalon
