// The verbs of the etalon command. Each function adds one; what it is given besides must outlive Command::run.
#pragma once

#include <vector>

namespace etalon {

class Verb;            // app/command_line.h
struct GoldenSupport;  // golden/golden.h
struct BitCase;        // bitcheck/bit_case.h

void addRender(Verb& command);
void addPlan(Verb& command);
void addProfiles(Verb& command);
void addOutputs(Verb& command);
void addSchema(Verb& command);
void addCompare(Verb& command);
void addCheck(Verb& command, const GoldenSupport& support);
void addAccept(Verb& command, const GoldenSupport& support);
// Light probes, and the verbs of `probe`.
void addProbe(Verb& command);
void addProbeConvert(Verb& probe);
void addProbeInfo(Verb& probe);
void addProbeLights(Verb& probe);
void addProbeSh(Verb& probe);
void addBits(Verb& command, const std::vector<BitCase>& cases);

}  // namespace etalon
