#pragma once
// Allocates large blocks of memory that return to the system as soon as they are freed. malloc may keep freed blocks
// instead, which raises the peak memory of a program with several phases.

#include <cstddef>
#include <new>
#include <vector>

namespace defocus::engine {

// Gives malloc's free memory back to the system (glibc only). Takes a few milliseconds; worthwhile after freeing tens
// of megabytes.
void giveBackFreedMemory();

// Makes malloc keep freed memory for later allocations, in huge pages where the system has them (glibc only). A
// software rasterizer's textures, and the vertices that it frees after each draw, then cost few page faults; getting
// new pages from the system can take longer than drawing. Call it once, before the program's first large allocation.
void keepFreedMemory();

// Size of a huge page in bytes. If the system's huge pages have a different size, blocks may get small pages instead.
inline constexpr std::size_t hugePage = std::size_t{2} << 20;

// Allocates zeroed pages for at least `bytes` bytes. Throws std::bad_alloc on failure.
void* allocatePages(std::size_t bytes);
void freePages(void* pages, std::size_t bytes) noexcept;
// Gives the pages that lie entirely inside the range back to the system. These pages then read as zero.
void giveBackPages(void* first, std::size_t bytes) noexcept;

// Allocator that uses pages for large blocks and operator new for small blocks.
template <typename T>
struct PageAllocator {
    using value_type = T;
    static constexpr std::size_t fewestBytes = hugePage / 2;

    PageAllocator() = default;
    template <typename Other>
    PageAllocator(const PageAllocator<Other>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        const std::size_t bytes = count * sizeof(T);
        return static_cast<T*>(bytes >= fewestBytes ? allocatePages(bytes)
                                                    : ::operator new (bytes, std::align_val_t{alignof(T)}));
    }
    void deallocate(T* values, std::size_t count) noexcept {
        const std::size_t bytes = count * sizeof(T);
        if (bytes >= fewestBytes)
            freePages(values, bytes);
        else
            ::operator delete (values, std::align_val_t{alignof(T)});
    }
    bool operator==(const PageAllocator&) const = default;
};

template <typename T>
using LargeVector = std::vector<T, PageAllocator<T>>;

// Gives the vector's unused capacity back to the system. Only vectors below fewestBytes are reallocated for this.
template <typename T>
void giveBackRoom(LargeVector<T>& values) {
    const std::size_t room = values.capacity() - values.size();
    if (values.capacity() * sizeof(T) < PageAllocator<T>::fewestBytes)
        values.shrink_to_fit();
    else
        giveBackPages(values.data() + values.size(), room * sizeof(T));
}

}  // namespace defocus::engine
