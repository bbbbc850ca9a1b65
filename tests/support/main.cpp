// doctest's main with one more option: --isa=LEVEL runs the tests at an instruction set level
// (numeric/isa.h).
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>

#include "numeric/isa.h"

int main(int argc, char** argv) {
    constexpr const char* kOption = "--isa=";
    for (int i = 1; i < argc; i++) {
        if (std::strncmp(argv[i], kOption, std::strlen(kOption)) != 0) continue;
        const auto level = etalon::findIsa(argv[i] + std::strlen(kOption));
        if (!level) {
            std::fprintf(stderr, "%s: no such level\n", argv[i]);
            return 2;
        }
        etalon::selectIsa(*level);
    }
    return doctest::Context(argc, argv).run();
}
