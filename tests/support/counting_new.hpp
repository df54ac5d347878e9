// Counts what a program asks of the heap: this replaces operator new. For one source file of a test program.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace liena::test {

/// Called for each request that may not fail silently; the program says what it does.
void heapAsked(std::size_t bytes);

inline void* askHeap(std::size_t size)
{
    heapAsked(size);
    if (void* memory = std::malloc(size > 0 ? size : 1))
        return memory;
    throw std::bad_alloc();
}

} // namespace liena::test

// All forms that a sanitizer would otherwise tell apart from std::free.
void* operator new(std::size_t size) { return liena::test::askHeap(size); }
void* operator new[](std::size_t size) { return liena::test::askHeap(size); }
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept { return std::malloc(size); }
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept { return std::malloc(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept { std::free(memory); }
