// Passes as values, and typed handles to their results.
//
// A pass says what it is, why it runs or not, what it reads, in which arithmetic, how much memory it takes, and how
// it runs. A Result<T> names what a pass yields. Only PassList::add makes one, and only the passes that are added
// with it are given the value, so that a pass cannot read what it does not say that it needs. A pass that does not
// run yields its neutral value: what it would have yielded where it shows nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "numeric/check.h"
#include "numeric/progress.h"
#include "raster/profile.h"

namespace etalon {

// What a running pass has beside its needs.
struct PassContext {
    const Profile& profile;  // what it computes with: Pass::profile
};

// What numbers a pass computes with.
enum class PassNumbers : uint8_t {
    none,         // it moves and counts
    doubles,      // double, whatever the profile
    vertex,       // the profile's vertex arithmetic
    fragment,     // the profile's fragment arithmetic
    environment,  // the profile's arithmetic for the light of environments
    vertexDepth,  // the profile's vertex arithmetic, its depth format and its subpixels
};

// What a result holds.
struct HeldMemory {
    uint64_t planes_bytes = 0;  // images that the plan knows the size of, and what is kept per sample
    uint64_t lists_bytes = 0;   // meshes, triangles, lights, images of files: known when the pass has run
    uint64_t all_bytes() const { return planes_bytes + lists_bytes; }
};
// Numbers and texts do not count. Of the results of a scene's passes: ar/held_memory.h.
template <class T>
requires(std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) HeldMemory heldMemory(const T&) {
    return {};
}

// What the plan says of a pass before it decides.
struct PassText {
    std::string name;      // unique in a plan
    std::string why;       // it runs; empty: the passes that read its result
    std::string nothing;   // it cannot show anything, why; empty: it may
    std::string unneeded;  // no pass that runs needs it, why; empty: the passes that would read it do not run
    // The decision assumes what is not known yet: "visibility", "environment light"; empty: it does not.
    std::string dependsOn;
    PassNumbers numbers = PassNumbers::none;
    // A bound on HeldMemory::planes_bytes of its result, with images that it works in.
    uint64_t memory_bytes = 0;
    bool isRoot = false;      // needed by who asks for the plan
    bool isLookedUp = false;  // its memory is that of maps and masks
};

struct Pass {
    PassText text;
    std::shared_ptr<const Profile> profile;  // may be replaced before it runs
    std::vector<size_t> needs;  // the passes whose results it reads, ascending; all come before it
    std::function<void(const PassContext&)> run;
    std::shared_ptr<const void> result;  // what Result<T> refers to

    bool runs = false;
    std::string reason;     // why it runs, or why not
    std::string dependsOn;  // the pass whose result may still decide that it does not run; empty: none
    bool isDone = false;
    double seconds = 0;  // that it ran
    HeldMemory held;     // by its result, when it has run
    std::function<HeldMemory()> heldNow;

    const std::string& name() const { return text.name; }
    uint64_t memory_bytes() const { return text.memory_bytes; }
};

// What a pass computes with, in words: "fp32", "fp16", "double"; empty: it does not compute.
std::string arithmeticOf(const Pass& pass);

// What a pass yields.
template <class T>
class Result {
  public:
    size_t pass() const { return pass_; }

  private:
    friend class PassList;
    Result(size_t pass, std::shared_ptr<T> value) : pass_(pass), value_(std::move(value)) {}
    size_t pass_;
    std::shared_ptr<T> value_;
};

// What a pass is given, for as long as the plan lives.
template <class T>
std::reference_wrapper<const T> lent(const T& value) {
    return value;
}
template <class T>
std::vector<const T*> lent(const std::vector<const T*>& values) {
    return values;
}

// Passes in the order of their needs.
class PassList {
  public:
    std::vector<Pass> passes;

    // A pass that is run as run(context, values of the needs...) and returns a T. A need is a Result<U>, given as
    // const U&, or a std::vector<Result<U>>, given as const std::vector<const U*>&.
    template <class T, class Run, class... Needs>
    Result<T> add(PassText text, std::shared_ptr<const Profile> profile, T neutral, Run run,
                  const Needs&... needs) {
        const auto value = std::make_shared<T>(std::move(neutral));
        Pass pass;
        pass.text = std::move(text);
        pass.profile = std::move(profile);
        (collect(pass, needs), ...);
        pass.run = [value, run = std::move(run), ... from = needs](const PassContext& context) {
            *value = run(context, argument(from)...);
        };
        pass.heldNow = [held = value.get()] { return heldMemory(*held); };
        pass.result = value;
        passes.push_back(std::move(pass));
        sortNeeds(passes.back());
        return Result<T>(passes.size() - 1, value);
    }

    // The value as it is: neutral before its pass has run.
    template <class T>
    const T& value(const Result<T>& result) const {
        check(result.pass_, result.value_);
        return *result.value_;
    }
    // Called when the pass has run, or would have; may change this list behind the pass.
    template <class T>
    void whenDone(const Result<T>& result, std::function<void(PassList&, const T&)> learn) {
        check(result.pass_, result.value_);
        // The value lives as long as the pass.
        learn_.emplace_back(result.pass_, [value = result.value_.get(), learn = std::move(learn)](
                                              PassList& list) { learn(list, *value); });
    }

    // Drops the passes from the given one on, with what waits for them.
    void truncate(size_t count);

    // Which passes run: those that can show something and that a root, or a pass that runs, needs. everything:
    // all. Passes that are done stay as they are.
    void decide(bool everything);
    // Runs pass i, if it runs, and has what waits for it learn; that may replace the passes behind it. progress may be
    // empty.
    void run(size_t i, const ProgressScope::Report& progress);

    const Pass* find(std::string_view name) const;
    // Of the passes that run, together.
    uint64_t memory_bytes() const;
    // Forgets the results and how passes run; what they say stays.
    void forgetResults();

  private:
    void check(size_t pass, const std::shared_ptr<const void>& result) const {
        ETALON_CHECK(pass < passes.size() && passes[pass].result == result,
                     "result of pass {} is of another plan", pass);
    }
    template <class U>
    void collect(Pass& pass, const Result<U>& need) const {
        check(need.pass_, need.value_);
        pass.needs.push_back(need.pass_);
    }
    template <class U>
    void collect(Pass& pass, const std::vector<Result<U>>& needs) const {
        for (const Result<U>& need : needs) collect(pass, need);
    }
    template <class U>
    static const U& argument(const Result<U>& need) {
        return *need.value_;
    }
    template <class U>
    static std::vector<const U*> argument(const std::vector<Result<U>>& needs) {
        std::vector<const U*> values;
        for (const Result<U>& need : needs) values.push_back(need.value_.get());
        return values;
    }
    static void sortNeeds(Pass& pass);
    size_t placeOf(std::string_view name) const;

    std::vector<std::pair<size_t, std::function<void(PassList&)>>> learn_;
};

}  // namespace etalon
