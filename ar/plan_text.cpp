// The plan as text, JSON and a graph.

#include <algorithm>

#include "ar/json.h"
#include "ar/plan.h"
#include "ar/toml_reader.h"
#include "numeric/text.h"

namespace etalon {

std::string planText(const Plan& plan) {
    size_t widest = 0;
    for (const PlanPass& pass : plan.passes) widest = std::max(widest, printable(pass.name).size());
    std::string text;
    for (const PlanPass& pass : plan.passes)
        text += formatText("{}  {:<{}}  {}\n", pass.runs ? "run " : "skip", printable(pass.name), widest,
                           pass.reason);
    text += formatText("memory: {:.1f} MiB at most for targets and images\n",
                       static_cast<double>(plan.memory_bytes) / (1 << 20));
    return text;
}

std::string planJson(const Plan& plan) {
    Json passes = Json::list();
    for (const PlanPass& pass : plan.passes)
        passes.append(
            {{"name", pass.name}, {"runs", pass.runs}, {"reason", pass.reason}, {"needs", pass.needs}});
    return jsonText({{"passes", passes}, {"memory_bytes", plan.memory_bytes}});
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
    for (const PlanPass& pass : plan.passes)
        text += formatText("  {} [tooltip={}{}];\n", quoted(pass.name), quoted(pass.reason),
                           pass.runs ? "" : ", style=dashed, fontcolor=gray50");
    for (const PlanPass& pass : plan.passes)
        for (const std::string& need : pass.needs)
            text += formatText("  {} -> {}{};\n", quoted(need), quoted(pass.name),
                               pass.runs ? "" : " [style=dashed, color=gray50]");
    return text + "}\n";
}

}  // namespace etalon
