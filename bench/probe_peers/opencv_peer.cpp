#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/probe_peers/probe_peers.h"
#include "probes/mapping.h"
#include "probes/texel_grid.h"

namespace etalon::bench {
namespace {

// Three channels in a texel, as OpenCV has them.
cv::Mat matOf(const Image<float>& image) {
    cv::Mat mat(image.height(), image.width(), CV_32FC3);
    for (int y = 0; y < image.height(); y++)
        for (int x = 0; x < image.width(); x++)
            mat.at<cv::Vec3f>(y, x) = {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
    return mat;
}

}  // namespace

CubeMaker openCvCubes(const Probe& latLong, const ProbeShape& cube) {
    cv::setNumThreads(1);
    const cv::Mat source = matOf(latLong.radiance[0]);
    const TexelGrid grid(cube);
    MappingKernel<double> kernel;
    cv::Mat u(cube.layers() * cube.height, cube.width, CV_32FC1), v = u.clone();
    for (int layer = 0; layer < cube.layers(); layer++)
        for (int y = 0; y < cube.height; y++)
            for (int x = 0; x < cube.width; x++) {
                const auto c = kernel.latLongCoordinates(grid.direction(layer, x, y));
                u.at<float>(layer * cube.height + y, x) = static_cast<float>(c.u * latLong.shape.width - 0.5);
                v.at<float>(layer * cube.height + y, x) =
                    static_cast<float>(c.v * latLong.shape.height - 0.5);
            }
    return [source, u, v, faces = cv::Mat()](Probe& result) mutable {
        cv::remap(source, faces, u, v, cv::INTER_LINEAR, cv::BORDER_WRAP);
        // The result stays as OpenCV has it; its planes are what is compared, not what is timed.
        if (result.radiance.empty()) return;
        const int size = result.shape.width;
        for (int y = 0; y < faces.rows; y++)
            for (int x = 0; x < size; x++)
                for (int c = 0; c < 3; c++)
                    result.radiance[static_cast<size_t>(y / size)].at(x, y % size, c) =
                        faces.at<cv::Vec3f>(y, x)[c];
    };
}

}  // namespace etalon::bench
