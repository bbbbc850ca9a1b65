// The verbs of the etalon command, and what they share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "ar/golden.h"
#include "bitcheck/bit_case.h"

namespace etalon {

// The exit codes of the command.
enum class ExitCode : int {
    done = 0,
    difference = 1,
    badInput = 2,  // of a file or of the command line
    nothingToCheck = 3,
};

// How check and accept render their cases.
struct GoldenSupport {
    GoldenRenderer render;
    std::string rulesVersion;
};

// Each adds one verb to the command, which when chosen runs inside app.parse() and sets the exit code. Errors
// are InputError. `exitCode`, `cases` and what `support` refers to must outlive the parse.
void addRender(CLI::App& app, ExitCode& exitCode);
void addPlan(CLI::App& app, ExitCode& exitCode);
void addCompare(CLI::App& app, ExitCode& exitCode);
void addCheck(CLI::App& app, ExitCode& exitCode, const GoldenSupport& support);
void addAccept(CLI::App& app, ExitCode& exitCode, const GoldenSupport& support);
// Light probes, and the verbs of `probe`.
void addProbe(CLI::App& app, ExitCode& exitCode);
void addProbeConvert(CLI::App& probe, ExitCode& exitCode);
void addProbeInfo(CLI::App& probe, ExitCode& exitCode);
void addProbeLights(CLI::App& probe, ExitCode& exitCode);
void addProbeSh(CLI::App& probe, ExitCode& exitCode);
void addBits(CLI::App& app, ExitCode& exitCode, const std::vector<BitCase>& cases);

// Settings of the command itself: name, --version, exactly one verb, unknown options are errors.
void configureCommand(CLI::App& app);

// Parses and runs. Whatever goes wrong is one line on standard error, "etalon: reason", and badInput.
ExitCode runCommand(CLI::App& app, const ExitCode& exitCode, int argc, const char* const* argv);

// Writes to standard output; InputError if that fails (a full disk behind a redirection).
void printOut(const std::string& text);

// Shows on standard error which case runs, if that is a terminal; a later call or finish() replaces it.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine() { finish(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(const std::string& text);
    void finish();

  private:
    bool terminal_, shown_ = false;
};

}  // namespace etalon
