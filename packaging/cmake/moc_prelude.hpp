// Read by moc before every file. moc skips <type_traits>, and what follows cannot be parsed unless this came first.
#include <cstddef>
