// Counts what operator new is asked for, in the whole program. It replaces the operators, so one source of a program
// may include it, and no library.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

namespace swiftlet::test_support {

/// Since the start of the program.
inline std::atomic<long> allocations{0};

inline void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace swiftlet::test_support

void* operator new(std::size_t size) { return swiftlet::test_support::counted(size); }
void* operator new[](std::size_t size) { return swiftlet::test_support::counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
