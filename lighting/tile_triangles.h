// The visible triangles of a tile, set up once each for interpolation, and what a group of fragments reads
// from them (rule 5).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/shading_kernels.h"
#include "lighting/vertex_lighting.h"
#include "numeric/number.h"
#include "raster/fragments.h"
#include "raster/setup.h"

namespace etalon {

// T: number type of the fragment arithmetic. A triangle is a record of words as T is stored; lanes get theirs
// by transposing the records of their triangles.
template <class T>
class TileTriangles {
  public:
    using K = ShadingKernels<T>;
    using vec3 = typename K::vec3;
    static constexpr int N = Number<T>::lanes;

    // The triangles of a group's fragments, and where these are shaded.
    struct Group {
        std::array<uint32_t, N> triangle;  // those behind a short group repeat the last one
        std::array<int32_t, N> x_subpx, y_subpx;
        bool isOneTriangle;
    };
    // What each attribute of a group is interpolated with.
    struct Weights {
        vec3 b;
        T facing;                    // 1 or -1
        std::array<vec3, 3> normal;  // x, y and z of the three corners
    };

    // Forgets all; triangles 0 .. count - 1 may be set.
    void reset(size_t count);
    void set(size_t number, const RenderTarget& target, uint32_t id, const PlacedMesh& placed);

    // What the corners of a triangle that is set reflect on the side that is seen.
    void setRadiance(size_t number, const RenderTarget& target, uint32_t id, const PlacedMesh& placed,
                     const VertexRadiance& radiance);

    Weights weights(const Group& group) const;
    vec3 normal(const Weights& w) const;  // interpolated, of any length
    vec3 position(const Weights& w, const Group& group) const;
    std::array<T, 2> surfaceCoordinates(const Weights& w, const Group& group) const;
    vec3 diffuseRadiance(const Weights& w, const Group& group) const { return radiance(w, group, 0); }
    vec3 specularRadiance(const Weights& w, const Group& group) const {
        return radiance(w, group, kSpecularRadiance);
    }
    T open(const Weights& w, const Group& group) const {
        return interpolated(w, three(columns<3>(&radiance_[kOpen], kRadianceWords, group).data()));
    }

  private:
    using Stored = typename Number<T>::Stored;
    using Row = Lanes<Stored, N>;
    using Whole = Lanes<uint32_t, N>;

    // Words of a record: attributes have three, for the corners, per component.
    static constexpr size_t kAreaScale = 0, kQ = 1, kFacing = 4, kNormal = 5, kPosition = 14, kSurface = 23,
                            kUsedWords = 29, kWords = 32;
    // Edge values inside a triangle whose area fits 31 bits do as well: computed modulo 2^32, from the steps
    // and the constant of edges 1 and 2; the value of edge 0 is what is left of the area.
    static constexpr size_t kEdge1 = 0, kEdge2 = 3, kArea = 6, kLarge = 7, kEdgeWords = 8;
    using LargeEdges = std::array<EdgeFunction, 3>;

    // Words of a record of what the corners reflect; blocks of N words are read.
    static constexpr size_t kOpen = 9, kSpecularRadiance = 16, kRadianceWords = 32;

    // The vertices of a triangle in the order of the source, and its corners.
    struct Corners {
        const RenderTarget& target;
        uint32_t id;
        const TriangleRecord record;
        const uint32_t* index;
    };
    static Corners cornersOf(const RenderTarget& target, uint32_t id, const PlacedMesh& placed);
    template <class ValueOf>
    static void gatherComponent(const Corners& corners, const ValueOf& valueOf, double* words);
    template <class Vectors>
    static void gather(const Corners& corners, const Vectors& values, int components, double* words);
    static void storeWords(const double* words, size_t count, Stored* to);
    vec3 radiance(const Weights& w, const Group& group, size_t first) const {
        const auto words = columns<9>(&radiance_[first], kRadianceWords, group);
        return {interpolated(w, three(&words[0])), interpolated(w, three(&words[3])),
                interpolated(w, three(&words[6]))};
    }

    void setEdges(size_t number, const TriangleRecord& record);
    double edgeValue(const Group& group, size_t lane, size_t edge) const;
    vec3 edgeValues(const Group& group, const Row& areaScale) const;
    template <size_t kCount, class S>
    static std::array<Lanes<S, N>, kCount> columns(const S* first, size_t stride, const Group& group);
    static T number(const Row& row);
    T interpolated(const Weights& w, const vec3& corners) const {
        K kernels;
        return kernels.interpolateAttribute(w.b, corners);
    }
    static vec3 three(const Row* rows) { return {number(rows[0]), number(rows[1]), number(rows[2])}; }

