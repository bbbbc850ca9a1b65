#include "raster/image.h"

#include <doctest/doctest.h>

using namespace etalon;

TEST_CASE("PlanesAreContiguousAndRowMajor") {
    Image<float> image(3, 2, 2);
    image.at(2, 1, 1) = 5.f;
    CHECK(image.plane(1)[5] == 5.f);
    CHECK(image.row(1, 1)[2] == 5.f);
    CHECK_THROWS_AS(Image<float>(-1, 2), PreconditionError);
    CHECK_THROWS_AS(Image<float>(kMaxImageSize + 1, 1), PreconditionError);
}
