// Harnesses of file readers are linked with these: a request for more than 64 MiB fails as on a machine that
// has no more, so that a legal file that announces gigabytes is no crash.
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constexpr size_t kMaxRequest_bytes = size_t{64} << 20;

void* allocate(size_t size) noexcept {
    return size > kMaxRequest_bytes ? nullptr : std::malloc(size == 0 ? 1 : size);
}
void* allocateOrThrow(size_t size) {
    void* const memory = allocate(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(size_t size) { return allocateOrThrow(size); }
void* operator new[](size_t size) { return allocateOrThrow(size); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void* operator new[](size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
