// Counts what operator new is asked for. A program that names the counter has the operators replaced as a whole.
#pragma once

#include <atomic>

namespace swiftlet::test_support {

/// Since the start of the program.
extern std::atomic<long> allocations;

}  // namespace swiftlet::test_support
