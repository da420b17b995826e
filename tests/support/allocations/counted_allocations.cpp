#include "tests/support/allocations/counted_allocations.hpp"

#include <cstdlib>
#include <new>

namespace swiftlet::test_support {

std::atomic<long> allocations{0};

namespace {

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace
}  // namespace swiftlet::test_support

void* operator new(std::size_t size) { return swiftlet::test_support::counted(size); }
void* operator new[](std::size_t size) { return swiftlet::test_support::counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
