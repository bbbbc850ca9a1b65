#include "probes/summed_area.h"

#include "numeric/door.h"
#include "probes/energy_passes.h"
#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace etalon {

namespace {

// Uninitialised memory for `count` doubles, in huge pages where the system has them: with small ones, the
// page faults of a table of 64 MiB cost twice the time of its sums.
double* allocateTable(size_t count) {
    constexpr size_t kHugePage_bytes = size_t{1} << 21;
    const size_t bytes = (count * sizeof(double) + kHugePage_bytes - 1) / kHugePage_bytes * kHugePage_bytes;
    const bool isLarge = bytes >= 4 * kHugePage_bytes;
    void* memory = isLarge ? std::aligned_alloc(kHugePage_bytes, bytes) : std::malloc(count * sizeof(double));
    if (!memory) throw std::bad_alloc();
    if (isLarge) madvise(memory, bytes, MADV_HUGEPAGE);
    return static_cast<double*>(memory);
}

}  // namespace

EnergyTable::EnergyTable(const Image<float>& radiance, std::span<const double> rowWeights, int threads)
    : width_(radiance.width()),
      height_(radiance.height()),
      inBand_(allocateTable(radiance.pixelCount()), std::free) {
    ETALON_CHECK(
        radiance.channels() == 3 && !radiance.empty() && rowWeights.size() == static_cast<size_t>(height_),
        "{}x{} texels with {} channels, {} weights", width_, height_, radiance.channels(), rowWeights.size());
    const auto width = static_cast<size_t>(width_);
    const EnergyPasses& passes = levelPasses<EnergyPasses>();
    const int bands = (height_ + kBandRows - 1) / kBandRows;
    parallelFor(static_cast<size_t>(bands), threads, [&](size_t band) {
        const int top = static_cast<int>(band) * kBandRows, bottom = std::min(height_, top + kBandRows);
        passes.bandOfTable(radiance, top, bottom, rowWeights.data(),
                           inBand_.get() + static_cast<size_t>(top) * width);
    });
    bandStart_.resize(static_cast<size_t>(bands) * width);
    for (size_t band = 1; band < static_cast<size_t>(bands); band++)
        for (size_t x = 0; x < width; x++) {
            BlockSumsKernel<double, 1> lastRow{{inBand_[(band * kBandRows - 1) * width + x]}};
            bandStart_[band * width + x] = lastRow.sumAlong(bandStart_[(band - 1) * width + x], 1);
        }
}

EnergyTable::EnergyTable(const Image<double>& entries)
    : width_(entries.width()),
      height_(entries.height()),
      inBand_(allocateTable(entries.pixelCount()), std::free),
      bandStart_(static_cast<size_t>((height_ + kBandRows - 1) / kBandRows) * static_cast<size_t>(width_)) {
    ETALON_CHECK(entries.channels() == 1 && !entries.empty(), "{}x{} entries with {} channels", width_,
                 height_, entries.channels());
    std::copy(entries.values().begin(), entries.values().end(), inBand_.get());
}

}  // namespace etalon
