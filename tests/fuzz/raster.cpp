// Triangles of arbitrary bits with arbitrary state: the rasterizer ends, and its result does not depend on
// the size of the tiles, the number of threads, nor the instruction set level.
#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include "numeric/isa.h"
#include "raster/rasterizer.h"
#include "tests/fuzz/fuzz.h"

using namespace etalon;

namespace {

constexpr int kMaxEdge = 20, kMaxDraws = 3, kMaxVertices = 12, kMaxTriangles = 8;

double takeCoordinate(fuzz::ByteReader& bytes) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kSpecial[] = {
        0.0,       -0.0,      1.0,     -1.0,    0.5,     2.0,       0x1p-80,
        0x1p-81,   -0x1p-80,  131072., 65536.,  -65536., 0x1p499,   -0x1p499,
        0x1p500,   kInfinity, 1e300,   -1e-300, 0x1p52,  0x1p-1074, std::numeric_limits<double>::quiet_NaN(),
        -kInfinity};
    switch (bytes.integer(0, 3)) {
        case 0:
            return bytes.take<double>();
        case 1:
            return bytes.pick(kSpecial);
        case 2:
            return bytes.take<int8_t>() / 64.0;
        default:
            return bytes.take<int16_t>() / 1024.0;
    }
}

template <class Enum>
Enum takeEnum(fuzz::ByteReader& bytes, Enum last) {
    return static_cast<Enum>(bytes.integer(0, static_cast<int>(last)));
}

StencilFace takeFace(fuzz::ByteReader& bytes) {
    const auto last = StencilOperation::decrementWrap;
    StencilFace face;
    face.compare = takeEnum(bytes, Compare::always);
    face.onStencilFail = takeEnum(bytes, last);
    face.onDepthFail = takeEnum(bytes, last);
    face.onPass = takeEnum(bytes, last);
    return face;
}

DrawState takeState(fuzz::ByteReader& bytes) {
    DrawState state;
    state.cull = takeEnum(bytes, CullMode::back);
    state.frontIsClockwise = bytes.boolean();
    state.depthCompare = takeEnum(bytes, Compare::always);
    state.depthWrite = bytes.boolean();
    state.idWrite = bytes.boolean();
    state.depthClamp = bytes.boolean();
    if (bytes.boolean())
        for (double* value : {&state.bias.constant, &state.bias.slopeScale, &state.bias.clamp})
            *value = takeCoordinate(bytes);
    state.stencil.enabled = bytes.boolean();
    if (!state.stencil.enabled) return state;
    state.stencil.reference = bytes.take<uint8_t>();
    state.stencil.readMask = bytes.take<uint8_t>();
    state.stencil.writeMask = bytes.take<uint8_t>();
    state.stencil.front = takeFace(bytes);
    state.stencil.back = takeFace(bytes);
    return state;
}

struct OwnedDraw {
    std::vector<ClipVertex> vertices;
    std::vector<uint32_t> indices;
    DrawState state;
};

OwnedDraw takeDraw(fuzz::ByteReader& bytes) {
    OwnedDraw draw;
    draw.state = takeState(bytes);
    const int vertices = bytes.integer(3, kMaxVertices), triangles = bytes.integer(0, kMaxTriangles);
    for (int v = 0; v < vertices; v++) {
        ClipVertex vertex;
        for (double* value : {&vertex.x, &vertex.y, &vertex.z}) *value = takeCoordinate(bytes);
        if (bytes.boolean()) vertex.w = takeCoordinate(bytes);
        draw.vertices.push_back(vertex);
    }
    for (int i = 0; i < 3 * triangles; i++)
        draw.indices.push_back(static_cast<uint32_t>(bytes.integer(0, vertices - 1)));
    return draw;
}

struct Drawing {
    int width = 0, height = 0;
    Viewport viewport;
    RenderTargetFormat format;
    std::vector<OwnedDraw> draws;
};

Drawing takeDrawing(fuzz::ByteReader& bytes) {
    Drawing d;
    d.viewport = {bytes.integer(0, kMaxEdge), bytes.integer(0, kMaxEdge), bytes.integer(1, kMaxEdge),
                  bytes.integer(1, kMaxEdge)};
    d.width = d.viewport.x + d.viewport.width + bytes.integer(0, kMaxEdge);
    d.height = d.viewport.y + d.viewport.height + bytes.integer(0, kMaxEdge);
    constexpr int kSamples[] = {1, 4, 16};
    d.format.samples = bytes.pick(kSamples);
    d.format.subpixelBits = bytes.integer(4, 8);
    d.format.depth = takeEnum(bytes, DepthFormat::d32f);
    d.format.depthRounding = takeEnum(bytes, DepthRounding::fixedFunction);
    d.format.real = takeEnum(bytes, RasterReal::fp64);
    const int draws = bytes.integer(1, kMaxDraws);
    for (int i = 0; i < draws; i++) d.draws.push_back(takeDraw(bytes));
    return d;
}

struct Drawn {
    RenderTarget target;
    RasterStatistics statistics;
};

Drawn drawn(const Drawing& d, const RasterOptions& options) {
    Drawn result{RenderTarget(d.width, d.height, d.format), {}};
    std::vector<Draw> draws;
    for (const OwnedDraw& draw : d.draws) draws.push_back({draw.vertices, draw.indices, draw.state});
    result.statistics = rasterize(result.target, d.viewport, draws, options);
    return result;
}

void checkIds(const RenderTarget& target, const Viewport& viewport) {
    for (int s = 0; s < target.id.channels(); s++)
        for (int y = 0; y < target.height(); y++)
            for (int x = 0; x < target.width(); x++) {
                const uint32_t id = target.id.at(x, y, s);
                const bool inside = x >= viewport.x && x < viewport.x + viewport.width && y >= viewport.y &&
                                    y < viewport.y + viewport.height;
                FUZZ_CHECK(id == kNoTriangle || (inside && id < target.triangles.size()));
                FUZZ_CHECK(target.depth.at(x, y, s) <= storedOne(target.format.depth));
            }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    fuzz::ByteReader bytes(data, size);
    const Drawing drawing = takeDrawing(bytes);
    const Drawn expected = drawn(drawing, {1, 64});
    checkIds(expected.target, drawing.viewport);
    constexpr RasterOptions kCuts[] = {{1, 8}, {3, 16}};
    const std::vector<IsaLevel>& levels = usableIsaLevels();
    for (size_t i = 0; i < std::max(levels.size(), std::size(kCuts)); i++) {
        selectIsa(levels[i % levels.size()]);
        const Drawn other = drawn(drawing, kCuts[i % std::size(kCuts)]);
        FUZZ_CHECK(other.statistics == expected.statistics);
        FUZZ_CHECK(other.target.depth == expected.target.depth &&
                   other.target.stencil == expected.target.stencil);
        FUZZ_CHECK(other.target.id == expected.target.id);
    }
    return 0;
}
