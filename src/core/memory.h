#pragma once
// Memory for large work that goes back to the system as soon as it is freed, so that the phases of a long piece of work
// take it one after the other. What malloc frees it keeps, where the process has freed large blocks before.

#include <cstddef>
#include <new>
#include <vector>

namespace defocus::engine {

// Gives back what malloc keeps, where the C library can (glibc; elsewhere nothing happens). Worth its time (a few
// milliseconds) after freeing tens of megabytes.
void giveBackFreedMemory();

// For programs, as it holds for the whole process: up to 128 MiB that were freed stay, for what is allocated next
// (glibc; elsewhere nothing happens). Software rasterisers free the vertices of a draw after it, and getting the same
// pages back from the system for the next one can take longer than drawing.
void keepFreedMemory();

inline constexpr std::size_t hugePage = std::size_t{2} << 20;  // of most processors; nothing hangs on it elsewhere

// Whole pages, zero. Throws std::bad_alloc.
void* allocatePages(std::size_t bytes);
void freePages(void* pages, std::size_t bytes) noexcept;
// Gives back those pages that lie wholly within the bytes, which are zero from then on.
void giveBackPages(void* first, std::size_t bytes) noexcept;

// Pages for large blocks, operator new for others.
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

// Gives back the room that the vector has beyond its values, which stay where they are if the vector is large.
template <typename T>
void giveBackRoom(LargeVector<T>& values) {
    const std::size_t room = values.capacity() - values.size();
    if (values.capacity() * sizeof(T) < PageAllocator<T>::fewestBytes)
        values.shrink_to_fit();
    else
        giveBackPages(values.data() + values.size(), room * sizeof(T));
}

}  // namespace defocus::engine
