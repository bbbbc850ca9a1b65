// The verbs check and accept with a renderer whose scenes are files that hold one number, the value of R; the
// verb bits with cases that a file changes.
#include <fstream>

#include "app/command_line.h"
#include "app/verbs.h"
#include "bitcheck/bit_case.h"
#include "golden/golden.h"

namespace {

etalon::Frame renderNumber(const etalon::GoldenManifest& manifest, const etalon::GoldenCase& c) {
    const std::filesystem::path path = manifest.resolve(c.scene);
    std::ifstream file(path);
    float value = 0;
    if (!(file >> value)) throw etalon::InputError(path.string() + ":1: not a number");
    etalon::Image<float> image(3, 2);
    image.fill(value);
    return {3, 2, {{"R", image}, {"G", image}, {"B", image}, {"Z", etalon::Image<float>(3, 2)}}, {}};
}

// A case of 70 x 50 numbers in two layers. A file planted.txt with a number of threads makes the word of
// pixel (66, 33) in layer 1 one more when that many threads run (0: always).
etalon::BitCase countingCase(const std::string& name) {
    return {name, "numbers in a row", true, true, true, [](const etalon::RasterOptions& options) {
                etalon::Image<float> image(70, 50, 2);
                for (size_t i = 0; i < image.values().size(); i++) image.values()[i] = static_cast<float>(i);
                int threads = -1;
                if (std::ifstream("planted.txt") >> threads && (threads == 0 || threads == options.threads))
                    image.at(66, 33, 1) += 1;
                return std::vector<etalon::BitPlane>{etalon::planeOf("numbers", image)};
            }};
}

}  // namespace

int main(int argc, char** argv) {
    const etalon::GoldenSupport support{renderNumber, "1"};
    const std::vector<etalon::BitCase> cases = {countingCase("count/one"), countingCase("count/two")};
    etalon::Command command;
    etalon::addCompare(command);
    etalon::addCheck(command, support);
    etalon::addAccept(command, support);
    etalon::addBits(command, cases);
    return static_cast<int>(command.run(argc, argv));
}
