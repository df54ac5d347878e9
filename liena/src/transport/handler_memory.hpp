// Where Asio keeps an operation in flight: in the connection itself, so that a message asks for no memory.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <utility>

namespace liena::transport {

/// Room for one operation; what does not fit, or comes beside it, takes the heap. Outlives its operation, one thread.
class HandlerMemory {
public:
    HandlerMemory() = default;
    HandlerMemory(const HandlerMemory&) = delete;
    HandlerMemory& operator=(const HandlerMemory&) = delete;

    void* allocate(std::size_t size)
    {
        if (size > m_room.size() || std::exchange(m_inUse, true))
            return ::operator new(size);
        return m_room.data();
    }

    void deallocate(void* memory)
    {
        if (memory == m_room.data())
            m_inUse = false;
        else
            ::operator delete(memory);
    }

private:
    alignas(std::max_align_t) std::array<std::byte, 768> m_room;
    bool m_inUse = false;
};

/// As the Allocator requirements and Asio's associated_allocator want it.
template <typename T>
class HandlerAllocator {
public:
    using value_type = T;

    explicit HandlerAllocator(HandlerMemory& memory) : m_memory(&memory) {}
    template <typename Other>
    HandlerAllocator(const HandlerAllocator<Other>& other) : m_memory(other.memory())
    {}

    T* allocate(std::size_t count) { return static_cast<T*>(m_memory->allocate(count * sizeof(T))); }
    void deallocate(T* memory, std::size_t /*count*/) { m_memory->deallocate(memory); }
    HandlerMemory* memory() const { return m_memory; }

    template <typename Other>
    bool operator==(const HandlerAllocator<Other>& other) const
    {
        return m_memory == other.memory();
    }

private:
    HandlerMemory* m_memory;
};

} // namespace liena::transport
