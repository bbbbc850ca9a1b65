// Line plots as SVG files, with logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace etalon::experiments {

struct Series {
    std::string name;
    std::vector<double> y;       // above 0
    std::vector<double> x = {};  // its own; empty: the plot's
};

struct Plot {
    std::string title, xName, yName;
    std::vector<double> x;  // above 0, rising; empty: each series has its own, and the axis is one of decades
    std::vector<Series> series;
};

// The SVG document, x and y logarithmic; the names of the series stand beside their last points. Points of
// series with x of their own are marked.
std::string svgOf(const Plot& plot);

}  // namespace etalon::experiments
