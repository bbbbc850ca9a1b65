// Writes an EXR and a PNG file into the folder that it is given and reads them back; exit code 0 if they hold
// what was written.
#include <filesystem>

#include "files/image_io.h"

int main(int, char** argv) {
    const std::filesystem::path folder = argv[1];
    etalon::Image<float> plane(2, 1);
    plane.at(1, 0) = 0.3f;
    etalon::writeExr({2, 1, {{"Z", plane}}, {}}, folder / "image.exr");
    etalon::Image<uint8_t> colours(2, 1, 3);
    colours.at(1, 0, 2) = 255;
    etalon::writePng(colours, folder / "image.png");
    const bool same = etalon::readRgb(folder / "image.exr").at(1, 0) == 0.3f &&
                      etalon::readRgb(folder / "image.png").at(1, 0, 2) == 1.0f;
    return same ? 0 : 1;
}
