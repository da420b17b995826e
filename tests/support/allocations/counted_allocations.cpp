#include "tests/support/allocations/counted_allocations.hpp"

#include <cstdlib>
#include <new>

namespace swiftlet::test_support {

std::atomic<long> allocations{0};

namespace {

void* counted(std::size_t size, const std::nothrow_t&) {
  ++allocations;
  return std::malloc(size == 0 ? 1 : size);
}
void* counted(std::size_t size) {
  if (void* memory = counted(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}

}  // namespace
}  // namespace swiftlet::test_support

void* operator new(std::size_t size) { return swiftlet::test_support::counted(size); }
void* operator new[](std::size_t size) { return swiftlet::test_support::counted(size); }
// std::stable_sort takes its buffer by these.
void* operator new(std::size_t size, const std::nothrow_t& tag) noexcept {
  return swiftlet::test_support::counted(size, tag);
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept {
  return swiftlet::test_support::counted(size, tag);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
