// The vertex stage: object space to world space to clip space, in the profile's vertex arithmetic.
#pragma once

#include <span>
#include <vector>

#include "lighting/surface_scene.h"
#include "lighting/view.h"
#include "raster/draw.h"
#include "raster/render_target.h"
#include "raster/uninitialized_vector.h"

namespace etalon {

// A mesh in world space; one per instance, shared by all views. The doubles hold values of the vertex
// arithmetic.
struct PlacedMesh {
    const SurfaceMesh* mesh = nullptr;
    std::vector<glm::dvec3> positions, normals;  // normals are not normalised
    bool mirrored = false;                       // the transform turns counter-clockwise faces clockwise
    glm::dmat4 toWorld{1};                       // of the mesh's vertices, before the vertex arithmetic
    RasterReal arithmetic = RasterReal::fp32;    // that the positions were computed in
    // How far a position may be from that of exact arithmetic, for this largest coordinate.
    double placingError_m(double largest_m) const {
        return largest_m * (arithmetic == RasterReal::fp32 ? 0x1p-20 : 0x1p-48);
    }
};

// Places every instance of the scene. Throws PreconditionError for an index of a mesh or vertex out of range.
std::vector<PlacedMesh> placeMeshes(const SurfaceScene& scene, RasterReal vertexReal, int threads);

// The vertices in clip space of a view; `vertices` is replaced.
void toClipSpace(const PlacedMesh& placed, const View& view, RasterReal vertexReal, int threads,
                 UninitializedVector<ClipVertex>& vertices);

}  // namespace etalon
