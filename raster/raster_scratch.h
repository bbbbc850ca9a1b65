// What rasterize keeps with a render target from call to call.
#pragma once

#include <map>
#include <mutex>

#include "numeric/door.h"
#include "raster/setup.h"
#include "raster/tile.h"

namespace etalon {

class RasterScratch {
  public:
    UninitializedVector<uint8_t> outcodes;  // of the call's vertices
    std::vector<TriangleSetup> setups;      // one per chunk of triangles
    UninitializedVector<uint32_t> listed;  // the triangles of each tile, tile after tile, in submission order
    std::vector<size_t> firstListed;       // of each tile; one more at the end

    // A tile rasterizer of the active level that no other thread has.
    std::unique_ptr<TileRasterizer> take() {
        const std::lock_guard lock(mutex_);
        auto& idle = idle_[activeIsa()];
        if (idle.empty()) return levelPasses<TilePasses>().makeRasterizer();
        auto rasterizer = std::move(idle.back());
        idle.pop_back();
        return rasterizer;
    }
    void giveBack(std::unique_ptr<TileRasterizer> rasterizer) {
        const std::lock_guard lock(mutex_);
        idle_[activeIsa()].push_back(std::move(rasterizer));
    }

  private:
    std::mutex mutex_;
    std::map<IsaLevel, std::vector<std::unique_ptr<TileRasterizer>>> idle_;
};

}  // namespace etalon
