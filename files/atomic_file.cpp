#include "files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>

#include "numeric/check.h"
#include "numeric/text.h"

namespace etalon {
namespace {

// The pending temporaries, readable from a signal handler: no memory is allocated and no lock is taken.
enum SlotState : int { kFree, kClaimed, kPending };
struct Slot {
    std::atomic<int> state{kFree};
    std::array<char, PATH_MAX> path{};
};
static_assert(std::atomic<int>::is_always_lock_free);
std::array<Slot, AtomicFile::kMaxPending> slots;

int claimSlot(const std::string& path) {
    for (int i = 0; i < AtomicFile::kMaxPending; ++i) {
        Slot& slot = slots[static_cast<size_t>(i)];
        int expected = kFree;
        if (!slot.state.compare_exchange_strong(expected, kClaimed)) continue;
        std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
        slot.state.store(kPending);
        return i;
    }
    throw InputError(
        formatText("{}: cannot write: more than {} files at once", path, AtomicFile::kMaxPending));
}

void releaseSlot(int slot) { slots[static_cast<size_t>(slot)].state.store(kFree); }

extern "C" void removePendingAndExit(int signalNumber) {
    for (Slot& slot : slots)
        if (slot.state.load() == kPending) unlink(slot.path.data());
    _exit(128 + signalNumber);
}

[[noreturn]] void throwSystemError(const std::filesystem::path& path, int error) {
    throw InputError(
        formatText("{}: cannot write: {}", path.string(), std::generic_category().message(error)));
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) : given_(target), target_(target) {
    std::error_code ignored;
    if (std::filesystem::is_symlink(target, ignored)) {
        std::error_code error;
        target_ = std::filesystem::weakly_canonical(target, error);
        if (error) throwSystemError(given_, error.value());
    }
    struct stat existing {};
    const bool exists = stat(target_.c_str(), &existing) == 0;
    if (!exists && errno != ENOENT) throwSystemError(given_, errno);
    if (exists && S_ISDIR(existing.st_mode)) throwSystemError(given_, EISDIR);
    if (exists && access(target_.c_str(), W_OK) != 0) throwSystemError(given_, errno);
    if (exists && !S_ISREG(existing.st_mode)) {
        temporary_ = target_;
        descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) throwSystemError(given_, errno);
        return;
    }
    // The name is registered before the file exists, so that no signal finds a file without a name.
    static std::atomic<unsigned> count{0};
    const std::filesystem::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    do {
        temporary_ = folder / formatText(".etalon-{}-{}.tmp", getpid(), count.fetch_add(1));
        if (temporary_.native().size() >= PATH_MAX) throwSystemError(given_, ENAMETOOLONG);
        slot_ = claimSlot(temporary_.native());
        descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0) {
            const int error = errno;
            releaseSlot(slot_);
            slot_ = -1;
            if (error != EEXIST) throwSystemError(given_, error);
        }
    } while (descriptor_ < 0);
    if (exists && fchmod(descriptor_, existing.st_mode & 07777) != 0) fail(errno);
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
    if (slot_ < 0) return;
    unlink(temporary_.c_str());
    releaseSlot(slot_);
    slot_ = -1;
}

void AtomicFile::fail(int error) {
    discard();
    throwSystemError(given_, error);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    ETALON_CHECK(descriptor_ >= 0, "{} was committed or has failed", given_.string());
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail(written < 0 ? errno : EIO);
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
}

void AtomicFile::commit() {
    ETALON_CHECK(descriptor_ >= 0, "{} was committed or has failed", given_.string());
    const bool direct = slot_ < 0;
    // Pipes and character devices have nothing to flush.
    if (fsync(descriptor_) != 0 && !(direct && (errno == EINVAL || errno == EROFS || errno == ENOTSUP)))
        fail(errno);
    const int closing = close(descriptor_);
    descriptor_ = -1;
    if (closing != 0) fail(errno);
    if (direct) return;
    if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    releaseSlot(slot_);
    slot_ = -1;
}

void writeFileAtomically(const std::filesystem::path& target, std::span<const std::byte> bytes) {
    AtomicFile file(target);
    file.write(bytes);
    file.commit();
}

void installSignalCleanup() {
    struct sigaction action {};
    action.sa_handler = removePendingAndExit;
    sigfillset(&action.sa_mask);
    for (const int signalNumber : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        if (sigaction(signalNumber, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(signalNumber, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace etalon
