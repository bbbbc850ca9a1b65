// The command line: what verbs say about their options. CLI11 reads the arguments; it is compiled in
// command_line.cpp alone, and what stands here costs the verbs no compile time.
#pragma once

#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace etalon {

// The exit codes of the command.
enum class ExitCode : int {
    done = 0,
    difference = 1,
    badInput = 2,  // of a file or of the command line
    nothingToCheck = 3,
};

// An option, flag or positional of a verb. Each function adds one condition and returns the option itself;
// arguments that break a condition are a usage error.
class Option {
  public:
    explicit Option(CLI::Option& option) : option_(&option) {}

    Option required() const;
    // The value, or each of several, is one of the names.
    Option oneOf(const std::vector<std::string>& names) const;
    template <class Names>
    Option oneOf(const Names& names) const {
        return oneOf(std::vector<std::string>(std::begin(names), std::end(names)));
    }
    // From least to most, both included. The type is that of the help text.
    Option range(int least, int most) const;
    Option range(uint64_t least, uint64_t most) const;
    Option range(double least, double most) const;
    // Of an int within its range; the message says that `what` is not a multiple.
    Option multipleOf(int divisor, const std::string& what) const;
    // Of several values: one argument may hold some, with the delimiter between them.
    Option delimiter(char between) const;
    // Of several values: one each time that the option is given.
    Option repeated() const;
    // Not together with the other one, which is told so too.
    Option excludes(Option other) const;
    Option needs(Option other) const;

    // Whether the arguments have it; known when the verb runs.
    bool isGiven() const;

  private:
    CLI::Option* option_;
};

// A verb of the command, or of another verb. Names are those of CLI11: "--width", "-o,--output", "FILE" for a
// positional. Variables must outlive Command::run; what they hold when an option is added is its default,
// which the help shows.
class Verb {
  public:
    Verb(const Verb&) = delete;
    Verb& operator=(const Verb&) = delete;
    ~Verb();

    Option add(const char* names, std::string& value, const char* help);
    Option add(const char* names, int& value, const char* help);
    Option add(const char* names, uint64_t& value, const char* help);
    Option add(const char* names, double& value, const char* help);
    Option add(const char* names, std::optional<int>& value, const char* help);
    Option add(const char* names, std::vector<std::string>& values, const char* help);
    // Called with the value when the arguments have the option, before the verb runs.
    Option addCall(const char* names, std::function<void(const std::string&)> call, const char* help);
    Option addFlag(const char* names, bool& value, const char* help);

    // A verb of this verb, which then needs exactly one of them.
    Verb& addVerb(const char* name, const char* description);

    // What the verb does when it is chosen and its arguments are good, and what happens just before. Errors
    // are InputError.
    void onRun(std::function<ExitCode()> run);
    void beforeRun(std::function<void()> check);

  protected:
    struct State;
    explicit Verb(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// The command itself: its name, its description, --help and --version, and exactly one verb.
class Command : public Verb {
  public:
    Command();

    // Reads the arguments and runs the chosen verb. Whatever goes wrong is one line on standard error,
    // "etalon: reason", and badInput.
    ExitCode run(int argc, const char* const* argv);
};

}  // namespace etalon
