#include "ar/pass.h"

#include <memory>
#include <doctest/doctest.h>

using namespace etalon;

namespace {

PassText textOf(std::string name, bool isRoot = false, std::string nothing = "") {
    PassText text;
    text.name = std::move(name);
    text.nothing = std::move(nothing);
    text.unneeded = "nothing reads it";
    text.isRoot = isRoot;
    return text;
}

std::shared_ptr<const Profile> profile() { return std::make_shared<const Profile>(profiles()[0]); }

void runAll(PassList& list) {
    for (size_t i = 0; i < list.passes.size(); i++) list.run(i, {});
}

// A handle comes from the pass that yields the result, and from nowhere else.
static_assert(!std::is_default_constructible_v<Result<int>>);
static_assert(!std::is_constructible_v<Result<int>, size_t, std::shared_ptr<int>>);
// A pass is given the values of its needs: what it does not name it cannot read, and what it reads it must name.
template <class Run, class... Needs>
concept CanRun = std::is_invocable_r_v<int, Run, const PassContext&, const Needs&...>;
static_assert(CanRun<int (*)(const PassContext&, const int&), int>);
static_assert(!CanRun<int (*)(const PassContext&, const int&)>);
static_assert(!CanRun<int (*)(const PassContext&, const int&), std::string>);

}  // namespace

TEST_CASE("PassesReadWhatTheirNeedsYield") {
    PassList list;
    const auto two = list.add(textOf("two"), profile(), 0, [](const PassContext&) { return 2; });
    const auto three = list.add(textOf("three"), profile(), 0, [](const PassContext&) { return 3; });
    const auto sum = list.add(
        textOf("sum", true), profile(), 0,
        [](const PassContext&, int a, const std::vector<const int*>& all) {
            return 100 * a + *all[0] + *all[1];
        },
        two, std::vector{two, three});
    CHECK(list.passes[sum.pass()].needs == std::vector<size_t>{0, 1});
    list.decide(false);
    CHECK(list.value(sum) == 0);
    runAll(list);
    CHECK(list.value(sum) == 205);
    CHECK(list.passes[0].reason == "read by sum");
}

TEST_CASE("WhatNothingNeedsOrWhatShowsNothingYieldsItsNeutralValue") {
    for (const bool everything : {false, true}) {
        PassList list;
        const auto black = list.add(textOf("black", false, "it is black"), profile(), 7,
                                    [](const PassContext&) { return 8; });
        const auto deep = list.add(textOf("deep"), profile(), 1, [](const PassContext&) { return 2; });
        const auto skipped = list.add(
            textOf("skipped", false, "it shows nothing"), profile(), 20,
            [](const PassContext&, int value) { return value; }, deep);
        const auto root = list.add(
            textOf("root", true), profile(), 0, [](const PassContext&, int a, int b) { return a + b; }, black,
            skipped);
        list.decide(everything);
        runAll(list);
        CHECK(list.value(root) == (everything ? 10 : 27));
        // Its need is not needed either.
        CHECK(list.value(deep) == (everything ? 2 : 1));
        CHECK(list.find("deep")->reason ==
              (everything ? "everything runs; else not: nothing reads it" : "nothing reads it"));
        CHECK(list.find("skipped")->reason.find("it shows nothing") != std::string::npos);
    }
}

TEST_CASE("APassReplacesThoseBehindIt") {
    PassList list;
    const auto number = list.add(textOf("number", true), profile(), 0, [](const PassContext&) { return 3; });
    list.add(textOf("unknown", true), profile(), 0, [](const PassContext&) { return -1; });
    list.whenDone<int>(number, [number](PassList& behind, int found) {
        behind.truncate(number.pass() + 1);
        for (int i = 0; i < found; i++)
            behind.add(
                textOf("copy" + std::to_string(i), true), profile(), 0,
                [](const PassContext&, int value) { return value; }, number);
        behind.decide(false);
    });
    list.decide(false);
    CHECK(list.passes.size() == 2);
    runAll(list);
    CHECK(list.passes.size() == 4);
    CHECK(list.find("unknown") == nullptr);
    for (const Pass& pass : list.passes) CHECK((pass.runs && pass.isDone));
}

TEST_CASE("AHandleOfAPassThatIsGoneIsRefusedWhenThePlanIsMade") {
    PassList list, other;
    const auto gone = list.add(textOf("gone"), profile(), 0, [](const PassContext&) { return 1; });
    list.truncate(0);
    list.add(textOf("another"), profile(), 0, [](const PassContext&) { return 2; });
    const auto read = [](const PassContext&, int value) { return value; };
    CHECK_THROWS_AS(list.add(textOf("reader"), profile(), 0, read, gone), PreconditionError);
    CHECK_THROWS_AS(other.add(textOf("reader"), profile(), 0, read, gone), PreconditionError);
    CHECK_THROWS_AS(list.value(gone), PreconditionError);
}

TEST_CASE("WhatOnlyUncertainPassesReadIsUncertain") {
    PassList list;
    const auto one = [](const PassContext&) { return 1; };
    const auto early = list.add(textOf("early"), profile(), 0, one);
    list.add(textOf("weather", true), profile(), 0, one);
    const auto source = list.add(textOf("source"), profile(), 0, one);
    const auto read = [](const PassContext&, int value) { return value; };
    PassText maybe = textOf("maybe", true);
    maybe.dependsOn = "weather";
    list.add(
        maybe, profile(), 0, [](const PassContext&, int a, int b) { return a + b; }, early, source);
    list.decide(false);
    CHECK(list.find("source")->dependsOn == "weather");
    // What has run by then is not ended.
    CHECK(list.find("early")->dependsOn.empty());
    list.add(textOf("surely", true), profile(), 0, read, source);
    list.decide(false);
    CHECK(list.find("source")->dependsOn.empty());
    CHECK(list.find("maybe")->dependsOn == "weather");
}

TEST_CASE("APassComputesInTheProfileThatItHasWhenItRuns") {
    PassList list;
    PassText text = textOf("name", true);
    text.numbers = PassNumbers::fragment;
    const auto name = list.add(text, std::make_shared<const Profile>(*findProfile("f32")), std::string(),
                               [](const PassContext& context) { return std::string(context.profile.name); });
    list.decide(false);
    CHECK(arithmeticOf(list.passes[0]) == "fp32");
    list.passes[0].profile = std::make_shared<const Profile>(*findProfile("fp16"));
    CHECK(arithmeticOf(list.passes[0]) == "fp16");
    runAll(list);
    CHECK(list.value(name) == "fp16");
}
