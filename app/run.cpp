#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>

#include "app/verbs.h"
#include "ar/atomic_file.h"
#include "numeric/text.h"

namespace etalon {
namespace {

ExitCode reportError(std::string text) {
    for (char& character : text)
        if (character == '\n') character = ' ';
    printText(stderr, "etalon: {}\n", text);
    return ExitCode::badInput;
}

}  // namespace

void configureCommand(CLI::App& app) {
    app.name("etalon");
    app.description(
        "Deterministic rasterizer: the reference for image-based lighting in augmented scenes.\n"
        "Exit codes: 0 done, 1 difference, 2 usage or bad input, 3 nothing to check.");
    app.set_version_flag("--version", std::string("etalon ") + ETALON_VERSION);
    app.require_subcommand(1);
    app.option_defaults()->always_capture_default();
}

ExitCode runCommand(CLI::App& app, const ExitCode& exitCode, int argc, const char* const* argv) {
    installSignalCleanup();
    try {
        app.parse(argc, argv);
        printOut("");
        return exitCode;
    } catch (const CLI::Success& request) {
        // --help and --version.
        app.exit(request);
        return std::fflush(stdout) == 0 ? ExitCode::done : reportError("cannot write to standard output");
    } catch (const CLI::ParseError& error) {
        return reportError(formatText("{} (see etalon --help)", error.what()));
    } catch (const InputError& error) {
        return reportError(error.what());
    } catch (const std::bad_alloc&) {
        return reportError("out of memory");
    } catch (const std::exception& error) {
        return reportError(formatText("internal error: {}", error.what()));
    }
}

void printOut(const std::string& text) {
    const bool good =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!good)
        throw InputError(
            formatText("standard output: cannot write: {}", std::generic_category().message(errno)));
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const std::string& text) {
    if (!terminal_) return;
    finish();
    printText(stderr, "{}", text);
    std::fflush(stderr);
    shown_ = true;
}

void ProgressLine::finish() {
    // Back to the first column, erase to the end of the line [ECMA-48].
    if (shown_) printText(stderr, "\r\x1b[K");
    shown_ = false;
}

}  // namespace etalon
