#include "experiments/plot.h"

#include <algorithm>
#include <cmath>

#include "numeric/text.h"

namespace etalon::experiments {
namespace {

constexpr double kWidth = 760, kHeight = 460, kLeft = 70, kRight = 150, kTop = 40, kBottom = 55;
constexpr double kLabelHeight = 14;
constexpr const char* kColours[] = {"#1b6ca8", "#d1495b", "#2e8b57", "#edae49", "#6a4c93", "#17becf",
                                    "#8d5b4c", "#444444", "#c2185b", "#7cb342", "#ff6f00"};

// Where the x axis is marked: at the plot's values, or at 1, 2 and 5 times the powers of ten around those of
// all series.
std::vector<double> ticksOf(const Plot& plot) {
    if (!plot.x.empty()) return plot.x;
    double least = plot.series[0].x[0], largest = least;
    for (const Series& s : plot.series)
        for (const double x : s.x) least = std::min(least, x), largest = std::max(largest, x);
    std::vector<double> ticks;
    for (double decade = std::pow(10.0, std::floor(std::log10(least))); decade < 10 * largest; decade *= 10)
        for (const double step : {1.0, 2.0, 5.0}) ticks.push_back(step * decade);
    while (ticks.size() > 2 && ticks[1] <= least) ticks.erase(ticks.begin());
    while (ticks.size() > 2 && ticks[ticks.size() - 2] >= largest) ticks.pop_back();
    return ticks;
}

}  // namespace

std::string svgOf(const Plot& plot) {
    double least = plot.series[0].y[0], largest = least;
    for (const Series& s : plot.series)
        for (const double y : s.y) least = std::min(least, y), largest = std::max(largest, y);
    const double low = std::floor(std::log10(least)),
                 high = std::max(low + 1.0, std::ceil(std::log10(largest)));
    const std::vector<double> ticks = ticksOf(plot);
    const double first = std::log2(ticks.front()), last = std::log2(ticks.back());
    const auto px = [&](double x) {
        return kLeft + (kWidth - kLeft - kRight) * (std::log2(x) - first) / (last - first);
    };
    const auto py = [&](double y) {
        return kTop + (kHeight - kTop - kBottom) * (high - std::log10(y)) / (high - low);
    };

    const auto xOf = [&](const Series& s) -> const std::vector<double>& {
        return s.x.empty() ? plot.x : s.x;
    };

    std::string svg = formatText(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{}\" height=\"{}\" fill=\"white\"/>\n",
        kWidth, kHeight, kWidth, kHeight, kWidth, kHeight);
    const auto text = [&](double x, double y, const char* anchor, const std::string& words,
                          const std::string& more = "") {
        svg += formatText("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor,
                          more, words);
    };
    const auto line = [&](double x0, double y0, double x1, double y1, const char* colour) {
        svg += formatText("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
                          x0, y0, x1, y1, colour);
    };
    text(kLeft, 22, "start", plot.title, " font-size=\"15\"");
    text((kLeft + kWidth - kRight) / 2, kHeight - 12, "middle", plot.xName);
    text(18, (kTop + kHeight - kBottom) / 2, "middle", plot.yName,
         formatText(" transform=\"rotate(-90 18 {:.1f})\"", (kTop + kHeight - kBottom) / 2));
    for (const double x : ticks) {
        line(px(x), kTop, px(x), kHeight - kBottom, "#e4e4e4");
        text(px(x), kHeight - kBottom + 18, "middle", formatText("{:g}", x));
    }
    for (int decade = static_cast<int>(low); decade <= static_cast<int>(high); decade++)
        for (int step = 1; step <= (decade < high ? 9 : 1); step++) {
            const double y = step * std::pow(10.0, decade);
            line(kLeft, py(y), kWidth - kRight, py(y), step == 1 ? "#c4c4c4" : "#f0f0f0");
            if (step == 1 || step == 2 || step == 5) text(kLeft - 6, py(y) + 4, "end", formatText("{:g}", y));
        }
    line(kLeft, kTop, kLeft, kHeight - kBottom, "black");
    line(kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom, "black");

    // Labels from top to bottom, none over another.
    std::vector<size_t> order(plot.series.size());
    for (size_t i = 0; i < order.size(); i++) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return plot.series[a].y.back() > plot.series[b].y.back(); });
    std::vector<double> label(order.size());
    double free = kTop;
    for (const size_t i : order) {
        label[i] = std::max(free, py(plot.series[i].y.back()));
        free = label[i] + kLabelHeight;
    }
    const double beyond = std::max(0.0, free - kLabelHeight - (kHeight - kBottom));
    for (size_t i = 0; i < plot.series.size(); i++) {
        const Series& s = plot.series[i];
        const char* colour = kColours[i % std::size(kColours)];
        std::string points;
        for (size_t k = 0; k < s.y.size(); k++)
            points += formatText("{}{:.1f},{:.1f}", k == 0 ? "" : " ", px(xOf(s)[k]), py(s.y[k]));
        svg += formatText("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n",
                          points, colour);
        for (size_t k = 0; k < s.x.size(); k++)
            svg += formatText("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", px(s.x[k]),
                              py(s.y[k]), k == 0 ? 4.5 : 2.5, colour);
        const double end = kWidth - kRight;
        if (s.x.empty()) line(end, py(s.y.back()), end + 14, label[i] - beyond, colour);
        text(end + 18, label[i] - beyond + 4, "start", s.name, formatText(" fill=\"{}\"", colour));
    }
    return svg + "</svg>\n";
}

}  // namespace etalon::experiments
