// The plan as text, JSON and a graph.

#include <algorithm>

#include "ar/plan.h"
#include "files/json.h"
#include "numeric/text.h"
#include "scene/toml_reader.h"

namespace etalon {

std::vector<std::string> namesOfNeeds(const Plan& plan, const Pass& pass) {
    std::vector<std::string> names;
    for (const size_t need : pass.needs)
        if (!pass.runs || plan.passes[need].runs) names.push_back(plan.passes[need].name());
    return names;
}

std::string planText(const Plan& plan) {
    size_t widest = 0;
    for (const Pass& pass : plan.passes) widest = std::max(widest, printable(pass.name()).size());
    std::string text;
    for (const Pass& pass : plan.passes)
        text += formatText("{}  {:<{}}  {}{}\n", pass.runs ? "run " : "skip", printable(pass.name()), widest,
                           printable(pass.reason),
                           pass.dependsOn.empty() ? "" : formatText(" (depends on {})", pass.dependsOn));
    text += formatText("memory: at most {:.1f} MiB for targets, maps and images, not counting files\n",
                       static_cast<double>(plan.memory_bytes()) / (1 << 20));
    return text;
}

Json planPassesJson(const Plan& plan) {
    Json passes = Json::list();
    for (const Pass& pass : plan.passes) {
        const std::string arithmetic = arithmeticOf(pass);
        passes.append({{"name", pass.name()},
                       {"runs", pass.runs},
                       {"reason", pass.reason},
                       {"depends_on", pass.dependsOn.empty() ? Json() : Json(pass.dependsOn)},
                       {"needs", namesOfNeeds(plan, pass)},
                       {"arithmetic", arithmetic.empty() ? Json() : Json(arithmetic)},
                       {"memory_bytes", pass.memory_bytes()},
                       {"result_bytes", pass.runs && pass.isDone ? Json(pass.held.all_bytes()) : Json()},
                       {"seconds", pass.runs && pass.isDone ? Json(pass.seconds) : Json()}});
    }
    return passes;
}

std::string planJson(const Plan& plan) {
    return jsonText({{"passes", planPassesJson(plan)}, {"memory_bytes", plan.memory_bytes()}});
}

std::string planDot(const Plan& plan) {
    const auto quoted = [](const std::string& name) {
        std::string text = "\"";
        for (char c : name) {
            if (c == '"' || c == '\\') text += '\\';
            text += c;
        }
        return text + '"';
    };
    std::string text = "digraph plan {\n  rankdir=LR;\n  node [shape=box];\n";
    for (const Pass& pass : plan.passes)
        text += formatText("  {} [tooltip={}{}];\n", quoted(pass.name()), quoted(pass.reason),
                           pass.runs ? "" : ", style=dashed, fontcolor=gray50");
    for (const Pass& pass : plan.passes)
        for (const std::string& need : namesOfNeeds(plan, pass))
            text += formatText("  {} -> {}{};\n", quoted(need), quoted(pass.name()),
                               pass.runs ? "" : " [style=dashed, color=gray50]");
    return text + "}\n";
}

}  // namespace etalon
