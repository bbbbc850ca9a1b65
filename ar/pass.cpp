#include "ar/pass.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "numeric/text.h"

namespace etalon {

std::string arithmeticOf(const Pass& pass) {
    const auto vertex = [&] { return pass.profile->vertex == RasterReal::fp32 ? "fp32" : "fp64"; };
    switch (pass.text.numbers) {
        case PassNumbers::none:
            return "";
        case PassNumbers::doubles:
            return "fp64";
        case PassNumbers::vertex:
        case PassNumbers::vertexDepth:
            return vertex();
        case PassNumbers::environment:
            return arithmeticName(pass.profile->environment);
        case PassNumbers::fragment:
            break;
    }
    return arithmeticName(pass.profile->fragment);
}

void PassList::sortNeeds(Pass& pass) {
    std::ranges::sort(pass.needs);
    pass.needs.erase(std::unique(pass.needs.begin(), pass.needs.end()), pass.needs.end());
}

void PassList::truncate(size_t count) {
    passes.resize(std::min(count, passes.size()));
    std::erase_if(learn_, [&](const auto& entry) { return entry.first >= count; });
}

size_t PassList::placeOf(std::string_view name) const {
    return static_cast<size_t>(
        std::ranges::find_if(passes, [&](const Pass& pass) { return pass.name() == name; }) - passes.begin());
}

namespace {

// "a does not run", "neither a nor b runs", "none of a, b and c runs"; the passes as numbers.
std::string noneRunsText(const std::vector<Pass>& passes, const std::set<size_t>& of) {
    if (of.empty()) return "nothing reads it";
    std::vector<std::string> names;
    for (const size_t i : of) names.push_back(passes[i].name());
    const std::string last = names.back();
    names.pop_back();
    if (names.empty()) return last + " does not run";
    const std::string others = joinText(names, ", ");
    return names.size() == 1 ? formatText("neither {} nor {} runs", others, last)
                             : formatText("none of {} and {} runs", others, last);
}

}  // namespace

void PassList::decide(bool everything) {
    // From the last pass to the first: who reads each, and which passes, having reasons of their own, would have made
    // each run.
    std::vector<std::vector<size_t>> readers(passes.size());
    std::vector<std::set<size_t>> wanting(passes.size());
    for (size_t i = passes.size(); i-- > 0;) {
        Pass& pass = passes[i];
        if (!pass.isDone) {
            const PassText& text = pass.text;
            const bool isNeeded = text.isRoot || !readers[i].empty();
            pass.runs = isNeeded && text.nothing.empty();
            pass.dependsOn.clear();
            if (pass.runs) {
                pass.reason = text.why;
                if (pass.reason.empty())
                    for (size_t k = readers[i].size(); k-- > 0;)
                        pass.reason +=
                            (pass.reason.empty() ? "read by " : ", ") + passes[readers[i][k]].name();
                // Undecided as long as all that need it are: then the earliest pass that they depend on may end it.
                pass.dependsOn = text.dependsOn;
                if (pass.dependsOn.empty() && !text.isRoot &&
                    std::ranges::all_of(readers[i], [&](size_t r) { return !passes[r].dependsOn.empty(); })) {
                    // One that comes before this pass, that is.
                    const auto place = [&](size_t r) { return placeOf(passes[r].dependsOn); };
                    const size_t first = std::ranges::min(readers[i], {}, place);
                    if (place(first) < i) pass.dependsOn = passes[first].dependsOn;
                }
            } else {
                pass.reason = !text.nothing.empty()    ? text.nothing
                              : !text.unneeded.empty() ? text.unneeded
                                                       : noneRunsText(passes, wanting[i]);
            }
        }
        const bool hasReason = pass.runs || !pass.text.nothing.empty() || !pass.text.unneeded.empty();
        for (const size_t need : pass.needs)
            if (hasReason)
                wanting[need].insert(i);
            else
                wanting[need].insert(wanting[i].begin(), wanting[i].end());
        if (pass.runs)
            for (const size_t need : pass.needs) readers[need].push_back(i);
    }
    if (!everything) return;
    for (Pass& pass : passes) {
        if (pass.isDone || pass.runs) continue;
        pass.runs = true;
        pass.reason = formatText("everything runs; else not: {}", pass.reason);
    }
}

void PassList::run(size_t i, const ProgressScope::Report& progress) {
    Pass& pass = passes[i];
    ETALON_CHECK(!pass.isDone && std::ranges::all_of(pass.needs, [&](size_t n) { return passes[n].isDone; }),
                 "pass {} is done or needs what is not", pass.name());
    if (pass.runs) {
        const auto start = std::chrono::steady_clock::now();
        {
            const ProgressScope watched(progress);
            pass.run({*pass.profile});
        }
        pass.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        pass.held = pass.heldNow();
    }
    pass.isDone = true;
    pass.dependsOn.clear();
    std::vector<std::function<void(PassList&)>> learn;
    for (auto& [of, call] : learn_)
        if (of == i) learn.push_back(std::move(call));
    std::erase_if(learn_, [&](const auto& entry) { return entry.first == i; });
    for (const auto& call : learn) call(*this);
}

const Pass* PassList::find(std::string_view name) const {
    const size_t place = placeOf(name);
    return place < passes.size() ? &passes[place] : nullptr;
}

uint64_t PassList::memory_bytes() const {
    uint64_t bytes = 0;
    for (const Pass& pass : passes)
        if (pass.runs) bytes += pass.memory_bytes();
    return bytes;
}

void PassList::forgetResults() {
    learn_.clear();
    for (Pass& pass : passes) {
        pass.run = nullptr;
        pass.heldNow = nullptr;
        pass.result = nullptr;
    }
}

}  // namespace etalon
