#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "app/output.h"
#include "files/atomic_file.h"
#include "numeric/check.h"
#include "numeric/text.h"

namespace etalon {
namespace {

template <class Number>
Option rangeOf(CLI::Option& option, Number least, Number most) {
    return Option(*option.check(CLI::Range(least, most)));
}

ExitCode reportError(std::string text) {
    for (char& character : text)
        if (character == '\n') character = ' ';
    printText(stderr, "etalon: {}\n", text);
    return ExitCode::badInput;
}

}  // namespace

Option Option::required() const { return Option(*option_->required()); }

Option Option::oneOf(const std::vector<std::string>& names) const {
    return Option(*option_->check(CLI::IsMember(names)));
}

Option Option::range(int least, int most) const { return rangeOf(*option_, least, most); }
Option Option::range(uint64_t least, uint64_t most) const { return rangeOf(*option_, least, most); }
Option Option::range(double least, double most) const { return rangeOf(*option_, least, most); }

Option Option::multipleOf(int divisor, const std::string& what) const {
    return Option(*option_->check([divisor, what](const std::string& text) {
        int value = 0;
        if (CLI::detail::lexical_cast(text, value) && value % divisor == 0) return std::string();
        return formatText("{} {} is not a multiple of {}", what, text, divisor);
    }));
}

Option Option::delimiter(char between) const { return Option(*option_->delimiter(between)); }

Option Option::repeated() const {
    return Option(*option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}

Option Option::excludes(Option other) const { return Option(*option_->excludes(other.option_)); }
Option Option::needs(Option other) const { return Option(*option_->needs(other.option_)); }

bool Option::isGiven() const { return option_->count() > 0; }

struct Verb::State {
    std::shared_ptr<CLI::App> parser;
    std::shared_ptr<ExitCode> exitCode;  // one for all verbs of the command
    std::function<void()> beforeRun;
    std::vector<std::unique_ptr<Verb>> verbs;
};

Verb::Verb(std::unique_ptr<State> state) : state_(std::move(state)) {}
Verb::~Verb() = default;

Option Verb::add(const char* names, std::string& value, const char* help) {
    return Option(*state_->parser->add_option(names, value, help));
}
Option Verb::add(const char* names, int& value, const char* help) {
    return Option(*state_->parser->add_option(names, value, help));
}
Option Verb::add(const char* names, uint64_t& value, const char* help) {
    return Option(*state_->parser->add_option(names, value, help));
}
Option Verb::add(const char* names, double& value, const char* help) {
    return Option(*state_->parser->add_option(names, value, help));
}
Option Verb::add(const char* names, std::optional<int>& value, const char* help) {
    return Option(*state_->parser->add_option(names, value, help));
}
Option Verb::add(const char* names, std::vector<std::string>& values, const char* help) {
    return Option(*state_->parser->add_option(names, values, help));
}
Option Verb::addCall(const char* names, std::function<void(const std::string&)> call, const char* help) {
    return Option(*state_->parser->add_option_function<std::string>(names, call, help));
}
Option Verb::addFlag(const char* names, bool& value, const char* help) {
    return Option(*state_->parser->add_flag(names, value, help));
}

Verb& Verb::addVerb(const char* name, const char* description) {
    state_->parser->require_subcommand(1);
    auto state = std::make_unique<State>();
    state->parser = CLI::App_p(state_->parser, state_->parser->add_subcommand(name, description));
    state->exitCode = state_->exitCode;
    state_->verbs.emplace_back(new Verb(std::move(state)));
    return *state_->verbs.back();
}

void Verb::onRun(std::function<ExitCode()> run) {
    state_->parser->callback([state = state_.get(), run = std::move(run)] {
        if (state->beforeRun) state->beforeRun();
        *state->exitCode = run();
    });
}

void Verb::beforeRun(std::function<void()> check) { state_->beforeRun = std::move(check); }

Command::Command() : Verb(std::make_unique<State>()) {
    state_->exitCode = std::make_shared<ExitCode>(ExitCode::done);
    state_->parser = std::make_shared<CLI::App>();
    state_->parser->name("etalon");
    state_->parser->description(
        "Deterministic rasterizer: the reference for image-based lighting in augmented scenes.\n"
        "Exit codes: 0 done, 1 difference, 2 usage or bad input, 3 nothing to check.");
    state_->parser->set_version_flag("--version", std::string("etalon ") + ETALON_VERSION);
    state_->parser->option_defaults()->always_capture_default();
}

ExitCode Command::run(int argc, const char* const* argv) {
    installSignalCleanup();
    try {
        state_->parser->parse(argc, argv);
        printOut("");
        return *state_->exitCode;
    } catch (const CLI::Success& request) {
        // --help and --version.
        state_->parser->exit(request);
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

}  // namespace etalon
