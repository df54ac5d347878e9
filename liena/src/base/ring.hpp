// A queue that keeps its memory while it is short: a message that comes and goes asks for none.
#pragma once

#include <boost/circular_buffer.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace liena::base {

template <typename T>
using Ring = boost::circular_buffer<T>;

/// Behind the last one, whatever the ring's capacity was.
template <typename T>
void append(Ring<T>& ring, std::type_identity_t<T>&& value)
{
    constexpr std::size_t fewest = 8;
    if (ring.full())
        ring.set_capacity(std::max(fewest, 2 * ring.capacity()));
    ring.push_back(std::move(value));
}

/// After what was taken away: the memory of a long burst is given back. One that comes again and again, as answers to a window of questions
/// do, finds its own: it would be asked for, and all that waits moved, two or three times in each.
template <typename T>
void settle(Ring<T>& ring)
{
    constexpr std::size_t longest = 256; // of messages some 90 KiB
    if (ring.empty() && ring.capacity() > longest)
        ring.set_capacity(longest);
}

} // namespace liena::base
