// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace etalon {

// A file under a temporary name beside its target, which takes the target's place at commit(). Without a
// commit (an exception, a signal after installSignalCleanup) the temporary is removed and the target is as it
// was. A symbolic link is followed: the file it names is replaced. A target that exists and is neither a file
// nor a directory (a pipe, /dev/null) is written directly, without a temporary. At most kMaxPending of them
// may be open at a time, more are an InputError. Errors of the system are InputError "path: reason".
class AtomicFile {
  public:
    static constexpr int kMaxPending = 1024;

    // Creates the temporary. InputError: missing or read-only folder, a directory or read-only file as
    // target.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    // Where the bytes go until commit().
    const std::filesystem::path& temporaryPath() const { return temporary_; }

    // Appends. InputError when not every byte could be written (full disk, file size limit).
    void write(std::span<const std::byte> bytes);

    // Flushes to the device, closes and renames, each checked. To be called once, after the last write.
    void commit();

  private:
    void discard();
    [[noreturn]] void fail(int error);

    std::filesystem::path given_, target_, temporary_;
    int descriptor_ = -1;
    int slot_ = -1;  // in the table of temporaries that a signal removes; -1: written directly
};

// The whole of a file at once.
void writeFileAtomically(const std::filesystem::path& target, std::span<const std::byte> bytes);

// From now on SIGINT, SIGTERM and SIGHUP remove every pending temporary and end the process with 128 + the
// signal's number (130 for SIGINT); a signal that is ignored on entry stays ignored. SIGXFSZ is ignored, so
// that a write beyond the file size limit fails as one on a full disk does. Only system calls that are safe
// in a signal handler are made.
void installSignalCleanup();

}  // namespace etalon
