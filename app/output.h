// What verbs write besides their files.
#pragma once

#include <string>

namespace etalon {

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
