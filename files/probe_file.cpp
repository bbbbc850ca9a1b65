#include "files/probe_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "files/image_io.h"
#include "numeric/text.h"
#include "probes/names.h"
#include "probes/texel_grid.h"

namespace etalon {
namespace {

constexpr const char* kMappingKey = "etalon.mapping";
constexpr const char* kBallDistanceKey = "etalon.ballDistance";
constexpr const char* kRotationKey = "etalon.rotation";
constexpr const char* kPositionKey = "etalon.position";
// How far the columns of a file's rotation may be from orthonormal.
constexpr double kRotationTolerance = 1e-6;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw InputError(formatText("{}: {}", path.string(), reason));
}

// The numbers of an attribute, between blanks.
std::vector<double> numbersOf(const std::filesystem::path& path, const std::string& key,
                              const std::string& text, size_t count) {
    std::vector<double> numbers;
    const char *at = text.data(), *end = at + text.size();
    while (at != end) {
        if (*at == ' ') {
            at++;
            continue;
        }
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) break;
        numbers.push_back(value);
        at = next;
    }
    if (at != end || numbers.size() != count)
        fail(path, formatText("attribute {} is not {} number{}", key, count, count == 1 ? "" : "s"));
    return numbers;
}

const std::string* findText(const Frame& frame, const std::string& key) {
    const auto found = frame.metadata.find(key);
    return found == frame.metadata.end() ? nullptr : &found->second;
}

struct FileShape {
    Mapping mapping;
    CubeLayout layout = CubeLayout::openExrStrip;
};

std::optional<CubeLayout> cubeLayoutOfSize(int width, int height) {
    if (height == 6 * width) return CubeLayout::openExrStrip;
    if (4 * height == 3 * width) return CubeLayout::horizontalCross;
    if (3 * height == 4 * width) return CubeLayout::verticalCross;
    return std::nullopt;
}

FileShape shapeOf(const Frame& frame, const ProbeFileOptions& options, const std::filesystem::path& path) {
    const auto byShape = cubeLayoutOfSize(frame.width, frame.height);
    std::optional<Mapping> mapping = options.mapping;
    if (!mapping && options.layout) mapping = Mapping::cube;
    if (!mapping) {
        if (const std::string* name = findText(frame, kMappingKey)) {
            mapping = memberOf<Mapping>(*name);
            if (!mapping) fail(path, formatText("attribute {} is unknown", kMappingKey));
        }
    }
    if (!mapping) {
        if (const std::string* name = findText(frame, "envmap"))
            mapping = *name == "cube" ? Mapping::cube : Mapping::latLong;
    }
    if (!mapping) {
        if (frame.width == 2 * frame.height)
            mapping = Mapping::latLong;
        else if (byShape)
            mapping = Mapping::cube;
        else
            fail(path,
                 formatText("{}x{} may be any mapping; say which (--mapping)", frame.width, frame.height));
    }
    FileShape shape{*mapping};
    if (*mapping != Mapping::cube) {
        if (!isLatLong(*mapping) && frame.width != frame.height)
            fail(path, formatText("{}x{} is not square, as the mapping {} is", frame.width, frame.height,
                                  nameOf(*mapping)));
        return shape;
    }
    if (!byShape)
        fail(path, formatText("{}x{} is no strip and no cross of cube faces", frame.width, frame.height));
    shape.layout = options.layout.value_or(*byShape);
    const int size = frame.width / layoutSize(shape.layout, 1).width;
    if (size < 1 || layoutSize(shape.layout, size) != LayoutSize{frame.width, frame.height})
        fail(path, formatText("{}x{} does not fit the layout of cube faces", frame.width, frame.height));
    return shape;
}

// The layers of one or three planes of a file.
std::vector<Image<float>> layersOf(const Image<float>& image, const FileShape& shape) {
    if (shape.mapping != Mapping::cube) return {image};
    const CubeMap<float> cube = unpackCube(image, shape.layout);
    return {cube.faces.begin(), cube.faces.end()};
}

Image<float> planeOf(const Channel& channel, const std::filesystem::path& path) {
    const auto* image = std::get_if<Image<float>>(&channel.values);
    if (!image) fail(path, formatText("channel {} holds identifiers (uint32)", channel.name));
    return *image;
}

