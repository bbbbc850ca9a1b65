// Line plots as SVG files, with logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace etalon::experiments {

struct Series {
    std::string name;
    std::vector<double> y;  // above 0
};

struct Plot {
    std::string title, xName, yName;
    std::vector<double> x;  // above 0, rising
    std::vector<Series> series;
};

// The SVG document: x to the base of 2, y to the base of 10; the names of the series stand at their last
// points.
std::string svgOf(const Plot& plot);

}  // namespace etalon::experiments
