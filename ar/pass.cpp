#include "ar/pass.h"

#include <algorithm>
#include <chrono>

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

void PassList::decide(bool everything) {
    // From the last pass to the first: who reads each.
    std::vector<std::vector<size_t>> readers(passes.size());
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
                    const auto place = [&](size_t r) { return placeOf(passes[r].dependsOn); };
                    pass.dependsOn = passes[std::ranges::min(readers[i], {}, place)].dependsOn;
                }
            } else {
                pass.reason = text.nothing.empty() ? text.unneeded : text.nothing;
            }
        }
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

void PassList::run(size_t i, const std::function<void(double)>& progress) {
    Pass& pass = passes[i];
    ETALON_CHECK(!pass.isDone && std::ranges::all_of(pass.needs, [&](size_t n) { return passes[n].isDone; }),
                 "pass {} is done or needs what is not", pass.name());
    if (pass.runs) {
        const auto start = std::chrono::steady_clock::now();
        pass.run({*pass.profile, progress ? progress : [](double) {}});
        pass.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
        pass.result = nullptr;
    }
}

}  // namespace etalon
