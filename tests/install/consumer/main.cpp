// Draws one triangle with an installed Etalon; exit code 0 if it covers half of the image.
#include <array>
#include <cstdint>

#include "lighting/render_view.h"
#include "raster/rasterizer.h"

int main() {
    etalon::RenderTarget target(64, 64, {});
    const std::array<etalon::ClipVertex, 3> vertices = {{{-1, -1, 0.5, 1}, {1, -1, 0.5, 1}, {-1, 1, 0.5, 1}}};
    const std::array<uint32_t, 3> indices = {0, 1, 2};
    etalon::Draw draw;
    draw.vertices = vertices;
    draw.indices = indices;
    etalon::rasterize(target, {0, 0, 64, 64}, {&draw, 1});
    int covered = 0;
    for (const uint32_t id : target.id.values()) covered += id != etalon::kNoTriangle ? 1 : 0;
    // The diagonal runs through pixel centres and belongs to one side only.
    return covered == 64 * 63 / 2 || covered == 64 * 65 / 2 ? 0 : 1;
}
