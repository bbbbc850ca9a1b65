// Number types, elementary functions, sums and samplers on tables of arguments.
#include <limits>
#include <span>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "bitcheck/number_tables.h"
#include "numeric/door.h"
#include "numeric/elementary.h"
#include "numeric/sum.h"

namespace etalon {
namespace {

constexpr size_t kArguments = 2048;
constexpr double kInfinity = std::numeric_limits<double>::infinity(),
                 kNan = std::numeric_limits<double>::quiet_NaN();

// Of either sign, magnitudes spread over exponents.
double spread(Random& random, int lowExponent, int highExponent) {
    const double scale = powerOfTwo(random.integer(lowExponent, highExponent));
    const double magnitude = scale * random.uniform(1, 2);
    return random.chance(0.5) ? magnitude : -magnitude;
}

// kArguments pairs; each number is made by a statement of its own.
template <class A, class B>
ArgumentTable makeTable(A&& makeA, B&& makeB) {
    ArgumentTable table;
    for (size_t i = 0; i < kArguments; i++) {
        table.a.push_back(makeA());
        table.b.push_back(makeB());
    }
    return table;
}

NumberTables makeTables() {
    static constexpr double kSpecial[] = {
        0.0,     -0.0,           1,       -1,        65504,      65519,    65520,
        0x1p-14, 0x1p-15,        0x1p-24, 0x1p-25,   -0x1p-126,  0x1p-127, 0x1p-149,
        0x1p64,  0x1.fffffep127, 0x1p128, kInfinity, -kInfinity, kNan};
    static constexpr double kAxes[] = {0.0, -0.0, 1, -1, kInfinity, -kInfinity};
    static constexpr double kBorders[] = {-1, -0.5, 0, 0.25,      0.5,        0.96875,
                                          1,  1.5,  2, kInfinity, -kInfinity, kNan};
    Random random(6);
    NumberTables t;
    const auto plain = [&] { return spread(random, -13, 13); };
    t.plain = makeTable(plain, plain);
    const auto special = [&] {
        if (random.chance(0.15)) return random.pick(kSpecial);
        const int reach = random.chance(0.5) ? 16 : 130;
        return spread(random, -reach, reach);
    };
    t.special = makeTable(special, special);
    t.powers = makeTable(
        [&] {
            if (random.chance(0.05)) return random.pick({0.0, 1.0, kInfinity});
            const double magnitude = spread(random, -12, 12);
            return magnitude < 0 ? -magnitude : magnitude;
        },
        [&] {
            if (random.chance(0.05)) return random.pick({0.0, 1.0, 2.0, -1.0});
            return spread(random, -8, 5);
        });
    const auto side = [&] { return random.chance(0.1) ? random.pick(kAxes) : spread(random, -10, 10); };
    t.angles = makeTable(side, side);
    const auto coordinate = [&] {
        if (random.chance(0.1)) return random.pick(kBorders);
        if (random.chance(0.2)) return random.integer(-64, 128) / 64.0;
        return random.uniform(-1.5, 2.5);
    };
    t.texture = makeTable(coordinate, coordinate);
    const auto component = [&] {
        if (random.chance(0.03)) return random.pick({kInfinity, -kInfinity, kNan});
        return random.chance(0.3) ? random.pick({0.0, -0.0, 1.0, -1.0, 0.5}) : random.uniform(-1, 1);
    };
    for (size_t i = 0; i < kArguments; i++)
        for (auto& components : t.directions) components.push_back(component());
    return t;
}

const NumberTables& tables() {
    static const NumberTables made = makeTables();
    return made;
}

// Functions of doubles that are not computed in lanes.
std::vector<BitPlane> scalarFunctions() {
    Random random(7);
    std::vector<double> sines, cosines, exponentials;
    for (size_t i = 0; i < kArguments; i++) {
        const double angle_rad = spread(random, -20, 18), exponent = spread(random, -20, 9);
        sines.push_back(sinOf(angle_rad));
        cosines.push_back(cosOf(angle_rad));
        exponentials.push_back(expOf(exponent));
    }
    return {planeOf("sinOf", std::span<const double>(sines), kTableWidth),
            planeOf("cosOf", std::span<const double>(cosines), kTableWidth),
            planeOf("expOf", std::span<const double>(exponentials), kTableWidth)};
}

// Sums of as many values as fill no tile, some tiles, and many.
std::vector<BitPlane> sums(int threads) {
    constexpr size_t kCounts[] = {1, 31, 33, 1024, 5000, 100000};
    Random random(8);
    std::vector<float> narrow;
    std::vector<double> wide;
    for (size_t i = 0; i < 100000; i++) {
        narrow.push_back(static_cast<float>(spread(random, -10, 10)));
        wide.push_back(spread(random, -30, 30));
    }
    std::vector<double> results;
    for (const size_t count : kCounts) {
        results.push_back(fixedSum(std::span(narrow).first(count), threads));
        results.push_back(fixedSum(std::span(wide).first(count), threads));
    }
    return {planeOf("sums", std::span<const double>(results), 2)};
}

BitPlane planeOfPositions(std::string name, const std::vector<glm::vec3>& points) {
    Image<float> image(kTableWidth, static_cast<int>((points.size() + kTableWidth - 1) / kTableWidth), 3);
    for (size_t i = 0; i < points.size(); i++)
        for (int c = 0; c < 3; c++) image.plane(c)[i] = points[i][c];
    return planeOf(std::move(name), image, "coordinate");
}

}  // namespace

void addNumericCases(std::vector<BitCase>& cases) {
    cases.push_back(
        {"inputs/scene", "what the other cases draw", false, false, false, [](const RasterOptions&) {
             const SurfaceScene scene = demoScene();
             return std::vector<BitPlane>{planeOfPositions("knot", scene.meshes[0].positions),
                                          planeOfPositions("knot-normals", scene.meshes[0].normals),
                                          planeOfPositions("ball", scene.meshes[1].positions),
                                          planeOf("sky", scene.environment.latLong)};
         }});
    cases.push_back({"numbers/arithmetic", "+ - * / sqrt floor min clamp in every number format", true, false,
                     false,
                     [](const RasterOptions&) { return levelPasses<NumberPasses>().arithmetic(tables()); }});
    cases.push_back({"numbers/elementary", "atan2Of and powOf in lanes", true, false, false,
                     [](const RasterOptions&) { return levelPasses<NumberPasses>().elementary(tables()); }});
    cases.push_back({"numbers/scalar", "sinOf, cosOf, expOf", false, false, false,
                     [](const RasterOptions&) { return scalarFunctions(); }});
    cases.push_back({"numbers/sums", "sums of fixed shape", false, true, false,
                     [](const RasterOptions& options) { return sums(options.threads); }});
    cases.push_back({"sampling/image", "filters, wrap modes, fraction bits", true, false, false,
                     [](const RasterOptions&) {
                         const Image<float> sky = skyImage(24, 12);
                         return levelPasses<NumberPasses>().sampling(tables(), TextureView(sky));
                     }});
    cases.push_back({"sampling/directions", "cube faces, seamless cube filter, lat-long", true, false, false,
                     [](const RasterOptions&) {
                         constexpr int kCubeSize = 9;
                         CubeMap<float> cube(kCubeSize, 3);
                         Random random(9);
                         for (Image<float>& face : cube.faces)
                             for (float& texel : face.values())
                                 texel = static_cast<float>(random.uniform(0, 4));
                         const Image<float> sky = skyImage(24, 12);
                         return levelPasses<NumberPasses>().cubeSampling(tables(), TextureView(cube),
                                                                         TextureView(sky));
                     }});
}

}  // namespace etalon
