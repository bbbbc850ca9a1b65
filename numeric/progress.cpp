#include "numeric/progress.h"

#include <utility>

namespace etalon {
namespace {

// That a loop reports at most.
constexpr size_t kReports = 500;

thread_local ProgressScope* watching = nullptr;

}  // namespace

ProgressScope::ProgressScope(Report report) : report_(std::move(report)), before_(watching) {
    watching = report_ ? this : nullptr;
}
ProgressScope::~ProgressScope() { watching = before_; }

ProgressLoop::ProgressLoop(size_t rounds) : scope_(rounds > 1 ? watching : nullptr), rounds_(rounds) {
    if (!scope_) return;
    watching = nullptr;
    scope_->report_(++scope_->step_, 0);
}
ProgressLoop::~ProgressLoop() {
    if (scope_) watching = scope_;
}

void ProgressLoop::next() {
    if (!scope_) return;
    const size_t done = ++done_, reports = done * kReports / rounds_;
    if (reports == (done - 1) * kReports / rounds_) return;
    const std::lock_guard lock(mutex_);
    if (reports <= reported_) return;
    reported_ = reports;
    scope_->report_(scope_->step_, static_cast<double>(done) / static_cast<double>(rounds_));
}

}  // namespace etalon
