// Read by moc before every file: it leaves <type_traits> out, and without that header's first include the standard library cannot be parsed.
#include <cstddef>