    std::vector<Stored> words_, radiance_;
    std::vector<uint32_t> edges_;
    std::vector<LargeEdges> large_;  // of the triangles with a larger area; kLarge is one more than the index
};

template <class T>
void TileTriangles<T>::reset(size_t count) {
    // Blocks of N words are read, also from the last record's end.
    words_.resize(std::max(words_.size(), count * kWords + N));
    edges_.resize(std::max(edges_.size(), count * kEdgeWords + N));
    large_.clear();
}

template <class T>
void TileTriangles<T>::setEdges(size_t number, const TriangleRecord& record) {
    const auto edges = edgeFunctions(record);
    uint32_t* to = &edges_[number * kEdgeWords];
    for (size_t i = 0; i < 2; i++) {
        const EdgeFunction& edge = edges[i + 1];
        to[3 * i] = static_cast<uint32_t>(edge.stepX);
        to[3 * i + 1] = static_cast<uint32_t>(edge.stepY);
        to[3 * i + 2] = static_cast<uint32_t>(edge.constant);
    }
    to[kArea] = static_cast<uint32_t>(record.area);
    to[kLarge] = 0;
    if (record.area > std::numeric_limits<int32_t>::max()) {
        large_.push_back(edges);
        to[kLarge] = static_cast<uint32_t>(large_.size());
    }
}

template <class T>
typename TileTriangles<T>::Corners TileTriangles<T>::cornersOf(const RenderTarget& target, uint32_t id,
                                                               const PlacedMesh& placed) {
    const TriangleRecord record = target.triangle(id);
    return {target, id, record, &placed.mesh->indices[3 * size_t{record.triangle}]};
}

// A number at the corners of a triangle: three words in the order of the record. valueOf: of a vertex.
// Magnitudes below 2^-60 are 0.
template <class T>
template <class ValueOf>
void TileTriangles<T>::gatherComponent(const Corners& corners, const ValueOf& valueOf, double* words) {
    constexpr double kSmallestAttribute = 0x1p-60;
    const uint32_t* index = corners.index;
    const std::array<double, 3> source = {valueOf(index[0]), valueOf(index[1]), valueOf(index[2])};
    for (size_t k = 0; k < 3; k++) {
        double value = source[corners.record.corner[k]];
        if (corners.record.clipped) {
            const auto& beta = corners.target.barycentric(corners.id, k);
            value = beta[0] * source[0] + (beta[1] * source[1] + beta[2] * source[2]);
        }
        words[k] = std::fabs(value) < kSmallestAttribute ? 0.0 : value;
    }
}

// The first components of the vectors at the corners, one after the other.
template <class T>
template <class Vectors>
void TileTriangles<T>::gather(const Corners& corners, const Vectors& values, int components, double* words) {
    for (int c = 0; c < components; c++)
        gatherComponent(
            corners, [&](uint32_t i) { return double{values[i][c]}; }, words + 3 * c);
}

// Each rounded once. count: a multiple of N.
template <class T>
void TileTriangles<T>::storeWords(const double* words, size_t count, Stored* to) {
    if constexpr (std::is_same_v<T, Lanes<float, N>> || std::is_same_v<T, float>)
        for (size_t i = 0; i < count; i++) to[i] = static_cast<float>(words[i]);
    else
        for (size_t i = 0; i < count; i += N) Number<T>::store(Number<T>::load(&words[i]), to + i, N);
}

template <class T>
void TileTriangles<T>::set(size_t number, const RenderTarget& target, uint32_t id, const PlacedMesh& placed) {
    const Corners corners = cornersOf(target, id, placed);
    setEdges(number, corners.record);
    const WeightScale scale = weightScale(corners.record);
    std::array<double, kWords> words{};
    for (size_t k = 0; k < 3; k++) words[kQ + k] = scale.q[k];
    words[kFacing] = corners.record.front ? 1.0 : -1.0;
    gather(corners, placed.normals, 3, &words[kNormal]);
    gather(corners, placed.positions, 3, &words[kPosition]);
    if (!placed.mesh->uv_m.empty()) gather(corners, placed.mesh->uv_m, 2, &words[kSurface]);
    storeWords(words.data(), kWords, &words_[number * kWords]);
    // A power of two is exact.
    words_[number * kWords + kAreaScale] = static_cast<Stored>(scale.areaScale);
}

template <class T>
void TileTriangles<T>::setRadiance(size_t number, const RenderTarget& target, uint32_t id,
                                   const PlacedMesh& placed, const VertexRadiance& radiance) {
    radiance_.resize(std::max(radiance_.size(), (number + 1) * kRadianceWords + N));
    const Corners corners = cornersOf(target, id, placed);
    const auto& side = radiance.sides[corners.record.front ? 0 : 1];
    std::array<double, kRadianceWords> words{};
    gather(corners, side.diffuse, 3, &words[0]);
    gather(corners, side.specular, 3, &words[kSpecularRadiance]);
    if (!side.open.empty())
        gatherComponent(
            corners, [&](uint32_t i) { return side.open[i]; }, &words[kOpen]);
    storeWords(words.data(), kRadianceWords, &radiance_[number * kRadianceWords]);
}

// A stored row as numbers of T.
template <class T>
T TileTriangles<T>::number(const Row& row) {
    if constexpr (std::is_same_v<T, Row>)
        return row;
    else if constexpr (requires { T::ofRepresentable(row); })
        return T::ofRepresentable(row);
    else
        return T(row[0]);
}

// Words 0 .. kCount - 1 at `first` of the record of each lane's triangle.
template <class T>
template <size_t kCount, class S>
std::array<Lanes<S, TileTriangles<T>::N>, kCount> TileTriangles<T>::columns(const S* first, size_t stride,
                                                                            const Group& group) {
    using L = Lanes<S, N>;
    std::array<L, kCount> result;
    if (group.isOneTriangle) {
        const S* words = first + stride * group.triangle[0];
        for (size_t i = 0; i < kCount; i++) result[i] = L(words[i] - typename L::Vector{});
        return result;
    }
    constexpr size_t kBlock = static_cast<size_t>(N);
    for (size_t block = 0; block < kCount; block += kBlock) {
        std::array<L, kBlock> rows;
        for (size_t i = 0; i < kBlock; i++) rows[i] = L::load(first + stride * group.triangle[i] + block);
        transposeLanes(rows);
        for (size_t i = 0; i < std::min(kBlock, kCount - block); i++) result[block + i] = rows[i];
    }
    return result;
}

// One edge value of a lane, exactly.
template <class T>
double TileTriangles<T>::edgeValue(const Group& group, size_t lane, size_t edge) const {
    const uint32_t* words = &edges_[group.triangle[lane] * kEdgeWords];
    const int32_t x = group.x_subpx[lane], y = group.y_subpx[lane];
    if (words[kLarge] != 0) return static_cast<double>(large_[words[kLarge] - 1][edge].at(x, y));
    const auto value = [&](const uint32_t* e) {
        return e[0] * static_cast<uint32_t>(x) + e[1] * static_cast<uint32_t>(y) + e[2];
    };
    const uint32_t e_1 = value(words + kEdge1), e_2 = value(words + kEdge2);
    return edge == 0 ? words[kArea] - (e_1 + e_2) : edge == 1 ? e_1 : e_2;
}

// Edge values times 2^m, each rounded once.
template <class T>
typename TileTriangles<T>::vec3 TileTriangles<T>::edgeValues(const Group& group, const Row& areaScale) const {
    if constexpr (N > 1) {
        const auto words = columns<kEdgeWords>(edges_.data(), kEdgeWords, group);
        if (!anyOf(words[kLarge] != Whole(0.0))) {
            using Signed = Lanes<int32_t, N>;
            const auto positions = [](const std::array<int32_t, N>& a) {
                return Whole(__builtin_bit_cast(typename Whole::Vector, Signed::load(a.data()).v));
            };
            const Whole x = positions(group.x_subpx), y = positions(group.y_subpx);
            const auto value = [&](size_t e) { return words[e] * x + (words[e + 1] * y + words[e + 2]); };
            const Whole e_1 = value(kEdge1), e_2 = value(kEdge2);
            const auto scaled = [&](const Whole& e) {
                const Signed inside(__builtin_bit_cast(typename Signed::Vector, e.v));
                // The product with a power of two is rounded once: a narrow number's is exact in float for
                // integers of at most 24 bits; larger ones lose 7 bits to the last one left (rounding to odd).
                if constexpr (std::is_same_v<T, Narrow<Row>>) {
                    const Signed cut(0x7f), largest(0x1p24);
                    const Signed odd = (inside | ((inside & cut) + cut)) & Signed(-0x80);
                    return T(convertLanes<Stored>(select(inside > largest, odd, inside)) * areaScale);
                } else {
                    return T(convertLanes<Stored>(inside) * areaScale);
                }
            };
            return {scaled(words[kArea] - (e_1 + e_2)), scaled(e_1), scaled(e_2)};
        }
    }
    const auto scaled = [&](size_t edge) {
        return Number<T>::generate([&](int i) {
            return edgeValue(group, static_cast<size_t>(i), edge) * static_cast<double>(areaScale[i]);
        });
    };
    return {scaled(0), scaled(1), scaled(2)};
}

template <class T>
typename TileTriangles<T>::Weights TileTriangles<T>::weights(const Group& group) const {
    const auto words = columns<kPosition>(words_.data(), kWords, group);
    K kernels;
    Weights w;
    w.b = kernels.perspectiveWeights(edgeValues(group, words[kAreaScale]), three(&words[kQ]));
    w.facing = number(words[kFacing]);
    for (size_t i = 0; i < 3; i++) w.normal[i] = three(&words[kNormal + 3 * i]);
    return w;
}

template <class T>
typename TileTriangles<T>::vec3 TileTriangles<T>::normal(const Weights& w) const {
    return {interpolated(w, w.normal[0]), interpolated(w, w.normal[1]), interpolated(w, w.normal[2])};
}

template <class T>
typename TileTriangles<T>::vec3 TileTriangles<T>::position(const Weights& w, const Group& group) const {
    const auto words = columns<kSurface - kPosition>(&words_[kPosition], kWords, group);
    return {interpolated(w, three(&words[0])), interpolated(w, three(&words[3])),
            interpolated(w, three(&words[6]))};
}

template <class T>
std::array<T, 2> TileTriangles<T>::surfaceCoordinates(const Weights& w, const Group& group) const {
    const auto words = columns<kUsedWords - kSurface>(&words_[kSurface], kWords, group);
    return {interpolated(w, three(&words[0])), interpolated(w, three(&words[3]))};
}

}  // namespace etalon
