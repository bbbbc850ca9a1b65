// That passes which do not run would change no bit, over random scenes.
#include <doctest/doctest.h>

#include <cstring>

#include "ar/render_scene.h"
#include "tests/ar/random_scene.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ETALON_TEST_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ETALON_TEST_SANITIZED
#endif

using namespace etalon;

namespace {

#if defined(__OPTIMIZE__) && !defined(ETALON_TEST_SANITIZED)
constexpr uint64_t kScenesPerShard = 600;
#else
constexpr uint64_t kScenesPerShard = 60;
#endif

RenderResult render(const Scene& scene, uint64_t number, bool everything) {
    RenderOptions options;
    options.raster.threads = 1;
    options.request.png = number % 5 == 0;
    options.everything = everything;
    return renderScene(scene, options);
}

template <class T>
bool haveSameBits(std::span<const T> a, std::span<const T> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

// The names of the channels that differ.
std::string differences(const Frame& a, const Frame& b) {
    std::string names;
    REQUIRE(a.channels.size() == b.channels.size());
    for (size_t c = 0; c < a.channels.size(); c++) {
        const Channel &of = a.channels[c], &to = b.channels[c];
        REQUIRE(of.name == to.name);
        const bool same = std::visit(
            [&](const auto& image) {
                const auto& other = std::get<std::decay_t<decltype(image)>>(to.values);
                return haveSameBits(image.values(), other.values());
            },
            of.values);
        if (!same) names += of.name + " ";
    }
    return names;
}
std::string differences(const RenderResult& a, const RenderResult& b) {
    std::string names = differences(a.frame, b.frame);
    REQUIRE(a.files.size() == b.files.size());
    for (size_t f = 0; f < a.files.size(); f++) {
        REQUIRE(a.files[f].name == b.files[f].name);
        if (!differences(a.files[f].frame, b.files[f].frame).empty()) names += a.files[f].name + " ";
    }
    const bool isPng = a.plan.find("tone mapping")->runs;
    return !isPng || haveSameBits(a.toned.values(), b.toned.values()) ? names : names + "PNG";
}

void checkShard(uint64_t shard, uint64_t count) {
    const test::RandomScenes scenes;
    for (uint64_t i = 0; i < count; i++) {
        const uint64_t number = shard * 100000 + i;
        const Scene scene = scenes.scene(number);
        const RenderResult needed = render(scene, number, false), all = render(scene, number, true);
        for (const Pass& pass : all.plan.passes) REQUIRE(pass.runs);
        const std::string different = differences(needed, all);
        if (different.empty()) continue;
        FAIL_CHECK("scene " << number << ": " << different << "\n"
                            << test::sceneText(scene) << "\n"
                            << planText(needed.plan));
    }
}

}  // namespace

// 2400 scenes in four shards.
TEST_CASE("PassesThatDoNotRunWouldChangeNoBitShard0") { checkShard(0, kScenesPerShard); }
TEST_CASE("PassesThatDoNotRunWouldChangeNoBitShard1") { checkShard(1, kScenesPerShard); }
TEST_CASE("PassesThatDoNotRunWouldChangeNoBitShard2") { checkShard(2, kScenesPerShard); }
TEST_CASE("PassesThatDoNotRunWouldChangeNoBitShard3") { checkShard(3, kScenesPerShard); }
TEST_CASE("PassesThatDoNotRunWouldChangeNoBitOfAFewScenes") { checkShard(4, 40); }