void readPlace(Probe& probe, const Frame& frame, const std::filesystem::path& path) {
    if (const std::string* text = findText(frame, kRotationKey)) {
        const auto rows = numbersOf(path, kRotationKey, *text, 9);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) probe.rotation[c][r] = rows[static_cast<size_t>(3 * r + c)];
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                const glm::dvec3 &u = probe.rotation[a], &v = probe.rotation[b];
                const double product = u.x * v.x + (u.y * v.y + u.z * v.z);
                if (!(std::fabs(product - (a == b ? 1 : 0)) <= kRotationTolerance))
                    fail(path, formatText("attribute {} is no rotation", kRotationKey));
            }
        const glm::dmat3& m = probe.rotation;
        const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) -
                                   m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
                                   m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
        if (determinant < 0)
            fail(path, formatText("attribute {} is a reflection, no rotation", kRotationKey));
    }
    if (const std::string* text = findText(frame, kPositionKey)) {
        const auto p = numbersOf(path, kPositionKey, *text, 3);
        probe.position_m = {p[0], p[1], p[2]};
    }
}

}  // namespace

Probe loadProbe(const std::filesystem::path& path, const ProbeFileOptions& options) {
    const Frame frame = readFrame(path);
    const FileShape shape = shapeOf(frame, options, path);
    Probe probe;
    probe.radiance = layersOf(rgbOf(frame, path), shape);
    probe.shape.mapping = shape.mapping;
    probe.shape.width = probe.radiance[0].width();
    probe.shape.height = probe.radiance[0].height();
    if (shape.mapping == Mapping::mirrorBall) {
        if (const std::string* text = findText(frame, kBallDistanceKey); text && *text != "inf")
            probe.shape.ballDistance_radii = numbersOf(path, kBallDistanceKey, *text, 1)[0];
        if (options.ballDistance_radii) probe.shape.ballDistance_radii = *options.ballDistance_radii;
        if (!(probe.shape.ballDistance_radii >= kLeastBallDistance_radii))
            fail(path, formatText("a mirror ball seen from {} radii", probe.shape.ballDistance_radii));
    }
    if (const Channel* channel = frame.find("distance"))
        probe.distance_m = layersOf(planeOf(*channel, path), shape);
    if (const Channel* channel = frame.find("valid"))
        for (const Image<float>& layer : layersOf(planeOf(*channel, path), shape)) {
            Image<uint8_t> valid(layer.width(), layer.height());
            std::ranges::transform(layer.values(), valid.values().begin(),
                                   [](float v) -> uint8_t { return v > 0 ? 1 : 0; });
            probe.valid.push_back(std::move(valid));
        }
    readPlace(probe, frame, path);
    return probe;
}

Frame frameOfProbe(const Probe& probe, CubeLayout layout) {
    checkProbe(probe);
    const auto packed = [&](std::vector<Image<float>> layers) {
        if (probe.shape.mapping != Mapping::cube) return layers[0];
        CubeMap<float> cube;
        std::ranges::move(layers, cube.faces.begin());
        return packCube(cube, layout);
    };
    Frame frame;
    const auto add = [&](const Image<float>& image, std::initializer_list<const char*> names) {
        frame.width = image.width();
        frame.height = image.height();
        int c = 0;
        for (const char* name : names) {
            Image<float> plane(image.width(), image.height());
            std::ranges::copy(image.plane(c++), plane.values().begin());
            frame.channels.push_back({name, std::move(plane)});
        }
    };
    add(packed(probe.radiance), {"R", "G", "B"});
    if (!probe.distance_m.empty()) add(packed(probe.distance_m), {"distance"});
    if (!probe.valid.empty()) {
        std::vector<Image<float>> layers;
        for (const Image<uint8_t>& valid : probe.valid) {
            Image<float> layer(valid.width(), valid.height());
            std::ranges::copy(valid.values(), layer.values().begin());
            layers.push_back(std::move(layer));
        }
        add(packed(std::move(layers)), {"valid"});
    }
    const glm::dmat3& m = probe.rotation;
    const glm::dvec3& p = probe.position_m;
    frame.metadata[kMappingKey] = nameOf(probe.shape.mapping);
    frame.metadata[kRotationKey] = formatText("{} {} {} {} {} {} {} {} {}", m[0][0], m[1][0], m[2][0],
                                              m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2]);
    frame.metadata[kPositionKey] = formatText("{} {} {}", p.x, p.y, p.z);
    if (probe.shape.mapping == Mapping::mirrorBall)
        frame.metadata[kBallDistanceKey] = formatText("{}", probe.shape.ballDistance_radii);
    // OpenEXR's attribute says that the image is in the layout of its specification.
    if (probe.shape.mapping == Mapping::latLong) frame.metadata["envmap"] = "latlong";
    if (probe.shape.mapping == Mapping::cube && layout == CubeLayout::openExrStrip)
        frame.metadata["envmap"] = "cube";
    return frame;
}

}  // namespace etalon
