// Visibility: clipping, set-up, coverage, depth, stencil.
#include <utility>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "lighting/geometry.h"

namespace etalon {
namespace {

constexpr int kSize_px = 128;
// The second is off the borders of every tile size, and of odd width.
constexpr Viewport kWhole = {0, 0, kSize_px, kSize_px}, kPart = {19, 7, 93, 104};

// Ids as the draw and the triangle that they stand for: how records are numbered is not a rule.
std::vector<BitPlane> planesOf(const RenderTarget& target) {
    Image<uint32_t> draw(target.width(), target.height(), target.format.samples), triangle = draw;
    for (size_t i = 0; i < target.id.values().size(); i++) {
        const uint32_t id = target.id.values()[i];
        const bool isEmpty = id == kNoTriangle;
        draw.values()[i] = isEmpty ? kNoTriangle : target.triangle(id).draw;
        triangle.values()[i] = isEmpty ? kNoTriangle : target.triangle(id).triangle;
    }
    std::vector<BitPlane> planes = {planeOf("depth", target.depth), planeOf("stencil", target.stencil),
                                    planeOf("draw", draw), planeOf("triangle", triangle)};
    if (!target.lowDepth.empty()) planes.push_back(planeOf("low-depth", target.lowDepth));
    return planes;
}

DrawState twoSided() {
    DrawState state;
    state.cull = CullMode::none;
    return state;
}

// The knot through the vertex stage.
void addKnot(DrawList& list, RasterReal real, const DrawState& state, int threads) {
    SurfaceScene scene;
    scene.meshes = {torusKnotMesh(160, 16)};
    scene.materials.resize(1);
    scene.instances.resize(1);
    scene.instances[0].toWorld[3][1] = 1.1;
    const std::vector<PlacedMesh> placed = placeMeshes(scene, real, threads);
    UninitializedVector<ClipVertex> clip;
    toClipSpace(placed[0], demoView(kSize_px, kSize_px), real, threads, clip);
    list.add({clip.begin(), clip.end()}, scene.meshes[0].indices, state);
}

// A mesh, large and small triangles, and some that the planes cut.
std::vector<BitPlane> drawMixed(const RenderTargetFormat& format, const RasterOptions& options) {
    const int size = format.samples == 16 ? kSize_px / 2 : kSize_px;
    const Viewport viewport = {0, 0, size, size};
    Random random(2);
    DrawList list;
    // Most triangles leave the mesh visible.
    DrawState mesh, around = twoSided();
    mesh.depthCompare = Compare::lessEqual;
    mesh.stencil.enabled = around.stencil.enabled = true;
    mesh.stencil.reference = around.stencil.reference = 1;
    mesh.stencil.front.onPass = StencilOperation::replace;
    around.stencil.front.compare = around.stencil.back.compare = Compare::notEqual;
    addKnot(list, format.real, mesh, options.threads);
    list.add(triangleSoup(random, Soup::slivers, 24, viewport), twoSided());
    for (const Soup family : {Soup::inside, Soup::onSamples, Soup::nearFar})
        list.add(triangleSoup(random, family, 24, viewport), around);
    RenderTarget target(size, size, format);
    rasterize(target, viewport, list.draws(), options);
    return planesOf(target);
}

// Everything that the planes of rule 2 cut, in two viewports.
std::vector<BitPlane> drawClipped(const RenderTargetFormat& format, bool depthClamp,
                                  const RasterOptions& options) {
    Random random(3);
    RenderTarget target(kSize_px, kSize_px, format);
    for (const Viewport& viewport : {kWhole, kPart}) {
        DrawList list;
        DrawState state = twoSided();
        state.depthClamp = depthClamp;
        // The few that cover much come first, and those behind them would all be hidden.
        state.depthCompare = Compare::always;
        for (const Soup family : {Soup::guardBand, Soup::behind, Soup::nearFar, Soup::folded})
            list.add(triangleSoup(random, family, family == Soup::folded ? 400 : 24, viewport), state);
        rasterize(target, viewport, list.draws(), options);
    }
    return planesOf(target);
}

// Layers of the same triangles with other bias, culling, comparison.
std::vector<BitPlane> drawBiased(const RenderTargetFormat& format, const RasterOptions& options) {
    constexpr DepthBias kBiases[] = {
        {0, 0, 0}, {-40, 0, 0}, {3, 1.5, 0}, {-2, -2.5, -0.01}, {100, 0.75, 0.002}};
    constexpr Compare kCompares[] = {Compare::less, Compare::lessEqual, Compare::greater,
                                     Compare::greaterEqual, Compare::notEqual};
    Random random(4);
    const std::vector<ClipVertex> large = triangleSoup(random, Soup::inside, 12, kWhole);
    DrawList list;
    for (size_t i = 0; i < std::size(kBiases); i++) {
        DrawState state;
        state.bias = kBiases[i];
        state.depthCompare = kCompares[i];
        state.cull = i % 2 == 0 ? CullMode::none : CullMode::front;
        state.frontIsClockwise = i == 3;
        list.add(large, state);
        list.add(triangleSoup(random, Soup::inside, 6, kWhole), state);
    }
    RenderTarget target(kSize_px, kSize_px, format);
    rasterize(target, kWhole, list.draws(), options);
    return planesOf(target);
}

// Triangles of one plane, but for the last bits of their vertices' depths.
std::vector<BitPlane> drawCoplanar(DepthOrder order, const RasterOptions& options) {
    Random random(6);
    DrawList list;
    std::vector<ClipVertex> vertices = triangleSoup(random, Soup::onSamples, 64, kWhole);
    for (ClipVertex& v : vertices) {
        const auto bits = static_cast<double>(random.next() % 4);
        v.z = (0.5 * v.w + 0.125 * v.x + 0.0625 * v.y) * (1 + bits * 0x1p-52);
    }
    list.add(std::move(vertices), twoSided());
    RenderTargetFormat format;
    format.samples = 4;
    format.depth = DepthFormat::d64f;
    format.real = RasterReal::fp64;
    format.depthOrder = order;
    RenderTarget target(kSize_px, kSize_px, format);
    rasterize(target, kWhole, list.draws(), options);
    return planesOf(target);
}

// Every stencil operation and comparison, masks, and draws that write no depth or no id.
std::vector<BitPlane> drawStencilled(const RenderTargetFormat& format, const RasterOptions& options) {
    constexpr int kOperations = 8, kCompares = 8;
    Random random(5);
    DrawList list;
    DrawState shadow = twoSided();
    shadow.idWrite = false;
    for (int i = 0; i < 32; i++) {
        const auto operation = [&](int step) {
            return static_cast<StencilOperation>((i * step + 2) % kOperations);
        };
        DrawState state = twoSided();
        state.depthWrite = i % 5 != 0;
        state.idWrite = i % 7 != 0;
        state.depthCompare = i % 3 == 0 ? Compare::always : Compare::less;
        state.stencil.enabled = i % 8 != 7;
        state.stencil.reference = static_cast<uint8_t>(37 * i);
        state.stencil.readMask = i % 4 == 0 ? 0x0f : 0xff;
        state.stencil.writeMask = i % 6 == 0 ? 0x3c : 0xff;
        state.stencil.front = {static_cast<Compare>(i < 4 ? kCompares - 1 : i % kCompares), operation(1),
                               operation(3), operation(5)};
        state.stencil.back = {static_cast<Compare>((i + 3) % kCompares), operation(7), operation(1),
                              operation(3)};
        list.add(triangleSoup(random, Soup::inside, 3, kWhole), state);
    }
    list.add(triangleSoup(random, Soup::inside, 3, kWhole), shadow);
    RenderTarget target(kSize_px, kSize_px, format);
    rasterize(target, kWhole, list.draws(), options);
    return planesOf(target);
}

RenderTargetFormat formatOf(int samples, int subpixelBits, DepthFormat depth, DepthRounding rounding,
                            RasterReal real) {
    return {samples, subpixelBits, depth, rounding, real};
}

}  // namespace

void addRasterCases(std::vector<BitCase>& cases) {
    const auto add = [&](std::string name, std::string what, auto run) {
        cases.push_back({"raster/" + std::move(name), std::move(what), true, true, true, std::move(run)});
    };
    const auto addMixed = [&](std::string name, std::string what, const RenderTargetFormat& format) {
        add(std::move(name), std::move(what),
            [format](const RasterOptions& options) { return drawMixed(format, options); });
    };
    using enum DepthFormat;
    using enum DepthRounding;
    using enum RasterReal;
    addMixed("d32f", "mesh and triangles, D32F, fp32 depth", formatOf(1, 8, d32f, exact, fp32));
    addMixed("d32f-fp64-4", "the same, fp64 depth, 4 samples", formatOf(4, 8, d32f, exact, fp64));
    addMixed("d32f-16", "the same, 16 samples", formatOf(16, 8, d32f, exact, fp32));
    addMixed("d24-4", "the same, D24, 4 samples", formatOf(4, 8, d24, exact, fp32));
    addMixed("d24-driver", "the same, D24 as drivers round it", formatOf(1, 8, d24, driver, fp32));
    addMixed("d16-subpixel-4", "the same, D16, 4 subpixel bits", formatOf(1, 4, d16, exact, fp32));
    addMixed("d16-driver-fp64-16",
             "the same, D16 as drivers round it, fp64 depth, 16 samples, 4 subpixel bits",
             formatOf(16, 4, d16, driver, fp64));
    addMixed("d64f-4", "the same, D64F, fp64 depth, 4 samples", formatOf(4, 8, d64f, exact, fp64));
    add("coplanar-d64f", "nearly one plane, D64F, 4 samples",
        [](const RasterOptions& options) { return drawCoplanar(DepthOrder::stored, options); });
    add("coplanar-exact", "the same in the exact order of depths",
        [](const RasterOptions& options) { return drawCoplanar(DepthOrder::exact, options); });

    add("clip", "every clipping plane, pieces of both signs, two viewports",
        [](const RasterOptions& options) {
            return drawClipped(formatOf(1, 8, d32f, exact, fp32), false, options);
        });
    add("clip-clamp-4", "the same with clamped depth, fp64 depth, 4 samples, 4 subpixel bits",
        [](const RasterOptions& options) {
            return drawClipped(formatOf(4, 4, d24, exact, fp64), true, options);
        });
    for (const auto& [name, depth] : {std::pair("d16", d16), std::pair("d24", d24), std::pair("d32f", d32f)})
        add(std::string("bias-") + name, "depth bias, comparisons, culling, facing",
            [depth = depth](const RasterOptions& options) {
                return drawBiased(formatOf(1, 8, depth, exact, fp32), options);
            });
    add("stencil-4", "stencil operations, comparisons and masks, write masks, 4 samples",
        [](const RasterOptions& options) {
            return drawStencilled(formatOf(4, 8, d24, exact, fp32), options);
        });
}

}  // namespace etalon
