#include "core/memory.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>  // defines __GLIBC__

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace defocus::engine {

namespace {

std::size_t pageSize() {
    return static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t bytesTo(const void* place, std::size_t alignment) {
    return (alignment - reinterpret_cast<std::uintptr_t>(place) % alignment) % alignment;
}

}  // namespace

void giveBackFreedMemory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

// Turns off mmap() for large allocations, so that all blocks come from the heap. Then allocates one large block,
// requests huge pages for it, and frees it, so that later allocations use its pages. `fence`, a small block after the
// large one, keeps free() from returning these pages to the system. Unused pages take address space but no memory, so
// nothing is allocated if the address space is limited.
void keepFreedMemory() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
    mallopt(M_TRIM_THRESHOLD, 128 << 20);
    mallopt(M_MMAP_MAX, 0);
    constexpr std::size_t room = std::size_t{1} << 30;
    static void* fence = nullptr;
    rlimit addresses{};
    if (fence != nullptr || getrlimit(RLIMIT_AS, &addresses) != 0 || addresses.rlim_cur != RLIM_INFINITY) return;
    void* const block = std::malloc(room);
    fence = std::malloc(room / 8);  // large enough to lie after `block`, not in a gap of the heap
    if (fence != nullptr) fence = std::realloc(fence, sizeof(void*));
    const std::size_t before = bytesTo(block, hugePage);
    if (block != nullptr) madvise(static_cast<std::byte*>(block) + before, room - before, MADV_HUGEPAGE);
    std::free(block);
#endif
}

// Aligns the block to huge pages: one page fault then replaces hundreds, if the system supports huge pages. The block's
// end uses small pages, so that less than one small page is wasted.
void* allocatePages(std::size_t bytes) {
    if (bytes > static_cast<std::size_t>(-1) - 2 * hugePage) throw std::bad_alloc();
    const std::size_t whole = (bytes + pageSize() - 1) / pageSize() * pageSize();
    void* const room = mmap(nullptr, whole + hugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) throw std::bad_alloc();
    const std::size_t before = bytesTo(room, hugePage);
    auto* const pages = static_cast<std::byte*>(room) + before;
    if (before > 0) munmap(room, before);
    munmap(pages + whole, hugePage - before);
#ifdef MADV_HUGEPAGE
    madvise(pages, whole, MADV_HUGEPAGE);
#endif
    return pages;
}

void giveBackPages(void* first, std::size_t bytes) noexcept {
    const std::size_t before = bytesTo(first, pageSize());
    if (bytes < before + pageSize()) return;
    madvise(static_cast<std::byte*>(first) + before, (bytes - before) / pageSize() * pageSize(), MADV_DONTNEED);
}

void freePages(void* pages, std::size_t bytes) noexcept {
    munmap(pages, bytes);
}

}  // namespace defocus::engine
